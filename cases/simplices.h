#ifndef meltfront_cases_simplices_h
#define meltfront_cases_simplices_h

#include <cases/position.h>

#include <algorithm>
#include <array>
#include <functional>
#include <initializer_list>

namespace meltfront::cases
{
  /** A point, an edge, a triangle or a tetrahedron, in the plane or in space. */
  class Simplex
  {
  public:
    /** @param corners one to four */
    Simplex(std::initializer_list<Position> corners)
      : count(corners.size())
    {
      std::copy(corners.begin(), corners.end(), corner.begin());
    }

    std::size_t size() const
    {
      return count;
    }
    Position &operator[](std::size_t i)
    {
      return corner[i];
    }
    const Position &operator[](std::size_t i) const
    {
      return corner[i];
    }

  private:
    std::array<Position, 4> corner{};
    std::size_t count;
  };

  /** Length, area or volume (m, m^2, m^3), of edges and triangles in space too. */
  double measure_of(const Simplex &simplex);

  /** The same with its sign: of a triangle in the plane positive if its corners run
   * counter-clockwise, of a tetrahedron if the last three do, seen from the first. */
  double signed_measure(const Simplex &simplex);

  /** Whether a point lies in a triangle of the plane or in a tetrahedron, or beyond its
   * boundary by no more than round-off. */
  bool holds_point(const Simplex &simplex, const Position &point);

  /** Distance of a point from an edge or a triangle (m). */
  double distance_from(const Simplex &simplex, const Position &point);

  /** Visit the centroids of the 2^(levels d) equal parts of a simplex of d dimensions,
   * each with the part's measure. */
  void visit_parts(const Simplex &simplex, int levels,
                   const std::function<void(const Position &, double measure)> &visit);
} // namespace meltfront::cases

#endif
