#include <particles/sph/explicit_stepper.h>

#include <utility>

namespace meltfront::particles
{
  ExplicitStepper::ExplicitStepper(HeatFlow &heat_flow,
                                   const Discretisation &discretisation,
                                   const StepPlan &plan, std::vector<double> initial,
                                   const std::string &method)
    : Stepper(heat_flow, discretisation, plan, std::move(initial), method)
    , super_step(plan.stages)
    , flow(enthalpy.size())
  {
    if(plan.stages > 1)
      for(auto *array : {&start, &before, &start_flow})
        array->resize(enthalpy.size());
  }

  double ExplicitStepper::make_step(long step, double begin)
  {
    const double end = time_of(step);
    heat_flow.prepare_step(begin, end);
    const bool super = plan.stages > 1 && step > plan.resolved_steps;
    double wall_heat = super ? take_super_step(end - begin)
                             : take_euler_steps(end - begin, plan.euler_substeps);
    double held_heat = finish();
    if(super && breaks_bounds())
    {
      std::swap(enthalpy, start);
      heat_flow.follow(enthalpy);
      wall_heat = take_euler_steps(end - begin, plan.euler_substeps);
      held_heat = finish();
      ++repeated;
    }
    book(wall_heat, held_heat);
    return end;
  }

  double ExplicitStepper::take_euler_steps(double duration, int steps)
  {
    const double step = duration / steps;
    double wall_heat = 0;
    for(int i = 0; i < steps; ++i)
    {
      if(i > 0)
        heat_flow.follow(enthalpy);
      wall_heat += step * heat_flow.scale()
                   * heat_flow.evaluate(enthalpy, double(i) / steps, flow);
      add_flow(enthalpy_factor(step), flow);
    }
    return wall_heat;
  }

  double ExplicitStepper::take_super_step(double duration)
  {
    const double step = duration * heat_flow.scale();
    const double factor = enthalpy_factor(duration);
    start = enthalpy;
    before = enthalpy;
    const double start_rate = heat_flow.evaluate(enthalpy, 0, start_flow);
    double wall_before = 0;
    double wall = super_step.first_rate * step * start_rate;
    add_flow(super_step.first_rate * factor, start_flow);
    for(const SuperStage &stage : super_step.stages)
    {
      heat_flow.follow(enthalpy);
      const double rate = heat_flow.evaluate(enthalpy, stage.fraction, flow);
      combine(stage, factor);
      std::swap(before, enthalpy);
      const double wall_next
          = stage.previous * wall + stage.before * wall_before
            + step * (stage.rate * rate + stage.start_rate * start_rate);
      wall_before = wall;
      wall = wall_next;
    }
    return wall;
  }

  void ExplicitStepper::add_flow(double factor, const std::vector<double> &added)
  {
    const int threads = heat_flow.threads();
    double *h = enthalpy.data();
    const double *f = added.data();
#pragma omp parallel for simd schedule(static) num_threads(threads) if(threads > 1)
    for(std::size_t a = 0; a < n; ++a)
      h[a] += factor * f[a];
  }

  void ExplicitStepper::combine(const SuperStage &stage, double factor)
  {
    const int threads = heat_flow.threads();
    const double *previous = enthalpy.data(), *first = start.data();
    const double *f = flow.data(), *first_flow = start_flow.data();
    double *next = before.data();
#pragma omp parallel for simd schedule(static) num_threads(threads) if(threads > 1)
    for(std::size_t a = 0; a < n; ++a)
      next[a] = stage.previous * previous[a] + stage.before * next[a]
                + stage.start * first[a]
                + factor * (stage.rate * f[a] + stage.start_rate * first_flow[a]);
  }
} // namespace meltfront::particles
