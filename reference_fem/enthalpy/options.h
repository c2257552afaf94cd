#ifndef meltfront_reference_fem_enthalpy_options_h
#define meltfront_reference_fem_enthalpy_options_h

#include <cases/method.h>
#include <cases/overshoot.h>
#include <cases/scene.h>
#include <reference_fem/enthalpy/linear_solver.h>

#include <vector>

namespace meltfront::reference_fem
{
  /** Cells along a curve are no rectangles: their matrix is none of the monotone ones that
   * obey the maximum principle. On meshes of rectangles it is obeyed. */
  inline constexpr cases::Overshoot overshoot{0.05, 0.5};

  /** The options of `fem-enthalpy`. */
  std::vector<cases::OptionDeclaration> enthalpy_options();

  /** Their values, made out for a scene. */
  struct RunOptions
  {
    /** @throws Refusal for a dimension that the scene cannot be simulated in. */
    RunOptions(const cases::Scene &scene, const cases::Resolution &resolution);

    int dimension;
    bool bdf2; ///< else backward Euler
    long steps;
    int start_halvings;
    int iteration_limit;
    Preconditioner preconditioner;
  };
} // namespace meltfront::reference_fem

#endif
