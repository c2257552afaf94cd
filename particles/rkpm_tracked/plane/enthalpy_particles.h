#ifndef meltfront_particles_rkpm_tracked_plane_enthalpy_particles_h
#define meltfront_particles_rkpm_tracked_plane_enthalpy_particles_h

#include <cases/scene.h>
#include <cases/snapshot.h>
#include <particles/rkpm_tracked/plane/contour.h>
#include <particles/rkpm_tracked/plane/nodes.h>

#include <vector>

namespace meltfront::particles::rkpm_tracked
{
  /**
   * A state of an enthalpy method, whose particles know of the front by their shares of
   * solid. Smoothed, with a kernel W that reaches two spacings of the nodes, these are
   *
   *   S(x) = sum_j A_j W(|x - x_j|) f_j / sum_j A_j W(|x - x_j|),
   *
   * one half on a straight front wherever in its cells that is; beyond the walls S is
   * that of the nearest place within.
   */
  class EnthalpyParticles
  {
  public:
    /** @param scene, nodes outlive this */
    EnthalpyParticles(const cases::Scene &scene, const PlaneNodes &nodes,
                      const cases::Snapshot &snapshot);

    EnthalpyParticles(const EnthalpyParticles &) = delete;
    EnthalpyParticles &operator=(const EnthalpyParticles &) = delete;

    /** 1/2 - S: negative in solid. */
    double level(const PlanePoint &place) const;

    /**
     * Move a front along its normals until, smoothed along and across it, its solid is
     * that of the particles near it: S cuts off what is bent.
     * @param solid_beyond whether what no curve goes round is solid
     */
    void fit(PlaneFront &front, bool solid_beyond) const;

    /**
     * Temperature of a phase: the parabola that fits particles of the phase and the
     * front, at the melting temperature, best about a place; never beyond that
     * temperature (K).
     */
    double temperature(const PlanePoint &place, bool solid, const PlaneFront &front,
                       const PlaneBins &front_bins) const;

    double solid_area = 0; ///< m^2

  private:
    PlanePoint within(const PlanePoint &place) const;
    std::vector<double> solid_missing(const FrontIndex &index) const;

    const cases::Scene &scene;
    const PlaneNodes &nodes;
    std::vector<PlanePoint> position;
    std::vector<double> area, share, value; ///< m^2, of solid, K
    PlaneBins bins;
  };
} // namespace meltfront::particles::rkpm_tracked

#endif
