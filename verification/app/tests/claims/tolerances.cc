#include <verification/app/tests/claims/tolerances.h>

namespace meltfront::verification::claims
{
  void adapt(const std::string &method, const std::string &form, Trial &trial)
  {
    const int dimension = trial.scene.domain.dimension;
    if(method == "fem-fitted")
      trial.n = dimension == 1 ? 16 : dimension == 2 ? 10 : 6;
    if(method == "fem-cut")
      trial.n = 16;
    if(form == "in the plane")
      trial.n = 20;
    if(method == "sph-2005" && (trial.scene.inclusion || !trial.scene.sources.empty()))
      trial.options = {{"step_factor", "0.05"}};
  }

  Tolerance tolerance_of(const std::string &, const cases::Scene &)
  {
    return {0.02, 0.02};
  }
} // namespace meltfront::verification::claims
