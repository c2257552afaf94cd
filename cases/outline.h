#ifndef meltfront_cases_outline_h
#define meltfront_cases_outline_h

#include <cases/position.h>

#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace meltfront::cases
{
  /**
   * A closed curve in the plane without self-crossings that bounds a domain: a polygon,
   * or a distance from a centre as a function of the angle.
   *
   * A polygon is exact to round-off in all that is asked of it. A polar curve is resolved
   * by chords that leave it by no more than 1e-7 of its size. Whether a point lies inside
   * is asked of the curve itself; area, perimeter and nearest points are improved from
   * the chords' to higher order, to 1e-11 (area, perimeter) and 1e-9 (points) of the size
   * where the radius is smooth and to 1e-7 at its kinks.
   */
  class Outline
  {
  public:
    using Point = std::array<double, 2>;

    /**
     * A polygon by its corners, in either direction.
     * @param centre what lattices of particles are arranged about (m)
     * @throws InputError for fewer than three corners, corners that coincide or sides
     * that touch or cross
     */
    explicit Outline(std::vector<Point> corners, const Point &centre = {});

    /**
     * The curve centre + radius(phi) (cos phi, sin phi), -pi <= phi <= pi.
     * @throws InputError for a radius that is not finite, positive and continuous
     * everywhere, or not the same at both ends
     */
    Outline(std::function<double(double phi)> radius, const Point &centre);

    /** Points on the outline itself may count either way. */
    bool inside(const Position &point) const;

    /** m^2 */
    double area() const
    {
      return enclosed;
    }

    /** m */
    double perimeter() const
    {
      return arc.back();
    }

    /** Corners of the bounding box (m). */
    const Point &lower() const
    {
      return lower_corner;
    }
    const Point &upper() const
    {
      return upper_corner;
    }

    const Point &centre() const
    {
      return middle;
    }

    /** The point of the outline that is nearest to a point. */
    Position nearest(const Position &point) const;

    /** A point of the outline (m) and the unit normal there, outwards. */
    struct Edge
    {
      Position place;
      Point normal;
    };

    /** The nearest point and, to the chords' accuracy, the normal. */
    Edge nearest_edge(const Position &point) const;

    /** Where the line from a point to another first crosses the outline or touches a
     * corner, to the chords' accuracy; nothing where it does not. */
    std::optional<Edge> first_crossing(const Position &from, const Position &to) const;

    /** Whether the line between two points inside leaves the outline and comes back: one
     * that only touches a corner does not. The same for both directions. */
    bool hides(const Position &from, const Position &to) const;

    /** Distance from the outline (m), on either side of it. */
    double distance(const Position &point) const;

    /** Length of the outline, counter-clockwise from where it begins to the point of it
     * that is nearest to a point (m). */
    double arc_length_at(const Position &point) const;

    /** The point at a length along the outline, which goes round as often as need be. */
    Position at(double arc_length) const;

    /** Points at equal lengths along the outline. */
    std::vector<Position> points(int count) const;

    /** Vertices, counter-clockwise: the corners of a polygon, points on a polar curve. */
    const std::vector<Point> &vertices() const
    {
      return vertex;
    }

    /** Lengths along the outline at which it turns by more than 15 degrees (m): the
     * corners of a polygon. */
    std::vector<double> corner_arc_lengths() const;

  private:
    /** A place on the outline: how far along which chord. */
    struct Place
    {
      std::size_t chord;
      double share; ///< of the chord's length, or of its angle
    };

    Place nearest_place(const Position &point) const;
    Place nearest_on_curve(const Position &point, double phi, double width) const;
    Point at_angle(double phi) const;
    Position position(const Place &place) const;
    const Point &chord_end(std::size_t chord) const;
    Point chord_normal(std::size_t chord) const;
    template <typename Visit>
    void visit_crossings(const Position &from, const Position &to,
                         const Visit &visit) const;
    void refine(double from, double to, double tolerance, int depth);
    void integrate_chords();
    void find_box();

    std::function<double(double phi)> radius; ///< of a polar curve, else empty
    Point middle;
    std::vector<Point> vertex;
    std::vector<double> angle; ///< of each vertex and again of the first, polar only
    std::vector<double> arc;   ///< length up to each vertex and, at the end, of all
    double enclosed = 0;
    Point lower_corner{}, upper_corner{};
  };
} // namespace meltfront::cases

#endif
