#ifndef meltfront_particles_sph_time_explicit_stepper_h
#define meltfront_particles_sph_time_explicit_stepper_h

#include <particles/sph/time/explicit_scheme.h>
#include <particles/sph/time/stepper.h>

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

    /** Make a step in which no breakpoint lies. */
    void cross(long step, double begin, double end);

    double euler_steps(double duration);

    ExplicitScheme scheme;
  };
} // namespace meltfront::particles

#endif
