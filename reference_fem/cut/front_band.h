#ifndef meltfront_reference_fem_cut_front_band_h
#define meltfront_reference_fem_cut_front_band_h

#include <reference_fem/cut/cut_geometry.h>
#include <reference_fem/cut/level_set.h>

#include <vector>

namespace meltfront::reference_fem::cut
{
  /** How far about the front the finest cells reach, and how the mesh grows beyond. */
  struct BandWidths
  {
    double finest = 9;  ///< finest cells on each side of the front
    double grading = 3; ///< cells of each further size before the next
  };

  /** Points of a front: one by cell that it cuts. */
  std::vector<Point> points_of_front(const BackgroundMesh &mesh,
                                     const CutGeometry &geometry);

  /** Points near all changes of sign of a function, sought at half the finest spacing:
   * what points_of_front() is to a front that no mesh holds yet. */
  std::vector<Point> points_of_front(const BackgroundMesh &mesh,
                                     const PointFunction &function);

  /**
   * The cells to divide so that the finest lie in a band about a front and cells grow
   * with the distance from it. What the rim cuts in `mesh` stays divided: the domain's
   * area would change with the cells that the rim cuts, and a coarse cell's node beyond
   * the rim would find no temperature.
   */
  RefinementCriterion refined_about(std::vector<Point> front, const BackgroundMesh &mesh,
                                    const BandWidths &widths);

  /**
   * Whether the front is so near to cells that are not the finest that after a step, or
   * with the cells into which a phase is extended, it might reach them.
   * @param reach of both together, in finest cells
   */
  bool leaves_band(const BackgroundMesh &mesh, const CutGeometry &geometry,
                   const Values &level_set, double reach);
} // namespace meltfront::reference_fem::cut

#endif
