#ifndef meltfront_particles_alloy_two_population_flow_h
#define meltfront_particles_alloy_two_population_flow_h

#include <particles/alloy/sites.h>
#include <particles/alloy/solid_path.h>
#include <particles/alloy/solute_diffusion.h>
#include <particles/sph/wall_temperature.h>

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

    /** Heat for a step that begins now. @return heat flow through walls. */
    double heat(std::span<double> to_liquid, std::span<double> to_ice);

    /** Concentrations in the liquid, before solute(). */
    void follow();

    /** Flow of a solute into each site (kg/s). */
    void solute(std::size_t solute, std::span<double> flow);

    /**
     * The largest explicit step that is certain to keep the maximum principle where the
     * exchange is the corrected one: with the self-exchange of a site in the sum and k
     * the larger conductivity,
     *
     *   dt <= min(rho c_l, rho_s c_s) V / (k sum_b g_ab),  dt <= m/(2 rho D sum_b g_ab).
     */
    double monotone_step() const;

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
    double population_heat(const Pair &pair, std::span<double> flow);
    double wall_solid_share(std::size_t site, double wall_excess) const;

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
    long evaluations = 0;
  };
} // namespace meltfront::particles

#endif
