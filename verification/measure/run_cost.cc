#include <cases/numbers.h>
#include <verification/measure/measure.h>

namespace meltfront::verification
{
  namespace
  {
    /** NaN for a method that does not iterate. */
    double if_positive(double number)
    {
      return number > 0 ? number : cases::nan;
    }
  } // namespace

  /** Iterations, time and memory. */
  MeasureKind run_cost()
  {
    using enum Shown;
    Quantity most = told(value_quantity("most_iterations", "most in a step", ""),
                         [](const RunFigures &run)
                         { return if_positive(1. * run.cost.most_iterations); });
    most.whole = true;
    return {{told(value_quantity("iterations_per_step", "iterations per step", ""),
                  [](const RunFigures &run) {
                    return if_positive(1. * run.cost.solver_iterations / run.cost.steps);
                  }),
             most,
             told(hidden_quantity("solver_iterations"),
                  [](const RunFigures &run) { return 1. * run.cost.solver_iterations; }),
             told(hidden_quantity("capped_steps"),
                  [](const RunFigures &run) { return 1. * run.cost.capped_steps; }),
             told(value_quantity("cpu_seconds", "CPU", "s", always, 0),
                  [](const RunFigures &run)
                  { return run.cost.setup_cpu + run.cost.stepping_cpu; }),
             told(value_quantity("wall_seconds", "wall", "s", always, 0),
                  [](const RunFigures &run)
                  { return run.cost.setup_wall + run.cost.stepping_wall; }),
             told(value_quantity("peak_memory_mb", "memory", "MB", always, 0),
                  [](const RunFigures &run) { return run.peak_memory_mb; }),
             told(value_quantity("work", "work", "entries", always, 0),
                  [](const RunFigures &run) { return 1. * run.cost.work; })}};
  }
} // namespace meltfront::verification
