#include <verification/measure/measure.h>

namespace meltfront::verification
{
  /** How fine a run is, and what that takes. */
  MeasureKind run_size()
  {
    using enum Shown;
    Quantity unknowns
        = told(value_quantity("unknowns", "unknowns", "", always, 0),
               [](const RunFigures &run) { return 1. * run.cost.unknowns; });
    Quantity steps = told(value_quantity("steps", "steps", "", always, 0),
                          [](const RunFigures &run) { return 1. * run.cost.steps; });
    unknowns.whole = steps.whole = true;
    return {{told(value_quantity("h", "h", "m", always, 0),
                  [](const RunFigures &run) { return run.description.spacing; }),
             told(value_quantity("dt", "dt", "s", in_time),
                  [](const RunFigures &run) { return run.description.time_step; }),
             unknowns, steps}};
  }
} // namespace meltfront::verification
