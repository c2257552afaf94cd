#ifndef meltfront_particles_sph_front_exchange_h
#define meltfront_particles_sph_front_exchange_h

#include <cases/effect_meter.h>
#include <cases/material.h>
#include <particles/core/particle_operator.h>
#include <particles/sph/front_planes.h>
#include <particles/sph/parameters.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

namespace meltfront::particles
{
  /** The state that the exchange at fronts depends on. */
  struct FrontState
  {
    const double *u;        ///< Kirchhoff variable k (T - T_m) of each particle
    const double *enthalpy; ///< J/kg
  };

  /**
   * What drives heat between particles at a front, with the front at its place within the
   * melting particle (the enthalpy method of Tacke 1985, carried over to particles).
   *
   * A melting particle of solid fraction f is at T_m, but its front is not at its centre:
   * seen from the solid it is (f - 1/2) spacings beyond it. So the difference u_b to a
   * solid partner is divided by 1/2 + f, to a liquid one by 3/2 - f. Between solid and
   * liquid the front is half way, at T_m: it gives 2 |u_s| to one side and takes 2 u_l
   * from the other, and the particle that is about to change phase bears the difference,
   * so that the pair exchanges twice the larger of the two. Each factor is at most 2.
   *
   * Where the partners' sensible heat exceeds the latent heat, the front is a mere
   * isotherm: the deviations from u_b - u_a fade with latent over sensible heat.
   */
  struct SubParticlePair
  {
    FrontState state;
    double latent_heat;

    /** Written without branches, so that eight rows advance together. */
    double operator()(std::size_t a, std::size_t b) const
    {
      const double own = state.u[a], other = state.u[b];
      const double own_enthalpy = state.enthalpy[a], other_enthalpy = state.enthalpy[b];
      const double difference = other - own;
      const bool melting = own == 0;
      const double molten = melting ? own_enthalpy : other_enthalpy; // J/kg
      const double partner = melting ? other : own;
      const double distance
          = partner < 0 ? 1.5 * latent_heat - molten : 0.5 * latent_heat + molten;
      const double at_melting = difference * (latent_heat / distance - 1);
      const double between
          = std::copysign(std::abs(std::abs(own) - std::abs(other)), difference);
      const double deviation = own * other > 0   ? 0.
                               : own * other < 0 ? between
                                                 : at_melting;
      return difference + latent_share(a, b) * deviation;
    }

    /**
     * From a wall with the Kirchhoff variable `wall`, half a spacing from the particle's
     * centre: the frozen (molten) part of the particle is all that lies between. The
     * wall's own sensible heat does not count, for it has no mass.
     */
    double from_wall(std::size_t a, double wall) const
    {
      const double own = state.u[a], enthalpy = state.enthalpy[a];
      if(own == 0)
      {
        const double molten = enthalpy / latent_heat;
        return wall / std::max(0.5, 2 * (wall < 0 ? 1 - molten : molten));
      }
      const double difference = wall - own;
      if(own < 0 ? wall <= 0 : wall >= 0)
        return difference;
      return difference
             + latent_share(sensible_heat(enthalpy))
                   * std::copysign(std::abs(std::abs(own) - std::abs(wall)), difference);
    }

    /** How much of the latent heat's deviations from u_b - u_a remains for a pair. */
    double latent_share(std::size_t a, std::size_t b) const
    {
      return latent_share(sensible_heat(state.enthalpy[a])
                          + sensible_heat(state.enthalpy[b]));
    }

  private:
    /** |c (T - T_m)| */
    double sensible_heat(double enthalpy) const
    {
      return std::max(-enthalpy, 0.) + std::max(enthalpy - latent_heat, 0.);
    }

    double latent_share(double sensible_heat) const
    {
      return latent_heat / std::max(latent_heat, sensible_heat);
    }
  };

  /**
   * What drives heat between particles whose phases conduct differently, with every front
   * half way between particles: within a phase u_b - u_a; between solid and liquid the
   * harmonic mean of Cleary and Monaghan (1999), 2 k_s k_l/(k_s + k_l) (T_b - T_a). A
   * melting particle has u = 0, so that u_b - u_a gives it its partner's conductivity; as
   * published it counts as liquid until it has frozen.
   */
  struct HarmonicPair
  {
    FrontState state;
    double solid_scale;  ///< 2 k_l/(k_s + k_l)
    double liquid_scale; ///< 2 k_s/(k_s + k_l)
    bool melting_is_liquid;

    double operator()(std::size_t a, std::size_t b) const
    {
      return from_wall(a, state.u[b]);
    }

    /** Written without branches, so that eight rows advance together. */
    double from_wall(std::size_t a, double other) const
    {
      const double own = state.u[a];
      const double harmonic = other * scale(other) - own * scale(own);
      return exchanges_across(own, other) ? harmonic : other - own;
    }

    /** Whether the harmonic mean holds between two values. */
    bool exchanges_across(double own, double other) const
    {
      return (own * other < 0) | (melting_is_liquid & ((own < 0) != (other < 0)));
    }

    double scale(double u) const
    {
      return u < 0 ? solid_scale : liquid_scale;
    }
  };

  /**
   * The exchange of heat at fronts: overwrites the rows near fronts, found from the
   * phases in each slice of the operator, and touches no other row.
   */
  class FrontExchange
  {
  public:
    /** @param rule FrontRule::sub_particle and plane for a material with latent heat
     * only */
    FrontExchange(const cases::Material &material, FrontRule rule,
                  const ParticleOperator &rows);

    /** Take the front's place from FrontPlanes in place of a melting particle's own solid
     * fraction; for the rule `plane`. */
    void follow_planes(const Discretisation &discretisation);

    /** The largest factor by which a pair exchanges more than u_b - u_a. */
    static double largest_factor(FrontRule rule);

    /** Correct the heat flows of the rows near fronts. */
    void apply(const ParticleOperator &rows, FrontState state, std::span<double> flow);

    /** Call a function with the pair function in use. */
    template <typename Use>
    auto with_pair(FrontState state, const Use &use) const
    {
      if(lies_within_particles(rule))
        return use(SubParticlePair{state, latent_heat});
      return use(
          HarmonicPair{state, solid_scale, liquid_scale, rule == FrontRule::liquid});
    }

    /** The slices near fronts, as of the last apply(). */
    std::span<const std::uint32_t> front_slices() const
    {
      return fronts;
    }

    /** Interactions that apply() touched so far. */
    long work() const
    {
      return touched;
    }

    /** The cost, booked under the effect that calls for the exchange. */
    cases::EffectCost cost(cases::Effect effect) const;

  private:
    void find_fronts(const double *u);
    bool update_phases(const double *u);
    void apply_planes(const ParticleOperator &rows, FrontState state,
                      std::span<double> flow);
    void settle(const ParticleOperator &rows, FrontState state,
                std::span<double> flow) const;

    FrontRule rule;
    double latent_heat;
    double solid_scale;
    double liquid_scale;
    std::vector<std::size_t> offsets;
    std::vector<std::uint32_t> adjacent; ///< slices that a slice's rows reach
    std::vector<unsigned char> phases;   ///< of a slice's particles, a set of bits
    std::vector<std::uint32_t> fronts;   ///< slices that reach more than one phase
    std::optional<FrontPlanes> planes;
    long touched = 0;
    cases::EffectMeter meter;
  };
} // namespace meltfront::particles

#endif
