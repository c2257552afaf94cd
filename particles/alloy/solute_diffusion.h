#ifndef meltfront_particles_alloy_solute_diffusion_h
#define meltfront_particles_alloy_solute_diffusion_h

#include <cases/effect_meter.h>
#include <particles/alloy/substance.h>
#include <particles/sph/conduction_rows.h>

#include <span>
#include <vector>

namespace meltfront::particles
{
  /** rho D f_ab (C_b/f_b - C_a/f_a), antisymmetric to the last bit. */
  struct DiffusionPair
  {
    const double *concentration; ///< C/f
    const double *mobility;      ///< f
    double scale;                ///< rho D

    double operator()(std::size_t a, std::size_t b) const
    {
      // Where both are solid nothing flows: the least number keeps 0/0 away.
      const double own = mobility[a], other = mobility[b];
      const double mean = 2 * own * other / (own + other + 1e-300);
      return scale * mean * (concentration[b] - concentration[a]);
    }
  };

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
   *
   * Solute is swept over the rows of the heat, together with it. Their coefficients
   * differ from those of closed walls for a few pairs next to walls of prescribed
   * temperature: what these lack is added pair by pair, to one partner what the other
   * loses.
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

    /** The same in one sweep with the heat, which flows by `heat_pair`. */
    template <typename HeatPair>
    void flow_with_heat(const HeatPair &heat_pair, std::span<double> heat,
                        std::size_t solute, const ParticleOperator &heat_rows,
                        std::span<double> flow, int threads)
    {
      joint_meter.measure(
          [&]
          {
            heat_rows.apply_pairs(heat_pair, pair(solute), heat, flow, threads);
            close_walls(solute, flow);
          });
      touched += static_cast<long>(heat_rows.interactions() + closing.size());
    }

    /** The first solute that diffuses. */
    std::size_t first_to_diffuse() const;

    /** The largest sum of 2 rho D g over a row: half of the mass over it bounds an
     * explicit step (kg/s). */
    double row_sum() const;

    /** Exchanges of solute computed so far: one for each interaction and solute. */
    long work() const
    {
      return touched;
    }

    /** Half the time of the sweeps shared with the heat counts as that of the solute:
     * one of two flows. */
    cases::EffectCost cost(std::size_t further_bytes) const;

  private:
    DiffusionPair pair(std::size_t solute) const;

    /** Add to the flows what pairs next to walls lack. */
    void close_walls(std::size_t solute, std::span<double> flow) const;

    const AlloySubstance &substance;
    std::size_t n;
    std::vector<std::uint32_t> dirichlet; ///< solid wall particles, which take no solute
    double eutectic_concentration;        ///< of a single solute
    double largest_row_sum;
    /** Coefficients with closed walls minus those of the heat. */
    std::vector<ParticleOperator::Entry> closing;
    std::vector<double> mobility;  ///< liquid mass fraction
    std::vector<double> in_liquid; ///< C/f of each solute, one after another
    long touched = 0;
    cases::EffectMeter meter, joint_meter;
  };
} // namespace meltfront::particles

#endif
