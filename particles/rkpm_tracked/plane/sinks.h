#ifndef meltfront_particles_rkpm_tracked_plane_sinks_h
#define meltfront_particles_rkpm_tracked_plane_sinks_h

#include <cases/scene.h>
#include <particles/rkpm_tracked/plane/bins.h>

#include <functional>
#include <span>

namespace meltfront::particles::rkpm_tracked
{
  /**
   * The singular part of the solid's temperature about line sources,
   *
   *   S(x, t) = - sum_i p_i(t)/(2 pi k_s) ln(|x - x_i|/l),   l the domain's side,
   *
   * with p_i the power per length (W/m), negative for a sink. T - S is smooth, and is
   * what is collocated in the solid.
   */
  class PlaneSinks
  {
  public:
    /** @param scene outlives the sinks
     * @param spacing of the nodes (m): S, infinite at a source, is evaluated at 0.05 of
     * it where it is asked for nearer */
    PlaneSinks(const cases::Scene &scene, double spacing);

    bool empty() const
    {
      return places.empty();
    }

    /** K */
    double value(const PlanePoint &point, double time) const;

    /** K/m */
    PlanePoint gradient(const PlanePoint &point, double time) const;

    /** Second derivatives xx, xy, yy (K/m^2). */
    Eigen::Vector3d second_derivatives(const PlanePoint &point, double time) const;

    /**
     * A temperature at a node: the mean over the node's cell where that holds a source,
     * since no value at a point there tells the cell's heat.
     * @param temperature may be infinite at a source
     * @param samples of the cell
     */
    double at_node(const std::function<double(const PlanePoint &)> &temperature,
                   const PlanePoint &node, std::span<const PlanePoint> samples) const;

    /** Heat from the sources since the start (J/m). */
    double energy(double time) const;

    std::vector<PlanePoint> places;

  private:
    const cases::Scene &scene;
    double spacing, smallest_distance, factor;
  };
} // namespace meltfront::particles::rkpm_tracked

#endif
