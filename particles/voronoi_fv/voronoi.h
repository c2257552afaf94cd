#ifndef meltfront_particles_voronoi_fv_voronoi_h
#define meltfront_particles_voronoi_fv_voronoi_h

#include <particles/core/particle_storage.h>
#include <particles/relaxation/conjugate_gradients.h>

#include <cstdint>
#include <span>
#include <vector>

namespace meltfront::particles
{
  /** What two cells share. */
  struct CellFace
  {
    std::uint32_t first = 0, second = 0; ///< first < second
    double area = 0;                     ///< length in 2D, 1 in 1D (m^(d-1))
  };

  /** What a cell shares with a wall of the box. */
  struct CellWall
  {
    std::uint32_t cell = 0;
    std::uint8_t side = 0; ///< as cases::Side: x_min, x_max, y_min, ...
    double area = 0;       ///< m^(d-1)
  };

  /** The cells of particles in a box: each holds what is nearer to its particle than to
   * any other. */
  struct VoronoiCells
  {
    std::vector<double> volumes; ///< m^d; their sum is the box's
    ParticleStorage centroids;   ///< m
    /** Ascending, each once. Its area is the mean of what it is found to be from either
     * side, which differ by round-off. */
    std::vector<CellFace> faces;
    std::vector<CellWall> walls; ///< cell by cell
  };

  /**
   * Tessellate a box by voro++ (Rycroft 2009). In less than three dimensions the box is
   * one layer of particles thick; volumes and faces are divided by the thickness.
   *
   * @throws cases::InputError for a particle outside of the box, or if the volumes do not
   * add up to the box's, as where two particles are at the same place.
   */
  VoronoiCells voronoi_cells(const ParticleStorage &particles, const CoordinateBox &box);

  /**
   * Move particles to the centroids of their cells, `sweeps` times (Lloyd 1982): towards
   * a centroidal tessellation, another surrogate for the error of disorder.
   *
   * @param movable numbers of those that move, the others stay
   */
  void lloyd(ParticleStorage &particles, std::span<const std::uint32_t> movable,
             const CoordinateBox &box, int sweeps);
} // namespace meltfront::particles

#endif
