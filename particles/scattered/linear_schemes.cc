#include <particles/scattered/linear_run.h>

#include <algorithm>

namespace meltfront::particles
{
  double LinearRun::rate_of(double length) const
  {
    return options.time_scheme == LinearScheme::backward_euler   ? 1 / length
           : options.time_scheme == LinearScheme::crank_nicolson ? 2 / length
                                                                 : 1.5 / length;
  }

  void LinearRun::advance(LinearSolver &solver, long k, double end, double length)
  {
    const bool anew = k == 1 || looks_back_over_breakpoint(end, length);
    if(options.time_scheme == LinearScheme::bdf2 && anew)
    {
      start_bdf2(k, end, length);
      return;
    }
    if(options.time_scheme == LinearScheme::crank_nicolson)
    {
      // Two half steps of backward Euler damp what a jump excites (Rannacher 1984);
      // their matrix is the same.
      if(anew)
        for(const double time : {end - length / 2, end})
          take_euler_step(solver, k, time, length / 2);
      else
        take_crank_nicolson_step(solver, k, end, length);
      return;
    }
    if(options.time_scheme == LinearScheme::backward_euler)
      take_euler_step(solver, k, end, length);
    else
      take_bdf2_step(solver, k, end, length);
  }

  bool LinearRun::looks_back_over_breakpoint(double end, double length) const
  {
    const auto next = std::ranges::upper_bound(breakpoints, end - 2 * length);
    return next != breakpoints.end() && *next < end;
  }

  LinearStep LinearRun::step_to(double end, double length, bool knows_before) const
  {
    const double begin = end - length;
    return {knows_before ? begin - length : begin, begin, end,
            knows_before && options.time_scheme == LinearScheme::bdf2 ? 0.5 : 0., end};
  }

  void LinearRun::set_load(double factor, std::span<const double> vector,
                           const LinearStep &step)
  {
    problem.source(step, source);
    problem.mass.multiply(vector, load, threads);
    for(std::size_t i = 0; i < n; ++i)
      load[i] = factor * load[i] + source[i];
    work += static_cast<long>(problem.mass.size());
  }

  void LinearRun::take_euler_step(LinearSolver &solver, long k, double time,
                                  double length)
  {
    const LinearStep step = step_to(time, length, false);
    set_load(1 / length, unknowns, step);
    solve(solver, k, time);
    book(step, length, 1);
  }

  void LinearRun::take_crank_nicolson_step(LinearSolver &solver, long k, double end,
                                           double length)
  {
    const LinearStep step = step_to(end, length, true);
    LinearStep at_begin = step;
    at_begin.at = step.begin;
    book(at_begin, length, 0.5);
    previous.resize(n);
    problem.operator_rows.multiply(unknowns, previous, threads);
    work += static_cast<long>(problem.operator_rows.size());
    problem.source(at_begin, source);
    for(std::size_t i = 0; i < n; ++i)
      previous[i] = algebraic(i) ? 0 : previous[i] + source[i];
    set_load(2 / length, unknowns, step);
    for(std::size_t i = 0; i < n; ++i)
      load[i] += previous[i];
    solve(solver, k, end);
    book(step, length, 0.5);
  }

  void LinearRun::start_bdf2(long k, double end, double length)
  {
    if(!starting)
      starting.emplace(
          make_solver(sum_of(1 / length, problem.mass, -1, problem.operator_rows), k));
    before = unknowns;
    heat_before = heat;
    take_euler_step(*starting, k, end, length);
    if(breakpoints.empty())
      starting.reset();
  }

  void LinearRun::take_bdf2_step(LinearSolver &solver, long k, double end, double length)
  {
    previous.resize(n);
    for(std::size_t i = 0; i < n; ++i)
      previous[i] = 2 * unknowns[i] - 0.5 * before[i];
    before = unknowns;
    const LinearStep step = step_to(end, length, true);
    set_load(1 / length, previous, step);
    solve(solver, k, end);
    // What has flowed in obeys the recursion of what is stored.
    const cases::HeatBudget last = heat;
    heat.boundary = (4 * last.boundary - heat_before.boundary) / 3;
    heat.sources = (4 * last.sources - heat_before.sources) / 3;
    heat_before = last;
    book(step, length, 2. / 3);
  }

  bool LinearRun::algebraic(std::size_t row) const
  {
    return problem.mass.offsets[row] == problem.mass.offsets[row + 1];
  }

  void LinearRun::book(const LinearStep &step, double length, double share)
  {
    if(!problem.inflow)
      return;
    const HeatInflow inflow = problem.inflow(step, unknowns);
    heat.boundary += share * length * inflow.through_walls;
    heat.sources += share * length * inflow.released;
  }
} // namespace meltfront::particles
