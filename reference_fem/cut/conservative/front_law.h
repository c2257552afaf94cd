#ifndef meltfront_reference_fem_cut_conservative_front_law_h
#define meltfront_reference_fem_cut_conservative_front_law_h

#include <reference_fem/cut/conservative/step_frame.h>

#include <optional>
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

  /** What the law of the front is off by, by hat (m^2). */
  Values debt(const StepFrame &frame, const Front &front, const Values &change,
              const Values &increment);

  /**
   * An increment of the level set that approaches what the law of the front asks for. For
   * a given change the law is the condition for the minimum of
   *
   *   int max(-phi, 0) + smoothing(psi, psi)/2 + sum_w (A(begin; w) + change(w)) psi_w,
   *
   * which is convex in the increment psi as phi = phi_begin + psi is linear in it, and
   * what the law is off by is its gradient. So a step of Newton's method, and one with
   * the derivative of heat that a solve found along with that heat, goes down, and where
   * it goes so far that the function rises at its end half as steeply as it fell, half of
   * it is made.
   */
  class FrontMove
  {
  public:
    FrontMove(const TriangleMesh &mesh, const StepFrame &frame, const Values &change,
              const Values &increment);

    /** Add a share, mostly all, of the displacement in a solution. No node moves by more
     * than a spacing. */
    void make(const LocalVector &solution, const Values &change);

    /** One step of Newton's method for a given change of the solid's area. */
    void approach(const Values &change);

    Values increment;           ///< psi (m)
    std::optional<Front> front; ///< after it
    Values debt;                ///< what the law is off by there, by hat (m^2)
    double largest;             ///< of the last displacement, at a cut triangle (m)
    bool limited = false;       ///< one there was longer than a spacing

  private:
    void go_to(const Values &increment, const Values &change);
    double largest_at_front(const LocalVector &solution) const;

    const TriangleMesh &mesh;
    const StepFrame &frame;
  };
} // namespace meltfront::reference_fem::cut::conservative

#endif
