#ifndef meltfront_reference_fem_fitted_options_h
#define meltfront_reference_fem_fitted_options_h

#include <cases/method.h>
#include <cases/overshoot.h>
#include <cases/scene.h>
#include <reference_fem/fitted/time/integrator.h>

#include <string>
#include <vector>

namespace meltfront::reference_fem::fitted
{
  inline constexpr const char *method_name = "fem-fitted";

  /** Elements of higher degree obey no maximum principle. A wall that jumps at the start
   * leaves a layer that the first steps do not resolve; it is the wider in cells, by
   * their root, the more there are. */
  inline constexpr cases::Overshoot overshoot{0.05, 0.5};

  /** The options of `fem-fitted`. */
  std::vector<cases::OptionDeclaration> fitted_options();

  /** Their values, made out for a scene. */
  struct RunOptions
  {
    /** @throws Refusal for a dimension that the scene cannot be simulated in. */
    RunOptions(const cases::Scene &scene, const cases::Resolution &resolution);

    int dimension;
    int degree;
    int cells;            ///< along the domain's side
    int cells_around = 0; ///< a round front
    int steps;
    bool refines_time; ///< n counts steps, not cells
    double grading;
    double tolerance;
    Scheme scheme;
    std::string clock; ///< auto, t or sqrt(t)
  };

  /**
   * Memory and steps of a run, from numbers alone: unknowns, entries of a row, and what
   * the factors of bands (1D) and of nested dissection (2D, 3D) fill.
   */
  cases::Demand demand_of(const cases::Scene &scene, const RunOptions &options);
} // namespace meltfront::reference_fem::fitted

#endif
