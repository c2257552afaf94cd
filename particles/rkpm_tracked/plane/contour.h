#ifndef meltfront_particles_rkpm_tracked_plane_contour_h
#define meltfront_particles_rkpm_tracked_plane_contour_h

#include <particles/rkpm_tracked/plane/front.h>

#include <functional>
#include <vector>

namespace meltfront::particles::rkpm_tracked
{
  /** A function of the plane, negative in solid. */
  using PlaneLevelSet = std::function<double(const PlanePoint &)>;

  /** Nodes of a grid that is walked through for zeros. */
  struct ContourGrid
  {
    PlanePoint lower{0, 0};
    double spacing = 0;
    long columns = 0, rows = 0; ///< nodes

    PlanePoint node(long column, long row) const
    {
      return lower + spacing * PlanePoint(column, row);
    }
  };

  /** A grid over a box, wider by a margin on each side (m). */
  ContourGrid contour_grid(const PlanePoint &lower, const PlanePoint &upper,
                           double margin, double spacing);

  /** Closed curves and what they leave outside. */
  struct Contours
  {
    std::vector<std::vector<PlanePoint>> curves; ///< solid on the left
    bool solid_beyond = false;
  };

  /**
   * The zeros of a function by marching squares: one point for each grid edge between
   * nodes of opposite signs, found by bisection, chained into closed curves. In a cell
   * with four of them the value at its middle decides what is joined. What leaves the
   * grid is closed along its rim, as liquid unless the whole rim is solid.
   *
   * @param values at the nodes, row by row; a node at exactly zero counts as solid
   * @param level_set for the places on the edges and middles of cells
   */
  Contours find_contours(const ContourGrid &grid, std::vector<double> values,
                         const PlaneLevelSet &level_set);

  /** The same of a function over a box and four spacings of nodes (m) beyond it, on a
   * grid of half of these. */
  Contours find_contours(const PlanePoint &lower, const PlanePoint &upper, double spacing,
                         const PlaneLevelSet &level_set);

  /**
   * A front of the contours' zeros, its particles `spacing` apart and on the zeros.
   * Curves shorter than `least_length` are left out.
   */
  PlaneFront front_on_zeros(const Contours &contours, const PlaneLevelSet &level_set,
                            double spacing, double least_length);
} // namespace meltfront::particles::rkpm_tracked

#endif
