#ifndef meltfront_particles_front_tracking_plane_sinks_h
#define meltfront_particles_front_tracking_plane_sinks_h

#include <cases/scene.h>
#include <particles/front_tracking/plane_bins.h>

namespace meltfront::particles::front_tracking
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
     * @param smallest_distance at which S is evaluated (m): it is infinite at a source */
    PlaneSinks(const cases::Scene &scene, double smallest_distance);

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

    /** Heat from the sources since the start (J/m). */
    double energy(double time) const;

    std::vector<PlanePoint> places;

  private:
    const cases::Scene &scene;
    double smallest_distance, factor;
  };
} // namespace meltfront::particles::front_tracking

#endif
