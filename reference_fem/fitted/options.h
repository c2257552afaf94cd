#ifndef meltfront_reference_fem_fitted_options_h
#define meltfront_reference_fem_fitted_options_h

#include <cases/method.h>
#include <cases/option_binder.h>
#include <cases/overshoot.h>
#include <cases/scene.h>
#include <reference_fem/fitted/time/integrator.h>

#include <string>

namespace meltfront::reference_fem::fitted
{
  inline constexpr const char *method_name = "fem-fitted";

  /** Elements of higher degree obey no maximum principle. A wall that jumps at the start
   * leaves a layer that the first steps do not resolve; it is the wider in cells, by
   * their root, the more there are. */
  inline constexpr cases::Overshoot overshoot{0.05, 0.5};

  /** What n refines. */
  enum class Refine
  {
    both,
    space,
    time
  };

  /** The options of `fem-fitted`. */
  struct RunOptions
  {
    void bind(cases::OptionBinder &options);

    int degree = 4;
    int dimension = 0; ///< 0: the lowest
    std::string scheme_name = "radau5";
    int steps = 0; ///< 0: by the cells
    Refine refine = Refine::both;
    int cells = 32;                  ///< along the domain's side
    int cells_around = 0;            ///< a round front; 0: by the cells
    std::string clock = "automatic"; ///< automatic, t or sqrt(t)
    double tolerance = 0;
    double grading = 1;
    Scheme scheme{};
  };

  /** Their values, made out for a scene.
   * @throws Refusal for a dimension that the scene cannot be simulated in. */
  RunOptions options_for(const cases::Scene &scene, const cases::Resolution &resolution);

  /**
   * Memory and steps of a run, from numbers alone: unknowns, entries of a row, and what
   * the factors of bands (1D) and of nested dissection (2D, 3D) fill.
   */
  cases::Demand demand_of(const cases::Scene &scene, const RunOptions &options);
} // namespace meltfront::reference_fem::fitted

#endif
