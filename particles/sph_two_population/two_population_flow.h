#ifndef meltfront_particles_sph_two_population_two_population_flow_h
#define meltfront_particles_sph_two_population_two_population_flow_h

#include <particles/alloy/solid_path.h>
#include <particles/alloy/solute_diffusion.h>
#include <particles/sph/time/time_stepping.h>
#include <particles/sph/wall_temperature.h>
#include <particles/sph_two_population/sites.h>
#include <particles/sph_two_population/two_population_exchange.h>

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace meltfront::particles
{
  /** The flows of heat into the particles of both populations, and of solutes into the
   * liquid, from the passes of the effects at hand. */
  class TwoPopulationFlow
  {
  public:
    TwoPopulationFlow(const Discretisation &discretisation,
                      const AlloySubstance &substance, const cases::EffectSet &effects,
                      const TwoPopulationParameters &parameters, Sites &sites);

    TwoPopulationFlow(const TwoPopulationFlow &) = delete;
    TwoPopulationFlow &operator=(const TwoPopulationFlow &) = delete;

    void prepare_step(double begin, double end);

    /** Give the ice on walls the wall's temperature at a fraction of the step. */
    void hold_walls(double fraction);

    /** Heat at a fraction of the step. @return heat flow through walls. */
    double heat(double fraction, std::span<double> to_liquid, std::span<double> to_ice);

    /** The same by the corrected exchange at other temperatures T - T_m than the sites',
     * to whose volumes it belongs: linear in the temperatures. */
    double heat_at(std::span<const double> liquid_excess,
                   std::span<const double> ice_excess, double fraction,
                   std::span<double> to_liquid, std::span<double> to_ice);

    /** Prepare apply_derivative() of heat_at() for the sites' volumes. */
    void linearise(double fraction);

    /** Change of heat_at() with the temperatures (W per simulated depth). */
    void apply_derivative(std::span<const double> liquid_change,
                          std::span<const double> ice_change, std::span<double> to_liquid,
                          std::span<double> to_ice);

    /** The diagonals of that derivative. */
    std::span<const double> liquid_diagonal() const
    {
      return diagonal[0];
    }

    std::span<const double> ice_diagonal() const
    {
      return diagonal[1];
    }

    /** Concentrations in the liquid, before solute(). */
    void follow();

    /** Flow of a solute into each site (kg/s). */
    void solute(std::size_t solute, std::span<double> flow);

    /**
     * The largest explicit step that keeps the maximum principle, for certain where the
     * exchange is the corrected one: with the self-exchange of a site in the sum and k
     * the larger conductivity, of the published exchange four times that (all volumes
     * taken for the site's),
     *
     *   dt <= min(rho c_l, rho_s c_s) V / (k sum_b g_ab),  dt <= m/(2 rho D sum_b g_ab).
     */
    double monotone_step() const;

    /** How long explicit steps may be.
     * @param held sites that hold a wall's temperature */
    StepLimits step_limits(const cases::Scene &scene, StepLimit asked,
                           std::span<const std::uint32_t> held) const;

    /** The largest explicit step of the diffusion of solutes, which there must be. */
    double solute_step() const
    {
      return sites.site_mass / diffusion->row_sum();
    }

    double melting_temperature() const
    {
      return substance.material.melting_temperature;
    }

    bool diffuses() const
    {
      return diffusion.has_value();
    }

    std::size_t interactions() const
    {
      return rows.rows.interactions();
    }

    double second_moment() const
    {
      return rows.second_moment;
    }

    long work() const;

    std::vector<cases::EffectCost> effect_costs(std::size_t per_solute) const;

  private:
    template <typename Pair>
    double population_heat(const Pair &pair, double fraction, std::span<double> flow);
    template <typename Pair>
    void pass(const Pair &pair, std::span<double> flow);
    CorrectedPair to_liquid_pair(const double *liquid, const double *ice) const;
    CorrectedPair to_ice_pair(const double *liquid, const double *ice) const;
    void set_diagonal(const CorrectedPair &pair, double fraction,
                      std::vector<double> &wall_rate, std::vector<double> &diagonal);
    template <typename Visitor>
    void with_path(const Visitor &visitor) const;
    template <typename Path>
    double other_share_of_wall(bool of_ice, std::size_t site, double wall_excess,
                               const Path &solid_path) const;
    template <typename Path>
    double wall_solid_share(std::size_t site, double wall_excess,
                            const Path &solid_path) const;

    cases::EffectSet effects;
    const AlloySubstance &substance;
    const TwoPopulationParameters &parameters;
    Sites &sites;
    double volume;
    int threads;
    SolidPath path;
    ConductionRows rows;
    double self_strength; ///< g of the two particles of a site
    ConductionVariable wall_excess;
    std::optional<SoluteDiffusion> diffusion;
    std::optional<WallTemperature> wall_temperature;
    std::vector<std::span<const double>> composition;
    std::array<std::vector<double>, 2> wall_slope, diagonal; ///< of liquid, of ice
    long evaluations = 0;
  };
} // namespace meltfront::particles

#endif
