#ifndef meltfront_particles_rkpm_tracked_plane_measure_h
#define meltfront_particles_rkpm_tracked_plane_measure_h

#include <particles/rkpm_tracked/plane/heat.h>

#include <vector>

namespace meltfront::particles::rkpm_tracked
{
  /** Spacings from the front within which areas are summed over points. */
  inline constexpr double cut_reach = 1.3;

  /** What a state holds of solid and of heat. */
  struct PlaneMeasure
  {
    std::vector<double> temperature;    ///< of each node
    std::vector<double> solid_fraction; ///< of the area that is each node's
    double solid_area = 0;              ///< m^2
    double sensible = 0;                ///< integral of rho c (T - T_m) (J/m)
    double latent = 0;                  ///< integral of rho L over the liquid (J/m)
  };

  /**
   * Area of the solid in the domain as the front's curves enclose it (m^2).
   * @return NaN if a curve leaves the domain
   */
  double enclosed_solid_area(const cases::Scene &scene, const PlaneNodes &nodes,
                             const PlaneState &state, bool solid_beyond);

  /**
   * Measure a state. Areas that the front cuts are summed over points closer than the
   * nodes, and shifted, all by the same distance, so that the solid's area is exactly
   * that within the curves; temperatures there come from the expansions about the front.
   */
  PlaneMeasure measure(const cases::Scene &scene, const PlaneNodes &nodes,
                       const PlaneHeat &heat, const PlaneState &state);
} // namespace meltfront::particles::rkpm_tracked

#endif
