#ifndef meltfront_particles_sph_mixture_mixture_flow_h
#define meltfront_particles_sph_mixture_mixture_flow_h

#include <particles/alloy/solute_diffusion.h>
#include <particles/sph/heat_sources.h>
#include <particles/sph/time/time_stepping.h>
#include <particles/sph/wall_exchange.h>
#include <particles/sph/wall_flux.h>
#include <particles/sph/wall_temperature.h>
#include <particles/sph_mixture/mixture_conduction.h>
#include <particles/sph_mixture/mixture_derivative.h>

#include <optional>
#include <span>
#include <vector>

namespace meltfront::particles
{
  /** Enthalpy and concentrations of all particles: views into arrays of the run. */
  struct MixtureView
  {
    std::span<double> enthalpy;                           ///< J/kg
    std::span<const std::span<const double>> composition; ///< mass fractions, per solute
  };

  /**
   * The flows of heat and solutes into each particle, composed once from the passes of
   * the effects at hand.
   */
  class MixtureFlow
  {
  public:
    /** @param uniform all particles have one composition at the start. */
    MixtureFlow(const Discretisation &discretisation, const AlloySubstance &substance,
                const cases::EffectSet &effects, const MixtureParameters &parameters,
                bool uniform);

    MixtureFlow(const MixtureFlow &) = delete;
    MixtureFlow &operator=(const MixtureFlow &) = delete;

    void prepare_step(double begin, double end);

    /** Set particles on walls to the wall's temperature at a fraction of the step.
     * @return heat that this took from the walls (J in the measure of the scene). */
    double hold_walls(double fraction, MixtureView state);

    /** Find equilibria. @return extremes of the temperature. */
    Extremes follow(MixtureView state);

    /** The same where only heat is going to flow. */
    Extremes follow_heat(MixtureView state);

    /** Flow of heat into each particle, as of the last follow().
     * @return heat flow through walls (W per simulated depth). */
    double heat(double fraction, std::span<double> flow);

    /** Flow of a solute into each particle (kg/s), as of the last follow(). */
    void solute(std::size_t solute, std::span<double> flow);

    /** Flows of the heat, and where solutes diffuse of each of these: arrays of
     * padded_size(), one after another, the first of heat.
     * @return heat flow through walls. */
    double evaluate(double fraction, std::span<double> flows);

    /** Prepare products with the derivative of heat() by the enthalpies, as of the last
     * follow(), compositions kept. */
    void linearise(double fraction, MixtureView state);

    /** How heat() follows a change of the enthalpies, to first order. */
    void apply_derivative(std::span<const double> change, std::span<double> flow_change);

    /** How each particle's heat flow follows its own enthalpy. */
    std::span<const double> derivative_diagonal() const
    {
      return diagonal;
    }

    /** Add a correction, each particle to the next kink of its T(H) at most. */
    void correct(std::span<const double> correction, std::span<double> enthalpy) const
    {
      derivative->correct(correction, enthalpy);
    }

    /** The largest explicit step of the solutes alone (s). */
    double largest_solute_step(double particle_mass) const
    {
      return particle_mass / diffusion->row_sum();
    }

    /** The largest explicit step that is certain to keep the maximum principle:
     * m / (sum_b g_ab (k/c + 2 rho D)), with the largest k, the least c and the largest
     * D. */
    double monotone_step(double particle_mass) const;

    /** How long explicit steps may be.
     * @param held particles that hold a wall's temperature */
    StepLimits step_limits(const cases::Scene &scene, double particle_mass,
                           StepLimit asked, std::span<const std::uint32_t> held) const;

    double source_heat(double time) const;

    std::span<const double> temperature_excess() const
    {
      return conduction.temperature_excess();
    }

    std::span<const double> liquid_fraction() const
    {
      return conduction.liquid_fraction();
    }

    bool diffuses() const
    {
      return diffusion.has_value();
    }

    std::size_t padded_size() const
    {
      return rows.rows.padded_rows();
    }

    int threads() const
    {
      return thread_count;
    }

    std::vector<cases::Parameter> describe() const;

    /** Interactions touched so far. */
    long work() const;

    /** @param per_solute bytes of the run's own arrays for each solute. */
    std::vector<cases::EffectCost> effect_costs(std::size_t per_solute) const;

  private:
    /** Add what comes from sources and walls. @return heat flow through walls. */
    double add_outer_heat(double fraction, std::span<double> flow);

    cases::EffectSet effects;
    const AlloySubstance &substance;
    int thread_count;
    ConductionRows rows;
    MixtureConduction conduction;
    ConductionVariable wall_excess; ///< T - T_m of a wall
    cases::EffectMeter equilibrium_meter;
    std::optional<SoluteDiffusion> diffusion;
    std::optional<HeatSources> heat_sources;
    std::optional<WallTemperature> wall_temperature;
    std::optional<WallFlux> wall_flux;
    std::optional<WallExchange> wall_exchange;
    std::optional<MixtureDerivative> derivative; ///< from the first linearise() on
    std::vector<double> wall_diagonal, diagonal; ///< of the heat from walls, of all
    long evaluations = 0;
  };
} // namespace meltfront::particles

#endif
