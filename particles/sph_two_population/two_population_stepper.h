#ifndef meltfront_particles_sph_two_population_two_population_stepper_h
#define meltfront_particles_sph_two_population_two_population_stepper_h

#include <particles/sph/time/explicit_scheme.h>
#include <particles/sph_two_population/two_population_flow.h>
#include <particles/sph_two_population/two_population_implicit.h>

#include <optional>
#include <vector>

namespace meltfront::particles
{
  /**
   * Steps of the sites in time.
   *
   * * Euler: conduction and diffusion from one state, then the change of phase.
   * * RKL2 super steps of masses, heats and concentrations, with the rates at which
   *   liquid at its liquidus freezes or melts ice (Sites::make_rates); after each stage
   *   the change of phase mends what begins, ends or turns within it.
   * * Implicit: TwoPopulationImplicit, after explicit diffusion of the solutes.
   *
   * A super step or an implicit one that breaks a bound, or that is not solved, is
   * repeated with Euler steps, of convex combinations only.
   */
  class TwoPopulationStepper
  {
  public:
    TwoPopulationStepper(const TwoPopulationParameters &parameters, const StepPlan &plan,
                         const cases::TemperatureBounds &bounds, TwoPopulationFlow &flows,
                         Sites &sites);

    /** @return heat through walls (J per simulated depth). */
    double advance(long step, double begin, double end);

    long repeated_steps() const
    {
      return repeated;
    }

    /** Iterations of the linear solver of implicit steps. */
    long solver_iterations() const
    {
      return implicit ? implicit->linear_iterations() : 0;
    }

  private:
    double take_euler_steps(double begin, double end, int steps);
    double take_super_step(double duration);
    bool take_implicit_step(long step, double begin, double end, double &wall_heat);
    double evaluate(double fraction, std::vector<double> &rates);
    void diffuse(double duration);
    bool breaks_bounds() const;

    StepPlan plan;
    TimeScheme scheme;
    cases::TemperatureBounds bounds;
    TwoPopulationFlow &flows;
    Sites &sites;
    std::vector<double> to_liquid, to_ice, solute_flow;
    std::optional<ExplicitScheme> super_scheme;
    std::optional<TwoPopulationImplicit> implicit;
    std::vector<double> state;
    long repeated = 0;
  };
} // namespace meltfront::particles

#endif
