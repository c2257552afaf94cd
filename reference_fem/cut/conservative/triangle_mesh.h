#ifndef meltfront_reference_fem_cut_conservative_triangle_mesh_h
#define meltfront_reference_fem_cut_conservative_triangle_mesh_h

#include <reference_fem/cut/conservative/polygon.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace meltfront::reference_fem::cut::conservative
{
  /** A triangle with linear shape functions ("hats"). */
  struct Triangle
  {
    std::array<unsigned int, 3> nodes; ///< counterclockwise
    Point centre;
    std::array<Gradient, 3> gradients; ///< of the hats (1/m)
    double area;                       ///< m^2
    Polygon part;                      ///< what of it lies in the domain, maybe nothing
    bool whole = true;                 ///< all of it does

    double hat(int node, const Point &point) const
    {
      return 1. / 3 + gradients[static_cast<std::size_t>(node)] * (point - centre);
    }

    Gradient gradient(const Values &field) const;
    double value(const Values &field, const Point &point) const;
    LinearFunction function(const Values &field) const;
  };

  struct InnerEdge
  {
    std::array<unsigned int, 2> triangles;
    Gradient normal; ///< of either sense
    double length;
  };

  /** A straight piece of the domain's boundary in one triangle. */
  struct WallPiece
  {
    unsigned int triangle;
    Segment segment;
    Gradient normal; ///< out of the domain
    cases::Side side;
    double share = 1; ///< of a rim's length in that of its polygon
  };

  /**
   * Squares cut in two, over a box or under a disk or an annulus. A rim is the zero line
   * of the linear interpolant of its distance, about a radius by which the domain has its
   * exact area.
   */
  class TriangleMesh
  {
  public:
    /** @param n squares along the domain's side
     * @throws cases::Refusal for a scene that is not two-dimensional */
    TriangleMesh(const cases::Domain &domain, int n);

    std::vector<Point> nodes;
    std::vector<Triangle> triangles;
    std::vector<InnerEdge> inner_edges; ///< between triangles that touch the domain
    std::vector<WallPiece> walls;
    /** Corners in lexicographic order; triangles 2 s and 2 s + 1 are halves of square s.
     */
    std::vector<std::array<unsigned int, 4>> squares;
    double spacing; ///< shortest side of the squares (m)

    /** The triangle that holds a point. */
    unsigned int triangle_at(const Point &point) const;

    /** Call visit(node) for nodes within a distance of a point, and some beyond it. */
    template <typename Visit>
    void visit_nodes_near(const Point &point, double reach, const Visit &visit) const
    {
      std::array<unsigned int, dim> first, last;
      for(int d = 0; d < dim; ++d)
      {
        const double place = (point[d] - lower[d]) / size[d];
        first[d] = static_cast<unsigned int>(
            std::max(0., std::floor(place - reach / size[d])));
        last[d] = static_cast<unsigned int>(
            std::min(double(number[d]), std::ceil(place + reach / size[d])));
      }
      for(unsigned int j = first[1]; j <= last[1]; ++j)
        for(unsigned int i = first[0]; i <= last[0]; ++i)
          visit(j * (number[0] + 1) + i);
    }

  private:
    void add_triangle(const std::array<unsigned int, 3> &nodes);
    double area() const;
    void cut_rim(const cases::Domain &domain, bool outer);
    void add_box_walls(const cases::Domain &domain);
    void find_inner_edges();

    Point lower;
    Gradient size; ///< of a square (m)
    std::array<unsigned int, dim> number;
  };
} // namespace meltfront::reference_fem::cut::conservative

#endif
