#ifndef meltfront_particles_sph_liquid_balance_h
#define meltfront_particles_sph_liquid_balance_h

#include <cases/scene.h>
#include <particles/sph/parameters.h>

namespace meltfront::particles
{
  /**
   * Freezing that displaces liquid in the plane and in space, as conduction in a material
   * of one density.
   *
   * Solid is at rest; liquid moves by u, of which freezing sets free as much as the
   * densities differ. With the volume fraction theta of the solid, e the enthalpy per
   * volume and s = rho_l c_l (T - T_m) the liquid's sensible part of it,
   *
   *   div u = (1 - rho_s/rho_l) theta_t,    e_t + div((rho_l L + s) u) = div(k grad T).
   *
   * The latent heat that liquid carries along is known with div u. Taken to the left side
   * it leaves
   *
   *   (rho_s H)_t = div(k grad T) - div(s u),
   *
   * where H is the enthalpy of a material that has the solid's density, its latent heat L
   * per mass and, as a liquid, the capacity c_l rho_l/rho_s: theta = 1 - H/L while it
   * melts. Heat is counted as e; see in_space().
   */
  struct LiquidBalance
  {
    /** @throws cases::Refusal for options under which particles do not stay on a lattice,
     * for implicit steps, and where the wall that liquid would leave through is none */
    LiquidBalance(const cases::Scene &scene, const SphParameters &parameters);

    LiquidBalance(const LiquidBalance &) = delete;
    LiquidBalance &operator=(const LiquidBalance &) = delete;

    /** The liquid's latent heat in space over that of the scene at rest. */
    double in_space() const
    {
      return density / at_rest.material.solid.density;
    }

    cases::Scene at_rest;
    double density;     ///< of the liquid (kg/m^3)
    double expansion;   ///< 1 - rho_s/rho_l: volume set free per volume that freezes
    cases::Side outlet; ///< the wall that liquid leaves through, or is drawn in
  };
} // namespace meltfront::particles

#endif
