#include <reference_fem/fitted/tests/support.h>

#include <reference_fem/fitted/fitted.h>

namespace meltfront::reference_fem::fitted::tests
{
  Record run(const cases::Scene &scene, int n, const OptionTexts &options,
             const cases::ExactSolution *exact, double temperature_from)
  {
    return {course_of(*make_fem_fitted(), scene, n, options), scene, exact,
            temperature_from};
  }
} // namespace meltfront::reference_fem::fitted::tests
