#ifndef meltfront_reference_fem_fitted_tests_support_h
#define meltfront_reference_fem_fitted_tests_support_h

#include <reference_fem/enthalpy/tests/support.h>

namespace meltfront::reference_fem::fitted::tests
{
  using namespace test_support;
  using Record = FrontCourse;

  /** A scene with the exact solution that it starts from and that its walls follow. */
  struct ExactScene
  {
    cases::Scene scene;
    ExactPointer exact;
  };

  /** Neumann's solution with the front from 0.1 to 0.5 of a slab. */
  ExactScene started_slab();

  /** Water under ice of another density. */
  ExactScene lighter_ice();

  /** Ice around a sink on the axis of a disk or at the centre of a ball. */
  ExactScene line_sink_disk();
  ExactScene point_sink_ball();

  /** Growth of solid into undercooled liquid, in 2 or 3 dimensions. */
  ExactScene frank(int dimension);

  /** Ice with a perturbed front on the inner wall of an annulus: T is a function of a
   * harmonic function that vanishes on the front. */
  cases::Scene perturbed_annulus(double end);

  /** A front with a wave along y, and along z in 3D, between a cold and a warm wall. */
  cases::Scene wavy_box(int dimension, double end);

  /**
   * Run a scene with its own effects.
   * @param temperature_from coordinate from which temperature errors count (m)
   */
  Record run(const cases::Scene &scene, int n, const OptionTexts &options = {},
             const cases::ExactSolution *exact = nullptr, double temperature_from = 0);
} // namespace meltfront::reference_fem::fitted::tests

#endif
