#ifndef meltfront_reference_fem_fitted_events_phase_check_h
#define meltfront_reference_fem_fitted_events_phase_check_h

#include <reference_fem/fitted/events/layered_state.h>

#include <string>
#include <vector>

namespace meltfront::reference_fem::fitted
{
  /** A wall that passes the melting temperature within a step. */
  struct WallCrossing
  {
    bool inner = true;
    double clock = 0; ///< at which it has passed it
  };

  /**
   * Keeps each phase on its own side of the melting temperature, but for those that are
   * beyond it at the start because the scene says so (Effect::metastable_phase).
   *
   * Heat that is conducted makes no extremes of its own: a phase passes the melting
   * temperature at a wall that leads it there or at a source first. What passes it
   * elsewhere is an overshoot of the elements, of which a little is borne.
   */
  class PhaseCheck
  {
  public:
    PhaseCheck(const EventScene &setting, std::string method);

    /** Learn which phases are metastable. */
    void start(const FittedProblem &problem, double time,
               const dealii::Vector<double> &u);

    bool is_metastable(bool solid) const
    {
      return metastable[solid ? 0 : 1];
    }

    /**
     * The walls that pass the melting temperature after one clock and up to another,
     * at which the state is @p u: one of fixed temperature at any of 16 times, one of
     * given flux at the end.
     */
    std::vector<WallCrossing> wall_crossings(const FittedProblem &problem, double from,
                                             double to,
                                             const dealii::Vector<double> &u) const;

    /**
     * Check a state.
     * @throws Refusal where the source at the centre starts a second front, and
     * of a start (step 0) beyond the melting point,
     * @throws NumericalError where the temperature of a phase is beyond the melting point
     * elsewhere, by more than the overshoot that is borne.
     */
    void check(const FittedProblem &problem, long step, double time,
               const dealii::Vector<double> &u) const;

    /** Whether a wall is beyond the melting temperature of the phase at it, by more than
     * rounding and what elements overshoot. */
    bool has_passed(const FittedProblem &problem, bool inner, unsigned int ray,
                    double time, const dealii::Vector<double> &u) const;

    /** @throws Refusal that names the wall and the time: of a second front in more than
     * one dimension. */
    [[noreturn]] void refuse(bool inner, double time) const;

  private:
    /** How far a temperature is beyond the melting point of what lies there. */
    static double beyond(bool solid, double excess)
    {
      return solid ? excess : -excess;
    }

    /** That of elements which is borne, of the temperature scale. */
    double overshoot() const;

    bool is_dirichlet_beyond(const FittedProblem &problem, bool inner, double time) const;
    void check_source(const FittedProblem &problem, double time) const;
    void check_nodes(const FittedProblem &problem, long step, double time,
                     const dealii::Vector<double> &u) const;

    const EventScene &setting;
    std::string method;
    std::array<bool, 2> metastable{}; ///< solid, liquid
    double largest_power = 0;
  };
} // namespace meltfront::reference_fem::fitted

#endif
