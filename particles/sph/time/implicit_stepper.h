#ifndef meltfront_particles_sph_time_implicit_stepper_h
#define meltfront_particles_sph_time_implicit_stepper_h

#include <particles/sph/time/implicit_heat_flow.h>
#include <particles/sph/time/implicit_scheme.h>
#include <particles/sph/time/stepper.h>

namespace meltfront::particles
{
  /** Advances the particles of one substance by implicit steps. */
  class ImplicitStepper : public Stepper, private ImplicitScheme::Subject
  {
  public:
    ImplicitStepper(const SphParameters &parameters, HeatFlow &heat_flow,
                    const Discretisation &discretisation, const StepPlan &plan,
                    std::vector<double> enthalpy, const std::string &method);

    StepCounts counts() const override;

  private:
    double make_step(long step, double begin) override;

    std::vector<double> &state() override
    {
      return enthalpy;
    }

    bool attempt(double begin, double end, TimeScheme scheme, WallHeat &heat) override;

    ImplicitScheme scheme;
    ImplicitHeatFlow implicit_flow;
    ImplicitSolver solver;
  };
} // namespace meltfront::particles

#endif
