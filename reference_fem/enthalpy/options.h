#ifndef meltfront_reference_fem_enthalpy_options_h
#define meltfront_reference_fem_enthalpy_options_h

#include <cases/method.h>
#include <cases/option_binder.h>
#include <cases/overshoot.h>
#include <cases/scene.h>
#include <reference_fem/enthalpy/linear_solver.h>

namespace meltfront::reference_fem
{
  /** Cells along a curve are no rectangles: their matrix is none of the monotone ones
   * that obey the maximum principle. On meshes of rectangles it is obeyed. */
  inline constexpr cases::Overshoot overshoot{0.05, 0.5};

  /** The options of `fem-enthalpy`. */
  struct RunOptions
  {
    void bind(cases::OptionBinder &options);

    bool bdf2 = true; ///< else backward Euler
    double steps_per_cell = 0.78125;
    long steps = 0; ///< 0: by steps_per_cell
    int start_halvings = 3;
    int dimension = 0; ///< 0: the lowest
    int iteration_limit = 100;
    bool front_within_cells = false; ///< conductances as FrontConduction has them
    bool refine_at_front = false;    ///< see FrontRefinement
    Preconditioner preconditioner = Preconditioner::automatic;
    double checkpoint = 0;    ///< between states that are kept (s of wall time); 0: none
    bool distributed = false; ///< the engine of several ranks, also on one
    std::vector<double> step_ends{}; ///< where steps end in between (s)
  };

  /** Their values, made out for a scene.
   * @throws Refusal for a dimension that the scene cannot be simulated in. */
  RunOptions options_for(const cases::Scene &scene, const cases::Resolution &resolution);
} // namespace meltfront::reference_fem

#endif
