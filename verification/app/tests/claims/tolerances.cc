#include <verification/app/tests/claims/tolerances.h>

namespace meltfront::verification::claims
{
  Tolerance tolerance_of(const std::string &, const cases::Scene &)
  {
    return {0.02, 0.02};
  }
} // namespace meltfront::verification::claims
