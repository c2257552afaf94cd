#include <cases/error.h>
#include <particles/greenspan/sphere_shadows.h>

#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace meltfront::particles::greenspan
{
  namespace
  {
    namespace geometry = boost::geometry;
    using Vector = std::array<double, 3>;
    using Box = geometry::model::box<
        geometry::model::point<double, 3, geometry::cs::cartesian>>;

    constexpr double whole_turn = 2 * std::numbers::pi;

    /** What is left of a cap is nothing from here on. */
    constexpr double nothing = 1e-12;

    double dot(const Vector &a, const Vector &b)
    {
      return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    }

    Vector cross(const Vector &a, const Vector &b)
    {
      return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
              a[0] * b[1] - a[1] * b[0]};
    }

    Vector operator-(const Vector &a, const Vector &b)
    {
      return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    }

    Vector combined(double a, const Vector &u, double b, const Vector &v)
    {
      return {a * u[0] + b * v[0], a * u[1] + b * v[1], a * u[2] + b * v[2]};
    }

    double length(const Vector &a)
    {
      return std::sqrt(dot(a, a));
    }

    /** Two directions across one, the three of them right-handed. */
    std::array<Vector, 2> across(const Vector &along)
    {
      const auto least = std::ranges::min_element(
          along, {}, [](double component) { return std::abs(component); });
      Vector axis{};
      axis[static_cast<std::size_t>(least - along.begin())] = 1;
      Vector first = cross(along, axis);
      const double size = length(first);
      for(double &component : first)
        component /= size;
      return {first, cross(along, first)};
    }

    /** A part of a circle, in angles of its own. */
    struct Arc
    {
      double begin, end;
    };

    /** What a sphere covers as it is seen from a point: the directions within an angle of
     * one. Half angles stand as squares of their sines, which lose nothing where small.
     */
    struct Cap
    {
      Vector centre;            ///< a direction
      std::array<Vector, 2> up; ///< across it
      double sine;              ///< of the cap's angle
      double half_square;       ///< sin^2 of half of it

      Cap(const Vector &direction, double sine)
        : centre(direction)
        , up(across(direction))
        , sine(sine)
        , half_square(sine * sine / (2 * (1 + std::sqrt(1 - sine * sine))))
      {
      }

      double area() const
      {
        return 2 * whole_turn * half_square;
      }

      /** Area of the sector of an arc. */
      double sector(double angle) const
      {
        return 2 * half_square * angle;
      }

      double reach() const
      {
        return 2 * std::sqrt(half_square);
      }

      Vector at(double angle) const
      {
        const Vector aside = combined(std::cos(angle), up[0], std::sin(angle), up[1]);
        return combined(1 - 2 * half_square, centre, sine, aside);
      }

      /** Cosine of half of the arc of this cap's edge that lies within another one. */
      double cosine_within(const Cap &other, double chord) const
      {
        const double between = chord * chord / 4; // sin^2 of half the angle
        return 2 * (half_square + between - other.half_square - 2 * half_square * between)
               / (sine * 2 * std::sqrt(between * (1 - std::min(between, 1.))));
      }

      /** Signed area of a triangle on the unit sphere. */
      static double triangle(const Vector &a, const Vector &b, const Vector &c)
      {
        return 2
               * std::atan2(dot(a, cross(b - a, c - a)),
                            1 + dot(a, b) + dot(b, c) + dot(c, a));
      }
    };

    /** What a sphere covers of a plane across rays: a disk. */
    struct Disk
    {
      Vector centre; ///< the third coordinate is 0
      double radius;

      double area() const
      {
        return sector(whole_turn);
      }

      double sector(double angle) const
      {
        return angle * radius * radius / 2;
      }

      double reach() const
      {
        return radius;
      }

      Vector at(double angle) const
      {
        return {centre[0] + radius * std::cos(angle),
                centre[1] + radius * std::sin(angle), 0};
      }

      static constexpr std::array<Vector, 2> up{Vector{1, 0, 0}, Vector{0, 1, 0}};

      double cosine_within(const Disk &other, double distance) const
      {
        return (distance * distance + radius * radius - other.radius * other.radius)
               / (2 * distance * radius);
      }

      static double triangle(const Vector &a, const Vector &b, const Vector &c)
      {
        return cross(b - a, c - a)[2] / 2;
      }
    };

    /** The part of a figure's edge within another one: half of its angle, 0 for none and
     * pi for all, about the direction to it. Of figures that coincide all. */
    template <typename Figure>
    Arc within(const Figure &figure, const Figure &other)
    {
      const Vector way = other.centre - figure.centre;
      const double distance = length(way);
      if(distance >= figure.reach() + other.reach())
        return {0, 0};
      const double cosine = distance > 0 ? figure.cosine_within(other, distance) : -1;
      const double half = std::acos(std::clamp(cosine, -1., 1.));
      const double middle = std::atan2(dot(way, figure.up[1]), dot(way, figure.up[0]));
      return {middle - half, middle + half};
    }

    /** What arcs leave of a circle. */
    std::vector<Arc> gaps_between(const std::vector<Arc> &arcs)
    {
      std::vector<Arc> turned;
      for(const Arc &arc : arcs)
      {
        const double turns = std::floor(arc.begin / whole_turn) * whole_turn;
        const double begin = arc.begin - turns, end = arc.end - turns;
        turned.push_back({begin, std::min(end, whole_turn)});
        if(end > whole_turn)
          turned.push_back({0, end - whole_turn});
      }
      std::ranges::sort(turned, {}, &Arc::begin);
      std::vector<Arc> gaps;
      double reached = 0;
      for(const Arc &arc : turned)
      {
        if(arc.begin > reached)
          gaps.push_back({reached, arc.begin});
        reached = std::max(reached, arc.end);
      }
      if(reached < whole_turn)
        gaps.push_back({reached, whole_turn});
      return gaps;
    }

    bool covers_all(const Arc &arc)
    {
      return arc.end - arc.begin >= whole_turn;
    }

    /** Area of a figure that others, in front of it, leave. */
    template <typename Figure>
    double area_left(const Figure &figure, const std::vector<const Figure *> &front)
    {
      std::vector<Arc> hidden;
      for(const Figure *other : front)
      {
        hidden.push_back(within(figure, *other));
        if(covers_all(hidden.back()) && other->area() >= figure.area())
          return 0;
      }
      double area = 0;
      for(const Arc &gap : gaps_between(hidden))
        area += figure.sector(gap.end - gap.begin);
      for(std::size_t j = 0; j < front.size(); ++j)
      {
        const Figure &edge = *front[j];
        const Arc inside = within(edge, figure);
        hidden = {{inside.end, inside.begin + whole_turn}};
        for(std::size_t k = 0; k < front.size(); ++k)
        {
          // Of two that coincide the later one's edge is hidden.
          if(k != j && (k < j || front[k]->centre != edge.centre))
            hidden.push_back(within(edge, *front[k]));
        }
        for(const Arc &gap : gaps_between(hidden))
        {
          const Vector from = edge.at(gap.begin), to = edge.at(gap.end);
          area -= edge.sector(gap.end - gap.begin)
                  + Figure::triangle(figure.centre, from, to)
                  - Figure::triangle(edge.centre, from, to);
        }
      }
      return std::clamp(area, 0., figure.area());
    }

    template <typename Figure>
    Box box_of(const Figure &figure)
    {
      const Vector &c = figure.centre;
      const double r = figure.reach();
      return {{c[0] - r, c[1] - r, c[2] - r}, {c[0] + r, c[1] + r, c[2] + r}};
    }

    /** What is left of each figure by those before it. */
    template <typename Figure>
    std::vector<Exposure> left_of_each(const std::vector<Figure> &figures)
    {
      using Entry = std::pair<Box, std::size_t>;
      geometry::index::rtree<Entry, geometry::index::quadratic<16>> tree;
      std::vector<Exposure> result(figures.size());
      std::vector<Entry> found;
      std::vector<const Figure *> front;
      for(std::size_t i = 0; i < figures.size(); ++i)
      {
        const Figure &figure = figures[i];
        const Box box = box_of(figure);
        found.clear();
        tree.query(geometry::index::intersects(box), std::back_inserter(found));
        std::ranges::sort(found, {}, &Entry::second);
        front.clear();
        for(const auto &[of_other, other] : found)
          if(const Arc edge = within(figure, figures[other]),
             of_edge = within(figures[other], figure);
             edge.end > edge.begin || of_edge.end > of_edge.begin)
            front.push_back(&figures[other]);
        result[i].width = area_left(figure, front);
        result[i].share = result[i].width / figure.area();
        if(result[i].share > nothing)
          tree.insert({box, i});
      }
      return result;
    }

    /** Exposures of figures that stand in an order. */
    template <typename Figure>
    std::vector<Exposure> in_given_order(const std::vector<Figure> &figures,
                                         const std::vector<std::size_t> &order)
    {
      std::vector<Exposure> result(order.size());
      const std::vector<Exposure> ordered = left_of_each(figures);
      for(std::size_t k = 0; k < order.size(); ++k)
        result[order[k]] = ordered[k];
      return result;
    }

    Vector place(const Centres &centres, std::size_t i)
    {
      return {centres[0][i], centres[1][i], centres[2][i]};
    }
  } // namespace

  std::vector<Exposure> exposure_to_point(const Centres &centres,
                                          const std::array<double, 3> &source,
                                          double radius)
  {
    require_light_radius(radius);
    const std::size_t n = centres[0].size();
    std::vector<double> distance(n);
    for(std::size_t i = 0; i < n; ++i)
      distance[i] = length(place(centres, i) - source);
    const std::vector<std::size_t> order = order_of_light(distance);
    if(n > 0 && distance[order.front()] <= radius) // the source is within it
    {
      std::vector<Exposure> result(n);
      result[order.front()] = {1, 2 * whole_turn};
      return result;
    }
    std::vector<Cap> caps;
    for(const std::size_t i : order)
    {
      Vector direction = place(centres, i) - source;
      for(double &component : direction)
        component /= distance[i];
      caps.emplace_back(direction, radius / distance[i]);
    }
    return in_given_order(caps, order);
  }

  std::vector<Exposure> exposure_to_rays(const Centres &centres,
                                         const std::array<double, 3> &direction,
                                         double radius)
  {
    require_light_radius(radius);
    const double size = length(direction);
    if(!(size > 0 && std::isfinite(size)))
      throw cases::InputError("the direction of rays must have a length");
    const Vector along{direction[0] / size, direction[1] / size, direction[2] / size};
    const std::array<Vector, 2> aside = across(along);
    std::vector<double> depth(centres[0].size());
    for(std::size_t i = 0; i < depth.size(); ++i)
      depth[i] = dot(place(centres, i), along);
    const std::vector<std::size_t> order = order_of_light(depth);
    std::vector<Disk> disks;
    for(const std::size_t i : order)
      disks.push_back(
          {{dot(place(centres, i), aside[0]), dot(place(centres, i), aside[1]), 0},
           radius});
    return in_given_order(disks, order);
  }
} // namespace meltfront::particles::greenspan
