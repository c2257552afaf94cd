#include <cases/wall_law.h>
#include <particles/rkpm_tracked/line/solver.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    /** Fronts are solved for to this, over the spacing. */
    constexpr double front_tolerance = 1e-10;
    /** The defect is heat that is lost. Where a layer is thinner than a cell a bracket
     * that closes about a jump may leave a cell's heat over: more than this, over the
     * tolerance, is no solution. */
    constexpr double most_lost = 1e3;
    constexpr int most_iterations = 60;
    /** From then on the points of phases are kept, where rows are balances: heat of cells
     * whose nodes come and go with the front is no function that has a zero. */
    constexpr int free_iterations = 8;
    constexpr double cfl = 1; ///< of a front in a step, over the spacing
    constexpr double least_thickness_over_spacing = 1e-3;
    /** Step of the differences that begin Broyden's matrix, over the spacing. */
    constexpr double difference = 1e-4;

    /** Where the only front must lie, as the signs of the defects tell. */
    struct Bracket
    {
      double lower = -std::numeric_limits<double>::infinity();
      double upper = std::numeric_limits<double>::infinity();

      void narrow(double front, double defect)
      {
        (defect > 0 ? lower : upper) = front;
      }

      double keep(double proposed) const
      {
        const bool closed = std::isfinite(lower) && std::isfinite(upper);
        return closed && !(proposed > lower && proposed < upper) ? (lower + upper) / 2
                                                                 : proposed;
      }
    };

    double largest(const std::vector<double> &values)
    {
      double result = 0;
      for(const double value : values)
        result = std::max(result, std::abs(value));
      return result;
    }

    bool finite(const std::vector<double> &values)
    {
      return std::ranges::all_of(values,
                                 [](double value) { return std::isfinite(value); });
    }
  } // namespace

  LineSolver::LineSolver(const LineProblem &problem, const LineSettings &settings)
    : problem(problem)
    , collocation(problem, settings)
    , history(problem, settings)
    , rate_history(problem.nodes.size())
  {
  }

  double LineSolver::least_thickness() const
  {
    double least = problem.spacing;
    for(const double beside_wall : problem.wall_spacing)
      if(beside_wall > 0)
        least = std::min(least, beside_wall);
    return least_thickness_over_spacing * least;
  }

  void LineSolver::restart(LineState state)
  {
    std::vector<EndSlopes> slopes(state.n_intervals());
    for(std::size_t p = 0; p < slopes.size(); ++p)
      slopes[p] = collocation.slopes(interval(problem, state, p), state.temperature);
    find_speeds(state, slopes, &LineWall::value_after);
    find_cells(state);
    history.restart(std::move(state));
    slope_known = false;
  }

  void LineSolver::set_wall(LineState &state, std::size_t side)
  {
    const LineWall &wall = problem.walls[side];
    double &value = side == 0 ? state.temperature.front() : state.temperature.back();
    if(wall.fixed())
      value = wall.value_after(state.time);
    else if(cases::exchanges_heat(wall.kind))
      value = collocation.exchanging_wall(
          interval(problem, state, side == 0 ? 0 : state.n_intervals() - 1), side,
          wall.value_after(state.time), state.temperature);
  }

  void LineSolver::find_speeds(LineState &state, const std::vector<EndSlopes> &slopes,
                               WallValue given) const
  {
    const double released = problem.front_density() * problem.material.latent_heat;
    const auto conductivity
        = [&](std::size_t p) { return problem.phase(state.solid(p)).conductivity; };
    state.speed.resize(state.fronts.size());
    for(std::size_t j = 0; j < state.fronts.size(); ++j)
    {
      const double heat
          = conductivity(j + 1) * slopes[j + 1][0] - conductivity(j) * slopes[j][1];
      state.speed[j] = (state.solid(j) ? -heat : heat) / released;
    }
    const std::size_t last = state.n_intervals() - 1;
    state.wall_flux
        = {-conductivity(0) * slopes[0][0], conductivity(last) * slopes[last][1]};
    for(const std::size_t side : {0, 1})
      if(const LineWall &wall = problem.walls[side]; cases::exchanges_heat(wall.kind))
        state.wall_flux[side] = cases::heat_through(wall.law, (wall.*given)(state.time),
                                                    side == 0 ? state.temperature.front()
                                                              : state.temperature.back())
                                    .flux;
  }

  void LineSolver::close_thin_layer(const LineInterval &interval, double growth,
                                    EndSlopes &slopes) const
  {
    // Without inner nodes the profile is that of a layer that grows like sqrt(t): an
    // error function, straight where it stands still.
    const double diffusivity = problem.phase(interval.solid).diffusivity();
    const double s = (interval.upper - interval.lower) * growth / (2 * diffusivity);
    if(!(s > 1e-12))
      return;
    const double at_wall = 2 * std::sqrt(s / std::numbers::pi) / std::erf(std::sqrt(s));
    slopes[interval.lower_front ? 1 : 0] *= at_wall;
    slopes[interval.lower_front ? 0 : 1] *= at_wall * std::exp(-s);
  }

  void LineSolver::find_history(std::size_t number, const LineInterval &interval)
  {
    const auto [first, end] = collocation.nodes_of(interval);
    for(std::size_t i = first; i < end; ++i)
    {
      double sum = 0;
      for(std::size_t k = 1; k < weights.size(); ++k)
        sum += weights[k] * history.temperature(k - 1, i, number);
      rate_history[i] = sum;
    }
  }

  void LineSolver::evaluate(Trial &trial)
  {
    ++counted.evaluations;
    LineState &state = trial.state;
    const std::size_t n_fronts = state.fronts.size();
    trial.rate.assign(n_fronts, 0.);
    for(std::size_t j = 0; j < n_fronts; ++j)
    {
      trial.rate[j] = weights[0] * state.fronts[j];
      for(std::size_t k = 1; k < weights.size(); ++k)
        trial.rate[j]
            += weights[k] * place_before(history.level(k - 1).fronts[j], state.fronts[j]);
    }
    if(problem.balanced())
      state.cells.assign(problem.nodes.size(), 0.);
    std::vector<EndSlopes> slopes(state.n_intervals());
    for(std::size_t p = 0; p < slopes.size(); ++p)
    {
      const LineInterval phase = interval(problem, state, p);
      find_history(p, phase);
      StepTerms terms{state.time, weights[0], rate_history, 0, 0};
      if(n_fronts > 0 && problem.displacement(phase.solid) != 0)
      {
        const std::size_t own = phase.upper_front ? p : p - 1;
        terms.displaced_speed = problem.displacement(phase.solid) * trial.rate[own];
        terms.displacing_front = state.fronts[own];
      }
      if(!problem.metastable && problem.displacement(phase.solid) == 0)
        terms.approach = {phase.lower_front ? std::max(trial.rate[p - 1], 0.) : 0.,
                          phase.upper_front ? std::max(-trial.rate[p], 0.) : 0.};
      terms.rate = {phase.lower_front ? trial.rate[p - 1] : 0.,
                    phase.upper_front ? trial.rate[p] : 0.};
      terms.given_flux = given_flux;
      slopes[p] = collocation.solve(phase, terms, state.temperature);

      if(collocation.is_held_film(phase))
        close_thin_layer(phase, phase.upper_front ? trial.rate[p] : -trial.rate[p - 1],
                         slopes[p]);
      if(problem.balanced())
        add_changed_cells(p, phase, state, slopes[p]);
    }
    find_speeds(state, slopes, &LineWall::value);
    trial.defect.resize(n_fronts);
    for(std::size_t j = 0; j < n_fronts; ++j)
      trial.defect[j] = state.speed[j] - trial.rate[j];
  }

  std::vector<double> LineSolver::predicted_fronts(double time_step) const
  {
    std::vector<double> result = history.newest().fronts;
    const std::size_t levels = std::min<std::size_t>(weights.size() - 1, 3);
    for(std::size_t j = 0; j < result.size(); ++j)
    {
      if(levels < 2)
      {
        result[j] += time_step * history.newest().speed[j];
        continue;
      }
      double sum = 0;
      for(std::size_t k = 0; k < levels; ++k)
        sum += lagrange_weight(std::span(times).subspan(1, levels), k, times[0])
               * (history.level(k).fronts[j] - result[j]);
      result[j] += sum;
    }
    return result;
  }

  /** @return whether some phase was kept from becoming too thin. */
  bool LineSolver::limit(std::vector<double> &fronts) const
  {
    const std::vector<double> &before = history.newest().fronts;
    for(std::size_t j = 0; j < fronts.size(); ++j)
    {
      const double move = cfl * problem.spacing_at(before[j]);
      fronts[j] = std::clamp(fronts[j], before[j] - move, before[j] + move);
    }
    bool closing = false;
    const double apart = least_thickness();
    double bound = problem.nodes.front();
    for(double &front : fronts)
    {
      closing |= front < bound + apart;
      front = bound = std::max(front, bound + apart);
    }
    bound = problem.nodes.back();
    for(std::size_t j = fronts.size(); j-- > 0;)
    {
      closing |= fronts[j] > bound - apart;
      fronts[j] = bound = std::min(fronts[j], bound - apart);
    }
    return closing;
  }

  void LineSolver::find_slope(const Trial &base)
  {
    const std::size_t n = base.state.fronts.size();
    slope.assign(n * n, 0.);
    for(std::size_t j = 0; j < n; ++j)
    {
      Trial moved = base;
      const LineInterval below = interval(problem, base.state, j);
      const LineInterval above = interval(problem, base.state, j + 1);
      const double room = std::min(
          {problem.spacing, below.upper - below.lower, above.upper - above.lower});
      moved.state.fronts[j] += difference * room;
      evaluate(moved);
      for(std::size_t i = 0; i < n; ++i)
        slope[i * n + j]
            = (moved.state.speed[i] - base.state.speed[i]) / (difference * room);
    }
    slope_known = true;
  }

  std::vector<double> LineSolver::correction(const std::vector<double> &defect) const
  {
    const std::size_t n = defect.size();
    std::vector<double> change(n);
    BandMatrix matrix;
    matrix.reset(n, n - 1, n - 1);
    for(std::size_t i = 0; i < n; ++i)
    {
      for(std::size_t j = 0; j < n; ++j)
        matrix(i, j) = slope[i * n + j];
      matrix(i, i) -= weights[0];
      change[i] = -defect[i];
    }
    // One front: a defect that grows with the front is no slope to follow.
    if(n == 1 && matrix(0, 0) >= 0)
      matrix(0, 0) = -weights[0];
    if(!matrix.solve(change))
      for(std::size_t i = 0; i < n; ++i)
        change[i] = defect[i] / weights[0];
    return change;
  }

  void LineSolver::update_slope(const std::vector<double> &change,
                                const std::vector<double> &before,
                                const std::vector<double> &after)
  {
    const std::size_t n = change.size();
    double squared = 0;
    for(const double c : change)
      squared += c * c;
    if(squared == 0)
      return;
    for(std::size_t i = 0; i < n; ++i)
    {
      double expected = -weights[0] * change[i];
      for(std::size_t j = 0; j < n; ++j)
        expected += slope[i * n + j] * change[j];
      const double missing = after[i] - before[i] - expected;
      for(std::size_t j = 0; j < n; ++j)
        slope[i * n + j] += missing * change[j] / squared;
    }
  }

  StepOutcome LineSolver::iterate(Trial &trial)
  {
    const bool closing = limit(trial.state.fronts);
    collocation.keep_points(false);
    evaluate(trial);
    return trial.state.fronts.empty()
               ? find_fronts(trial, closing)
               : front_meter.measure([&] { return find_fronts(trial, closing); });
  }

  StepOutcome LineSolver::find_fronts(Trial &trial, bool closing)
  {
    const double tolerance = front_tolerance * problem.spacing;
    if(!slope_known && !trial.state.fronts.empty())
      find_slope(trial);
    Bracket bracket;
    for(int iteration = 0; iteration < most_iterations; ++iteration)
    {
      if(problem.balanced() && iteration == free_iterations)
      {
        collocation.keep_points(true);
        evaluate(trial);
        find_slope(trial);
        bracket = {};
      }
      if(!finite(trial.defect) || !finite(trial.state.temperature))
        return StepOutcome::not_finite;
      if(largest(trial.defect) <= tolerance * std::abs(weights[0]))
        return StepOutcome::accepted;
      const std::vector<double> fronts = trial.state.fronts;
      std::vector<double> proposed = correction(trial.defect);
      for(std::size_t j = 0; j < fronts.size(); ++j)
        proposed[j] += fronts[j];
      if(fronts.size() == 1)
      {
        bracket.narrow(fronts[0], trial.defect[0]);
        proposed[0] = bracket.keep(proposed[0]);
      }
      if(!finite(proposed))
        return StepOutcome::not_finite;
      const std::vector<double> wanted = proposed;
      closing = limit(proposed);
      std::vector<double> change(fronts.size());
      for(std::size_t j = 0; j < fronts.size(); ++j)
        change[j] = proposed[j] - fronts[j];
      if(largest(change) <= tolerance)
        return closing              ? StepOutcome::closing
               : proposed != wanted ? StepOutcome::too_far
               : (steep[0] || steep[1]) && !jumps_accepted
                       && largest(trial.defect)
                              > most_lost * tolerance * std::abs(weights[0])
                   ? StepOutcome::not_converged
                   : StepOutcome::accepted;
      const std::vector<double> before = trial.defect;
      trial.state.fronts = proposed;
      evaluate(trial);
      update_slope(change, before, trial.defect);
    }
    return closing ? StepOutcome::closing : StepOutcome::not_converged;
  }

  StepOutcome LineSolver::step_to(double time)
  {
    const long evaluations = counted.evaluations;
    Trial trial;
    trial.state = history.newest();
    const double time_step = time - trial.state.time;
    trial.state.time = time;
    times = history.times(time);
    weights = differentiation_weights(times);
    find_given_flux();
    find_steep_phases();
    trial.state.fronts = predicted_fronts(time_step);
    const StepOutcome outcome = iterate(trial);
    counted.most_evaluations
        = std::max(counted.most_evaluations, counted.evaluations - evaluations);
    if(outcome == StepOutcome::accepted)
    {
      ++counted.steps;
      if(problem.balanced())
        book_walls(trial.state);
      history.push(std::move(trial.state));
    }
    else
      slope_known = false;
    return outcome;
  }

  cases::EffectCost LineSolver::cost(cases::Effect effect) const
  {
    if(effect == cases::Effect::phase_change)
    {
      const std::size_t n = state().fronts.size();
      return front_meter.cost(effect, (slope.size() + 2 * n) * sizeof(double));
    }
    if(const cases::EffectMeter *meter = collocation.meter(effect))
      return meter->cost(effect, 0);
    return {effect, counted.evaluations, 0, 0};
  }
} // namespace meltfront::particles::rkpm_tracked
