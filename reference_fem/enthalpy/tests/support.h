#ifndef meltfront_reference_fem_enthalpy_tests_support_h
#define meltfront_reference_fem_enthalpy_tests_support_h

#include <cases/tests/support/course.h>
#include <cases/tests/support/scenes.h>
#include <reference_fem/enthalpy/run.h>

namespace meltfront::reference_fem::tests
{
  using namespace test_support;

  /** k = c = rho = L = 1 with T_m = 1: the normalised case, lambda = 1/2 for this wall.
   */
  inline cases::Material normalised_material()
  {
    return unit_material(1);
  }

  inline constexpr double normalised_wall = 0.1906024227888705;
  inline constexpr double normalised_far = 1.2;

  /** What a run showed, one entry per step. */
  struct RunRecord : FrontCourse
  {
    StepStatistics statistics;
  };

  /** Run a scene with its own effects, every step recorded. The text `threads` sets the
   * number of threads, any other an option of the method. */
  RunRecord run(const cases::Scene &scene, int n, const OptionTexts &options = {},
                const cases::ExactSolution *exact = nullptr);
} // namespace meltfront::reference_fem::tests

#endif
