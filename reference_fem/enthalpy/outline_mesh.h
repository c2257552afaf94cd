#ifndef meltfront_reference_fem_enthalpy_outline_mesh_h
#define meltfront_reference_fem_enthalpy_outline_mesh_h

#include <cases/outline.h>

#include <array>
#include <vector>

namespace meltfront::reference_fem
{
  /** Quadrilaterals that fill what an outline bounds. */
  struct QuadrilateralMesh
  {
    std::vector<cases::Outline::Point> vertices;
    /** Vertices of each cell in lexicographic order. */
    std::vector<std::array<unsigned int, 4>> cells;

    /** Sine of the sharpest or flattest corner of any cell: 1 where all are right angles,
     * 0 or less for one that is folded over. */
    double worst_corner() const;
  };

  /**
   * Mesh what an outline bounds (after Schneiders 1996, grid-based): squares of the
   * lattice about the outline's centre, shifted if need be, as far as they keep away from
   * the outline, and one layer of quadrilaterals from there to it, whose outer vertices
   * lie on the outline, at its corners where it has some; vertices near the outline are
   * then moved to the middle of their neighbours where that makes no cell worse. The area
   * is short by O(spacing^2).
   *
   * @throws cases::Refusal where the outline has features finer than a few cells
   */
  QuadrilateralMesh mesh_outline(const cases::Outline &outline, double spacing);
} // namespace meltfront::reference_fem

#endif
