#include <reference_fem/fitted/events/profile.h>
#include <reference_fem/fitted/events/transitions.h>

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

    /** A wall at the melting temperature starts a front at once if this share of its flux
     * is not conducted away. */
    constexpr double not_conducted = 1e-2;

    /** The same, of the time that the wall took to get there: for so long its
     * temperature is a ramp. */
    constexpr double ramp_share = 1e-2;

    /** A seed is so wide at least, of the ray, lest it be lost in rounding; if the time
     * is too short for that, it is made longer, up to this share of what is left. */
    constexpr double thinnest_seed = 1e-11, latest_share = 1e-3;
    constexpr double longer = 4;

    constexpr double growth_of_steps = 2;

    /** Cells next to a wall in the thermal layer that forms before a front starts, and
     * steps of that time's double. */
    constexpr double cells_in_layer = 2;
    constexpr int steps_to_passing = 28;

    /** Secant steps for the front's place: its heat is all but linear in it. */
    constexpr int balance_steps = 6;

    /** Images farther away than so many layers are none: i^2erfc(6) is 1e-19. */
    constexpr double far_image = 6;

    HeatContent sum_of(const HeatContent &a, const HeatContent &b)
    {
      return {a.sensible + b.sensible, a.latent + b.latent, a.walls + b.walls,
              a.sources + b.sources};
    }

    /** i^2erfc, the second integral of the complementary error function. */
    double second_integral(const double x)
    {
      return 0.25
             * ((1 + 2 * x * x) * std::erfc(x)
                - 2 * x * std::exp(-x * x) / std::sqrt(std::numbers::pi));
    }

    double coordinate_of(const EventScene &setting, const cases::Position &p)
    {
      return setting.scene.domain.round() ? std::hypot(p[0], p[1], p[2]) : p[0];
    }

    /** Halve the cells of an interval on both sides of the face at @p place until those
     * next to it are that small. */
    std::vector<double> halved_towards(std::vector<double> shares, const double place,
                                       const double smallest)
    {
      auto face = std::ranges::min_element(
          shares, {}, [&](const double share) { return std::abs(share - place); });
      for(; face != shares.begin() && *face - *(face - 1) > smallest; ++face)
        face = shares.insert(face, 0.5 * (*face + *(face - 1)));
      while(face + 1 != shares.end() && *(face + 1) - *face > smallest)
        face = shares.insert(face + 1, 0.5 * (*face + *(face + 1))) - 1;
      return shares;
    }

    /** The state of a segment on a mesh with more faces, and steps to come. */
    RunSegment on_finer_mesh(const EventScene &setting, const RunSegment &segment,
                             const std::vector<std::vector<double>> &shares,
                             const Clock &clock)
    {
      const FittedProblem &old = *segment.problem;
      const RayMesh &mesh = old.mesh();
      Physics physics = old.physics();
      physics.clock = clock;
      const LayeredState layers = layers_of(segment, segment.time, segment.state);
      RunSegment result;
      result.problem = std::make_shared<FittedProblem>(
          RayMesh(mesh.surface, mesh.inner, mesh.outer, shares), physics);
      result.time = segment.time;
      result.state
          = result.problem->state(segment.time, layers.fronts,
                                  [&](const cases::Position &p) {
                                    return layers.temperature(coordinate_of(setting, p));
                                  });
      result.before = layers.before;
      return result;
    }
  } // namespace

  RunSegment one_phase_stretch(const EventScene &setting)
  {
    const cases::Scene &scene = setting.scene;
    const RayScene &rays = setting.rays;
    const RayMesh mesh(rays.surface, rays.inner, rays.outer,
                       graded_shares(rays.cells, 1, true));
    Physics physics
        = physics_between(setting, initial_fronts(scene, rays).solid_inside, 0);
    physics.clock = {};
    // A sink makes a front at once: this is the state before it is switched on.
    physics.power = {};
    RunSegment result;
    result.problem = std::make_shared<FittedProblem>(mesh, physics);
    result.time = scene.start_time;
    result.state
        = result.problem->state(scene.start_time, {},
                                [&](const cases::Position &p) {
                                  return scene.initial.temperature(p, scene.start_time);
                                });
    result.steps = {{scene.end_time, (scene.end_time - scene.start_time)
                                         / std::max(1, setting.options.steps)}};
    return result;
  }

  RunSegment refined_stretch(const EventScene &setting, const RunSegment &segment,
                             const bool inner, const double soon)
  {
    const RayMesh &mesh = segment.problem->mesh();
    const unsigned int interval = inner ? 0 : mesh.n_fronts();
    const Phase &phase = segment.problem->phase(interval);
    const double length
        = room_at_wall(setting, layers_of(segment, segment.time, segment.state), inner);
    std::vector<std::vector<double>> shares = mesh.shares;
    shares[interval]
        = halved_towards(shares[interval], inner ? 0 : 1,
                         std::sqrt(phase.conductivity / phase.capacity * soon)
                             / (cells_in_layer * length));
    RunSegment result
        = on_finer_mesh(setting, segment, shares, Clock{true, segment.time});
    const Physics &physics = result.problem->physics();
    const double early = std::min(physics.clock.clock(segment.time + 2 * soon),
                                  physics.clock.clock(setting.scene.end_time));
    const double end = physics.clock.clock(setting.scene.end_time);
    const int steps = steps_for(setting, segment.time);
    result.steps = {{early, early / std::max(steps_to_passing, steps / 2)}};
    if(early < end)
      for(const StepRange &range : lengthening_steps(early, end, steps, growth_of_steps))
        result.steps.push_back(range);
    result.event
        = {segment.time, fmt::format("cells and steps are drawn to the wall {}, which is "
                                     "about to pass the melting temperature",
                                     to_string(side_at(setting.scene, inner)))};
    return result;
  }

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
    for(;; tau *= longer)
    {
      Integrator beyond(*past.problem, integration);
      beyond.start(old_clock.clock(crossing), u);
      beyond.advance_to(old_clock.clock(crossing + tau), scene.end_time);
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
        throw cases::Refusal(fmt::format(
            "{} cannot start a front at t = {:.6g} ({}): it is not to be told from its "
            "wall before the phase there has changed",
            integration.method, crossing, where));
      }
      LateSeed seed(setting, state, Clock{true, passings.front().time}, layers);
      const bool balances = std::ranges::none_of(layers, [](const LateLayer &layer)
                                                 { return layer.held; })
                            && std::ranges::none_of(passings, &WallPassing::at_once);
      if(balances && !seed.balance())
        throw cases::Refusal(
            fmt::format("{} cannot start a front at t = {:.6g} ({}): no place of it "
                        "balances the heat of its cells there; more cells would help",
                        integration.method, crossing, where));
      RunSegment result;
      result.problem = seed.problem;
      result.state = seed.u;
      result.time = state.time;
      result.before = state.before;
      result.before.walls += seed.surplus();
      const Clock &clock = result.problem->physics().clock;
      result.steps
          = lengthening_steps(clock.clock(state.time), clock.clock(scene.end_time),
                              steps_for(setting, crossing), growth_of_steps);
      result.event = {crossing, where};
      return result;
    }
  }

  namespace
  {
    /** The cells of an interval without those of others that are no more. */
    std::vector<double> shares_between(const std::vector<double> &faces)
    {
      std::vector<double> shares;
      for(const double face : faces)
        shares.push_back((face - faces.front()) / (faces.back() - faces.front()));
      return shares;
    }

    std::string what_vanishes(const EventScene &setting, const RayMesh &mesh,
                              const unsigned int vanished, const double place)
    {
      if(vanished > 0 && vanished < mesh.n_fronts())
        return fmt::format("two fronts meet at {:.6g}", place);
      return fmt::format(
          "the front reaches {}",
          vanished == 0 && mesh.has_centre()
              ? "the centre"
              : fmt::format("the wall {}",
                            to_string(side_at(setting.scene, vanished == 0))));
    }
  } // namespace

  namespace
  {
    /** A segment on cells that are halved towards places where the temperature bends,
     * with steps that lengthen from short ones. */
    RunSegment drawn_segment(const EventScene &setting, const RunSegment &segment,
                             const std::vector<double> &places, const Clock &clock,
                             const std::string &event)
    {
      const RayMesh &mesh = segment.problem->mesh();
      const std::vector<StepRange> steps = lengthening_steps(
          clock.clock(segment.time), clock.clock(setting.scene.end_time),
          steps_for(setting, segment.time), clock.root ? 1 : 2);
      const double first = clock.time(steps.front().end) - segment.time;
      std::vector<std::vector<double>> shares = mesh.shares;
      const LayeredState layers = layers_of(segment, segment.time, segment.state);
      double lower = mesh.inner;
      for(unsigned int k = 0; k <= mesh.n_fronts(); ++k)
      {
        const double upper = k < mesh.n_fronts() ? layers.fronts[k] : mesh.outer;
        const Phase &phase = segment.problem->phase(k);
        const double smallest = std::sqrt(phase.conductivity / phase.capacity * first)
                                / (cells_in_layer * (upper - lower));
        for(const double place : places)
          if(place >= lower && place <= upper)
            shares[k]
                = halved_towards(shares[k], (place - lower) / (upper - lower), smallest);
        lower = upper;
      }
      RunSegment result = on_finer_mesh(setting, segment, shares, clock);
      result.steps = steps;
      result.event = {segment.time, event};
      return result;
    }
  } // namespace

  RunSegment drawn_to_walls(const EventScene &setting, const RunSegment &segment,
                            const std::array<WallLayer, 2> &forms)
  {
    Clock clock = segment.problem->physics().clock;
    if(setting.options.clock != "t")
      clock = {true, segment.time};
    std::vector<double> places;
    std::string walls;
    for(const bool inner : {true, false})
      if(forms[inner ? 0 : 1].forms())
      {
        places.push_back(inner ? setting.rays.inner : setting.rays.outer);
        walls += fmt::format("{}{}", walls.empty() ? "" : " and ",
                             to_string(side_at(setting.scene, inner)));
      }
    return drawn_segment(setting, segment, places, clock,
                         fmt::format("cells and steps are drawn to the wall {}, where a "
                                     "layer of heat forms",
                                     walls));
  }

  RunSegment remaining_stretch(const EventScene &setting, const RunSegment &past,
                               const double time, const Vector<double> &u,
                               const unsigned int vanished)
  {
    const FittedProblem &old = *past.problem;
    const RayMesh &mesh = old.mesh();
    if(vanished == 0 && old.physics().power)
      throw cases::Refusal(fmt::format(
          "fem-fitted does not simulate a source whose own phase vanishes, which "
          "leaves no field to split off: at t = {:.6g}",
          time));
    const unsigned int degree = mesh.surface.degree, n = mesh.n_fronts();
    const bool at_inner = vanished == 0, at_outer = vanished == n;

    // What is left, level by level; the levels on both sides of the gap are one, and the
    // cells next to it reach as far as it does.
    std::vector<unsigned int> levels, intervals;
    for(unsigned int level = 0; level < mesh.n_levels(); ++level)
    {
      const bool before = vanished > 0 && level <= mesh.front_level(vanished - 1);
      const bool beyond = vanished < n && level >= mesh.front_level(vanished);
      if(!before && (!beyond || (!at_inner && level == mesh.front_level(vanished))))
        continue;
      levels.push_back(level);
      intervals.push_back(before ? mesh.interval_of(level)
                                 : std::max(mesh.interval_of(level), vanished + 1));
    }
    const double lower = at_inner ? mesh.inner : u[mesh.front_node(0, vanished - 1)];
    const double upper = at_outer ? mesh.outer : u[mesh.front_node(0, vanished)];
    const double place = at_inner ? lower : at_outer ? upper : 0.5 * (lower + upper);

    std::vector<double> fronts;
    std::vector<std::vector<double>> shares(1);
    std::vector<double> faces;
    for(std::size_t i = 0; i < levels.size(); i += degree)
    {
      const unsigned int level = levels[i], front = mesh.front_at(level);
      const bool gap
          = front != RayMesh::none && (front + 1 == vanished || front == vanished);
      faces.push_back(gap ? place : old.coordinate(0, level, u));
      if(front == RayMesh::none || gap)
        continue;
      fronts.push_back(faces.back());
      shares.back() = shares_between(faces);
      shares.emplace_back();
      faces = {faces.back()};
    }
    shares.back() = shares_between(faces);

    Physics physics
        = physics_between(setting, old.phase(at_inner ? 1 : 0).solid, fronts.size());
    if(setting.options.clock != "t")
      physics.clock = {true, time};
    RunSegment left;
    left.problem = std::make_shared<FittedProblem>(
        RayMesh(mesh.surface, mesh.inner, mesh.outer, shares), physics);
    left.time = time;
    left.state.reinit(left.problem->size());
    const RayMesh &mesh_left = left.problem->mesh();
    for(unsigned int front = 0; front < fronts.size(); ++front)
      left.state[mesh_left.front_node(0, front)] = fronts[front];
    for(unsigned int i = 0; i < levels.size(); ++i)
      if(mesh_left.front_at(i) == RayMesh::none)
      {
        const double r = left.problem->coordinate(0, i, left.state);
        left.state[i] = old.theta(intervals[i], 0, levels[i], time, u);
        if(r > 0)
          left.state[i]
              += old.source(intervals[i], time).value(old.coordinate(0, levels[i], u))
                 - left.problem->source(mesh_left.interval_of(i), time).value(r);
      }
    const HeatContent before = old.heat(time, u),
                      now = left.problem->heat(time, left.state);
    left.before = sum_of(past.before, before);
    left.before.sensible -= now.sensible;
    left.before.latent -= now.latent;
    return drawn_segment(setting, left, {place}, physics.clock,
                         what_vanishes(setting, mesh, vanished, place));
  }
} // namespace meltfront::reference_fem::fitted
