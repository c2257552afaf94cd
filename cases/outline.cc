#include <cases/error.h>
#include <cases/outline.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace meltfront::cases
{
  namespace
  {
    using Point = Outline::Point;

    /** Chords leave a polar curve by no more than this share of its size. */
    constexpr double chord_tolerance = 1e-7;

    /** Chords that a polar curve starts with, and how often each may be halved: a jump of
     * the radius ends in a chord along the ray. */
    constexpr int first_chords = 64, most_halvings = 24;

    /** Of a chord without a jump the middle by angle is this far from both ends at least,
     * over its length. */
    constexpr double least_half = 0.1;

    /** Relative: radii this near each other close a polar curve. */
    constexpr double closing_tolerance = 1e-9;

    double cross(const Point &a, const Point &b, const Point &c)
    {
      return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    }

    double length(const Point &a, const Point &b)
    {
      return std::hypot(b[0] - a[0], b[1] - a[1]);
    }

    /** Whether a point that is in line with a segment lies on it. */
    bool within(const Point &a, const Point &b, const Point &p)
    {
      return std::min(a[0], b[0]) <= p[0] && p[0] <= std::max(a[0], b[0])
             && std::min(a[1], b[1]) <= p[1] && p[1] <= std::max(a[1], b[1]);
    }

    /** Whether two segments have a point in common. */
    bool meet(const Point &a, const Point &b, const Point &c, const Point &d)
    {
      const double abc = cross(a, b, c), abd = cross(a, b, d);
      const double cda = cross(c, d, a), cdb = cross(c, d, b);
      if(((abc > 0 && abd < 0) || (abc < 0 && abd > 0))
         && ((cda > 0 && cdb < 0) || (cda < 0 && cdb > 0)))
        return true;
      return (abc == 0 && within(a, b, c)) || (abd == 0 && within(a, b, d))
             || (cda == 0 && within(c, d, a)) || (cdb == 0 && within(c, d, b));
    }

    std::string words(const Point &p)
    {
      return fmt::format("({:.6g}, {:.6g})", p[0], p[1]);
    }

    void check_polygon(const std::vector<Point> &corners)
    {
      const std::size_t n = corners.size();
      if(n < 3)
        throw InputError(fmt::format("has {} corner{}; a polygon needs three at least", n,
                                     n == 1 ? "" : "s"));
      const auto corner
          = [&corners, n](std::size_t i) -> const Point & { return corners[i % n]; };
      for(std::size_t i = 0; i < n; ++i)
      {
        const Point &a = corner(i), &b = corner(i + 1);
        if(!std::isfinite(a[0]) || !std::isfinite(a[1]))
          throw InputError(fmt::format("has a corner that is not finite, {}", words(a)));
        if(a == b)
          throw InputError(fmt::format("holds the corner {} twice in a row", words(a)));
      }
      for(std::size_t i = 0; i < n; ++i)
      {
        const Point &a = corner(i), &b = corner(i + 1), &c = corner(i + 2);
        const double along
            = (b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1]);
        if(cross(a, b, c) == 0 && along < 0)
          throw InputError(
              fmt::format("turns back on itself at the corner {}", words(b)));
        for(std::size_t j = i + 2; j < n; ++j)
          if((j + 1) % n != i && meet(a, b, corner(j), corner(j + 1)))
            throw InputError(fmt::format(
                "crosses or touches itself: the side from {} to {} meets that from {} to "
                "{}",
                words(a), words(b), words(corner(j)), words(corner(j + 1))));
      }
    }

    /** Twice the signed area, about the first corner so that few digits cancel. */
    double twice_area(const std::vector<Point> &corners)
    {
      double sum = 0;
      for(std::size_t i = 1; i + 1 < corners.size(); ++i)
        sum += cross(corners[0], corners[i], corners[i + 1]);
      return sum;
    }
  } // namespace

  Outline::Outline(std::vector<Point> corners, const Point &centre)
    : middle(centre)
    , vertex(std::move(corners))
  {
    check_polygon(vertex);
    if(twice_area(vertex) < 0)
      std::reverse(vertex.begin(), vertex.end());
    enclosed = twice_area(vertex) / 2;
    arc.push_back(0);
    for(std::size_t i = 0; i < vertex.size(); ++i)
      arc.push_back(arc.back() + length(vertex[i], chord_end(i)));
    find_box();
  }

  Outline::Outline(std::function<double(double phi)> given_radius, const Point &centre)
    : middle(centre)
  {
    constexpr double pi = std::numbers::pi;
    radius = [given = std::move(given_radius)](double phi)
    {
      const double r = given(phi);
      if(!(r > 0) || !std::isfinite(r))
        throw InputError(fmt::format(
            "is {:.6g} at phi = {:.6g}; a radius is finite and positive", r, phi));
      return r;
    };
    double size = 0;
    for(int i = 0; i <= first_chords; ++i)
      size = std::max(size, radius(-pi + 2 * pi * i / first_chords));
    if(std::abs(radius(pi) - radius(-pi)) > closing_tolerance * size)
      throw InputError(fmt::format("does not close: it is {:.9g} at phi = -pi and {:.9g} "
                                   "at phi = pi",
                                   radius(-pi), radius(pi)));
    for(int i = 0; i < first_chords; ++i)
      refine(-pi + 2 * pi * i / first_chords, -pi + 2 * pi * (i + 1) / first_chords,
             chord_tolerance * size, most_halvings);
    angle.push_back(pi);
    integrate_chords();
    find_box();
  }

  Outline::Point Outline::at_angle(double phi) const
  {
    const double r = radius(phi);
    return {middle[0] + r * std::cos(phi), middle[1] + r * std::sin(phi)};
  }

  /** Append the curve from one angle up to another, the latter left out. */
  void Outline::refine(double from, double to, double tolerance, int depth)
  {
    const Point a = at_angle(from), b = at_angle(to);
    const double chord = length(a, b);
    const Point half = at_angle((from + to) / 2);
    bool straight = std::min(length(a, half), length(half, b)) > least_half * chord;
    for(const double share : {0.25, 0.5, 0.75})
      straight = straight
                 && std::abs(cross(a, b, at_angle(from + share * (to - from))))
                        <= tolerance * chord;
    if(!straight && depth > 0)
    {
      refine(from, (from + to) / 2, tolerance, depth - 1);
      refine((from + to) / 2, to, tolerance, depth - 1);
      return;
    }
    if(!straight && chord > tolerance)
      throw InputError(fmt::format("jumps at phi = {:.6g}", from));
    vertex.push_back(a);
    angle.push_back(from);
  }

  /** Richardson's extrapolation of each chord's length and of the area between it and the
   * curve, from two and four chords in its place. */
  void Outline::integrate_chords()
  {
    enclosed = twice_area(vertex) / 2;
    arc.push_back(0);
    for(std::size_t i = 0; i < vertex.size(); ++i)
    {
      const Point &a = vertex[i], &b = chord_end(i);
      const double step = (angle[i + 1] - angle[i]) / 4;
      const Point quarter = at_angle(angle[i] + step),
                  half = at_angle(angle[i] + 2 * step),
                  most = at_angle(angle[i] + 3 * step);
      const double area_two = cross(a, half, b) / 2;
      const double area_four
          = area_two + (cross(a, quarter, half) + cross(half, most, b)) / 2;
      enclosed += (4 * area_four - area_two) / 3;
      const double two = length(a, half) + length(half, b);
      const double four = length(a, quarter) + length(quarter, half) + length(half, most)
                          + length(most, b);
      arc.push_back(arc.back() + (4 * four - two) / 3);
    }
  }

  void Outline::find_box()
  {
    lower_corner = upper_corner = vertex.front();
    for(const Point &p : vertex)
      for(int d = 0; d < 2; ++d)
      {
        lower_corner[d] = std::min(lower_corner[d], p[d]);
        upper_corner[d] = std::max(upper_corner[d], p[d]);
      }
  }

  const Point &Outline::chord_end(std::size_t chord) const
  {
    return vertex[chord + 1 < vertex.size() ? chord + 1 : 0];
  }

  bool Outline::inside(const Position &p) const
  {
    if(radius)
    {
      const double x = p[0] - middle[0], y = p[1] - middle[1];
      return std::hypot(x, y) <= radius(std::atan2(y, x));
    }
    bool odd = false;
    for(std::size_t i = 0; i < vertex.size(); ++i)
    {
      const Point &a = vertex[i], &b = chord_end(i);
      if((a[1] > p[1]) != (b[1] > p[1]))
      {
        // The side crosses the ray from the point along x if the point is left of it.
        const double left = cross(a, b, {p[0], p[1]});
        odd = odd != (b[1] > a[1] ? left > 0 : left < 0);
      }
    }
    return odd;
  }

  Outline::Place Outline::nearest_place(const Position &p) const
  {
    Place best{0, 0};
    double least = std::numeric_limits<double>::infinity();
    for(std::size_t i = 0; i < vertex.size(); ++i)
    {
      const Point &a = vertex[i], &b = chord_end(i);
      const double dx = b[0] - a[0], dy = b[1] - a[1];
      const double x = p[0] - a[0], y = p[1] - a[1];
      const double share = std::clamp((x * dx + y * dy) / (dx * dx + dy * dy), 0., 1.);
      const double ex = x - share * dx, ey = y - share * dy;
      if(ex * ex + ey * ey < least)
      {
        least = ex * ex + ey * ey;
        best = {i, share};
      }
    }
    if(!radius)
      return best;
    const double width = angle[best.chord + 1] - angle[best.chord];
    return nearest_on_curve(p, angle[best.chord] + best.share * width, width);
  }

  /** From a place near to it, by parabolas through the squared distance at three angles
   * ever closer to each other. */
  Outline::Place Outline::nearest_on_curve(const Position &p, double phi,
                                           double width) const
  {
    constexpr int parabolas = 3;
    constexpr double narrowing = 16, pi = std::numbers::pi;
    const auto squared = [&](double angle_there)
    {
      const Point c = at_angle(std::remainder(angle_there, 2 * pi));
      return (c[0] - p[0]) * (c[0] - p[0]) + (c[1] - p[1]) * (c[1] - p[1]);
    };
    double least = squared(phi);
    for(int i = 0; i < parabolas; ++i, width /= narrowing)
    {
      const double before = squared(phi - width), after = squared(phi + width);
      const double curvature = before - 2 * least + after;
      if(!(curvature > 0))
        continue;
      const double step
          = std::clamp(width * (before - after) / (2 * curvature), -width, width);
      if(const double there = squared(phi + step); there < least)
      {
        phi += step;
        least = there;
      }
    }
    phi = std::remainder(phi, 2 * pi);
    const auto above = std::upper_bound(angle.begin() + 1, angle.end() - 1, phi);
    const auto chord = static_cast<std::size_t>(above - angle.begin()) - 1;
    return {chord,
            std::clamp((phi - angle[chord]) / (angle[chord + 1] - angle[chord]), 0., 1.)};
  }

  Position Outline::position(const Place &place) const
  {
    const Point &a = vertex[place.chord], &b = chord_end(place.chord);
    if(place.share == 0 || place.share == 1)
      return {place.share == 0 ? a[0] : b[0], place.share == 0 ? a[1] : b[1], 0};
    if(!radius)
      return {a[0] + place.share * (b[0] - a[0]), a[1] + place.share * (b[1] - a[1]), 0};
    const double from = angle[place.chord], to = angle[place.chord + 1];
    const Point on = at_angle(from + place.share * (to - from));
    return {on[0], on[1], 0};
  }

  Position Outline::nearest(const Position &point) const
  {
    return position(nearest_place(point));
  }

  Outline::Point Outline::chord_normal(std::size_t chord) const
  {
    const Point &a = vertex[chord], &b = chord_end(chord);
    const double size = length(a, b);
    return {(b[1] - a[1]) / size, (a[0] - b[0]) / size};
  }

  Outline::Edge Outline::nearest_edge(const Position &point) const
  {
    const Place place = nearest_place(point);
    return {position(place), chord_normal(place.chord)};
  }

  /** Call visit(chord, share of the line) where a line crosses a chord, or ends one in a
   * corner: a line that touches a corner meets none or two. */
  template <typename Visit>
  void Outline::visit_crossings(const Position &from, const Position &to,
                                const Visit &visit) const
  {
    const Point p{from[0], from[1]}, q{to[0], to[1]};
    const auto [left, right] = std::minmax(p[0], q[0]);
    const auto [low, high] = std::minmax(p[1], q[1]);
    for(std::size_t i = 0; i < vertex.size(); ++i)
    {
      const Point &a = vertex[i], &b = chord_end(i);
      if((a[0] < left && b[0] < left) || (a[0] > right && b[0] > right)
         || (a[1] < low && b[1] < low) || (a[1] > high && b[1] > high))
        continue;
      const double begins = cross(a, b, p), ends = cross(a, b, q);
      if((begins > 0) != (ends > 0) && (cross(p, q, a) > 0) != (cross(p, q, b) > 0))
        visit(i, begins / (begins - ends));
    }
  }

  std::optional<Outline::Edge> Outline::first_crossing(const Position &from,
                                                       const Position &to) const
  {
    std::optional<std::size_t> chord;
    double first = 0;
    visit_crossings(from, to,
                    [&](std::size_t crossed, double share)
                    {
                      if(chord && share >= first)
                        return;
                      chord = crossed;
                      first = share;
                    });
    if(!chord)
      return {};
    return Edge{
        {from[0] + first * (to[0] - from[0]), from[1] + first * (to[1] - from[1]), 0},
        chord_normal(*chord)};
  }

  bool Outline::hides(const Position &from, const Position &to) const
  {
    constexpr double touch = 1e-9;
    double first = 1, last = 0;
    visit_crossings(from, to,
                    [&](std::size_t, double share)
                    {
                      first = std::min(first, share);
                      last = std::max(last, share);
                    });
    return last - first > touch;
  }

  double Outline::distance(const Position &point) const
  {
    const Position on = nearest(point);
    return std::hypot(point[0] - on[0], point[1] - on[1]);
  }

  double Outline::arc_length_at(const Position &point) const
  {
    const Place place = nearest_place(point);
    return arc[place.chord] + place.share * (arc[place.chord + 1] - arc[place.chord]);
  }

  Position Outline::at(double arc_length) const
  {
    const double turns = std::floor(arc_length / perimeter());
    const double s = std::clamp(arc_length - turns * perimeter(), 0., perimeter());
    const auto above = std::upper_bound(arc.begin(), arc.end() - 1, s);
    const auto chord = static_cast<std::size_t>(above - arc.begin()) - 1;
    return position(
        {chord, std::min((s - arc[chord]) / (arc[chord + 1] - arc[chord]), 1.)});
  }

  std::vector<Position> Outline::points(int count) const
  {
    std::vector<Position> result;
    for(int i = 0; i < count; ++i)
      result.push_back(at(perimeter() * i / count));
    return result;
  }

  std::vector<double> Outline::corner_arc_lengths() const
  {
    const double least = std::sin(15 * std::numbers::pi / 180);
    std::vector<double> result;
    for(std::size_t i = 0; i < vertex.size(); ++i)
    {
      const Point &before = vertex[(i == 0 ? vertex.size() : i) - 1];
      const Point &here = vertex[i], &after = chord_end(i);
      const double sides = length(before, here) * length(here, after);
      const double along = (here[0] - before[0]) * (after[0] - here[0])
                           + (here[1] - before[1]) * (after[1] - here[1]);
      if(along < 0 || std::abs(cross(before, here, after)) > least * sides)
        result.push_back(arc[i]);
    }
    return result;
  }
} // namespace meltfront::cases
