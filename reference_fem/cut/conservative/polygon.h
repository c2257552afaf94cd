#ifndef meltfront_reference_fem_cut_conservative_polygon_h
#define meltfront_reference_fem_cut_conservative_polygon_h

#include <reference_fem/cut/background_mesh.h>

#include <array>
#include <cstddef>

namespace meltfront::reference_fem::cut::conservative
{
  /** A convex polygon, counterclockwise; a triangle that two rims and a front have cut
   * has six corners at most. */
  class Polygon
  {
  public:
    void add(const Point &corner)
    {
      corners.at(number++) = corner;
    }

    const Point *begin() const
    {
      return corners.data();
    }

    const Point *end() const
    {
      return corners.data() + number;
    }

    /** With three corners or more. */
    bool empty() const
    {
      return number < 3;
    }

    double area() const;

  private:
    std::array<Point, 8> corners;
    std::size_t number = 0;
  };

  struct Segment
  {
    Point begin, end;

    double length() const
    {
      return begin.distance(end);
    }
  };

  /** A linear function of space. */
  struct LinearFunction
  {
    Point origin;
    double value; ///< at the origin
    Gradient gradient;

    double operator()(const Point &point) const
    {
      return value + gradient * (point - origin);
    }
  };

  /** Both sides of a straight line through a polygon, and what of the line lies in it. */
  struct Split
  {
    Polygon negative, positive;
    Segment line; ///< of no length if `crossed` is not set
    bool crossed = false;
  };

  Split split(const Polygon &polygon, const LinearFunction &function);

  /** Call visit(point, weight) for a quadrature that is exact for polynomials of degree
   * 2, on triangles whose edges are divided. All points are inside: on a side that is the
   * front a datum that jumps there would be of the one or the other phase by chance. */
  template <typename Visit>
  void integrate(const Polygon &polygon, const Visit &visit, int divisions = 1)
  {
    if(polygon.empty())
      return;
    const Point *const corner = polygon.begin();
    for(const Point *next = corner + 2; next < polygon.end(); ++next)
    {
      const Gradient first = (next[-1] - corner[0]) / divisions,
                     second = (next[0] - corner[0]) / divisions;
      const double weight = (first[0] * second[1] - first[1] * second[0]) / 6;
      const auto piece = [&](const Point &origin, const Gradient &a, const Gradient &b)
      {
        visit(origin + (a + b) / 6, weight);
        visit(origin + (4 * a + b) / 6, weight);
        visit(origin + (a + 4 * b) / 6, weight);
      };
      for(int i = 0; i < divisions; ++i)
        for(int j = 0; i + j < divisions; ++j)
        {
          const Point origin = corner[0] + i * first + j * second;
          piece(origin, first, second);
          if(i + j + 1 < divisions)
            piece(origin + first + second, -1 * first, -1 * second);
        }
    }
  }

  /** Call visit(point, weight) for three points of Gauss. */
  template <typename Visit>
  void integrate(const Segment &segment, const Visit &visit)
  {
    constexpr double outer = 0.11270166537925831148; // (1 - sqrt(3/5))/2
    constexpr std::array<double, 3> places{outer, 0.5, 1 - outer};
    constexpr std::array<double, 3> weights{5. / 18, 8. / 18, 5. / 18};
    const Gradient along = segment.end - segment.begin;
    const double length = along.norm();
    for(std::size_t q = 0; q < places.size(); ++q)
      visit(segment.begin + places[q] * along, weights[q] * length);
  }
  /** Call visit(point, weight) for the trapezoidal rule. */
  template <typename Visit>
  void integrate_at_ends(const Segment &segment, const Visit &visit)
  {
    const double half = segment.length() / 2;
    visit(segment.begin, half);
    visit(segment.end, half);
  }
} // namespace meltfront::reference_fem::cut::conservative

#endif
