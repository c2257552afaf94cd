#ifndef meltfront_reference_fem_cut_conservative_front_law_h
#define meltfront_reference_fem_cut_conservative_front_law_h

#include <reference_fem/cut/conservative/step_frame.h>

#include <vector>

namespace meltfront::reference_fem::cut::conservative
{
  /**
   * Add the rows of the front's law, linear about a front for a further increment dpsi of
   * the level set,
   *
   *   int_front dpsi w/|grad phi| + smoothing(psi + dpsi; w)
   *     = A(front; w) - A(begin; w) - change(w)
   *
   * @param change of the solid's area since the step's begin that the law asks for, by
   * hat (m^2), but for what depends on unknowns
   * @param increment psi so far
   */
  void add_area_law(const StepFrame &frame, const Front &front, const Values &change,
                    const Values &increment, std::vector<Eigen::Triplet<double>> &entries,
                    LocalVector &load);

  /** Add the displacement found to the increment, one spacing at most at a node.
   * @return the largest at a cut triangle, as it was found (m) */
  double add_displacement(const StepFrame &frame, const Front &front, double spacing,
                          const LocalVector &solution, Values &increment);

  /** What the law of the front is off by, by hat (m^2). */
  Values debt(const StepFrame &frame, const Front &front, const Values &change,
              const Values &increment);
} // namespace meltfront::reference_fem::cut::conservative

#endif
