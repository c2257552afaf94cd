#ifndef meltfront_particles_sph_heat_flow_h
#define meltfront_particles_sph_heat_flow_h

#include <particles/sph/conduction_rows.h>
#include <particles/sph/front_exchange.h>
#include <particles/sph/heat_sources.h>
#include <particles/sph/liquid_flow.h>
#include <particles/sph/moving_sources.h>
#include <particles/sph/open_end.h>
#include <particles/sph/phase_map.h>
#include <particles/sph/time/time_stepping.h>
#include <particles/sph/volumetric_source.h>
#include <particles/sph/wall_exchange.h>
#include <particles/sph/wall_flux.h>
#include <particles/sph/wall_temperature.h>

#include <optional>
#include <span>
#include <vector>

namespace meltfront::particles
{
  /** The rule asked for, or the best that can be had.
   * @throws cases::Refusal for a rule that the scene or the particles do not allow */
  FrontRule resolve_front_rule(const Discretisation &discretisation,
                               const SphParameters &parameters);

  /**
   * The heat flow into each particle, composed once from the passes of the effects at
   * hand: an effect that is absent has no pass and no array.
   */
  class HeatFlow
  {
  public:
    /** @param moving where freezing displaces liquid along a line */
    HeatFlow(const Discretisation &discretisation, const cases::EffectSet &effects,
             const SphParameters &parameters, const MassCoordinates *moving = nullptr);

    HeatFlow(const HeatFlow &) = delete;
    HeatFlow &operator=(const HeatFlow &) = delete;

    /** Evaluate walls and sources for a step. */
    void prepare_step(double begin, double end);

    /** Set particles on walls to the wall's temperature at a fraction of the step.
     * @return heat that this took from the walls (J in the measure of the scene). */
    double hold_walls(double fraction, std::span<double> enthalpy);

    /** Let displaced liquid pass the particles, in the plane or in space.
     * @param enthalpy at the start
     * @param explicit_step the longest Euler step that is made (s) */
    void let_liquid_flow(const LiquidBalance &balance,
                         const Discretisation &discretisation,
                         std::span<const double> enthalpy, double explicit_step);

    bool displaces_liquid() const
    {
      return liquid_end || liquid_flow;
    }

    /** Where freezing displaces liquid: let it leave or enter at the end of a step, and
     * follow that. @return heat that came in with it (J in the measure of the scene). */
    double displace(double begin, double end, std::span<double> enthalpy);

    /** Where liquid displaced along a line leaves; else null. */
    const OpenEnd *open_end() const
    {
      return liquid_end ? &*liquid_end : nullptr;
    }

    /** How displaced liquid flows in the plane or in space; else null. */
    const LiquidFlow *flowing_liquid() const
    {
      return liquid_flow ? &*liquid_flow : nullptr;
    }

    /** Follow a change of the enthalpy; needed before evaluate(). */
    void follow(std::span<const double> enthalpy);

    /** Lowest and highest temperature of the enthalpy followed last, over all processes.
     */
    Extremes temperatures(std::span<const double> enthalpy) const;

    /**
     * Heat flow into each particle at a fraction of the step, over scale(), and where it
     * stands for more or less than a cell over its share.
     * @return heat flow through walls into the scene, over scale().
     */
    double evaluate(std::span<const double> enthalpy, double fraction,
                    std::span<double> flow);

    /**
     * Prepare products with the derivative of the flows by the enthalpy, at the enthalpy
     * and the fraction that evaluate() was last called with.
     */
    void linearise(std::span<const double> enthalpy, double fraction);

    /** How the flows follow a change of the enthalpy, to first order. */
    void apply_derivative(std::span<const double> change, std::span<double> flow_change);

    /** How each particle's flow follows its own enthalpy. */
    std::span<const double> derivative_diagonal() const
    {
      return derivative.diagonal;
    }

    /** Unit of the flows (W for 1). */
    double scale() const
    {
      return variable.flow_scale();
    }

    /** Heat from sources since the start of the scene (J m^(d-3)). */
    double source_heat(double time) const;

    /** How long explicit steps may be.
     * @param held particles that hold a wall's temperature */
    StepLimits step_limits(double particle_mass, StepLimit asked,
                           std::span<const std::uint32_t> held) const;

    /** Threads that share a pass: one where there are too few particles for more. */
    int threads() const
    {
      return thread_count;
    }

    /** Length of arrays of enthalpy and flow. */
    std::size_t padded_size() const
    {
      return conduction.rows.padded_rows();
    }

    /** Along a line, how far apart the numbers of particles are that exchange heat, if
     * that is a few; else 0. */
    std::size_t half_bandwidth() const
    {
      return bandwidth;
    }

    /** What the report prints of the operator. */
    std::vector<cases::Parameter> describe() const;

    /** Interactions and wall links touched so far by this process. */
    long work() const;

    std::vector<cases::EffectCost> effect_costs() const;

  private:
    bool exchange_at_fronts() const
    {
      return effects.contains(exchange_effect);
    }

    /** What products with the derivative need; empty until the first linearise(). */
    struct Derivative
    {
      const double *enthalpy = nullptr;
      std::vector<double> slope;         ///< dw/dH
      std::vector<double> change;        ///< of w
      std::vector<double> wall_diagonal; ///< of the heat from walls
      std::vector<double> diagonal;
    };

    std::span<const double> conduction_variable(std::span<const double> enthalpy) const
    {
      return variable.mapped() ? std::span<const double>(mapped) : enthalpy;
    }

    void find_own_slices();
    void conduct(std::span<const double> w, std::span<double> flow) const;
    void follow_end(std::uint32_t previous);
    void correct_end_change(std::span<const double> change,
                            std::span<double> flow_change);
    double wall_flow(FrontState state, double fraction, std::span<double> flow);

    template <typename Slope>
    void differentiate_walls(const Slope &slope, double fraction);

    const cases::EffectSet &effects;
    const cases::Scene &scene;
    const cases::Material &material;
    const OwnParticles &own;
    std::size_t n; ///< particles at hand
    int thread_count;
    std::size_t bandwidth = 0; ///< see half_bandwidth()
    ConductionRows conduction;
    /** Those of own particles, where processes share a run; else empty: all. */
    std::vector<std::uint32_t> own_slices;
    std::size_t interactions = 0; ///< of rows that are computed
    ConductionVariable variable;
    FrontRule front_rule;
    cases::Effect exchange_effect; ///< the effect that calls for the exchange at fronts
    std::vector<double> mapped;    ///< conduction variable, where it is not the enthalpy
    Extremes extremes{};           ///< of the conduction variable
    std::optional<FrontExchange> front_exchange;
    std::optional<HeatSources> heat_sources;
    std::optional<MovingSources> moving_sources;
    std::optional<VolumetricSource> volumetric_source;
    std::optional<WallTemperature> wall_temperature;
    std::optional<WallFlux> wall_flux;
    std::optional<WallExchange> wall_exchange;
    std::optional<OpenEnd> liquid_end;
    std::optional<LiquidFlow> liquid_flow;
    Derivative derivative;
    long evaluations = 0;
  };
} // namespace meltfront::particles

#endif
