#ifndef meltfront_particles_sph_mass_coordinates_h
#define meltfront_particles_sph_mass_coordinates_h

#include <cases/scene.h>
#include <particles/sph/parameters.h>

namespace meltfront::particles
{
  /**
   * A slab in which freezing displaces liquid because the densities differ, as a problem
   * at rest.
   *
   * Solid lies at rest at x_min; what is beyond it is pushed towards x_max, an open end
   * through which it leaves, or is drawn from there. The coordinate X with rho_s dX = rho
   * dx moves with the matter. There both phases have the solid's density, and
   *
   *   rho_s dH/dt = d/dX (k' dT/dX),   k'_s = k_s,  k'_l = k_l rho_l/rho_s.
   *
   * In the slab's length L = x_max - x_min a solid of the thickness s leaves liquid up to
   * X = s + (rho_l/rho_s)(L - s), the open end, which moves as the solid grows.
   */
  class MassCoordinates
  {
  public:
    /** @throws cases::Refusal unless the scene is along a line and solid, if there is
     * any, lies at x_min with nothing but liquid beyond it; or where the options ask for
     * particles that reach beyond their nearest neighbours. */
    MassCoordinates(const cases::Scene &scene, const SphParameters &parameters);

    MassCoordinates(const MassCoordinates &) = delete;
    MassCoordinates &operator=(const MassCoordinates &) = delete;

    /** The open end where the solid has a thickness (m of X). */
    double open_end(double solid) const
    {
      return density_ratio * length + (1 - density_ratio) * solid;
    }

    /** What a thickness in X takes up in space, of which a share of the mass is solid
     * (m).
     */
    double width(double thickness, double solid_fraction) const
    {
      return thickness * (solid_fraction + (1 - solid_fraction) / density_ratio);
    }

    /** The scene at rest. Its domain is a whole number of spacings, as many as the open
     * end may ever need; at the start the end is on a face between two of them. */
    cases::Scene at_rest;
    double solid;         ///< thickness of the solid at the start (m)
    double lowest;        ///< x_min (m)
    double length;        ///< of the slab (m)
    double density_ratio; ///< rho_l/rho_s
    int particles;        ///< that fill the domain at rest
  };
} // namespace meltfront::particles

#endif
