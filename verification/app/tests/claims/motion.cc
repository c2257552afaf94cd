#include <verification/app/tests/claims/domains.h>
#include <verification/app/tests/claims/motion.h>

#include <cases/exact/planar_neumann.h>
#include <cases/shape.h>
#include <cases/velocity_field.h>
#include <particles/greenspan/tables.h>

#include <cmath>

namespace meltfront::verification::claims
{
  namespace
  {
    using cases::Effect, cases::Position, cases::Side;

    struct Body
    {
      Position position{}, velocity{};
    };

    constexpr double gravity = 32, time_step = 1e-4;

    /** The particles of the report's first table. */
    std::vector<Body> table()
    {
      const particles::greenspan::ParticleState state
          = particles::greenspan::read_table(1, particles::greenspan::Errata::as_printed);
      std::vector<Body> bodies(state.size());
      for(std::size_t i = 0; i < bodies.size(); ++i)
        for(int d = 0; d < 2; ++d)
        {
          bodies[i].position[d] = state.position[d][i];
          bodies[i].velocity[d] = state.velocity[d][i];
        }
      return bodies;
    }

    /** Falls freely from bounce to bounce; a bounce leaves nothing of the motion along
     * the floor. */
    void fall(Body &body, const cases::ParticleSolid &solid, double time)
    {
      constexpr int most_bounces = 1000;
      for(int bounce = 0; bounce < most_bounces; ++bounce)
      {
        double &y = body.position[1], &v = body.velocity[1];
        double until = time;
        if(solid.base)
        {
          const double root = std::sqrt(v * v + 2 * solid.gravity * std::fmax(y, 0));
          until = std::fmin(time, (v + root) / solid.gravity);
        }
        body.position[0] += body.velocity[0] * until;
        y += v * until - solid.gravity * until * until / 2;
        v -= solid.gravity * until;
        time -= until;
        if(time <= 0)
          return;
        const double x = body.position[0];
        const bool hot = solid.base->hot && std::abs(x) < solid.base->hot->half_width;
        const double share
            = hot ? solid.base->hot->left
                        - solid.base->hot->slope * (x + solid.base->hot->half_width)
                  : solid.base->restitution;
        y = 0;
        v *= -share;
        body.velocity[0] = 0;
      }
      // What is left of so many bounces lies on the floor.
    }

    /** The source as a force, by the classical Runge-Kutta method in short steps. */
    void drive_away(Body &body, const cases::PointHeating &heating, double time)
    {
      const int steps = static_cast<int>(std::lround(time / time_step)) * 4;
      const double h = time / steps;
      const auto force = [&](const Position &p)
      {
        Position result{};
        const double dx = p[0] - heating.position[0], dy = p[1] - heating.position[1];
        const double distance = std::hypot(dx, dy);
        if(distance >= heating.reach)
          return result;
        const double size = heating.stages.front().strength / time_step
                            * std::pow(distance, -heating.power - 1);
        result = {size * dx, size * dy, 0};
        return result;
      };
      for(int step = 0; step < steps; ++step)
      {
        const Body start = body;
        Position drift{}, kick{};
        Body stage = start;
        constexpr double part[] = {0.5, 0.5, 1, 0},
                         share[] = {1. / 6, 1. / 3, 1. / 3, 1. / 6};
        for(int s = 0; s < 4; ++s)
        {
          const Position a = force(stage.position), v = stage.velocity;
          for(int d = 0; d < 2; ++d)
          {
            drift[d] += share[s] * v[d];
            kick[d] += share[s] * a[d];
            stage.position[d] = start.position[d] + part[s] * h * v[d];
            stage.velocity[d] = start.velocity[d] + part[s] * h * a[d];
          }
        }
        for(int d = 0; d < 2; ++d)
        {
          body.position[d] = start.position[d] + h * drift[d];
          body.velocity[d] = start.velocity[d] + h * kick[d];
        }
      }
    }

    /** Flies on a straight line; drag, which a bath of no temperature is, and light
     * change the speed only. */
    void fly(Body &body, const cases::ParticleSolid &solid, double time)
    {
      const double fading = solid.drag + (solid.bath ? solid.bath->rate : 0);
      double way = fading > 0 ? -std::expm1(-fading * time) / fading : time;
      if(solid.light)
      {
        // s^2 = s_0^2 + 2 g t, of a disk that is lit whole.
        const double speed = std::hypot(body.velocity[0], body.velocity[1]);
        const double gain = solid.light->power * 2 * solid.light->radius;
        way = (std::pow(speed * speed + 2 * gain * time, 1.5) - std::pow(speed, 3))
              / (3 * gain * speed);
      }
      for(int d = 0; d < 2; ++d)
        body.position[d] += way * body.velocity[d];
    }

    Trial free_particles(const cases::ParticleSolid &given)
    {
      Trial trial;
      trial.scene.name = "claim";
      trial.scene.problem = cases::ProblemKind::particle_solid;
      trial.scene.end_time = 0.3;
      cases::ParticleSolid solid = given;
      solid.law.attraction = solid.law.repulsion = 1e-30;
      solid.time_step = time_step;
      trial.scene.particle_solid = solid;
      trial.judge = [solid, time = trial.scene.end_time](const EndState &end)
      {
        std::vector<Body> bodies = table();
        double squares = 0;
        for(std::size_t i = 0; i < bodies.size(); ++i)
        {
          if(solid.heating)
            drive_away(bodies[i], *solid.heating, time);
          else if(solid.drag > 0 || solid.bath || solid.light)
            fly(bodies[i], solid, time);
          else
            fall(bodies[i], solid, time);
          for(int d = 0; d < 2; ++d)
            squares += std::pow(end.position(i)[d] - bodies[i].position[d], 2);
        }
        return Differences{std::sqrt(squares / static_cast<double>(bodies.size())), 0};
      };
      trial.n = 28;
      return trial;
    }
  } // namespace

  std::optional<EffectTrials> free_particle_trials(Effect effect)
  {
    cases::ParticleSolid first, second;
    switch(effect)
    {
    case Effect::gravity:
      second.gravity = gravity;
      break;
    case Effect::base:
      first.gravity = second.gravity = gravity;
      second.base = cases::SolidBase{.restitution = 0.5, .hot = {}};
      break;
    case Effect::hot_base:
      first.gravity = second.gravity = gravity;
      first.base = second.base = cases::SolidBase{.restitution = 0.5, .hot = {}};
      second.base->hot = cases::HotBase();
      break;
    case Effect::point_heating:
      second.heating = cases::PointHeating{{0.2, 5.8, 0}, {{30000, 0.002}}, 1, 2.5};
      break;
    case Effect::drag:
      second.drag = 3;
      break;
    case Effect::heat_bath:
      second.bath = cases::HeatBath{{0}, {0}, 3};
      break;
    case Effect::light:
      // Disks so small that none is in the shadow of another one.
      second.light = cases::Light{true, {0.31, -1, 0}, 1e5, 1e-4};
      break;
    default:
      return {};
    }
    return EffectTrials{free_particles(first), free_particles(second)};
  }

  Trial particle_bar(double hot)
  {
    constexpr double cold = 42;
    Trial trial;
    cases::Domain domain = domain_of(cases::DomainShape::slab, 1, false);
    domain.upper[0] = 60;
    trial.scene = scene_on(domain);
    cases::Scene &scene = trial.scene;
    scene.material.solid
        = {.conductivity = 177.6, .specific_heat_capacity = 2.41, .density = 0.927};
    scene.material.liquid
        = {.conductivity = 44.96, .specific_heat_capacity = 4.86, .density = 0.927};
    scene.material.latent_heat = 27.4;
    scene.material.melting_temperature = 44.99;
    scene.end_time = 8;
    scene.initial.temperature = cases::Field::uniform(cold);
    for(const auto &[side, temperature] :
        {std::pair(Side::x_min, hot), std::pair(Side::x_max, cold)})
      wall(scene, side) = {.kind = cases::BoundaryKind::fixed_temperature,
                           .value = cases::Field::uniform(temperature)};
    cases::ParticleSolid solid;
    solid.arrangement = cases::SolidArrangement::bar;
    solid.rows = 8;
    solid.pressure = 30;
    solid.time_step = 4e-4;
    scene.particle_solid = solid;
    const auto neumann
        = std::make_shared<cases::PlanarNeumann>(scene.material, hot, cold);
    const double end = scene.end_time;
    trial.judge = temperature_judge([neumann, end](const Position &p)
                                    { return neumann->temperature(p, end); },
                                    1 - neumann->front(end) / domain.upper[0]);
    trial.n = 74;
    trial.scale = 10;
    return trial;
  }

  std::optional<EffectTrials> particle_bar_trials(Effect effect)
  {
    constexpr double hot = 75;
    EffectTrials trials{particle_bar(hot), particle_bar(hot), true};
    cases::Material &other = trials.second.scene.material;
    switch(effect)
    {
    case Effect::phase_change:
      other.latent_heat *= 2;
      return trials;
    case Effect::phase_conductivity:
      other.liquid.conductivity *= 2;
      return trials;
    case Effect::phase_heat_capacity:
      other.liquid.specific_heat_capacity *= 2;
      return trials;
    case Effect::wall_temperature:
      return EffectTrials{particle_bar(hot), particle_bar(46)};
    default:
      return {};
    }
  }

  Trial advected_ball(int dimension, cases::BoundaryKind kind)
  {
    constexpr double radius = 0.22;
    const Position start{0.4, 0.5, dimension == 3 ? 0.5 : 0};
    constexpr double way = 0.2;
    Trial trial;
    trial.scene.name = "claim";
    trial.scene.problem = cases::ProblemKind::interface_advection;
    cases::Domain &domain = trial.scene.domain;
    domain.shape = cases::DomainShape::box;
    domain.dimension = dimension;
    for(int d = 0; d < dimension; ++d)
      domain.upper[d] = 1;
    trial.scene.symmetry = cases::Symmetry::none;
    for(int s = 0; s < 2 * dimension; ++s)
      wall(trial.scene, static_cast<Side>(s)).kind
          = s < 2 ? kind : cases::BoundaryKind::insulated;
    trial.scene.interface = cases::InterfaceAdvection{
        std::make_shared<cases::Ball>(dimension, start, radius),
        std::make_shared<cases::RigidMotion>(Position{way, 0, 0}, 0., Position{})};
    trial.judge = [=](const EndState &end)
    {
      cases::Domain unit;
      unit.dimension = dimension;
      for(int d = 0; d < dimension; ++d)
        unit.upper[d] = 1;
      const std::vector<Position> points = lattice(unit);
      double wrong = 0;
      for(std::size_t i = 0; i < points.size(); ++i)
      {
        const double off
            = std::hypot(points[i][0] - start[0] - way, points[i][1] - start[1],
                         dimension == 3 ? points[i][2] - start[2] : 0);
        wrong += end.inside[i] != (off < radius);
      }
      return Differences{wrong / static_cast<double>(points.size()), 0};
    };
    trial.n = dimension == 2 ? 40 : 20;
    return trial;
  }
} // namespace meltfront::verification::claims
