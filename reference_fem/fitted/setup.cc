#include <reference_fem/fitted/setup.h>

#include <cases/error.h>

#include <boost/math/tools/toms748_solve.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace meltfront::reference_fem::fitted
{
  namespace
  {
    using cases::BoundaryKind;
    using cases::DomainShape;
    using cases::Effect;
    using cases::Refusal;
    using cases::Side;
    using cases::Symmetry;

    /** Points of a ray at which a front is looked for: of the one of a line, and of each
     * of many. */
    constexpr int samples_on_line = 4096, samples_on_ray = 256;

    /** Nearer to the melting temperature, of the largest |T - T_m|, is at it. */
    constexpr double round_off = 1e-12;

    /** Temperatures are told to no less than this share of what latent heat would heat.
     */
    constexpr double least_scale = 1e-6;

    /** Smallest cell of a phase, of the phase's length: places on the ray are known to
     * 1e-16 of it, and a cell's width is to be known to six digits. */
    constexpr double smallest_cell = 1e-10;

    /** The first and the last of them, off the walls by this share of the ray: a wall may
     * be at the melting temperature. */
    constexpr double next_to_wall = 1e-9;

    int cells_across(const cases::Domain &domain, int d, int n)
    {
      const double width = domain.upper[d] - domain.lower[d];
      return std::max(1, static_cast<int>(std::lround(n * width / domain.side())));
    }

    /** Walls beside the rays are insulated or periodic. */
    bool is_periodic(const cases::Scene &scene, Side lower, Side upper)
    {
      bool periodic = true;
      for(const Side side : {lower, upper})
      {
        const BoundaryKind kind = scene.boundary(side).kind;
        if(kind != BoundaryKind::insulated && kind != BoundaryKind::periodic)
          throw Refusal(fmt::format("fem-fitted has rays along x and takes walls beside "
                                    "them that are insulated or periodic; {} is neither",
                                    to_string(side)));
        periodic = periodic && kind == BoundaryKind::periodic;
      }
      return periodic;
    }

    FrontSurface surface_of(const cases::Scene &scene, const RunOptions &options)
    {
      using std::numbers::pi;
      const cases::Domain &domain = scene.domain;
      const int n = options.cells;
      if(options.dimension == 1)
        return scene.symmetry == Symmetry::cylindrical
                   ? FrontSurface::point(options.degree, 2 * pi, 1)
               : scene.symmetry == Symmetry::spherical
                   ? FrontSurface::point(options.degree, 4 * pi, 2)
                   : FrontSurface::point(options.degree, 1, 0);
      if(domain.round())
        return options.dimension == 2
                   ? FrontSurface::circle(options.degree,
                                          std::max(2, options.cells_around))
                   : FrontSurface::sphere(options.degree,
                                          std::max(1, options.cells_around / 4));
      const bool periodic_y = is_periodic(scene, Side::y_min, Side::y_max);
      if(options.dimension == 2)
        return FrontSurface::line(options.degree, cells_across(domain, 1, n),
                                  domain.lower[1], domain.upper[1], periodic_y);
      return FrontSurface::rectangle(
          options.degree, {cells_across(domain, 1, n), cells_across(domain, 2, n)},
          domain.lower, domain.upper,
          {periodic_y, is_periodic(scene, Side::z_min, Side::z_max)});
    }
  } // namespace

  cases::Side side_at(const cases::Scene &scene, bool inner)
  {
    if(scene.domain.round())
      return inner ? Side::inner : Side::outer;
    return inner ? Side::x_min : Side::x_max;
  }

  RayScene rays_of(const cases::Scene &scene, const RunOptions &options)
  {
    const cases::Domain &domain = scene.domain;
    RayScene result{surface_of(scene, options)};
    result.inner = domain.shape == DomainShape::shell  ? domain.inner_radius
                   : domain.shape == DomainShape::ball ? 0
                                                       : domain.lower[0];
    result.outer = domain.round() ? domain.radius : domain.upper[0];
    const double share = (result.outer - result.inner) / domain.side();
    result.cells = std::max(2, static_cast<int>(std::lround(options.cells * share)));
    return result;
  }

  RayMesh mesh_between_fronts(const RayScene &rays, unsigned int fronts, double grading)
  {
    const int inside = rays.cells / 2;
    const int most = rays.cells - inside;
    if(grading > 1 && fronts > 1)
      throw Refusal(
          fmt::format("fem-fitted.grading = {:g} draws cells to one front; here "
                      "are {}",
                      grading, fronts));
    // Of cells r^0 ... r^(m-1) the smallest is (r - 1)/(r^m - 1) of all.
    const double smallest = std::log(grading - 1) - most * std::log(grading);
    if(grading > 1 && smallest < std::log(smallest_cell))
      throw Refusal(fmt::format(
          "fem-fitted.grading = {:g} with {} cells in a phase makes the smallest of them "
          "1e{:.0f} of the phase, and they may not be smaller than {:g}: take a smaller "
          "grading or fewer cells",
          grading, most, smallest / std::log(10.), smallest_cell));
    std::vector<std::vector<double>> shares;
    for(unsigned int interval = 0; interval < fronts; ++interval)
      shares.push_back(graded_shares(inside, grading, false));
    shares.push_back(graded_shares(most, grading, true));
    return {rays.surface, rays.inner, rays.outer, shares};
  }

  namespace
  {
    void set_walls(const cases::Scene &scene, Physics &physics)
    {
      if(scene.domain.shape != DomainShape::ball)
        physics.inner_wall = scene.boundary(side_at(scene, true));
      physics.outer_wall = scene.boundary(side_at(scene, false));
      for(const cases::Boundary *wall : {&physics.inner_wall, &physics.outer_wall})
        if(wall->kind == BoundaryKind::periodic)
          throw Refusal("fem-fitted follows rays along x from wall to wall, which cannot "
                        "be periodic");
    }

    void set_source(const cases::Scene &scene, Physics &physics)
    {
      if(scene.sources.size() != 1 || scene.domain.shape != DomainShape::ball
         || scene.sources[0].position != cases::Position{})
        throw Refusal("fem-fitted takes one source, at the centre of a ball");
      physics.power = scene.sources[0].power;
    }

    /** Of what the scene gives: how far the initial state, held walls and surroundings
     * are from the melting temperature, whatever fluxes and sources may add to it; not so
     * little that latent heat's rounding is more. */
    double temperature_scale(const cases::Scene &scene)
    {
      cases::Scene given = scene;
      given.sources.clear();
      given.volumetric_source.reset();
      for(std::optional<cases::Boundary> &boundary : given.boundaries)
        if(boundary && boundary->kind == BoundaryKind::flux)
          boundary = cases::Boundary{};
      const cases::TemperatureBounds bounds = cases::temperature_bounds(given);
      const double by_latent_heat
          = scene.material.latent_heat / scene.material.solid.specific_heat_capacity;
      double scale = 0;
      for(const double bound : {bounds.lower, bounds.upper})
        if(std::isfinite(bound))
          scale = std::max(scale, std::abs(bound - scene.material.melting_temperature));
      return scale > 0 ? std::max(scale, least_scale * by_latent_heat) : by_latent_heat;
    }

    Clock clock_of(const cases::Scene &scene, const std::string &word)
    {
      const double origin
          = scene.initial.exact ? scene.initial.exact->start_time() : scene.start_time;
      const bool similar = scene.initial.exact && scene.start_time > origin;
      return {word == "sqrt(t)" || (word == "automatic" && similar),
              std::min(origin, scene.start_time)};
    }
  } // namespace

  Physics physics_of(const cases::Scene &scene, const cases::EffectSet &effects,
                     const RunOptions &options, bool solid_inside)
  {
    const cases::Material &material = scene.material;
    Physics physics;
    const Phase solid{true, material.solid.conductivity,
                      material.solid.volumetric_heat_capacity(), 0};
    const Phase liquid{false, material.liquid.conductivity,
                       material.liquid.volumetric_heat_capacity(),
                       material.liquid.density * material.latent_heat};
    physics.phases = {solid_inside ? solid : liquid, solid_inside ? liquid : solid};
    physics.melting_temperature = material.melting_temperature;
    physics.temperature_scale = temperature_scale(scene);
    physics.clock = clock_of(scene, options.clock);
    set_walls(scene, physics);
    if(effects.contains(Effect::heat_sources))
      set_source(scene, physics);
    if(effects.contains(Effect::volumetric_source))
      physics.volumetric_source = *scene.volumetric_source;
    if(effects.contains(Effect::liquid_motion))
    {
      if(!solid_inside)
        throw Refusal("fem-fitted moves liquid only away from solid at the origin or at "
                      "x_min");
      physics.displacement = 1 - material.solid.density / material.liquid.density;
    }
    return physics;
  }

  InitialFronts initial_fronts(const cases::Scene &scene, const RayScene &rays)
  {
    const double time = scene.start_time;
    const cases::InitialState &initial = scene.initial;
    const double melting = scene.material.melting_temperature;
    const double at_melting
        = round_off * std::max(temperature_scale(scene), std::abs(melting));
    // Negative in solid. What is at the melting temperature is what the scene says.
    const auto by_temperature = [&](const cases::Position &p)
    {
      const double excess = initial.temperature(p, time) - melting;
      return std::abs(excess) > at_melting              ? excess
             : initial.solid_fraction_at_melting >= 0.5 ? -at_melting
                                                        : at_melting;
    };
    const auto level = [&](const cases::Position &p)
    {
      if(const double front = initial.front ? (*initial.front)(p, time) : 0; front != 0)
        return front;
      if(initial.exact)
        return (initial.exact->solid_at_origin() ? 1 : -1)
               * initial.exact->signed_distance(p, time);
      return by_temperature(p);
    };
    const int samples = rays.surface.n_rays() == 1 ? samples_on_line : samples_on_ray;
    InitialFronts result;
    const RayMesh geometry(rays.surface, rays.inner, rays.outer, {0, 1});
    for(unsigned int ray = 0; ray < rays.surface.n_rays(); ++ray)
    {
      const auto on_ray = [&](double r) { return level(geometry.position(ray, r)); };
      const auto sample = [&](int i)
      {
        const double share = std::clamp(static_cast<double>(i) / samples, next_to_wall,
                                        1 - next_to_wall);
        return rays.inner + (rays.outer - rays.inner) * share;
      };
      std::vector<double> found;
      double at_lower = on_ray(sample(0));
      if(ray == 0)
        result.solid_inside = at_lower < 0;
      for(int i = 1; i <= samples; ++i)
      {
        const double at_upper = on_ray(sample(i));
        if((at_lower < 0) != (at_upper < 0))
        {
          if(found.empty())
            result.solid_inside = at_lower < 0;
          std::uintmax_t iterations = 200;
          const auto bracket = boost::math::tools::toms748_solve(
              on_ray, sample(i - 1), sample(i), at_lower, at_upper,
              boost::math::tools::eps_tolerance<double>(52), iterations);
          found.push_back(0.5 * (bracket.first + bracket.second));
        }
        at_lower = at_upper;
      }
      if(found.size() > 1 && rays.surface.n_rays() > 1)
        throw Refusal("fem-fitted follows several fronts in one dimension only; in more "
                      "it follows one that each ray from wall to wall, or from the "
                      "centre, crosses once, and this one is crossed again");
      result.number = std::max(result.number, static_cast<unsigned int>(found.size()));
      result.coordinates.insert(result.coordinates.end(), found.begin(), found.end());
    }
    if(result.coordinates.size() < result.number * rays.surface.n_rays())
      throw Refusal("fem-fitted follows a front that each ray from wall to wall, or "
                    "from the centre, crosses once; some rays do not cross it");
    return result;
  }
} // namespace meltfront::reference_fem::fitted
