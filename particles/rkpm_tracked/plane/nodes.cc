#include <particles/rkpm_tracked/plane/nodes.h>

#include <cases/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    constexpr double two_pi = 2 * std::numbers::pi;

    /** Spacings that inner nodes keep from round walls. */
    constexpr double clearance = 0.5;

    /** Samples of a node's area along each direction. */
    constexpr int samples_across = 6;

    /** Spacings from where a node now is within which areas change by its move. */
    constexpr double area_reach = 3.5;

    constexpr double golden = 0.6180339887498949;

    int round_count(double length, double spacing)
    {
      return std::max(1, static_cast<int>(std::lround(length / spacing)));
    }
  } // namespace

  const WallPiece *WallNode::dirichlet() const
  {
    for(int i = 0; i < n_pieces; ++i)
      if(pieces[i].boundary->kind == cases::BoundaryKind::fixed_temperature)
        return &pieces[i];
    return nullptr;
  }

  PlaneNodes::PlaneNodes(const cases::Scene &scene, int n, const NodeLayout &layout)
    : scene(scene)
  {
    const cases::Domain &domain = scene.domain;
    if(domain.dimension != 2 || domain.shape == cases::DomainShape::slab)
      throw cases::Refusal("the plane form of rkpm-tracked needs a domain of two "
                           "dimensions: a box, a disk, an annulus or an outline");
    for(const cases::Side side : scene.sides())
      if(scene.boundary(side).kind == cases::BoundaryKind::periodic)
        throw cases::Refusal("rkpm-tracked does not simulate periodic walls");
    spacing = domain.side() / n;
    switch(domain.shape)
    {
    case cases::DomainShape::box:
      lay_box(n);
      break;
    case cases::DomainShape::outline:
      lay_outline(n);
      break;
    default:
      lay_rims(n);
    }
    const std::size_t inner = position.size() - walls.size();
    if(inner < 9)
      throw cases::Refusal(fmt::format("rkpm-tracked: {} nodes lie inside of the domain "
                                       "with n = {}; take a larger n",
                                       inner, n));
    displace(layout);
    bins = PlaneBins(position, spacing);
    share_area();
  }

  double PlaneNodes::wall_distance(const PlanePoint &point) const
  {
    const cases::Domain &domain = scene.domain;
    if(domain.outline)
    {
      const double distance = domain.outline->distance(position_of(point));
      return domain.outline->inside(position_of(point)) ? distance : -distance;
    }
    if(domain.round())
    {
      const double outer = domain.radius - point.norm();
      return domain.shape == cases::DomainShape::shell
                 ? std::min(outer, point.norm() - domain.inner_radius)
                 : outer;
    }
    return std::min((point - lower).minCoeff(), (upper - point).minCoeff());
  }

  void PlaneNodes::add_wall_node(const PlanePoint &place, const WallNode &wall)
  {
    walls.push_back(wall);
    walls.back().node = static_cast<std::uint32_t>(position.size());
    wall_of_node.push_back(static_cast<std::int32_t>(walls.size() - 1));
    position.push_back(place);
  }

  void PlaneNodes::lay_box(int n)
  {
    lower = {scene.domain.lower[0], scene.domain.lower[1]};
    upper = {scene.domain.upper[0], scene.domain.upper[1]};
    const PlanePoint size = upper - lower;
    area = size.prod();
    const std::array<int, 2> count{n, round_count(size.y(), spacing)};
    const PlanePoint step(size.x() / count[0], size.y() / count[1]);
    for(int j = 0; j <= count[1]; ++j)
      for(int i = 0; i <= count[0]; ++i)
      {
        // Whole numbers of steps from the nearer wall: mirror images are exact.
        const std::array<int, 2> index{i, j};
        PlanePoint place;
        WallNode wall;
        wall.n_pieces = 0;
        for(int d = 0; d < 2; ++d)
        {
          place[d] = 2 * index[d] <= count[d]
                         ? lower[d] + index[d] * step[d]
                         : upper[d] - (count[d] - index[d]) * step[d];
          if(index[d] != 0 && index[d] != count[d])
            continue;
          WallPiece &piece = wall.pieces[wall.n_pieces++];
          const bool last = index[d] == count[d];
          piece.boundary = &scene.boundary(static_cast<cases::Side>(2 * d + last));
          piece.normal = PlanePoint(0, 0);
          piece.normal[d] = last ? 1 : -1;
          const int other = 1 - d;
          const bool end = index[other] == 0 || index[other] == count[other];
          piece.length = end ? step[other] / 2 : step[other];
        }
        if(wall.n_pieces > 0)
          add_wall_node(place, wall);
        else
        {
          position.push_back(place);
          wall_of_node.push_back(-1);
        }
      }
  }

  void PlaneNodes::lay_rims(int)
  {
    const cases::Domain &domain = scene.domain;
    const bool shell = domain.shape == cases::DomainShape::shell;
    upper = PlanePoint(domain.radius, domain.radius);
    lower = -upper;
    area = std::numbers::pi * domain.radius * domain.radius;
    if(shell)
      area -= std::numbers::pi * domain.inner_radius * domain.inner_radius;
    const auto lay = [&](double radius, cases::Side side, double direction)
    {
      const int count = std::max(8, round_count(two_pi * radius, spacing));
      for(int i = 0; i < count; ++i)
      {
        const double phi = two_pi * i / count;
        const PlanePoint away(std::cos(phi), std::sin(phi));
        WallNode wall;
        wall.pieces[0]
            = {&scene.boundary(side), direction * away, two_pi * radius / count};
        add_wall_node(radius * away, wall);
      }
    };
    lay(domain.radius, cases::Side::outer, 1);
    if(shell)
      lay(domain.inner_radius, cases::Side::inner, -1);
    fill_inside(PlanePoint(spacing / 2, spacing / 2), clearance * spacing);
  }

  void PlaneNodes::lay_outline(int)
  {
    const cases::Outline &outline = *scene.domain.outline;
    lower = {outline.lower()[0], outline.lower()[1]};
    upper = {outline.upper()[0], outline.upper()[1]};
    area = outline.area();
    std::vector<double> corners = outline.corner_arc_lengths();
    if(corners.empty())
      corners.push_back(0);
    const double whole = outline.perimeter();
    for(std::size_t c = 0; c < corners.size(); ++c)
    {
      const double from = corners[c],
                   to = c + 1 < corners.size() ? corners[c + 1] : corners[0] + whole;
      const int count = std::max(2, round_count(to - from, spacing));
      const double step = (to - from) / count;
      for(int i = 0; i < count; ++i)
      {
        const double at = from + i * step, reach = 0.25 * std::min(step, spacing);
        const cases::Position place = outline.at(at), before = outline.at(at - reach),
                              after = outline.at(at + reach);
        const PlanePoint along(after[0] - before[0], after[1] - before[1]);
        WallNode wall;
        wall.pieces[0] = {&scene.boundary(cases::Side::outer),
                          PlanePoint(along.y(), -along.x()).normalized(), step};
        add_wall_node({place[0], place[1]}, wall);
      }
    }
    const PlanePoint centre(outline.centre()[0], outline.centre()[1]);
    fill_inside(centre + PlanePoint(spacing / 2, spacing / 2), clearance * spacing);
  }

  void PlaneNodes::fill_inside(const PlanePoint &origin, double least_wall_distance)
  {
    const auto first = [&](int d)
    { return static_cast<long>(std::floor((lower[d] - origin[d]) / spacing)); };
    const auto last = [&](int d)
    { return static_cast<long>(std::ceil((upper[d] - origin[d]) / spacing)); };
    for(long j = first(1); j <= last(1); ++j)
      for(long i = first(0); i <= last(0); ++i)
      {
        // Written so that the lattice is its own mirror image about the centre.
        const PlanePoint centre = origin - PlanePoint(spacing / 2, spacing / 2);
        const PlanePoint place = centre
                                 + spacing
                                       * PlanePoint(static_cast<double>(i) + 0.5,
                                                    static_cast<double>(j) + 0.5);
        if(wall_distance(place) < least_wall_distance)
          continue;
        position.push_back(place);
        wall_of_node.push_back(-1);
      }
  }

  void PlaneNodes::displace(const NodeLayout &layout)
  {
    if(layout.jitter == 0)
      return;
    std::mt19937_64 generator(layout.seed);
    const auto draw
        = [&] { return 2 * static_cast<double>(generator() >> 11) * 0x1p-53 - 1; };
    for(std::size_t i = 0; i < size(); ++i)
    {
      if(wall_of_node[i] >= 0)
        continue;
      const double x = draw(), y = draw();
      const PlanePoint place = position[i] + layout.jitter * spacing * PlanePoint(x, y);
      if(wall_distance(place) >= clearance * spacing)
        position[i] = place;
    }
  }

  void PlaneNodes::move(const std::vector<PlanePoint> &places)
  {
    std::vector<PlanePoint> moved;
    for(std::size_t i = 0; i < size(); ++i)
      if(places[i] != position[i])
        moved.push_back(places[i]);
    position = places;
    bins = PlaneBins(position, spacing);
    const PlaneBins moved_bins(moved, spacing);
    std::vector<std::vector<PlanePoint>> of_node(size());
    std::vector<PlanePoint> free;
    for(std::size_t i = 0; i < size(); ++i)
    {
      bool touched = false;
      moved_bins.visit(position[i], area_reach * spacing,
                       [&](std::uint32_t, double) { touched = true; });
      const auto begin = samples.begin() + static_cast<long>(sample_offsets[i]);
      const auto end = samples.begin() + static_cast<long>(sample_offsets[i + 1]);
      auto &kept = touched ? free : of_node[i];
      kept.insert(kept.end(), begin, end);
    }
    assign(free, of_node);
    gather_samples(of_node);
  }

  void PlaneNodes::share_area()
  {
    sample_spacing = spacing / samples_across;
    const PlanePoint size = upper - lower;
    const long across = static_cast<long>(std::ceil(size.x() / sample_spacing - 1e-9));
    const long along = static_cast<long>(std::ceil(size.y() / sample_spacing - 1e-9));
    lattice.columns = across;
    lattice.rows = along;
    lattice.step
        = {size.x() / static_cast<double>(across), size.y() / static_cast<double>(along)};
    lattice.first = lower + lattice.step / 2;
    lattice.inside.resize(across * along);
    std::vector<PlanePoint> inside;
    for(std::size_t s = 0; s < lattice.inside.size(); ++s)
    {
      const PlanePoint sample = lattice.place(s);
      lattice.inside[s] = wall_distance(sample) > 0;
      if(lattice.inside[s])
        inside.push_back(sample);
    }
    std::vector<std::vector<PlanePoint>> of_node(position.size());
    assign(inside, of_node);
    gather_samples(of_node);
  }

  /** Give samples to the nodes that are nearest. */
  void PlaneNodes::assign(const std::vector<PlanePoint> &free,
                          std::vector<std::vector<PlanePoint>> &of_node) const
  {
    // Off the lattice's own lines of symmetry, so that no sample is undecided.
    const PlanePoint nudge = 1e-7 * spacing * PlanePoint(golden, 1 - golden);
    for(const PlanePoint &sample : free)
      of_node[bins.nearest(sample + nudge)].push_back(sample);
  }

  void PlaneNodes::gather_samples(const std::vector<std::vector<PlanePoint>> &of_node)
  {
    samples.clear();
    sample_offsets.assign(1, 0);
    for(const auto &own : of_node)
    {
      samples.insert(samples.end(), own.begin(), own.end());
      sample_offsets.push_back(samples.size());
    }
    weight.resize(position.size());
    centroid = position;
    for(std::size_t i = 0; i < weight.size(); ++i)
    {
      const auto own = static_cast<double>(of_node[i].size());
      weight[i] = area * own / static_cast<double>(samples.size());
      if(own > 0)
        centroid[i]
            = std::accumulate(of_node[i].begin(), of_node[i].end(), PlanePoint(0, 0))
              / own;
    }
  }
} // namespace meltfront::particles::rkpm_tracked
