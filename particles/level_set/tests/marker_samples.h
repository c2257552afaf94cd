#ifndef meltfront_particles_level_set_tests_marker_samples_h
#define meltfront_particles_level_set_tests_marker_samples_h

#include <particles/level_set/marker_scheme.h>

namespace meltfront::particles::level_set
{
  /** A square or cube of unit side. */
  inline Grid unit_grid(int cells, int dimension = 2)
  {
    return {dimension, {0, 0, 0}, 1. / cells, {cells, cells, cells}};
  }

  inline double circle(const Position &p)
  {
    return 0.15 - std::hypot(p[0] - 0.5, p[1] - 0.75);
  }

  inline double ball(const Position &p)
  {
    return 0.15 - std::hypot(p[0] - 0.35, p[1] - 0.35, p[2] - 0.35);
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
