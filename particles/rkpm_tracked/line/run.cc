#include <cases/error.h>
#include <cases/scene.h>
#include <cases/stopwatch.h>
#include <cases/time_integral.h>
#include <particles/rkpm_tracked/line/relax.h>
#include <particles/rkpm_tracked/line/run.h>
#include <particles/rkpm_tracked/line/sites.h>
#include <particles/rkpm_tracked/line/start.h>
#include <particles/rkpm_tracked/line/stepper.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    /** Steps may use up so much of the overshoot that is allowed. */
    constexpr double overshoot_of_step = 0.25;
    /** A body at rest has bounds without a span: it has at least this share of the one
     * that the melting temperature belongs to. */
    constexpr double least_span = 1e-6;

    /** Of the heat at hand so much as layers hold, a spacing thick each, may get lost at
     * fronts and walls, beside what one such layer takes up at most. */
    constexpr double layers_lost = 3;

    /** Steps shorter than this share of the run fail. */
    constexpr double shortest_step_over_run = 1e-13;
    /** Where rows are balances time is resolved as space is: a step is this over the
     * number of steps as long as the time since the last event at most, and a thin layer
     * grows by no more, over its thickness. */
    constexpr double age_in_steps = 12, layer_in_steps = 6, most_layer_growth = 0.1;

    constexpr int scheme_order(TimeScheme scheme)
    {
      return static_cast<int>(scheme);
    }

    /** Largest difference of temperatures that a scene can bring about. */
    double temperature_span(const cases::TemperatureBounds &bounds,
                            const LineState &initial, double melting)
    {
      double lowest = melting, highest = melting;
      for(const double value : initial.temperature)
      {
        lowest = std::min(lowest, value);
        highest = std::max(highest, value);
      }
      if(std::isfinite(bounds.lower))
        lowest = std::min(lowest, bounds.lower);
      if(std::isfinite(bounds.upper))
        highest = std::max(highest, bounds.upper);
      return highest > lowest ? highest - lowest : 1.;
    }

    class LineRun : public cases::Run
    {
    public:
      LineRun(const cases::Scene &scene, const cases::EffectSet &effects,
              const cases::Resolution &resolution)
        : scene(scene)
        , effects(effects)
        , parameters(read_tracking_parameters(scene, resolution))
        , problem(pose_line_problem(scene, parameters, resolution.seed))
        , initial(initial_state(scene, problem))
        , bounds(cases::temperature_bounds(scene))
        , stepper(problem,
                  {parameters.basis_order, parameters.dilation,
                   parameters.interpolation_distance,
                   scheme_order(parameters.time_scheme)},
                  rules(),
                  [this](double time, const std::string &event) { note(time, event); })
        , start(choose_start(scene, problem, parameters, initial,
                             planned_time(1) - scene.start_time))
      {
      }

      cases::RunDescription describe() const override
      {
        cases::RunDescription result;
        result.dimension = 1;
        result.spacing = problem.spacing;
        for(const double beside_wall : problem.wall_spacing)
          if(beside_wall > 0)
            result.resolved_width = beside_wall;
        result.smoothing_length = 0;
        result.time_step = (scene.end_time - scene.start_time) / parameters.steps;
        result.unknowns = static_cast<long>(problem.nodes.size() + initial.fronts.size());
        result.parameters = {
            {"particles",
             fmt::format("{} nodes{}, one particle on each front", problem.nodes.size(),
                         parameters.jitter > 0
                             ? fmt::format(", displaced by up to {:g} of their spacing",
                                           parameters.jitter)
                             : ""),
             ""},
            {"form", problem.balanced() ? "balances of cells" : "collocation", ""},
            {"kernel", "cubic spline, fixed at each node, for each phase apart", ""},
            {"basis order", std::to_string(parameters.basis_order), ""},
            {"dilation", fmt::format("{:g}", parameters.dilation), "spacings"},
            {"time scheme",
             parameters.time_scheme == TimeScheme::backward_euler
                 ? "backward Euler"
                 : fmt::format("BDF{}", scheme_order(parameters.time_scheme)),
             ""},
            {"steps",
             fmt::format("{}, equal in {}, divided where a front would move by more "
                         "than {:g} spacings",
                         parameters.steps,
                         parameters.clock == Clock::time ? "t" : "sqrt(t)",
                         parameters.cfl),
             ""},
            {"start", start.how, ""},
            {"fronts", "Broyden's method, all temperatures anew in each iteration", ""},
            {"linear solver", "banded elimination", ""}};
        if(parameters.relax > 0)
          result.parameters.push_back(
              {"relaxation of inner nodes",
               fmt::format("{}, every {} steps",
                           parameters.relax_rule == RelaxRule::springs
                               ? "repulsion and springs to their homes"
                               : "Lennard-Jones energy",
                           parameters.relax),
               ""});
        return result;
      }

      cases::Cost cost() const override
      {
        const LineSolver &solver = stepper.line_solver();
        cases::Cost result;
        result.steps = first_step + stepper.steps();
        result.unknowns
            = static_cast<long>(problem.nodes.size() + stepper.state().fronts.size());
        result.work = solver.work();
        result.solver_iterations = solver.counters().evaluations;
        result.most_iterations = solver.counters().most_evaluations;
        result.capped_steps = stepper.shortened();
        for(const cases::EffectDecision &decision : effects.decisions())
          if(decision.on)
            result.effects.push_back(solver.cost(decision.effect));
        return result;
      }

    private:
      void take_steps() override
      {
        report(initial);
        booked = start.from_initial
                     ? stepper.set_walls(start.state)
                     : heat_of(problem, start.state).total() - initial_heat;
        stepper.start(start.state, start.older);
        if(start.state.time > scene.start_time)
        {
          ++first_step;
          report(stepper.state());
        }
        for(int k = 1; k <= parameters.steps; ++k)
          while(planned_time(k) > stepper.state().time)
            advance(planned_time(k));
      }

      StepRules rules() const
      {
        const double duration = scene.end_time - scene.start_time;
        const double step = planned_time(1) - scene.start_time;
        StepRules result;
        result.cfl = parameters.cfl;
        // A first step of backward Euler so short that it spoils no higher order.
        result.first_step = parameters.time_scheme == TimeScheme::backward_euler
                                ? step
                                : step * std::min(1., step / duration);
        result.temperature_span
            = temperature_span(bounds, initial, scene.material.melting_temperature);
        if(problem.balanced())
        {
          result.share_of_age = age_in_steps / parameters.steps;
          result.planned_step = duration / parameters.steps;
          result.layer_growth
              = std::min(most_layer_growth, layer_in_steps / parameters.steps);
        }
        result.shortest_step = shortest_step_over_run * duration;
        result.bounds = bounds;
        const double between = bounds.upper - bounds.lower;
        result.largest_overshoot
            = overshoot_of_step
              * (std::isfinite(between)
                     ? std::max(between, least_span * result.temperature_span)
                     : result.temperature_span)
              * cases::allowed_overshoot(overshoot_along_line, problem.spacing,
                                         scene.domain);
        return result;
      }

      /** Advance to a time, or to where a step has to end before it. */
      void advance(double target)
      {
        const double end
            = cases::end_of_piece(problem.step_ends, stepper.state().time, target);
        stepper.advance(end, [this](const LineState &begin) { after_step(begin); });
        if(!std::ranges::binary_search(problem.breakpoints, end))
          return;
        const double jump = stepper.begin_anew();
        walls = problem.balanced() ? stepper.state().taken : walls + jump;
      }

      double planned_time(int step) const
      {
        if(step == parameters.steps)
          return scene.end_time;
        const double share = static_cast<double>(step) / parameters.steps;
        if(parameters.clock == Clock::time)
          return cases::snap_to_breakpoint(
              problem.breakpoints,
              scene.start_time + share * (scene.end_time - scene.start_time));
        const double origin
            = scene.initial.exact ? scene.initial.exact->start_time() : scene.start_time;
        const double first = std::sqrt(scene.start_time - origin);
        const double last = std::sqrt(scene.end_time - origin);
        const double root = first + share * (last - first);
        return cases::snap_to_breakpoint(problem.breakpoints, origin + root * root);
      }

      void after_step(const LineState &begin)
      {
        const LineState &state = stepper.state();
        const double step = state.time - begin.time;
        walls = problem.balanced()
                    ? state.taken
                    : walls
                          + step * (wall_heat(problem, begin) + wall_heat(problem, state))
                                / 2
                          + given_wall_heat(problem, begin.time, state.time);
        released += release(begin.time, state.time);
        try
        {
          check(state);
        }
        catch(const cases::NumericalError &error)
        {
          for(const std::string &reason :
              {stepper.unresolved_layer(), thin_phase_at_start()})
            if(!reason.empty())
              throw cases::Refusal(fmt::format("{}; {}", error.what(), reason));
          throw;
        }
        report(state);
        if(parameters.relax > 0 && stepper.steps() % parameters.relax == 0)
          relax_nodes(step);
      }

      /** Which phase lay at the start between fronts that less than two spacings part, in
       * words; else empty. */
      std::string thin_phase_at_start() const
      {
        constexpr double fewest_spacings = 2;
        for(std::size_t i = 1; i < initial.fronts.size(); ++i)
        {
          const double from = initial.fronts[i - 1], to = initial.fronts[i];
          const double spacings = (to - from) / problem.spacing_at((from + to) / 2);
          if(spacings < fewest_spacings)
            return fmt::format(
                "at the start a phase lies between {:.4g} and {:.4g} m, {:.2g} spacings "
                "thick: take n {:.2g} times as large or more",
                from, to, spacings, fewest_spacings / spacings);
        }
        return {};
      }

      /** @throws cases::Refusal where the heat released melts or freezes away from
       * fronts.
       */
      void check_release(const LineState &state) const
      {
        const double melting = scene.material.melting_temperature;
        double scale = 0;
        for(const double value : state.temperature)
          scale = std::max(scale, std::abs(value - melting));
        for(std::size_t i = 0; i < problem.nodes.size(); ++i)
        {
          const double x = problem.nodes[i], excess = state.temperature[i] - melting;
          const bool solid = state.solid(state.interval_of(x));
          const bool near = std::ranges::any_of(
              state.fronts, [&](double front)
              { return std::abs(front - x) < spacings_from_fronts * problem.spacing; });
          if(!near && (solid ? excess : -excess) > beyond_by_release * scale)
            throw cases::Refusal(fmt::format(
                "{} follows fronts from where they start; at t = {:.6g} the heat "
                "released "
                "throughout {} at x = {:.6g} away from them",
                method_name, state.time, solid ? "melts solid" : "freezes liquid", x));
        }
      }

      void check(const LineState &state)
      {
        const long step = first_step + stepper.steps();
        const auto [lowest, highest]
            = std::minmax_element(state.temperature.begin(), state.temperature.end());
        cases::check_temperature(bounds, *lowest, *highest, method_name, step, state.time,
                                 cases::allowed_overshoot(overshoot_along_line,
                                                          problem.spacing, scene.domain));
        if(problem.volumetric_source && !problem.metastable)
          check_release(state);
        const LineHeat heat = heat_of(problem, state);
        largest_heat = std::max({largest_heat, std::abs(heat.sensible) + heat.latent,
                                 std::abs(walls + booked), std::abs(released)});
        const double lost
            = std::abs(heat.total() - initial_heat - walls - booked - released);
        const double layer = problem.spacing / scene.domain.side();
        // Without a layer that is not resolved nothing explains a loss: others judge it.
        if(lost > layer * (heat_of_domain + layers_lost * largest_heat)
           && !stepper.unresolved_layer().empty())
          throw cases::NumericalError(
              method_name, step, state.time, "heat balance",
              fmt::format("leaves {:.6g} unaccounted for, {:.3g} of the heat at hand",
                          lost, lost / largest_heat));
      }

      /** @param step the last one (s) */
      void relax_nodes(double step)
      {
        std::vector<double> places
            = relaxation.places(problem, stepper.state(), parameters.relax * step);
        if(places == problem.nodes)
          return;
        std::deque<LineState> states = stepper.line_solver().states();
        for(LineState &state : states)
          resample(problem, places, parameters.basis_order + 1, state);
        problem.nodes.swap(places);
        stepper.nodes_moved(places, std::move(states));
      }

      /** Heat released in the domain in a step. */
      double release(double begin, double end) const
      {
        if(!problem.volumetric_source)
          return 0;
        double sum = 0;
        const std::vector<double> &x = problem.nodes;
        for(std::size_t i = 0; i < x.size(); ++i)
        {
          const double lower = i == 0 ? x[i] : (x[i - 1] + x[i]) / 2;
          const double upper = i + 1 == x.size() ? x[i] : (x[i] + x[i + 1]) / 2;
          sum += (end - begin) * problem.mean_release(x[i], begin, end)
                 * cases::volume_between(problem.symmetry, lower, upper);
        }
        return sum;
      }

      void report(const LineState &state)
      {
        shown = &state;
        reached(shown == &initial ? 0 : first_step + stepper.steps(), state.time);
      }

      cases::Snapshot snapshot(long step, double) override
      {
        cases::Snapshot snapshot;
        snapshot.step = step;
        sites.read(problem, *shown, snapshot);
        const LineHeat heat = heat_of(problem, *shown);
        snapshot.heat.stored = heat.sensible;
        snapshot.heat.latent = heat.latent;
        snapshot.heat.boundary = booked + walls;
        snapshot.heat.sources = released;
        snapshot.heat.initial = initial_heat;
        return snapshot;
      }

      const cases::Scene &scene;
      const cases::EffectSet &effects;
      TrackingParameters parameters;
      LineProblem problem;
      LineState initial;
      cases::TemperatureBounds bounds;
      LineStepper stepper;
      LineStart start;
      LineRelaxation relaxation{problem, parameters.relax_rule};
      LineSites sites;
      const LineState *shown = nullptr; ///< the state to take a snapshot of
      double initial_heat = heat_of(problem, initial).total();
      double largest_heat = std::abs(initial_heat);
      /** What the domain takes up between the coldest and the warmest state. */
      double heat_of_domain
          = cases::volume_between(problem.symmetry, problem.nodes.front(),
                                  problem.nodes.back())
            * (std::max(problem.phase(true).volumetric_heat_capacity(),
                        problem.phase(false).volumetric_heat_capacity())
                   * temperature_span(bounds, initial,
                                      problem.material.melting_temperature)
               + problem.phase(false).density * problem.material.latent_heat);
      double booked = 0; ///< through the walls before the first step
      double walls = 0, released = 0;
      long first_step = 0; ///< 1 if the run set out from the similarity solution
    };
  } // namespace

  std::unique_ptr<cases::Run> make_line_run(const cases::Scene &scene,
                                            const cases::EffectSet &effects,
                                            const cases::Resolution &resolution)
  {
    return std::make_unique<LineRun>(scene, effects, resolution);
  }
} // namespace meltfront::particles::rkpm_tracked
