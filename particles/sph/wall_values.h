#ifndef meltfront_particles_sph_wall_values_h
#define meltfront_particles_sph_wall_values_h

#include <cases/time_integral.h>
#include <particles/sph/conduction_rows.h>

#include <vector>

namespace meltfront::particles
{
  /**
   * Values at points of the walls during a step: taken from the boundary at the step's
   * ends, linear in time between; or their means over the step. Points that must have the
   * same value share one.
   */
  class WallValues
  {
  public:
    /** Rewrites the links' point numbers to those of the distinct values. */
    WallValues(const cases::Scene &scene, const std::vector<WallPoint> &points,
               std::vector<WallLink> &links);

    /** Evaluate at both ends of a step: within it, where the value jumps at an end. */
    void prepare_step(double begin, double end);

    /** Average over a step. */
    void average_step(double begin, double end);

    /** A value at a fraction of the step. */
    double at(std::size_t point, double fraction) const
    {
      return first[point] + fraction * (last[point] - first[point]);
    }

    std::size_t size() const
    {
      return points.size();
    }

    std::size_t bytes() const;

  private:
    /** Values that do not change are evaluated once. @return whether they are at hand. */
    bool holds_constants(double begin, double end);

    std::vector<WallPoint> points;
    std::vector<std::size_t> mean_of_point;
    std::vector<cases::TimeMean> means; ///< of the boundaries
    std::vector<double> first, last;
    double last_time;
    bool constant;
  };
} // namespace meltfront::particles

#endif
