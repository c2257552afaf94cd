#ifndef meltfront_particles_sph_explicit_stepper_h
#define meltfront_particles_sph_explicit_stepper_h

#include <particles/sph/stepper.h>

namespace meltfront::particles
{
  /**
   * Explicit Euler steps, or super steps of RKL2. A super step that breaks a bound is
   * repeated by Euler steps: only these convex combinations keep the maximum principle
   * for certain.
   */
  class ExplicitStepper : public Stepper
  {
  public:
    ExplicitStepper(HeatFlow &heat_flow, const Discretisation &discretisation,
                    const StepPlan &plan, std::vector<double> enthalpy,
                    const std::string &method);

  private:
    double make_step(long step, double begin) override;

    /** @return heat through walls. */
    double take_euler_steps(double duration, int steps);

    /** One step of RKL2. @return heat through walls, by the same recursion. */
    double take_super_step(double duration);

    void add_flow(double factor, const std::vector<double> &added);

    /** Y_j, into the array of Y_(j-2). */
    void combine(const SuperStage &stage, double factor);

    SuperStep super_step;
    std::vector<double> flow;                      ///< heat flow into each particle
    std::vector<double> start, before, start_flow; ///< Y_0, Y_(j-2), F(Y_0) of RKL2
  };
} // namespace meltfront::particles

#endif
