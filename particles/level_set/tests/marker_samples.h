#ifndef meltfront_particles_level_set_tests_marker_samples_h
#define meltfront_particles_level_set_tests_marker_samples_h

#include <particles/level_set/markers/marker_scheme.h>
#include <particles/level_set/tests/shapes.h>

namespace meltfront::particles::level_set
{
  inline double circle(const Position &p)
  {
    return disk.signed_distance(p);
  }

  inline double sphere(const Position &p)
  {
    return ball.signed_distance(p);
  }

  /** A function's values at all nodes, ghosts included. */
  inline std::vector<double> at_nodes(const Grid &grid, const DistanceFunction &function)
  {
    std::vector<double> result(grid.size());
    for(std::size_t node = 0; node < grid.size(); ++node)
      result[node] = function(grid.position(node));
    return result;
  }

  /** Markers of which a place, a distance and a normal are given. */
  struct GivenMarker
  {
    Position place;
    double distance;
    Position normal;
  };

  inline Markers given_markers(const std::vector<GivenMarker> &list, int dimension = 2)
  {
    Markers markers;
    markers.dimension = dimension;
    for(const GivenMarker &marker : list)
      markers.add(marker.place, marker.distance, marker.normal, true,
                  static_cast<std::uint32_t>(markers.size()));
    return markers;
  }
} // namespace meltfront::particles::level_set

#endif
