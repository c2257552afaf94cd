#include <reference_fem/fitted/events/late_start.h>
#include <reference_fem/fitted/events/profile.h>

#include <cases/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace meltfront::reference_fem::fitted
{
  namespace
  {
    using cases::BoundaryKind;
    using dealii::Vector;

    /** How long after the crossing a front is seeded, of the time that is left; and where
     * no layer of heat announces it, so that the state of the crossing is taken. */
    constexpr double late_share = 1e-5, share_at_once = 1e-8;

    /** The same, of the time that the wall took to get there: for so long its
     * temperature is a ramp. */
    constexpr double ramp_share = 1e-2;

    /** If the time is too short for a seed that is not lost in rounding, it is made
     * longer, up to this share of what is left. */
    constexpr double latest_share = 1e-3;
    constexpr double longer = 4;

    /** A wall at the melting temperature starts a front at once if this share of its flux
     * is not conducted away. */
    constexpr double not_conducted = 1e-2;

    constexpr double growth_of_late_steps = 2;

    /** Secant steps for the front's place: its heat is all but linear in it. */
    constexpr int balance_steps = 6;

    /** Images farther away than so many layers are none: i^2erfc(6) is 1e-19. */
    constexpr double far_image = 6;

    /** i^2erfc, the second integral of the complementary error function. */
    double second_integral(const double x)
    {
      return 0.25
             * ((1 + 2 * x * x) * std::erfc(x)
                - 2 * x * std::exp(-x * x) / std::sqrt(std::numbers::pi));
    }
  } // namespace

  double time_of_seed(const EventScene &setting, const RunSegment &past,
                      const WallPassing &passing)
  {
    const double crossing = passing.time, left = setting.scene.end_time - crossing,
                 to_breakpoint = 0.5 * time_to_breakpoint(setting.scene, crossing);
    if(passing.at_once)
      return std::min(share_at_once * left, to_breakpoint);
    const double result = std::min(late_share * left, to_breakpoint);
    return crossing > past.time ? std::min(result, ramp_share * (crossing - past.time))
                                : result;
  }

  bool leads_at_once(const FittedProblem &problem, const bool inner, const double time,
                     const Vector<double> &u)
  {
    const RayMesh &mesh = problem.mesh();
    const Phase &phase = problem.phase(inner ? 0 : mesh.n_fronts());
    const cases::Boundary &law
        = inner ? problem.physics().inner_wall : problem.physics().outer_wall;
    if(law.kind == BoundaryKind::fixed_temperature)
      return false;
    const double wall = inner ? mesh.inner : mesh.outer;
    const double flux = cases::heat_through(law, mesh.position(0, wall), time,
                                            problem.physics().melting_temperature)
                            .flux;
    const double outflow
        = phase.conductivity * Profile(problem, time, u).slope(wall) * (inner ? 1 : -1);
    return (phase.solid ? 1 : -1) * (flux + outflow) > not_conducted * std::abs(flux);
  }

  namespace
  {
    /** A phase that is seeded at a wall, everything by distance from it: positive slopes
     * lead away. */
    struct LateLayer
    {
      NewLayer place;
      double wall = 0;      ///< coordinate (m)
      double room = 0;      ///< up to the next front (m)
      bool reflects = true; ///< there is one
      double excess = 0;    ///< of the wall without the new phase (K)
      double latent = 0;    ///< of the new phase, negative where it melts (J/m^3)
      double gradient = 0;  ///< of the new phase (K/m)
      bool held = false;    ///< the wall, at a temperature

      /** What the old phase loses by being held at the melting temperature (K). */
      double response(const double distance) const
      {
        if(excess == 0 || (reflects && distance >= room))
          return 0;
        double sum = second_integral(distance / place.layer);
        for(double image = 2 * room;
            reflects && image - distance < far_image * place.layer; image += 2 * room)
          sum += second_integral((image + distance) / place.layer)
                 - second_integral((image - distance) / place.layer);
        return 4 * excess * sum;
      }
    };

    LateLayer late_layer(const EventScene &setting, const WallPassing &passing,
                         const FittedProblem &problem, const LayeredState &state,
                         const Profile &profile, const double wall_excess)
    {
      const cases::Scene &scene = setting.scene;
      const Physics &physics = problem.physics();
      const bool inner = passing.inner;
      const Phase &old = problem.phase(inner ? 0 : problem.mesh().n_fronts());
      const double direction = old.solid ? -1 : 1;
      const double since = state.time - passing.time;
      const double diffusivity = old.conductivity / old.capacity;
      const cases::Boundary &law = inner ? physics.inner_wall : physics.outer_wall;
      const cases::PhaseProperties &grown
          = old.solid ? scene.material.liquid : scene.material.solid;
      LateLayer result;
      result.wall = inner ? setting.rays.inner : setting.rays.outer;
      result.room = room_at_wall(setting, state, inner);
      result.reflects = !state.fronts.empty();
      result.held = law.kind == BoundaryKind::fixed_temperature;
      const double latent = scene.material.latent_heat * grown.density;
      result.latent = direction * latent;
      result.excess = passing.at_once ? 0. : wall_excess;
      const double outflow
          = old.conductivity * profile.slope(result.wall) * (inner ? 1 : -1);
      const double flux
          = result.held
                ? 0
                : cases::heat_through(law, problem.mesh().position(0, result.wall),
                                      state.time, scene.material.melting_temperature)
                      .flux;
      double width = 0;
      if(result.held)
      {
        const double rate = std::abs(wall_excess) / since;
        width
            = since
              * (std::sqrt(std::pow(outflow, 2) + 4 * latent * grown.conductivity * rate)
                 - direction * outflow)
              / (2 * latent);
      }
      else if(passing.at_once)
        width = since * direction * (-flux - outflow) / latent;
      else
        width = 4. / 3 * old.conductivity * std::abs(wall_excess) * std::sqrt(since)
                / (latent * std::sqrt(std::numbers::pi * diffusivity));
      result.place = {inner, width, 2 * std::sqrt(diffusivity * since)};
      result.gradient = result.held ? -wall_excess / width : -flux / grown.conductivity;
      return result;
    }

    std::vector<NewLayer> places_of(const std::vector<LateLayer> &layers)
    {
      std::vector<NewLayer> result;
      for(const LateLayer &layer : layers)
        result.push_back(layer.place);
      return result;
    }

    /** Seeds layers in what the solution without them has become. */
    class LateSeed
    {
    public:
      LateSeed(const EventScene &setting, const LayeredState &state, const Clock &clock,
               std::vector<LateLayer> layers)
        : layers(std::move(layers))
        , problem(problem_with(setting, state, places_of(this->layers), {}, clock))
        , setting(setting)
        , state(state)
      {
        place();
      }

      /** Heat that it holds more than the state. */
      double surplus() const
      {
        const HeatContent now = problem->heat(state.time, u);
        return now.sensible + now.latent - state.heat;
      }

      /** Move the fronts behind given fluxes to where the heat balances. False where
       * there is no such place. */
      bool balance()
      {
        const int exponent = setting.rays.surface.exponent;
        const double measure = exponent == 0   ? 1
                               : exponent == 1 ? 2 * std::numbers::pi
                                               : 4 * std::numbers::pi;
        const auto area = [&](double r) { return std::pow(r, exponent) * measure; };
        double all = 0;
        for(const LateLayer &layer : layers)
          all += std::abs(layer.latent) * area(layer.wall) * layer.place.width;
        std::vector<double> shares;
        for(const LateLayer &layer : layers)
          shares.push_back(std::abs(layer.latent) * area(layer.wall) * layer.place.width
                           / all);
        for(int step = 0; step < balance_steps; ++step)
        {
          const double excess = surplus();
          for(std::size_t k = 0; k < layers.size(); ++k)
          {
            double &width = layers[k].place.width;
            width += shares[k] * excess / (layers[k].latent * area(layers[k].wall));
            if(!(width > 0 && width < layers[k].room))
              return false;
          }
          place();
        }
        return true;
      }

      std::vector<LateLayer> layers;
      std::shared_ptr<FittedProblem> problem;
      Vector<double> u;

    private:
      void place()
      {
        u = problem->state(state.time, fronts_with(setting, state, places_of(layers)),
                           [&](const cases::Position &p)
                           {
                             const double r = coordinate_of(setting, p);
                             double temperature = state.temperature(r);
                             for(const LateLayer &layer : layers)
                             {
                               const double distance = std::abs(r - layer.wall);
                               if(distance < layer.place.width)
                                 return setting.scene.material.melting_temperature
                                        + layer.gradient * (distance - layer.place.width);
                               temperature -= layer.response(distance);
                             }
                             return temperature;
                           });
      }

      const EventScene &setting;
      const LayeredState &state;
    };

    /** Whether the seeds are wide enough to be told from their walls. */
    bool tells(const EventScene &setting, const std::vector<LateLayer> &layers)
    {
      const double ray = setting.rays.outer - setting.rays.inner;
      return std::ranges::all_of(layers,
                                 [&](const LateLayer &layer)
                                 {
                                   return layer.place.width > thinnest_seed * ray
                                          && layer.place.width < 0.5 * layer.room;
                                 });
    }

    std::string text_of(const EventScene &setting,
                        const std::vector<WallPassing> &passings)
    {
      std::string result;
      for(const WallPassing &passing : passings)
        result += fmt::format("{}the wall {} passes the melting temperature "
                              "and a front starts there",
                              result.empty() ? "" : "; ",
                              to_string(side_at(setting.scene, passing.inner)));
      return result;
    }
  } // namespace

  RunSegment late_stretch(const EventScene &setting, const RunSegment &past,
                          const std::vector<WallPassing> &passings, double tau,
                          const Vector<double> &u, const IntegrationOptions &integration)
  {
    const cases::Scene &scene = setting.scene;
    const Clock &old_clock = past.problem->physics().clock;
    const double crossing = passings.back().time;
    const double latest = std::min(latest_share * (scene.end_time - crossing),
                                   0.5 * time_to_breakpoint(scene, crossing));
    const std::string where = text_of(setting, passings);
    const Profile at_crossing(*past.problem, crossing, u);
    const auto refuse = [&](const char *why)
    {
      throw cases::Refusal(fmt::format("{} cannot start a front at t = {:.6g} ({}): {}",
                                       integration.method, crossing, where, why));
    };
    constexpr const char *too_thin
        = "it is not to be told from its wall before the phase "
          "there has changed";
    for(;; tau *= longer)
    {
      Integrator beyond(*past.problem, integration);
      beyond.start(old_clock.clock(crossing), u);
      try
      {
        beyond.advance_to(old_clock.clock(crossing + tau), scene.end_time);
      }
      catch(const cases::NumericalError &)
      {
        refuse(too_thin);
      }
      LayeredState state = layers_of(past, crossing + tau, beyond.state());
      const Profile profile(*past.problem, state.time, beyond.state());
      std::vector<LateLayer> layers;
      for(const WallPassing &passing : passings)
      {
        if(passing.at_once)
          state.temperature = [&](double r)
          { return scene.material.melting_temperature + at_crossing.value(r); };
        const double excess
            = past.problem->wall_excess(passing.inner, 0, state.time, beyond.state());
        if(excess == 0 || (excess < 0) == !state.solid_at(passing.inner))
        {
          layers.push_back(late_layer(setting, passing, *past.problem, state,
                                      passing.at_once ? at_crossing : profile, excess));
          continue;
        }
        throw cases::NumericalError(integration.method, 0, state.time, "the wall",
                                    "turned back from the melting temperature at once");
      }
      if(!tells(setting, layers))
      {
        if(longer * tau <= latest)
          continue;
        refuse(too_thin);
      }
      LateSeed seed(setting, state, Clock{true, passings.front().time}, layers);
      const bool balances = std::ranges::none_of(layers, [](const LateLayer &layer)
                                                 { return layer.held; })
                            && std::ranges::none_of(passings, &WallPassing::at_once);
      const bool balanced = !balances || seed.balance();
      if(!balanced || !tells(setting, seed.layers))
      {
        // What a new mesh rounds the state by counts less in a wider seed.
        if(longer * tau <= latest)
          continue;
        refuse(balanced ? too_thin
                        : "no place of it balances the heat of its cells there; more "
                          "cells would help");
      }
      RunSegment result;
      result.problem = seed.problem;
      result.state = seed.u;
      result.time = state.time;
      result.before = state.before;
      result.before.walls += seed.surplus();
      const Clock &clock = result.problem->physics().clock;
      result.steps
          = lengthening_steps(clock.clock(state.time), clock.clock(scene.end_time),
                              steps_for(setting, crossing), growth_of_late_steps);
      result.event = {crossing, where};
      return result;
    }
  }
} // namespace meltfront::reference_fem::fitted
