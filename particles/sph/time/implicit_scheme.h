#ifndef meltfront_particles_sph_time_implicit_scheme_h
#define meltfront_particles_sph_time_implicit_scheme_h

#include <particles/sph/time/implicit_solver.h>
#include <particles/sph/time/time_stepping.h>

#include <string>
#include <vector>

namespace meltfront::particles
{
  /**
   * Implicit steps of any length: backward Euler, or Crank-Nicolson with its first two
   * steps made of two backward Euler steps each, which damp what a discontinuous start
   * excites (Rannacher 1984).
   *
   * A step that fails, for its equations are not solved or a bound is broken, is repeated
   * as two backward Euler steps of half its length, and so on.
   *
   * Where an error is wanted, each step is made once whole and once in two halves, and
   * the halves are kept if both agree: the sum over the particles of the differences of
   * their enthalpy, over the sum of all its changes since the start, is at most the
   * wanted error; likewise of each concentration. The differences that a phase change
   * within a step makes fall with its length only in proportion to all changes so far,
   * not to the step's own.
   */
  class ImplicitScheme
  {
  public:
    /** What is advanced. */
    class Subject
    {
    public:
      virtual ~Subject() = default;

      /** All that a step changes: fields of equal length, one after another. */
      virtual std::vector<double> &state() = 0;

      /** Make one step. @return false if it failed; the state is then of no use. */
      virtual bool attempt(double begin, double end, TimeScheme scheme, WallHeat &heat)
          = 0;
    };

    /**
     * @param fields of the state
     * @param method its name, for errors
     */
    ImplicitScheme(const SphParameters &parameters, const StepPlan &plan,
                   const cases::Scene &scene, std::size_t fields, std::string method);

    /**
     * Make a step of the plan, or where an error is wanted one that keeps to it.
     * @return its end.
     * @throws cases::NumericalError if it fails however short it is.
     */
    double make_step(Subject &subject, long step, double begin, WallHeat &heat);

    /** Steps that were rejected and made anew. */
    long repeated() const
    {
      return rejected;
    }

  private:
    double make_controlled_step(Subject &subject, long step, double begin,
                                WallHeat &heat);

    /** The scheme of a step; the first are always backward Euler, and those that begin
     * at a breakpoint. */
    TimeScheme scheme_of(long step, double begin) const;

    /** Cross a time in one step, or in halves of it until they succeed. */
    void cross(Subject &subject, long step, double begin, double end, TimeScheme scheme,
               int halvings, WallHeat &heat);

    /** One step whole and in halves. @return their difference over what has changed so
     * far, or infinity where a step failed; the state is that of the halves. */
    double compare(Subject &subject, double begin, double end, TimeScheme scheme,
                   WallHeat &heat);

    /** The difference in one field. */
    double compare_field(const std::vector<double> &state, std::size_t field);

    [[noreturn]] void fail(long step, double time) const;

    TimeScheme scheme;
    double wanted_error; ///< of a step; 0: steps of equal length
    StepPlan plan;
    double start, last;              ///< times of the run
    std::vector<double> breakpoints; ///< of the scene, at which steps end (s)
    std::string method;
    double next_step;           ///< to be tried next where an error is wanted (s)
    std::vector<double> moved;  ///< all changes of each field so far, summed
    std::vector<double> change; ///< the same in the step compared last
    std::vector<double> before, whole;
    long rejected = 0;
  };
} // namespace meltfront::particles

#endif
