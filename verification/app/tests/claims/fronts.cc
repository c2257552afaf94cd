#include <verification/app/tests/claims/domains.h>
#include <verification/app/tests/claims/fronts.h>

#include <cases/exact/line_sink.h>
#include <cases/exact/oracle.h>
#include <cases/exact/planar_neumann.h>
#include <cases/wall_law.h>

#include <boost/math/tools/toms748_solve.hpp>

#include <cmath>
#include <numbers>

namespace meltfront::verification::claims
{
  namespace
  {
    using cases::BoundaryKind, cases::DomainShape, cases::Effect, cases::Position,
        cases::Side, cases::Symmetry;
    using std::numbers::pi;

    int resolution_of(int dimension)
    {
      return dimension == 1 ? 40 : dimension == 2 ? 24 : 14;
    }

    Symmetry symmetry_of(const cases::Domain &domain)
    {
      return domain.round() || domain.outline
                 ? domain.dimension == 2 ? Symmetry::cylindrical : Symmetry::spherical
                 : Symmetry::planar;
    }

    Side far_side(const cases::Domain &domain)
    {
      return domain.round() || domain.outline ? Side::outer : Side::x_max;
    }

    Side near_side(const cases::Domain &domain)
    {
      return domain.round() ? Side::inner : Side::x_min;
    }

    /** Solid from the near wall or the centre to the front, liquid up to 1. */
    struct Start
    {
      double inner = 0, front = 0.4;
      bool wall = true;      ///< there is a near wall
      double warmest = 1;    ///< of the liquid (negative: undercooled), at the far end
      bool straight = false; ///< liquid profile: else a sine with no flux at its end

      double operator()(double r) const
      {
        const double share = (r - inner) / (front - inner);
        if(r < front)
          return wall ? share - 1 : share * share - 1;
        const double beyond = (r - front) / (1 - front);
        return warmest * (straight ? beyond : std::sin(pi / 2 * beyond));
      }
    };

    /** A scene with a front in one coordinate, before it is solved. */
    struct FrontScene
    {
      Trial trial;
      Start start;
      cases::OracleProblem problem;
    };

    FrontScene front_scene(DomainShape shape, int dimension, bool symmetric,
                           double displaced = 1)
    {
      FrontScene result;
      cases::Scene &scene = result.trial.scene;
      scene = scene_on(domain_of(shape, dimension, true));
      const cases::Domain &domain = scene.domain;
      if(symmetric)
        scene.symmetry = symmetry_of(domain);
      scene.material.solid
          = {.conductivity = 2, .specific_heat_capacity = 1, .density = 1};
      scene.material.liquid
          = {.conductivity = 1, .specific_heat_capacity = 2, .density = displaced};
      scene.material.latent_heat = 2;
      scene.end_time = 0.06;
      result.trial.n = resolution_of(dimension);
      result.start.inner = domain.inner_radius;
      result.start.front = shape == DomainShape::shell ? 0.6 : 0.4;
      result.start.wall = shape == DomainShape::slab || shape == DomainShape::box
                          || shape == DomainShape::shell;
      return result;
    }

    /** The initial state, the near wall, and the same for the oracle. */
    void complete(FrontScene &of)
    {
      cases::Scene &scene = of.trial.scene;
      const Symmetry symmetry = symmetry_of(scene.domain);
      const Start start = of.start;
      scene.initial.temperature
          = field([start, symmetry](const Position &p, double)
                  { return start(cases::coordinate(symmetry, p)); });
      scene.initial.front
          = field([start, symmetry](const Position &p, double)
                  { return cases::coordinate(symmetry, p) - start.front; });
      of.problem.symmetry = symmetry;
      of.problem.material = scene.material;
      of.problem.inner = start.inner;
      of.problem.end_time = scene.end_time;
      of.problem.initial_fronts = {start.front};
      of.problem.initial_temperature = start;
      of.problem.nodes = 24;
      of.problem.tolerance = 1e-9;
      if(!start.wall)
        return;
      cases::Boundary &near = wall(scene, near_side(scene.domain));
      if(near.kind == BoundaryKind::insulated)
        near = held_at([](const Position &, double) { return -1.; });
      of.problem.inner_wall
          = {near.kind, [value = near.value](double time) { return value({}, time); }};
    }

    /** Hand the far wall to scene and oracle alike, and solve. */
    Trial solve(FrontScene of)
    {
      complete(of);
      const cases::Boundary &far = wall(of.trial.scene, far_side(of.trial.scene.domain));
      if(far.kind != BoundaryKind::insulated)
        of.problem.outer_wall
            = {far.kind, [value = far.value](double time) { return value({}, time); }};
      of.trial.judge = solution_judge(
          of.trial.scene, std::make_shared<cases::SpectralOracle>(of.problem));
      return of.trial;
    }

    /** Heat that comes in faster and faster. */
    double growing_flux(double strength, double time)
    {
      return strength * time;
    }

    Trial with_flux(FrontScene of, double strength)
    {
      wall(of.trial.scene, far_side(of.trial.scene.domain))
          = {.kind = BoundaryKind::flux,
             .value = field([strength](const Position &, double time)
                            { return growing_flux(strength, time); })};
      return solve(std::move(of));
    }

    /** The surroundings are as warm as they must be for the wall to take up a given flux.
     */
    Trial with_surroundings(FrontScene of, BoundaryKind kind, double strength)
    {
      complete(of);
      of.problem.outer_wall = {BoundaryKind::flux, [strength](double time)
                               { return growing_flux(strength, time); }};
      const auto oracle = std::make_shared<const cases::SpectralOracle>(of.problem);
      wall(of.trial.scene, far_side(of.trial.scene.domain)) = surrounded(
          kind,
          [oracle](const Position &, double time)
          { return oracle->temperature(1., time); },
          [strength](const Position &, double time)
          { return growing_flux(strength, time); });
      of.trial.judge = solution_judge(of.trial.scene, oracle);
      return of.trial;
    }

    constexpr double strong_flux = 150, moderate_flux = 40;

    /**
     * A front that heat drawn throughout the domain drives at a constant speed between
     * linear profiles: slopes A in the solid, B in the liquid with c_s A = c_l B, and
     * rho L v = k_s A - k_l B. Without the release the same walls are the oracle's.
     */
    Trial released_front(DomainShape shape, int dimension, bool released)
    {
      FrontScene of = front_scene(shape, dimension, false);
      cases::Scene &scene = of.trial.scene;
      constexpr double in_solid = 4, in_liquid = 2, speed = 1, from = 0.3;
      scene.material.latent_heat = 6;
      scene.end_time = 0.3;
      const auto exact = [=](double x, double time)
      {
        const double off = x - from - speed * time;
        return (off < 0 ? in_solid : in_liquid) * off;
      };
      for(const Side side : {Side::x_min, Side::x_max})
        wall(scene, side) = held_at([exact](const Position &p, double time)
                                    { return exact(p[0], time); });
      scene.initial.temperature
          = field([exact](const Position &p, double) { return exact(p[0], 0); });
      scene.initial.front = field([=](const Position &p, double) { return p[0] - from; });
      if(released)
        scene.volumetric_source = cases::Field::uniform(-in_solid * speed);
      const double end = scene.end_time;
      cases::OracleProblem &problem = of.problem;
      problem.material = scene.material;
      problem.end_time = end;
      problem.initial_fronts = {from};
      problem.initial_temperature = [exact](double x) { return exact(x, 0); };
      problem.inner_wall = {BoundaryKind::fixed_temperature,
                            [exact](double time) { return exact(0, time); }};
      problem.outer_wall = {BoundaryKind::fixed_temperature,
                            [exact](double time) { return exact(1, time); }};
      problem.nodes = 24;
      problem.tolerance = 1e-9;
      of.trial.judge
          = released
                ? temperature_judge([exact, end](const Position &p)
                                    { return exact(p[0], end); },
                                    from + speed * end)
                : solution_judge(scene, std::make_shared<cases::SpectralOracle>(problem));
      return of.trial;
    }

    /** The mean temperature and the disk's radius follow from the balance of heat,
     * R^2 = R_0^2 + c R_out^2 (T_front(R) - T_0)/L. */
    Trial capillary_disk(double coefficient)
    {
      constexpr double outer = 0.5, start = 0.25, undercooling = 0.2;
      Trial trial;
      cases::Domain domain = domain_of(DomainShape::ball, 2, true);
      domain.radius = outer;
      trial.scene = scene_on(domain);
      cases::Scene &scene = trial.scene;
      scene.material.latent_heat = 1;
      scene.material.gibbs_thomson_coefficient = coefficient;
      // With the mean -undercooling, and warmer at the front: without capillarity it is
      // at zero.
      constexpr double even = 0.6;
      const auto off_front = [](double share)
      { return std::pow(share - start * start / (outer * outer), 2); };
      const double mean = (std::pow(off_front(1), 1.5) + std::pow(off_front(0), 1.5)) / 3;
      scene.initial.temperature = field(
          [=](const Position &p, double)
          {
            const double share = (p[0] * p[0] + p[1] * p[1]) / (outer * outer);
            return -undercooling * (even + (1 - even) * off_front(share) / mean);
          });
      scene.initial.front = field([](const Position &p, double)
                                  { return std::hypot(p[0], p[1]) - start; });
      scene.end_time = 0.6;
      const auto excess = [=](double radius)
      {
        return radius * radius - start * start
               - outer * outer * (undercooling - coefficient / radius);
      };
      // The larger of two radii; the smaller is no stable equilibrium.
      std::uintmax_t iterations = 100;
      const auto bracket = boost::math::tools::toms748_solve(
          excess, 0.2, outer, boost::math::tools::eps_tolerance<double>(40), iterations);
      const double radius = (bracket.first + bracket.second) / 2;
      trial.judge
          = temperature_judge([=](const Position &) { return -coefficient / radius; },
                              radius * radius / (outer * outer));
      trial.n = 24;
      return trial;
    }
  } // namespace

  Trial moving_front(DomainShape shape, int dimension, BoundaryKind kind, bool symmetric,
                     double displaced)
  {
    FrontScene of = front_scene(shape, dimension, symmetric, displaced);
    if(kind == BoundaryKind::flux)
      return with_flux(std::move(of), moderate_flux);
    if(cases::exchanges_heat(kind))
      return with_surroundings(std::move(of), kind, moderate_flux);
    if(kind == BoundaryKind::fixed_temperature)
      wall(of.trial.scene, far_side(of.trial.scene.domain))
          = held_at([](const Position &, double) { return 1.; });
    if(kind == BoundaryKind::periodic)
      for(const Side side : of.trial.scene.sides())
        if(side == Side::y_min || side == Side::y_max)
          wall(of.trial.scene, side) = {.kind = kind, .value = {}};
    return solve(std::move(of));
  }

  std::optional<EffectTrials> front_trials(Effect effect, DomainShape shape,
                                           int dimension, double displaced)
  {
    const auto vary = [&](const auto &change)
    {
      EffectTrials trials;
      for(const bool second : {false, true})
      {
        FrontScene of = front_scene(shape, dimension, false, displaced);
        change(of, second);
        (second ? trials.second : trials.first) = solve(std::move(of));
      }
      return trials;
    };
    switch(effect)
    {
    case Effect::phase_change:
      return vary([](FrontScene &of, bool second)
                  { of.trial.scene.material.latent_heat = second ? 20 : 0.4; });
    case Effect::phase_conductivity:
      return vary([](FrontScene &of, bool second)
                  { of.trial.scene.material.liquid.conductivity = second ? 8 : 2; });
    case Effect::phase_heat_capacity:
      return vary(
          [](FrontScene &of, bool second)
          { of.trial.scene.material.liquid.specific_heat_capacity = second ? 8 : 1; });
    case Effect::wall_temperature:
      return vary(
          [](FrontScene &of, bool second)
          {
            const double rate = second ? 20 : 0;
            wall(of.trial.scene, near_side(of.trial.scene.domain)) = held_at(
                [rate](const Position &, double time) { return -1 - rate * time; });
          });
    case Effect::liquid_motion:
      return vary(
          [](FrontScene &of, bool second)
          {
            of.start.straight = true;
            of.trial.scene.material.liquid.density = second ? 0.25 : 4;
            of.trial.scene.end_time = 0.17;
            wall(of.trial.scene, far_side(of.trial.scene.domain))
                = held_at([](const Position &, double) { return 1.; });
          });
    case Effect::metastable_phase:
      return vary(
          [](FrontScene &of, bool second)
          {
            of.start.warmest = second ? -0.5 : -0.1;
            of.problem.metastable = true;
          });
    case Effect::wall_flux:
      return EffectTrials{
          with_flux(front_scene(shape, dimension, false, displaced), 0),
          with_flux(front_scene(shape, dimension, false, displaced), strong_flux)};
    case Effect::robin_wall:
    case Effect::radiating_wall:
    {
      const auto kind = effect == Effect::robin_wall ? BoundaryKind::heat_transfer
                                                     : BoundaryKind::radiation;
      return EffectTrials{
          with_surroundings(front_scene(shape, dimension, false, displaced), kind, 0),
          with_surroundings(front_scene(shape, dimension, false, displaced), kind,
                            strong_flux)};
    }
    case Effect::volumetric_source:
      return EffectTrials{released_front(shape, dimension, false),
                          released_front(shape, dimension, true)};
    default:
      return {};
    }
  }

  Trial line_sink(double lambda, bool symmetric, bool begun)
  {
    constexpr double far = 0.5;
    Trial trial;
    trial.scene = scene_on(domain_of(DomainShape::ball, 2, true));
    cases::Scene &scene = trial.scene;
    if(symmetric)
      scene.symmetry = Symmetry::cylindrical;
    scene.material.solid = {.conductivity = 2, .specific_heat_capacity = 1, .density = 1};
    scene.material.latent_heat = 2;
    scene.initial.temperature = cases::Field::uniform(far);
    scene.end_time = 0.06; // the liquid's heat has come as far as 2 sqrt(a t) = 0.49
    const auto sink = std::make_shared<cases::LineSink>(scene.material, lambda, far);
    wall(scene, Side::outer) = held_at([sink](const Position &p, double time)
                                       { return sink->temperature(p, time); });
    if(begun)
    {
      scene.start_time = scene.end_time / 4;
      constexpr double next_to_line = 1e-3; // at which it is infinitely cold
      scene.initial.temperature = field(
          [sink](const Position &p, double time) {
            return sink->temperature(std::fmax(next_to_line, std::hypot(p[0], p[1])),
                                     time);
          });
      scene.initial.front = field([sink](const Position &p, double time)
                                  { return std::hypot(p[0], p[1]) - sink->front(time); });
      scene.initial.exact = sink;
    }
    const double strength = sink->strength();
    scene.sources = {{.position = {},
                      .expression = "of the claim",
                      .power = [strength](double) { return -strength; },
                      .energy = [strength](double time) { return -strength * time; }}};
    trial.judge = solution_judge(scene, sink, 0.2);
    trial.n = 40;
    trial.scale = 2; // of the temperatures beside the line
    return trial;
  }

  Trial cold_wall(bool partly_melted, double displaced, DomainShape shape)
  {
    constexpr double cold = -1;
    const double far = partly_melted ? 0 : 0.5;
    Trial trial;
    const int dimension = shape == DomainShape::slab ? 1 : 2;
    trial.scene = scene_on(domain_of(shape, dimension, false));
    cases::Scene &scene = trial.scene;
    scene.material.latent_heat = 2;
    scene.material.liquid.density = displaced;
    scene.end_time = 0.06;
    scene.initial.temperature = cases::Field::uniform(far);
    cases::Material to_freeze = scene.material;
    if(partly_melted)
    {
      scene.initial.solid_fraction_at_melting = 0.5;
      to_freeze.latent_heat *= 0.5;
    }
    const auto neumann = std::make_shared<cases::PlanarNeumann>(to_freeze, cold, far);
    wall(scene, Side::x_min)
        = {.kind = BoundaryKind::fixed_temperature, .value = cases::Field::uniform(cold)};
    wall(scene, Side::x_max) = held_at([neumann](const Position &p, double time)
                                       { return neumann->temperature(p, time); });
    const double front = neumann->front(scene.end_time);
    trial.judge = temperature_judge([neumann, end = scene.end_time](const Position &p)
                                    { return neumann->temperature(p, end); },
                                    partly_melted ? (1 + front) / 2 : front);
    trial.n = resolution_of(dimension);
    return trial;
  }

  EffectTrials capillary_trials()
  {
    return {capillary_disk(0.015), capillary_disk(0.035)};
  }
} // namespace meltfront::verification::claims
