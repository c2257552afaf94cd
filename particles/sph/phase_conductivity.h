#ifndef meltfront_particles_sph_phase_conductivity_h
#define meltfront_particles_sph_phase_conductivity_h

#include <cases/material.h>
#include <particles/core/particle_operator.h>
#include <particles/sph/effect_meter.h>
#include <particles/sph/parameters.h>

#include <span>
#include <vector>

namespace meltfront::particles
{
  /**
   * What drives heat between two particles (or a wall and a particle) whose phases
   * conduct differently: an antisymmetric function of their Kirchhoff variables u = k (T
   * - T_m).
   *
   * Within a phase it is u_b - u_a. A particle at the melting temperature has u = 0, so
   * the same difference gives it its partner's conductivity. Only a pair of solid with
   * liquid needs the harmonic mean of Cleary and Monaghan (1999), 2 k_s k_l/(k_s + k_l)
   * (T_b - T_a). As published, a melting particle counts as liquid.
   */
  template <MeltingConductivity rule>
  struct PhasePair
  {
    double solid_scale;  ///< 2 k_l/(k_s + k_l)
    double liquid_scale; ///< 2 k_s/(k_s + k_l)

    double
    operator()(double own, double other) const
    {
      const bool differ = rule == MeltingConductivity::partner
                              ? (own < 0 && other > 0) || (own > 0 && other < 0)
                              : (own < 0) != (other < 0);
      return differ ? scaled(other) - scaled(own) : other - own;
    }

    /** 2 k_s k_l/(k_s + k_l) (T - T_m) */
    double
    scaled(double u) const
    {
      return u * (u < 0 ? solid_scale : liquid_scale);
    }
  };

  /**
   * The effect of different conductivities: overwrites the rows near fronts, found from
   * the phases in each slice of the operator, and touches no other row.
   */
  class PhaseConductivity
  {
  public:
    PhaseConductivity(const cases::Material &material, MeltingConductivity rule,
                      const ParticleOperator &rows);

    /** Correct the heat flows of the rows near fronts. */
    void apply(const ParticleOperator &rows, std::span<const double> u,
               std::span<double> flow);

    /** Call a function with the pair function in use. */
    template <typename Use>
    auto
    with_pair(const Use &use) const
    {
      if(rule == MeltingConductivity::partner)
        return use(PhasePair<MeltingConductivity::partner>{solid_scale, liquid_scale});
      return use(PhasePair<MeltingConductivity::liquid>{solid_scale, liquid_scale});
    }

    /** Interactions that apply() touched so far. */
    long
    work() const
    {
      return touched;
    }

    cases::EffectCost cost() const;

  private:
    void find_fronts(std::span<const double> u);
    bool update_phases(std::span<const double> u);

    MeltingConductivity rule;
    double solid_scale;
    double liquid_scale;
    std::vector<std::size_t> offsets;
    std::vector<std::uint32_t> adjacent; ///< slices that a slice's rows reach
    std::vector<unsigned char> phases;   ///< of a slice's particles: 1 solid, 2 not
    std::vector<std::uint32_t> fronts;   ///< slices that reach both phases
    long touched = 0;
    EffectMeter meter;
  };
} // namespace meltfront::particles

#endif
