#ifndef meltfront_reference_fem_fitted_setup_h
#define meltfront_reference_fem_fitted_setup_h

#include <cases/effects.h>
#include <cases/scene.h>
#include <reference_fem/fitted/options.h>
#include <reference_fem/fitted/physics.h>
#include <reference_fem/fitted/ray_mesh.h>

#include <vector>

namespace meltfront::reference_fem::fitted
{
  /** The rays of a scene and where they end. */
  struct RayScene
  {
    FrontSurface surface;
    double inner = 0, outer = 1; ///< r at the ends (m)
    int cells = 2;               ///< along a ray
  };

  /** @throws Refusal for walls or sources that rays cannot have. */
  RayScene rays_of(const cases::Scene &scene, const RunOptions &options);

  /** Equal cells between all fronts and walls, half of those of a ray in each interval,
   * drawn to the only front by the option `grading`. */
  RayMesh mesh_between_fronts(const RayScene &rays, unsigned int fronts, double grading);

  /** Phases, walls, source and clock of a scene.
   * @throws Refusal for what the method cannot treat. */
  Physics physics_of(const cases::Scene &scene, const cases::EffectSet &effects,
                     const RunOptions &options, bool solid_inside);

  /** The side at an end of the rays. */
  cases::Side side_at(const cases::Scene &scene, bool inner);

  /** Where fronts start. */
  struct InitialFronts
  {
    bool solid_inside = true; ///< or everywhere
    unsigned int number = 0;
    std::vector<double> coordinates; ///< by front and ray (m)
  };

  /**
   * The roots on each ray of the scene's initial front, of its exact solution's, or of
   * T - T_m.
   * @throws Refusal where one of many rays crosses the front more than once, or only some
   * do.
   */
  InitialFronts initial_fronts(const cases::Scene &scene, const RayScene &rays);
} // namespace meltfront::reference_fem::fitted

#endif
