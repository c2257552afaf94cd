#ifndef meltfront_particles_sph_implicit_stepper_h
#define meltfront_particles_sph_implicit_stepper_h

#include <particles/sph/implicit_solver.h>
#include <particles/sph/stepper.h>

namespace meltfront::particles
{
  /**
   * Implicit steps of any length: backward Euler, or Crank-Nicolson with its first two
   * steps made of two backward Euler steps each, which damp what a discontinuous start
   * excites (Rannacher 1984).
   *
   * A step whose equations are not solved, or that breaks a bound, is repeated as two
   * backward Euler steps of half its length, and so on.
   *
   * Where an error is wanted, each step is made once whole and once in two halves, and
   * the halves are kept if both agree: the sum over the particles of the differences of
   * their enthalpy, over the sum of all its changes since the start, is at most the
   * wanted error. The differences that a phase change within a step makes fall with its
   * length only in proportion to all changes so far, not to the step's own.
   */
  class ImplicitStepper : public Stepper
  {
  public:
    ImplicitStepper(const SphParameters &parameters, HeatFlow &heat_flow,
                    const Discretisation &discretisation, const StepPlan &plan,
                    std::vector<double> enthalpy, const std::string &method);

    StepCounts counts() const override;

  private:
    /** Heat that came through walls and that held particles took. */
    struct WallHeat
    {
      double through = 0, held = 0;
    };

    double make_step(long step, double begin) override;
    double make_controlled_step(long step, double begin);

    /** The scheme of a step; the first are always backward Euler. */
    TimeScheme scheme_of(long step) const;

    /** Cross a time in one step, or in halves of it until they succeed. */
    void cross(long step, double begin, double end, TimeScheme scheme, int halvings,
               WallHeat &heat);

    /** @return false if the step failed; the state is then of no use. */
    bool attempt(double begin, double end, TimeScheme scheme, WallHeat &heat);

    /** One step whole and in halves. @return their difference over what has changed so
     * far, or infinity where a step failed; the state is that of the halves. */
    double compare(double begin, double end, TimeScheme scheme, WallHeat &heat);

    [[noreturn]] void fail(long step, double time) const;

    TimeScheme scheme;
    double wanted_error; ///< of a step; 0: steps of equal length
    double next_step;    ///< to be tried next where an error is wanted (s)
    double moved = 0;    ///< all changes of the enthalpies so far, summed (J/kg)
    double change = 0;   ///< the same in the step compared last
    ImplicitSolver solver;
    std::vector<double> base, flow, before, whole;
    long most_iterations = 0;
  };
} // namespace meltfront::particles

#endif
