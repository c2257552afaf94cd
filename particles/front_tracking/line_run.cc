#include <cases/error.h>
#include <particles/front_tracking/line_run.h>

namespace meltfront::particles::front_tracking
{
  cases::Cost solve_line(const cases::Scene &, const cases::EffectSet &,
                         const cases::Resolution &, cases::Observer &)
  {
    throw cases::Refusal("rkpm-tracked does not run along a line in this build");
  }
} // namespace meltfront::particles::front_tracking
