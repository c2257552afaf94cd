#ifndef meltfront_particles_alloy_solute_diffusion_h
#define meltfront_particles_alloy_solute_diffusion_h

#include <particles/alloy/substance.h>
#include <particles/sph/conduction_rows.h>
#include <particles/sph/effect_meter.h>

#include <optional>
#include <span>
#include <vector>

namespace meltfront::particles
{
  /**
   * Diffusion of solutes through the liquid between particles. With the liquid's mass
   * fraction f and its concentration C/f,
   *
   *   m dC_a/dt = sum_b g_ab rho D f_ab (C_b/f_b - C_a/f_a),
   *   f_ab = 2 f_a f_b/(f_a + f_b)
   *
   * (Monaghan, Huppert and Worster 2005, equation 2.13 and section 4; rho f
   * is the mass of liquid per volume): none where one of both is solid. No wall lets
   * solute through: images beyond all walls have the concentration of their particles.
   */
  class SoluteDiffusion
  {
  public:
    SoluteDiffusion(const Discretisation &discretisation, const SphParameters &parameters,
                    const AlloySubstance &substance, const ParticleOperator &heat_rows);

    /** Find concentrations in the liquid. */
    void follow(std::span<const double> liquid_fraction,
                std::span<const double> depression,
                std::span<const std::span<const double>> concentration);

    /** Flow of a solute into each particle (kg/s). */
    void flow(std::size_t solute, const ParticleOperator &heat_rows,
              std::span<double> flow, int threads);

    /** The largest sum of 2 rho D g over a row: half of the mass over it bounds an
     * explicit step (kg/s). */
    double row_sum() const;

    /** Interactions touched so far. */
    long work() const
    {
      return touched;
    }

    cases::EffectCost cost(std::size_t further_bytes) const;

  private:
    const AlloySubstance &substance;
    std::size_t n;
    std::vector<std::uint32_t> held; ///< solid wall particles, which take no solute
    double eutectic_concentration;   ///< of a single solute
    double largest_row_sum;
    std::optional<ParticleOperator> own_rows; ///< where walls of prescribed temperature
                                              ///< have changed those of the heat
    std::vector<double> mobility;             ///< liquid mass fraction
    std::vector<double> in_liquid;            ///< C/f of each solute, one after another
    long touched = 0;
    EffectMeter meter;
  };
} // namespace meltfront::particles

#endif
