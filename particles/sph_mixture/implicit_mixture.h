#ifndef meltfront_particles_sph_mixture_implicit_mixture_h
#define meltfront_particles_sph_mixture_implicit_mixture_h

#include <particles/sph/time/implicit_solver.h>
#include <particles/sph_mixture/mixture_flow.h>

#include <span>
#include <vector>

namespace meltfront::particles
{
  /**
   * Implicit steps of a mixture. Heat flows with compositions kept, for which the
   * equations of all particles are solved; solutes flow with enthalpies kept, by explicit
   * steps, whose bound is some hundred times looser than that of the heat. Backward
   * Euler: heat, then solutes, first order. Crank-Nicolson: half the time of the solutes
   * by steps of second order (Heun, a mean of convex combinations), all of the heat, the
   * other half of the solutes (Strang 1968).
   */
  class ImplicitMixture : private ImplicitFlow
  {
  public:
    ImplicitMixture(MixtureFlow &flows, const AlloySubstance &substance,
                    std::size_t particles, double particle_mass);

    /**
     * One step.
     * @param composed views into arrays of the run
     * @param concentrations the arrays of those that diffuse, one after another; empty
     * where none does
     * @return whether the equations were solved; if not, the state is of no use.
     */
    bool take_step(MixtureView composed, std::span<double> concentrations, double begin,
                   double end, TimeScheme scheme, WallHeat &heat);

    const ImplicitSolver &equations() const
    {
      return solver;
    }

  private:
    std::size_t size() const override
    {
      return n;
    }

    std::size_t padded_size() const override
    {
      return flows.padded_size();
    }

    double scale() const override
    {
      return 1;
    }

    double evaluate(std::span<const double> enthalpy, double fraction,
                    std::span<double> flow) override;
    void linearise(std::span<const double> enthalpy, double fraction) override;
    void apply_derivative(std::span<const double> change,
                          std::span<double> flow_change) override;
    std::span<const double> derivative_diagonal() const override;
    void correct(std::span<const double> correction,
                 std::span<double> enthalpy) const override;
    double largest_sensible_heat(std::span<const double> enthalpy) const override;

    /** Explicit steps of the solutes, as many as keep to their bound. */
    void diffuse(std::span<double> concentrations, double duration, bool second_order);

    /** Add the flows of a time to the concentrations. */
    void add_flows(std::span<double> concentrations, double duration);

    MixtureFlow &flows;
    const AlloySubstance &substance;
    std::size_t n;
    double mass;
    MixtureView view; ///< of the step at hand
    std::vector<double> solute_flow, solute_start;
    ImplicitSolver solver;
  };
} // namespace meltfront::particles

#endif
