#include <particles/core/particle_operator.h>
#include <particles/sph/bent_walls.h>
#include <particles/sph/cell_sections.h>
#include <particles/sph/front_planes.h>
#include <particles/sph/square_lattice.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace meltfront::particles
{
  namespace
  {
    /** Spacings within which neighbours on a lattice lie in the cells about a particle.
     */
    constexpr double reach = 1.8;

    /** Cells along the side of the square (the cube) about a particle. */
    constexpr int side = 3;

    /** Two fronts' gradients cancel: a single front is in doubt below the second, and
     * excluded below the first part of the gradient of one along a lattice line. */
    constexpr double least_gradient = 0.4, sure_gradient = 0.8;

    /** Largest curvature that a lattice shows, per spacing. */
    constexpr double most_curved = 0.5;

    double dot(const std::array<double, 3> &a, const std::array<double, 3> &b)
    {
      return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    }

    /** Number of a step of -1, 0 or 1 cells in each direction. */
    std::uint32_t number_of(const std::array<long, 3> &step)
    {
      return static_cast<std::uint32_t>((step[0] + 1) * 9 + (step[1] + 1) * 3 + step[2]
                                        + 1);
    }
  } // namespace

  FrontPlanes::FrontPlanes(const Discretisation &dis)
    : dimension(dis.dimension)
    , sections(dis.particles.size())
  {
    for(double x : {-1., 0., 1.})
      for(double y : {-1., 0., 1.})
        for(double z : {-1., 0., 1.})
        {
          const double length = dis.spacing * std::hypot(x, y, z);
          steps.push_back({{x, y, z},
                           length > 0 && z * z <= dimension - 2
                               ? -dis.kernel.radial_derivative_over_distance(length)
                               : 0.});
        }
    steepest = std::transform_reduce(steps.begin(), steps.end(), 0., std::plus<>(),
                                     [](const Step &step)
                                     { return step.step[0] > 0 ? step.weight : 0.; });
    const SquareLattice square(dis);
    const NeighboursInSight in_sight(
        dis,
        NeighbourList(square.particles(), reach * dis.spacing, square.periodicity()));
    const NeighbourList &neighbours = in_sight.seen;
    const std::size_t n = dis.particles.size();
    find_images(square, dis.spacing, neighbours);
    std::vector<std::vector<std::uint32_t>> beyond(images.empty() ? 0 : n);
    for(std::size_t i = 0; i < images.size(); ++i)
    {
      const auto number = static_cast<std::uint32_t>(n + i);
      beyond[images[i].of].push_back(number);
      for(const std::uint32_t a : neighbours[images[i].of])
        beyond[a].push_back(number);
    }
    offsets.reserve(n + 1);
    links.reserve(neighbours.size());
    for(std::size_t a = 0; a < n; ++a)
    {
      offsets.push_back(links.size());
      const auto link = [&](std::uint32_t b, const cases::Position &place)
      {
        std::array<long, 3> step{};
        for(int d = 0; d < dimension; ++d)
          step[d] = std::lround(square.periodicity().shortest(
                                    d, place[d] - square.particles().position[d][a])
                                / dis.spacing);
        if(std::ranges::all_of(step, [](long cells) { return std::abs(cells) <= 1; }))
          links.push_back({b, number_of(step)});
      };
      for(const std::uint32_t b : neighbours[a])
        link(b, square.particles().point(b));
      if(!images.empty())
        for(const std::uint32_t image : beyond[a])
          link(image, images[image - n].place);
    }
    offsets.push_back(links.size());
    fraction.resize(n + images.size());
    distances.resize((n + ParticleOperator::lanes - 1) / ParticleOperator::lanes
                     * ParticleOperator::lanes);
    trusts.resize(distances.size());
  }

  /** Of the particles beside plane walls, in each wall and where walls meet. */
  void FrontPlanes::find_images(const SquareLattice &square, double spacing,
                                const NeighbourList &neighbours)
  {
    const ParticleStorage &particles = square.particles();
    const auto beside = [&](const PlaneWall &wall, const cases::Position &place)
    { return std::abs(place[wall.direction] - wall.coordinate) < 0.75 * spacing; };
    const auto inner_of = [&](std::uint32_t a, const PlaneWall &wall)
    {
      const cases::Position own = particles.point(a);
      for(const std::uint32_t b : neighbours[a])
      {
        const cases::Position place = particles.point(b);
        bool behind = std::abs(place[wall.direction] - wall.coordinate)
                          - std::abs(own[wall.direction] - wall.coordinate)
                      > 0.5 * spacing;
        for(int d = 0; d < dimension; ++d)
          behind = behind
                   && (d == wall.direction
                       || std::abs(square.periodicity().shortest(d, place[d] - own[d]))
                              < 0.5 * spacing);
        if(behind)
          return b;
      }
      return a;
    };
    // Each image is mirrored in the walls that follow those that it was mirrored in.
    const auto mirror = [&](const auto &self, const Image &image, std::size_t first,
                            unsigned directions) -> void
    {
      for(std::size_t i = first; i < square.walls().size(); ++i)
      {
        const PlaneWall &wall = square.walls()[i];
        if(directions >> wall.direction & 1 || !beside(wall, image.place))
          continue;
        Image beyond = image;
        beyond.place[wall.direction] = 2 * wall.coordinate - beyond.place[wall.direction];
        const bool driven = wall.boundary->kind != cases::BoundaryKind::insulated;
        if(directions == 0 || (driven && !image.driven))
          beyond.inner = inner_of(image.of, wall);
        beyond.driven = image.driven || driven;
        images.push_back(beyond);
        self(self, beyond, i + 1, directions | 1u << wall.direction);
      }
    };
    for(std::uint32_t a = 0; a < particles.size(); ++a)
      mirror(mirror, {a, a, false, particles.point(a)}, 0, 0);
  }

  /**
   * Insulated walls mirror the phases. A front sets out from a wall that lets heat
   * through, and ends there: beyond a particle that melts there is the phase that its
   * inner neighbour has less of.
   */
  double FrontPlanes::fraction_of(const Image &image) const
  {
    const double own = fraction[image.of], inner = fraction[image.inner];
    if(!image.driven || own == 0 || own == 1 || own == inner)
      return own;
    return inner < own ? 1 : 0;
  }

  void FrontPlanes::update(std::span<const std::uint32_t> slices, const double *enthalpy,
                           double latent_heat)
  {
    constexpr std::size_t lanes = ParticleOperator::lanes;
    const std::size_t n = sections.size();
    for(std::size_t a = 0; a < n; ++a)
      fraction[a] = 1 - std::clamp(enthalpy[a] / latent_heat, 0., 1.);
    for(std::size_t i = 0; i < images.size(); ++i)
      fraction[n + i] = fraction_of(images[i]);
    ++updates;
    const auto visit = [&](const auto &each)
    {
      for(const std::uint32_t slice : slices)
        for(std::size_t a = slice * lanes; a < std::min((slice + 1) * lanes, n); ++a)
          each(a);
    };
    visit([&](std::size_t a) { sections[a] = section_of(a); });
    visit([&](std::size_t a) { sections[a].curvature = curvature_of(a); });
    visit(
        [&](std::size_t a)
        {
          distances[a] = sections[a].distance - beyond_section(a);
          trusts[a] = sections[a].trust;
        });
  }

  FrontPlanes::Section FrontPlanes::section_of(std::size_t a) const
  {
    double sum = fraction[a];
    Vector gradient{};
    for(std::size_t i = offsets[a]; i < offsets[a + 1]; ++i)
    {
      const Step &step = steps[links[i].step];
      const double other = fraction[links[i].neighbour];
      sum += other;
      for(int d = 0; d < 3; ++d)
        gradient[d] -= step.weight * step.step[d] * (other - fraction[a]);
    }
    const double mean = sum / double(1 + offsets[a + 1] - offsets[a]);
    const double size = std::sqrt(dot(gradient, gradient));
    Section section{.trust = trust_in(a, mean, size), .update = updates};
    if(section.trust == 0)
      return section;
    for(int d = 0; d < 3; ++d)
      section.normal[d] = gradient[d] / size;
    const auto &[x, y, z] = section.normal;
    if(dimension == 2)
    {
      const double from_centre = line_through_square(mean, x, y);
      section.distance = -side * from_centre;
      section.size = side * length_in_square(from_centre, x, y);
    }
    else
    {
      const double from_centre = plane_through_cube(mean, section.normal);
      section.distance = -side * from_centre;
      section.size = side * side * area_in_cube(from_centre, section.normal);
    }
    return section;
  }

  /** Along a lattice line the cells before and behind are full and empty unless the front
   * lies in one of them: their difference is 1, or three times the rarer phase's part. */
  double FrontPlanes::trust_in(std::size_t a, double mean, double gradient) const
  {
    const std::size_t cells = dimension == 2 ? side * side : side * side * side;
    const double rarer = std::min(mean, 1 - mean);
    if(1 + offsets[a + 1] - offsets[a] < cells || rarer <= 0)
      return 0;
    const double part = gradient / (steepest * std::min(1., side * rarer));
    return std::clamp((part - least_gradient) / (sure_gradient - least_gradient), 0., 1.);
  }

  template <typename Visit>
  void FrontPlanes::visit_sections(std::size_t a, const Visit &visit) const
  {
    for(std::size_t i = offsets[a]; i < offsets[a + 1]; ++i)
    {
      if(links[i].neighbour >= sections.size()) // an image
        continue;
      const Section &other = sections[links[i].neighbour];
      if(other.update == updates && other.size > 0)
        visit(steps[links[i].step].step, other);
    }
  }

  double FrontPlanes::curvature_of(std::size_t a) const
  {
    const Section &own = sections[a];
    if(own.size == 0)
      return 0;
    double weight = own.trust, q = 0, r = 0, qq = 0, qr = 0;
    visit_sections(a,
                   [&](const Vector &step, const Section &other)
                   {
                     const double along = dot(own.normal, step);
                     const double bend = (dot(step, step) - along * along) / 2;
                     const double rest = other.distance - own.distance - along;
                     weight += other.trust;
                     q += other.trust * bend;
                     r += other.trust * rest;
                     qq += other.trust * bend * bend;
                     qr += other.trust * bend * rest;
                   });
    const double spread = weight * qq - q * q;
    if(!(spread > 1e-9))
      return 0;
    return std::clamp((weight * qr - q * r) / spread, -most_curved, most_curved);
  }

  /**
   * How far the middle of the arc lies beyond its line, towards the liquid. The curvature
   * is the mean of the neighbours': that of one particle would feed rows that melt in
   * turns, every other one ahead, and hold the front back.
   */
  double FrontPlanes::beyond_section(std::size_t a) const
  {
    const Section &own = sections[a];
    if(own.size == 0)
      return 0;
    double weight = own.trust, sum = own.trust * own.curvature;
    visit_sections(a,
                   [&](const Vector &, const Section &other)
                   {
                     weight += other.trust;
                     sum += other.trust * other.curvature;
                   });
    return sum / weight * (dimension == 2 ? own.size * own.size / 24 : own.size / 12);
  }

  std::size_t FrontPlanes::bytes() const
  {
    return offsets.size() * sizeof(offsets[0]) + links.size() * sizeof(Link)
           + (fraction.size() + 2 * distances.size()) * sizeof(double)
           + sections.size() * sizeof(Section) + images.size() * sizeof(Image);
  }
} // namespace meltfront::particles
