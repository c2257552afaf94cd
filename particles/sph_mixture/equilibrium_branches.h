#ifndef meltfront_particles_sph_mixture_equilibrium_branches_h
#define meltfront_particles_sph_mixture_equilibrium_branches_h

#include <particles/alloy/substance.h>

namespace meltfront::particles
{
  /**
   * The branches of T(H) of one composition, from below: solid, melting at one
   * temperature (the eutectic one, or T_m without solute), mush, liquid. A branch that is
   * absent has no width.
   */
  struct EquilibriumBranches
  {
    double solid;    ///< the highest enthalpy of the solid (J/kg)
    double eutectic; ///< the highest at which it melts at one temperature
    double liquid;   ///< the least of the liquid
    double knee;     ///< where the mush's T(H) bends most, a kink in dilute alloys
    double known;    ///< down to which the liquidus is known
  };

  EquilibriumBranches find_branches(const AlloySubstance &substance, double first,
                                    double second);

  /** How a particle follows its enthalpy, its composition kept. */
  struct EquilibriumSlopes
  {
    double temperature;     ///< dT/dH (K kg/J)
    double liquid_fraction; ///< df/dH (kg/J)
  };

  /**
   * On the branch that the enthalpy is on. In the mush, with f = C/c(T) and the heat of
   * freezing L(T) = L + (c_l - c_s)(T - T_m),
   *
   *   dH/dT = (1 - f) c_s + f c_l + L(T) df/dT,
   *
   * df/dT = f/(T_m - T) for a straight liquidus, f/(C P'(c)/f) for T_m - T = P(c).
   *
   * @param excess T - T_m, @param liquid f, of the equilibrium at this enthalpy
   */
  EquilibriumSlopes find_slopes(const AlloySubstance &substance,
                                const EquilibriumBranches &branches, double enthalpy,
                                double excess, double liquid, double concentration);

  /** Where a particle stops that changes its enthalpy: on its way beyond a kink it begins
   * the next branch, and it does not leave what the liquidus is known for. */
  double stop_at_kink(const EquilibriumBranches &branches, double from, double to,
                      double latent_heat);
} // namespace meltfront::particles

#endif
