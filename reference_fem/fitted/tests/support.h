#ifndef meltfront_reference_fem_fitted_tests_support_h
#define meltfront_reference_fem_fitted_tests_support_h

#include <reference_fem/enthalpy/tests/support.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace meltfront::reference_fem::fitted::tests
{
  /** What a run of `fem-fitted` showed, one entry per step from the initial state on. */
  struct Record
  {
    cases::Cost cost;
    cases::RunDescription description;
    std::vector<double> time, solid_volume, front, front_exact, budget_defect;
    std::vector<double> front_points[3];           ///< at the end
    double temperature_error = 0;                  ///< relative L2 of T - T_m at the end
    std::vector<double> temperature, positions[3]; ///< at the end
    cases::HeatBudget heat;

    double worst_budget_defect() const;
    double worst_front_error() const; ///< over the exact front at the end
    double final_front_error() const;
  };

  using reference_fem::tests::ExactPointer;

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

  using Texts = std::map<std::string, std::string>;

  /**
   * Run a scene with its own effects.
   * @param temperature_from coordinate from which temperature errors count (m)
   */
  Record run(const cases::Scene &scene, int n, const Texts &options = {},
             const cases::ExactSolution *exact = nullptr, double temperature_from = 0);
} // namespace meltfront::reference_fem::fitted::tests

#endif
