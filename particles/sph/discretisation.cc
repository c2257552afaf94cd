#include <cases/domain_measure.h>
#include <cases/error.h>
#include <particles/relaxation/lennard_jones.h>
#include <particles/sph/discretisation.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace meltfront::particles
{
  using cases::Boundary;
  using cases::BoundaryKind;
  using cases::DomainShape;
  using cases::Side;

  namespace
  {
    double power(double base, int exponent)
    {
      return exponent == 0 ? 1. : base * power(base, exponent - 1);
    }

    /** Particles across the strip that stands for a slab: two radii of interaction wide.
     */
    int columns_needed(const SmoothingKernel &kernel, double spacing)
    {
      return static_cast<int>(std::ceil(2 * kernel.support() / spacing - 1e-9));
    }

    /** Least distance of particles from a round wall whose temperature is given on it
     * alone, in spacings. */
    constexpr double nearest_to_wall = 0.25;
    /** Of a spacing: by how much a side may miss a whole number of them. */
    constexpr double fits = 1e-6;
    /** Fewest cells of a side that are stretched so that they fill it. */
    constexpr double fewest_stretched = 4;
    /** Over a cell: what a particle beside a round wall stands for at least. */
    constexpr double least_share = 0.25;

    /** Particles must not act on each other across a hole, nor ghosts lie at its centre.
     */
    void require_resolved(const cases::Domain &domain, double spacing, double support)
    {
      const double thickness = domain.radius - domain.inner_radius;
      if(domain.inner_radius < support * (1 - 1e-9))
        throw cases::Refusal(fmt::format(
            "an inner wall of radius {:.6g} m is too narrow for particles that act over "
            "{:.6g} m: take n at least {:.3g} times as large",
            domain.inner_radius, support, support / domain.inner_radius));
      if(thickness < 4 * spacing * (1 - 1e-9))
        throw cases::Refusal(fmt::format(
            "a shell {:.6g} m thick holds fewer than four particle spacings of {:.6g} m: "
            "take n at least {:.3g} times as large",
            thickness, spacing, 4 * spacing / thickness));
    }
  } // namespace

  double RoundWall::conductive_depth(double distance, int dimension) const
  {
    const double ratio = distance / radius;
    const double outwards = radius * (dimension == 2 ? std::log(ratio) : 1 - 1 / ratio);
    return inner ? outwards : -outwards;
  }

  double RoundWall::area(int dimension) const
  {
    return std::numbers::pi * radius * (dimension == 2 ? 2. : 4 * radius);
  }

  double RoundWall::enclosed(int dimension) const
  {
    return area(dimension) * radius / dimension;
  }

  cases::Position PlaneWall::project(cases::Position position) const
  {
    position[direction] = coordinate;
    return position;
  }

  Discretisation::Discretisation(const cases::Scene &scene, const SphParameters &p)
    : scene(scene)
    , dimension(p.dimension)
    , layout(p.layout)
    , spacing(lattice_spacing(scene.domain.side(), p.n, p.layout))
    , cell{spacing, spacing, spacing}
    , kernel(p.kernel, p.dimension, p.smoothing_length * spacing)
    , displaced(p.jitter > 0 || p.arrangement >= Arrangement::random)
    , particle_volume(power(spacing, p.dimension))
    , cross_section(1)
  {
    particles.dimension = ghosts.dimension = dimension;
    if(scene.domain.round())
      fill_ball_or_shell();
    else if(scene.domain.outline)
      fill_outline();
    else
      fill_slab_or_box(p);
    disturb(p);
    reorder(particles, order_along_curve(particles, spacing));
    weights.assign(particles.size(), particle_volume / cross_section);
    if(!p.whole_cells)
      share_what_cells_miss();
    if(scene.domain.shape == DomainShape::axisymmetric)
      turn_about_axis(p);
    find_dirichlet_particles();
    own.end = own.all = particles.size();
  }

  void Discretisation::keep(std::span<const std::uint32_t> numbers, OwnParticles mine)
  {
    reorder(particles, numbers);
    weights.resize(numbers.size()); // all alike
    weights.shrink_to_fit();
    own = std::move(mine);
  }

  /** Each particle stands for a ring.
   * @throws cases::Refusal for particles that reach farther than the next of a lattice,
   * across the axis or past a wall, where pairs have no middle */
  void Discretisation::turn_about_axis(const SphParameters &p)
  {
    if(p.layout != LatticeLayout::cell_centred || displaced
       || kernel.support() > 2 * spacing * (1 + 1e-9))
      throw cases::Refusal("about an axis particles need a lattice (layout = cell, "
                           "jitter = 0) and a kernel that reaches the next ones alone "
                           "(smoothing_length)");
    for(std::size_t i = 0; i < particles.size(); ++i)
    {
      const double circumference = 2 * std::numbers::pi * particles.position[0][i];
      weights[i] *= circumference;
      wall_cells.push_back({static_cast<std::uint32_t>(i), circumference});
    }
  }

  /** Particles beside walls that bend stand for what the cells leave out. */
  void Discretisation::share_what_cells_miss()
  {
    for(const RoundWall &wall : round_walls)
      share_the_rest(wall);
    if(const auto &outline = scene.domain.outline)
      share_beside_wall([&outline](const cases::Position &place)
                        { return outline->distance(place); },
                        outline->area() - particles.size() * particle_volume);
  }

  /** Jitter the particles, but for those on walls, and relax them if that is wanted. */
  void Discretisation::disturb(const SphParameters &p)
  {
    if(!displaced)
      return;
    if(p.arrangement >= Arrangement::random)
    {
      scatter_in_box(p);
      return;
    }
    const auto movable = [this](const cases::Position &position)
    {
      if(layout == LatticeLayout::cell_centred)
        return true;
      for(const PlaneWall &wall : walls)
        if(std::abs(position[wall.direction] - wall.coordinate) < 1e-6 * spacing)
          return false;
      return true;
    };
    jitter(particles, p.jitter * spacing, p.seed, movable);
    if(p.arrangement != Arrangement::relaxed)
      return;
    if(scene.domain.outline)
      throw cases::Refusal(
          "particles within an outline are not relaxed: nothing holds them inside");
    RelaxationBounds bounds{periodicity, {}, {dimension, {}}, movable};
    for(const PlaneWall &wall : walls)
      bounds.mirrors.push_back({wall.direction, wall.coordinate,
                                wall.coordinate > scene.domain.lower[wall.direction]});
    for(const RoundWall &wall : round_walls)
      add_points_beyond(wall, bounds.fixed);
    relaxation = relax(particles, kernel, spacing, bounds);
  }

  /** Three rows of the lattice of cells outside of a box. */
  ParticleStorage Discretisation::lattice_around_box() const
  {
    constexpr int rows = 3;
    std::array<LatticeDirection, 3> wider;
    for(int d = 0; d < dimension; ++d)
      wider[d] = {scene.domain.lower[d] - rows * spacing,
                  scene.domain.upper[d] + rows * spacing, LatticeLayout::cell_centred};
    const ParticleStorage all = arrange_in_box(dimension, wider, spacing);
    ParticleStorage around{dimension, {}};
    for(std::size_t i = 0; i < all.size(); ++i)
    {
      bool inside = true;
      for(int d = 0; d < dimension; ++d)
        inside = inside && all.position[d][i] > scene.domain.lower[d]
                 && all.position[d][i] < scene.domain.upper[d];
      if(!inside)
        around.add(all.point(i));
    }
    return around;
  }

  void Discretisation::scatter_in_box(const SphParameters &p)
  {
    bool periodic = false;
    for(const double period : periodicity.period)
      periodic = periodic || period > 0;
    if(layout != LatticeLayout::cell_centred || periodic || scene.domain.round()
       || scene.domain.outline)
      throw cases::Refusal(
          "random particles need a slab in one dimension or a box without "
          "periodic walls, in the cell layout");
    std::vector<std::uint32_t> all(particles.size());
    std::iota(all.begin(), all.end(), 0U);
    scatter(particles, all, scene.domain.lower, scene.domain.upper, p.seed);
    if(p.arrangement != Arrangement::minimised)
      return;
    LennardJonesRelaxation how;
    how.potential.length = spacing;
    descent = relax_by_lennard_jones(particles, lattice_around_box(),
                                     {dimension, scene.domain.lower, scene.domain.upper},
                                     how);
  }

  bool Discretisation::stretched() const
  {
    return cell[0] != spacing || cell[1] != spacing || cell[2] != spacing;
  }

  /**
   * What moves particles from the lattice, or sums over kernels as published, takes
   * squares.
   * @throws cases::InputError where the sides of a box are no whole numbers of these,
   * cases::Refusal where one is so short that a cell would be stretched by more than an
   * eighth
   */
  void Discretisation::fit_cells(const SphParameters &p)
  {
    if(scene.domain.shape == DomainShape::slab || displaced || p.whole_cells
       || !p.moment_correction || p.layout != LatticeLayout::cell_centred)
      return require_whole_cells(p);
    for(int d = 0; d < dimension; ++d)
    {
      const double length = scene.domain.upper[d] - scene.domain.lower[d];
      const double cells = length / spacing, whole = std::round(cells);
      if(std::abs(cells - whole) <= fits)
        continue;
      if(whole < fewest_stretched)
        throw cases::Refusal(fmt::format(
            "with n = {3} a side of {0:.6g} m is {1:.3g} particle spacings long, "
            "and fewer than four must be a whole number: take n at least {2}",
            length, cells, std::ceil(fewest_stretched / cells * p.n), p.n));
      cell[d] = length / whole;
    }
    if(stretched())
      particle_volume = std::accumulate(cell.begin(), cell.begin() + dimension, 1.,
                                        std::multiplies<>());
  }

  /** @throws cases::InputError with the next n at which a lattice fills the box */
  void Discretisation::require_whole_cells(const SphParameters &p) const
  {
    const int step = cases::fewest_whole_cells(scene.domain);
    const int on_walls = p.layout == LatticeLayout::on_edge ? 1 : 0;
    if((p.n - on_walls) % step != 0)
      throw cases::InputError(fmt::format(
          "with n = {} not all sides of the box are whole numbers of particle spacings; "
          "n = {} fits",
          p.n, (p.n - on_walls + step - 1) / step * step + on_walls));
  }

  void Discretisation::fill_slab_or_box(const SphParameters &p)
  {
    const bool slab = scene.domain.shape == DomainShape::slab;
    fit_cells(p);
    std::array<LatticeDirection, 3> directions;
    for(int d = 0; d < dimension; ++d)
    {
      const bool across = slab && d > 0;
      const int columns = p.columns > 0 ? p.columns : columns_needed(kernel, spacing);
      const double lower = across ? 0 : scene.domain.lower[d];
      const double upper = across ? columns * spacing : scene.domain.upper[d];
      bool periodic = across;
      for(int s = 2 * d; s <= 2 * d + 1 && !across; ++s)
      {
        const Boundary &boundary = scene.boundary(static_cast<Side>(s));
        if(boundary.kind == BoundaryKind::periodic)
          periodic = true;
        else
          walls.push_back({&boundary, d, s == 2 * d ? lower : upper});
      }
      directions[d]
          = {lower, upper, periodic ? LatticeLayout::cell_centred : p.layout, cell[d]};
      if(periodic)
        periodicity.period[d] = upper - lower;
      if(across)
        cross_section *= upper - lower;
    }
    particles = arrange_in_box(dimension, directions, spacing);
  }

  void Discretisation::fill_ball_or_shell()
  {
    const cases::Domain &domain = scene.domain;
    round_walls.push_back({&scene.boundary(Side::outer), domain.radius, false});
    double innermost = 0;
    if(domain.shape == DomainShape::shell)
    {
      require_resolved(domain, spacing, kernel.support());
      round_walls.push_back({&scene.boundary(Side::inner), domain.inner_radius, true});
      innermost = domain.inner_radius + least_depth(round_walls.back());
    }
    particles = arrange_in_shell(dimension, innermost,
                                 domain.radius - least_depth(round_walls.front()),
                                 spacing, layout);
    for(const RoundWall &wall : round_walls)
      if(wall.boundary->kind != BoundaryKind::insulated)
        add_points_beyond(wall, ghosts);
  }

  /**
   * How far from a round wall the particles begin. Where a temperature is given on the
   * wall alone, lines through it and a particle tell less the nearer the particle is.
   */
  double Discretisation::least_depth(const RoundWall &wall) const
  {
    const bool on_the_wall_alone
        = wall.boundary->kind == BoundaryKind::fixed_temperature && !wall.known_beyond();
    return on_the_wall_alone ? nearest_to_wall * spacing : 0;
  }

  void Discretisation::add_points_beyond(const RoundWall &wall,
                                         ParticleStorage &points) const
  {
    const double reach = kernel.support() * (1 - 1e-9), gap = least_depth(wall);
    const ParticleStorage beyond
        = wall.inner ? arrange_in_shell(dimension, wall.radius - reach, wall.radius + gap,
                                        spacing, layout)
                     : arrange_in_shell(dimension, wall.radius - gap, wall.radius + reach,
                                        spacing, layout);
    for(std::size_t i = 0; i < beyond.size(); ++i)
      points.add(beyond.point(i));
  }

  void Discretisation::share_the_rest(const RoundWall &wall)
  {
    const double innermost_other
        = wall.inner ? wall.radius + least_depth(wall) : wall.radius - least_depth(wall);
    const double cells
        = arrange_in_shell(dimension, 0, innermost_other, spacing, layout).size();
    const double missing = wall.enclosed(dimension) - cells * particle_volume;
    share_beside_wall([&wall](const cases::Position &place)
                      { return wall.depth(std::hypot(place[0], place[1], place[2])); },
                      wall.inner ? -missing : missing);
  }

  void Discretisation::share_beside_wall(
      const std::function<double(const cases::Position &)> &depth, double missing)
  {
    std::vector<std::uint32_t> nearest;
    for(std::size_t i = 0; i < particles.size(); ++i)
      if(depth(particles.point(i)) < spacing)
        nearest.push_back(static_cast<std::uint32_t>(i));
    const double added = missing / nearest.size();
    const double share = 1 + added / particle_volume;
    if(!(share > least_share))
      throw cases::Refusal(
          fmt::format("a lattice of spacing {:.6g} m does not fill the domain: the "
                      "particles beside its wall stand for {:.3g} of a cell each",
                      spacing, share));
    for(const std::uint32_t i : nearest)
    {
      weights[i] += added;
      wall_cells.push_back({i, share});
    }
  }

  const RoundWall &Discretisation::nearest_round_wall(double distance) const
  {
    return *std::ranges::min_element(round_walls, {},
                                     [distance](const RoundWall &wall)
                                     { return std::abs(wall.depth(distance)); });
  }

  /** Points of the lattice of cells about the outline's centre: those inside are
   * particles, those as far beyond the wall as particles reach hold its values. */
  void Discretisation::fill_outline()
  {
    const cases::Outline &outline = *scene.domain.outline;
    const BoundaryKind kind = scene.boundary(Side::outer).kind;
    const double reach
        = kind == BoundaryKind::insulated ? 0 : kernel.support() * (1 - 1e-9);
    const double gap
        = kind == BoundaryKind::fixed_temperature ? nearest_to_wall * spacing : 0;
    std::array<std::vector<double>, 2> line;
    for(int d = 0; d < 2; ++d)
    {
      const double middle = outline.centre()[d];
      const auto index = [&](double coordinate)
      { return static_cast<int>(std::floor((coordinate - middle) / spacing)); };
      const int last = index(outline.upper()[d] + reach);
      for(int i = index(outline.lower()[d] - reach); i <= last; ++i)
        line[d].push_back(middle + (i + 0.5) * spacing);
    }
    for(const double y : line[1])
      for(const double x : line[0])
      {
        const cases::Position place{x, y, 0};
        const double distance = reach > 0 ? outline.distance(place) : 0;
        if(outline.inside(place) && distance >= gap)
          particles.add(place);
        else if(distance < reach)
          ghosts.add(place);
      }
    if(particles.size() == 0)
      throw cases::Refusal(fmt::format(
          "no particle of a lattice of spacing {:.6g} m lies within the outline",
          spacing));
  }

  bool Discretisation::on_wall(const PlaneWall &wall, std::size_t particle) const
  {
    return std::abs(particles.position[wall.direction][particle] - wall.coordinate)
           < 1e-6 * spacing;
  }

  void Discretisation::find_dirichlet_particles()
  {
    if(layout == LatticeLayout::cell_centred)
      return;
    for(std::size_t i = 0; i < particles.size(); ++i)
    {
      bool holds = false;
      for(const PlaneWall &wall : walls)
        if(wall.boundary->kind == BoundaryKind::fixed_temperature && on_wall(wall, i))
        {
          holds = true;
          weights[i] *= 0.5; // half of its cell lies outside the domain
        }
      if(holds)
        dirichlet.push_back(i);
    }
  }
} // namespace meltfront::particles
