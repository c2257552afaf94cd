#ifndef meltfront_particles_level_set_markers_marker_motion_h
#define meltfront_particles_level_set_markers_marker_motion_h

#include <cases/velocity_field.h>
#include <particles/level_set/markers/marker_storage.h>

namespace meltfront::particles::level_set
{
  /** What of a marker changes as it moves. */
  enum class Carried
  {
    position, ///< nothing else: distances stay, right where the front moves rigidly
    distance_normal, ///< distance and normal are strained with the flow
    normal           ///< the normal turns, distances stay
  };

  /**
   * Moves markers by one time step: Runge-Kutta of order 3 with the stages of the grid
   * (Shu, Osher 1988). Distance and normal follow, to first order in the distance,
   *
   *   dd/dt = d (n . G n),   dn/dt = -(I - n n^T) G^T n,   G_ij = du_i/dx_j,
   *
   * by the midpoint rule; the distance by the exponential of the rate there. Arrays are
   * worked through in blocks, whose size and results do not depend on the threads.
   * @throws cases::NumericalError if a marker's place is not finite afterwards
   */
  class MarkerMotion
  {
  public:
    /** @param name of the method, for messages */
    MarkerMotion(std::string name, int threads);

    void step(Markers &markers, const cases::VelocityField &velocity, double time,
              double time_step, Carried carried, long number);

  private:
    const std::string name;
    const int threads;
  };
} // namespace meltfront::particles::level_set

#endif
