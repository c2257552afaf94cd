#include <cases/error.h>
#include <particles/relaxation/lennard_jones.h>
#include <particles/sph/discretisation.h>

#include <fmt/format.h>

#include <cmath>
#include <numeric>

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
  } // namespace

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
    , kernel(p.kernel, p.dimension, p.smoothing * spacing)
    , displaced(p.jitter > 0 || p.arrangement >= Arrangement::random)
    , particle_volume(power(spacing, p.dimension))
    , cross_section(1)
  {
    particles.dimension = ghosts.dimension = dimension;
    if(scene.domain.shape == DomainShape::ball)
      fill_ball();
    else if(scene.domain.outline)
      fill_outline();
    else
      fill_slab_or_box(p);
    disturb(p);
    reorder(particles, order_along_curve(particles, spacing));
    weights.assign(particles.size(), particle_volume / cross_section);
    find_held_particles();
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
    if(scene.domain.shape == DomainShape::ball)
      bounds.fixed
          = arrange_in_shell(dimension, scene.domain.radius,
                             scene.domain.radius + kernel.support(), spacing, layout);
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

  void Discretisation::fill_slab_or_box(const SphParameters &p)
  {
    const bool slab = scene.domain.shape == DomainShape::slab;
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
      directions[d] = {lower, upper, periodic ? LatticeLayout::cell_centred : p.layout};
      if(periodic)
        periodicity.period[d] = upper - lower;
      if(across)
        cross_section *= upper - lower;
    }
    particles = arrange_in_box(dimension, directions, spacing);
  }

  void Discretisation::fill_ball()
  {
    const double radius = scene.domain.radius;
    particles = arrange_in_shell(dimension, 0, radius, spacing, layout);
    if(scene.boundary(Side::outer).kind != BoundaryKind::insulated)
      ghosts = arrange_in_shell(dimension, radius, radius + kernel.support(), spacing,
                                layout);
  }

  /** Points of the lattice of cells about the outline's centre that lie inside. */
  void Discretisation::fill_outline()
  {
    const cases::Outline &outline = *scene.domain.outline;
    std::array<std::vector<double>, 2> line;
    for(int d = 0; d < 2; ++d)
    {
      const double middle = outline.centre()[d];
      const auto index = [&](double coordinate)
      { return static_cast<int>(std::floor((coordinate - middle) / spacing)); };
      const int last = index(outline.upper()[d]);
      for(int i = index(outline.lower()[d]); i <= last; ++i)
        line[d].push_back(middle + (i + 0.5) * spacing);
    }
    for(const double y : line[1])
      for(const double x : line[0])
        if(outline.inside({x, y, 0}))
          particles.add({x, y, 0});
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

  void Discretisation::find_held_particles()
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
        held.push_back(i);
    }
  }
} // namespace meltfront::particles
