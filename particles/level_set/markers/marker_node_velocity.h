#ifndef meltfront_particles_level_set_markers_marker_node_velocity_h
#define meltfront_particles_level_set_markers_marker_node_velocity_h

#include <cases/velocity_field.h>
#include <particles/level_set/grid.h>

#include <vector>

namespace meltfront::particles::level_set
{
  /**
   * A velocity known at the nodes of a grid, linear between them along each axis and
   * steady during a step, as a front's speed extended off it gives.
   */
  class NodeVelocity : public cases::VelocityField
  {
  public:
    /** At rest. */
    explicit NodeVelocity(const Grid &grid);

    /** A component at all nodes, ghosts included, for the caller to fill (m/s). */
    std::span<double> component(int direction)
    {
      return values[direction];
    }

    std::string description() const override;
    void velocities(const cases::PointArrays &points, double time,
                    const std::array<std::span<double>, 3> &velocity) const override;

    /** Of central differences at the nodes, interpolated: continuous. */
    void gradients(const cases::PointArrays &points, double time,
                   const std::array<std::span<double>, 9> &gradient) const override;

  private:
    const Grid grid;
    std::array<std::vector<double>, 3> values;
  };
} // namespace meltfront::particles::level_set

#endif
