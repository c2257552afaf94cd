#ifndef meltfront_reference_fem_cut_conservative_square_element_h
#define meltfront_reference_fem_cut_conservative_square_element_h

#include <reference_fem/cut/background_mesh.h>

#include <array>

namespace meltfront::reference_fem::cut::conservative
{
  /** Sides of a square that has corners in lexicographic order. */
  enum class SquareSide : unsigned char
  {
    left,
    right,
    bottom,
    top
  };

  /**
   * Mass and conduction of a square of four nodes, whose rows add up to a compact scheme
   * of fourth order ("Mehrstellen", Collatz 1960) on a lattice,
   *
   *   M = 1 + (dx^2 + dy^2)/12,
   *   K = -(dx^2/h_x^2 + dy^2/h_y^2 + (1/h_x^2 + 1/h_y^2) dx^2 dy^2/12),
   *
   * dx^2 and dy^2 second differences. On a side beyond which other elements are, rows are
   * what these expect: the integrals of f w and grad T . grad w for functions w that are
   * linear along it, up to third differences of a harmonic T, for which such a side adds
   *
   *   -h_n^2/12 int (d_s d_n T)(d_s w) ds        h_n: size of the square across the side
   *
   * to grad T . grad w and what is left of first moments to f w. (On four such sides the
   * mass is that of bilinear elements, and so is the conduction.) The hats w of the mass
   * are those of the square's two triangles, divided from the first to the last corner:
   * at these they take up the `bubble` more of what is in the square than bilinear ones,
   * and as much less at the others. Conduction is of bilinear hats: what is missing is
   * the bubble's share of grad^2 T at the centre.
   *
   * Linear functions are exact. Columns of K sum to zero: no heat is lost.
   */
  struct SquareElement
  {
    using Matrix = std::array<std::array<double, 4>, 4>; ///< row, column

    /** @param size of the square (m)
     * @param open sides, by SquareSide, beyond which there is another kind of element */
    SquareElement(const Gradient &size, const std::array<bool, 4> &open);

    Matrix mass{};       ///< of unit heat capacity (m^2)
    Matrix conduction{}; ///< of unit conductivity: int grad T . grad w
    double bubble;       ///< a twelfth of the area (m^2)
  };
} // namespace meltfront::reference_fem::cut::conservative

#endif
