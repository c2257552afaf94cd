#include <cases/error.h>
#include <particles/rkpm_tracked/line/sites.h>
#include <particles/rkpm_tracked/line/stepper.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    /** Steps of backward differentiation of order 2 and 3 may grow so fast and stay
     * stable (limits: 2.41, 1.53). */
    constexpr double growth_of_order[] = {2., 2., 1.5};
    /** Layers thinner than some spacings are thin: they grow by so much in a step. */
    constexpr double thin_layer = 5;
    constexpr double most_layer_growth = 0.2;
    /** One that vanishes at a wall of given temperature is to thin by no more, and is
     * left no less than this share. */
    constexpr double layer_decline = 0.25;
    constexpr double most_decline = 0.5;
    /** Radius of the least body about an axis (spacings). */
    constexpr double least_body = 1e-3;
    /** Events are found to this share of the temperature's span. */
    constexpr double event_tolerance = 1e-5;
    constexpr double least_excess = 1e-9;
    /** First step over the time in which heat evens out in a cell beside a wall. */
    constexpr double wall_step = 0.25;
    constexpr double largest_excess = 1e-2;
    constexpr long most_events = 10000;
    /** A step divided to this share of a planned one may lose heat; by how much the heat
     * balance tells. */
    constexpr double last_resort = 1e-2;
    /** A shorter step is taken where it overshoots by less than this share of what the
     * longer one does: else the cause is not the step. */
    constexpr double worth_halving = 0.75;
    /** Phases beyond the melting temperature by more than this share of the span are
     * spoken of; walls see to themselves. */
    constexpr double spoken_of = 1e-3;

    const char *name_of(bool solid)
    {
      return solid ? "solid" : "liquid";
    }

    /** By how much temperatures within the walls are beyond what bounds them, and phases
     * beyond the melting temperature (K). */
    double overshoot(const LineProblem &problem, const cases::TemperatureBounds &bounds,
                     const LineState &state)
    {
      const double melting = problem.material.melting_temperature;
      // Undercooled, or heated throughout, a phase may pass it.
      const bool stable = !problem.metastable && !problem.volumetric_source;
      double most = 0;
      std::size_t number = 0;
      for(std::size_t i = 1; i + 1 < problem.nodes.size(); ++i)
      {
        while(number < state.fronts.size() && state.fronts[number] <= problem.nodes[i])
          ++number;
        const double value = state.temperature[i];
        most = std::max({most, bounds.lower - value, value - bounds.upper});
        if(stable)
          most = std::max(most, state.solid(number) ? value - melting : melting - value);
      }
      return most;
    }
  } // namespace

  LineStepper::LineStepper(const LineProblem &problem, const LineSettings &settings,
                           const StepRules &rules, Note note)
    : problem(problem)
    , solver(problem, settings)
    , rules(rules)
    , note(std::move(note))
    , next_step(rules.first_step)
    , growth(growth_of_order[settings.time_order - 1])
    , wanted{least_excess * rules.temperature_span, least_excess * rules.temperature_span}
  {
  }

  void LineStepper::restart(LineState state)
  {
    if(const auto [enclosed, where] = enclosed_phase(problem, state); enclosed)
      throw cases::Refusal(fmt::format(
          "{}: the {}, which moves where the densities differ, lies {} at t = {:.6g} and "
          "has no wall to give way through; the phase there has to be at rest (option "
          "displaced)",
          method_name, name_of(state.solid(*enclosed)), where, state.time));
    begun = state.time;
    solver.restart(std::move(state));
    next_step = rules.first_step;
    const double at_jumps
        = kept == 0 && !problem.jumps.empty() ? problem.jump_spacing : 0;
    for(const double spacing :
        {problem.wall_spacing[0], problem.wall_spacing[1], at_jumps})
      if(spacing > 0)
        next_step
            = std::min(next_step, wall_step * spacing * spacing
                                      / std::max(problem.phase(true).diffusivity(),
                                                 problem.phase(false).diffusivity()));
  }

  void LineStepper::start(LineState state, std::vector<LineState> older)
  {
    const double time = state.time;
    restart(std::move(state));
    for(LineState &before : older)
      solver.add_older(std::move(before));
    if(solver.states().size() > 1)
      next_step = time - solver.states()[1].time;
    insert_where_called_for();
  }

  double LineStepper::begin_anew()
  {
    LineState now = state();
    const double heat = set_walls(now);
    now.taken += heat;
    restart(std::move(now));
    insert_where_called_for();
    return heat;
  }

  double LineStepper::set_walls(LineState &changed)
  {
    const double before = heat_of(problem, changed).total();
    for(std::size_t side = 0; side < 2; ++side)
      if(problem.walls[side].fixed() || !problem.balanced())
        solver.set_wall(changed, side);
    return heat_before_layers(problem, changed).total() - before;
  }

  void LineStepper::insert_where_called_for()
  {
    for(std::size_t side = 0; side < 2 && !problem.metastable; ++side)
      if(wall_excess(problem, state(), side) > wanted[side])
        insert(side);
  }

  void LineStepper::insert(std::size_t side)
  {
    LineState changed = state();
    const double thickness = insert_layer(problem, changed, side);
    // A thin layer keeps a wall that exchanges heat near the melting temperature.
    if(!problem.walls[side].fixed())
      solver.set_wall(changed, side);
    const bool solid = changed.solid(side == 0 ? 0 : changed.n_intervals() - 1);
    note(changed.time,
         fmt::format("{} appeared at the {} wall in a layer of {:.3g} m", name_of(solid),
                     side == 0 ? "lower" : "upper", thickness));
    restart(std::move(changed));
    ++events;
    const double speed
        = std::abs(side == 0 ? state().speed.front() : state().speed.back());
    if(speed * next_step > growth_of_layer(thickness))
      next_step = growth_of_layer(thickness) / speed;
  }

  void LineStepper::remove(std::size_t number)
  {
    LineState changed = state();
    // A layer that does not hold comes back only when the wall is farther beyond the
    // melting temperature: it may have appeared by an error of the scheme's.
    for(const std::size_t side : {0, 1})
      if(number == (side == 0 ? 0 : changed.fronts.size()))
        wanted[side]
            = std::min(10 * wanted[side], largest_excess * rules.temperature_span);
    const Vanished gone = remove_interval(problem, changed, number);
    note(changed.time,
         fmt::format("{} {} at {:.6g} m; {:.3g} J/m^2 of latent and {:.3g} J/m^2 of "
                     "sensible heat were left in it",
                     name_of(gone.solid),
                     gone.at_wall ? "vanished" : "between two fronts that met vanished",
                     gone.place, gone.latent, gone.sensible));
    ++events;
    restart(std::move(changed));
  }

  /** By how much a thin layer may grow in a step (m). */
  double LineStepper::growth_of_layer(double thickness) const
  {
    const double share = rules.layer_growth;
    if(!std::isfinite(rules.share_of_age))
      return share * thickness;
    const double thinner = thin_layer * problem.spacing / thickness;
    return std::clamp(share * std::sqrt(thinner), share, most_layer_growth) * thickness;
  }

  double LineStepper::choose_end(double target) const
  {
    const LineState &now = state();
    double step = next_step;
    if(const double age = now.time - begun; age > 0 && std::isfinite(rules.share_of_age))
    {
      const double share = rules.share_of_age;
      const double earlier = rules.planned_step / (share * age);
      step = std::min(step, share * age * std::pow(std::max(earlier, 1.), 0.25));
    }
    const auto allow = [&step](double move, double speed)
    {
      if(speed * step > move)
        step = move / speed;
    };
    for(std::size_t j = 0; j < now.fronts.size(); ++j)
      allow(rules.cfl * problem.spacing_at(now.fronts[j]), std::abs(now.speed[j]));
    if(!now.fronts.empty())
    {
      const double below = now.fronts.front() - problem.nodes.front();
      const double above = problem.nodes.back() - now.fronts.back();
      // Against a wall whose temperature is given heat flows as one over the thickness.
      if(below < thin_layer * problem.spacing)
      {
        allow(growth_of_layer(below), now.speed.front());
        if(problem.walls[0].fixed())
          allow(layer_decline * below, -now.speed.front());
      }
      if(above < thin_layer * problem.spacing)
      {
        allow(growth_of_layer(above), -now.speed.back());
        if(problem.walls[1].fixed())
          allow(layer_decline * above, now.speed.back());
      }
    }
    constexpr double round_off = 1e-9;
    const double rest = target - now.time;
    const double parts = std::ceil(rest / step * (1 - round_off));
    return parts <= 1 ? target : now.time + rest / parts;
  }

  void LineStepper::shorten(StepOutcome outcome, double time_step)
  {
    ++shortened_steps;
    const auto [number, thickness] = thinnest_interval(problem, state());
    if(outcome == StepOutcome::closing && thickness <= 2 * solver.least_thickness())
    {
      remove(number);
      return;
    }
    next_step = time_step / 2;
    if(next_step < rules.shortest_step)
      throw cases::NumericalError(
          method_name, kept, state().time,
          outcome == StepOutcome::not_finite ? "temperature" : "front",
          outcome == StepOutcome::not_finite
              ? "is not finite"
              : "finds no place that its speed and its neighbours agree with");
  }

  bool LineStepper::vanishes_too_fast(const LineState &before) const
  {
    const auto too_fast = [this](std::size_t side, double thickness, double thickness_now)
    {
      return problem.walls[side].fixed() && thickness < thin_layer * problem.spacing
             && thickness_now < most_decline * thickness;
    };
    const LineState &now = state();
    if(now.fronts.empty() || now.fronts.size() != before.fronts.size())
      return false;
    const double lower = problem.nodes.front(), upper = problem.nodes.back();
    return too_fast(0, before.fronts.front() - lower, now.fronts.front() - lower)
           || too_fast(1, upper - before.fronts.back(), upper - now.fronts.back());
  }

  /** Whether what is left of a body about the axis is so small that its heat is round-off
   * of that of the others, and its speed with it. None grows from there but into a phase
   * that is undercooled or superheated. */
  bool LineStepper::gone_at_centre() const
  {
    return problem.axis && !problem.metastable && !state().fronts.empty()
           && state().fronts.front() - problem.nodes.front()
                  < least_body * problem.spacing;
  }

  bool LineStepper::a_front_turned(const std::deque<LineState> &before) const
  {
    const LineState &now = state();
    if(before.size() < 2 || now.fronts.size() != before[0].fronts.size()
       || now.fronts.size() != before[1].fronts.size())
      return false;
    for(std::size_t j = 0; j < now.fronts.size(); ++j)
      if((now.fronts[j] - before[0].fronts[j])
             * (before[0].fronts[j] - before[1].fronts[j])
         < 0)
        return true;
    return false;
  }

  void LineStepper::step_without_history(const LineState &before, double end)
  {
    const std::deque<LineState> with_history = solver.states();
    solver.restart(before);
    if(solver.step_to(end) != StepOutcome::accepted)
      solver.restore(with_history);
  }

  bool LineStepper::pass_wall(const std::deque<LineState> &before, double time_step)
  {
    if(problem.metastable)
      return false;
    const double tolerance = event_tolerance * rules.temperature_span;
    for(const std::size_t side : {0, 1})
    {
      const double now = wall_excess(problem, state(), side) - wanted[side];
      if(now <= 0)
        continue;
      const double earlier = wall_excess(problem, before.front(), side) - wanted[side];
      if(now <= tolerance || time_step <= rules.shortest_step)
        continue; // as good as at the melting temperature
      solver.restore(before);
      // The step that ends where the wall passes, by straight interpolation.
      if(-earlier > tolerance)
        next_step = time_step * earlier / (earlier - now);
      else
        insert(side);
      return true;
    }
    return false;
  }

  double LineStepper::shorten_to_bounds(const std::deque<LineState> &before,
                                        double time_step)
  {
    const double tolerated = std::max(rules.largest_overshoot,
                                      overshoot(problem, rules.bounds, before.front()));
    double beyond = overshoot(problem, rules.bounds, state());
    while(beyond > tolerated && time_step > rules.first_step)
    {
      const std::deque<LineState> longer = solver.states();
      solver.restore(before);
      const bool solved
          = solver.step_to(before.front().time + time_step / 2) == StepOutcome::accepted;
      const double left = overshoot(problem, rules.bounds, state());
      if(!solved || left > worth_halving * beyond)
      {
        solver.restore(longer);
        break;
      }
      ++shortened_steps;
      time_step /= 2;
      beyond = left;
    }
    return time_step;
  }

  void LineStepper::advance(double target, const AfterStep &after_step)
  {
    while(state().time < target)
    {
      if(events > most_events)
        throw cases::NumericalError(method_name, kept, state().time, "number of events",
                                    "exceeds every bound");
      if(gone_at_centre())
      {
        remove(0);
        continue;
      }
      const double end = choose_end(target);
      const double time_step = end - state().time;
      if(!(time_step > 0))
        throw cases::NumericalError(method_name, kept, state().time, "time step",
                                    "is too short to be added to the time");
      const std::deque<LineState> before = solver.states();
      solver.accept_jumps(time_step < last_resort * rules.planned_step);
      const StepOutcome outcome = solver.step_to(end);
      if(outcome != StepOutcome::accepted)
      {
        shorten(outcome, time_step);
        continue;
      }
      if(!unresolved.empty() && a_front_turned(before))
        step_without_history(before.front(), end);
      if(time_step > rules.shortest_step && vanishes_too_fast(before.front()))
      {
        ++shortened_steps;
        solver.restore(before);
        next_step = time_step / 2;
        continue;
      }
      next_step = time_step * growth;
      if(pass_wall(before, time_step))
        continue;
      next_step = std::min(next_step, shorten_to_bounds(before, time_step) * growth);
      ++kept;
      warn_of_thin_layers();
      warn_of_metastable_phases();
      after_step(before.front());
      insert_where_called_for();
    }
  }

  void LineStepper::warn_of_thin_layers()
  {
    const LineState &now = state();
    const double width = 2 * problem.spacing;
    for(std::size_t j = 0; j < now.fronts.size(); ++j)
    {
      const LineInterval below = interval(problem, now, j);
      const LineInterval above = interval(problem, now, j + 1);
      // A layer that has just appeared is thin by its nature.
      if(below.upper - below.lower < width || above.upper - above.lower < width)
        continue;
      for(const bool solid : {false, true})
      {
        const double diffusivity = problem.phase(solid).diffusivity();
        const double h = problem.spacing_at(now.fronts[j]);
        const double peclet = std::abs(now.speed[j]) * h / diffusivity;
        const int strength = peclet > 1 ? 2 : peclet > 0.5 ? 1 : 0;
        if(strength <= warned[solid ? 1 : 0])
          continue;
        warned[solid ? 1 : 0] = strength;
        const std::string text = fmt::format(
            "the thermal layer of the {} beside the front is {}: V h/alpha = {:.3g} with "
            "V = {:.3g} m/s, h = {:.3g} m, alpha = {:.3g} m^2/s; 0.5 wants a spacing of "
            "{:.3g} m",
            name_of(solid), strength == 2 ? "not resolved" : "hardly resolved", peclet,
            now.speed[j], h, diffusivity, h * 0.5 / peclet);
        note(now.time, text);
        if(strength == 2)
          unresolved = fmt::format("at t = {:.6g} {}", now.time, text);
      }
    }
  }

  void LineStepper::warn_of_metastable_phases()
  {
    if(problem.metastable)
      return;
    const LineState &now = state();
    const double melting = problem.material.melting_temperature;
    for(std::size_t i = 1; i + 1 < problem.nodes.size(); ++i)
    {
      const bool solid = now.solid(now.interval_of(problem.nodes[i]));
      const double excess = (solid ? 1 : -1) * (now.temperature[i] - melting);
      bool &warned_before = warned_metastable[solid ? 1 : 0];
      if(warned_before || excess <= spoken_of * rules.temperature_span)
        continue;
      warned_before = true;
      note(now.time,
           fmt::format("{} by {:.3g} K at {:.6g} m; inside a phase none appears",
                       solid ? "solid is superheated" : "liquid is undercooled", excess,
                       problem.nodes[i]));
    }
  }
} // namespace meltfront::particles::rkpm_tracked
