#ifndef meltfront_particles_level_set_markers_marker_seeding_h
#define meltfront_particles_level_set_markers_marker_seeding_h

#include <particles/level_set/markers/marker_storage.h>

#include <cstdint>
#include <functional>

namespace meltfront::particles::level_set
{
  /** Signed distance from the front at a point (m), positive inside the tracked phase. */
  using DistanceFunction = std::function<double(const Position &)>;

  /** How markers are strewn along the front. */
  struct SeedingParameters
  {
    int per_cell = 12;      ///< drawn in each cell near the front
    double band = 1;        ///< such cells have a corner as near to it (spacings)
    double nearest = 0;     ///< none nearer to the front (spacings)
    double furthest = 1.5;  ///< none further from it (spacings)
    bool normals = true;    ///< whether markers carry them
    std::uint64_t seed = 1; ///< other seeds draw other places
  };

  /**
   * Markers at random places, evenly spread in the cells near a front, each with its
   * distance from it. Every cell draws its own numbers from the seed: they do not depend
   * on which other cells are near the front.
   * @param distance of the true front, which need not be the one of the grid
   * @throws cases::InputError for parameters out of range or a distance that is not
   * finite
   */
  Markers seed_markers(const Grid &grid, const DistanceFunction &distance,
                       const SeedingParameters &parameters);

  /** The same in chosen cells only, further numbers for each round. */
  void seed_in_cells(const Grid &grid, const DistanceFunction &distance,
                     const SeedingParameters &parameters,
                     std::span<const std::uint32_t> keys,
                     std::span<const std::uint32_t> how_many, std::uint64_t round,
                     Markers &markers, std::uint32_t &births);

  /** Signed radius of a marker that looks for escapes: its distance held between 0.1 and
   * 0.5 spacings, equation (4.10) of the report. */
  double signed_radius(double distance, double spacing);
} // namespace meltfront::particles::level_set

#endif
