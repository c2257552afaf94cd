#include <reference_fem/cut/conservative/initial_front.h>

#include <reference_fem/cut/conservative/front_law.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

namespace meltfront::reference_fem::cut::conservative
{
  namespace
  {
    using LevelSet = std::function<double(const Point &)>;

    /** Of an edge, for area and distances. */
    constexpr int divisions = 8;

    /** Spacings from the front within which triangles are divided. */
    constexpr double divided = 1.5;

    constexpr int most_corrections = 50;
    constexpr double settled_fit = 1e-12; ///< spacings

    /** The front before it is made linear in triangles. */
    struct FineFront
    {
      Values solid_area; ///< integral of each hat over what is solid (m^2)
      std::vector<Segment> segments;
    };

    /** The zero between two points of opposite signs, by regula falsi (Illinois form). */
    Point zero_between(const Point &a, const Point &b, double value_a, double value_b,
                       const LevelSet &level_set)
    {
      constexpr int most_steps = 40;
      constexpr double near_enough = 1e-10; // of what is between the points
      double lower = 0, upper = 1, place = 0.5, before = 2;
      int side = 0;
      for(int i = 0; i < most_steps && std::abs(place - before) > near_enough; ++i)
      {
        before = place;
        place = (lower * value_b - upper * value_a) / (value_b - value_a);
        const double value = level_set(a + place * (b - a));
        const bool with_a = (value < 0) == (value_a < 0);
        (with_a ? lower : upper) = place;
        (with_a ? value_a : value_b) = value;
        if(side == (with_a ? 1 : -1))
          (with_a ? value_b : value_a) /= 2;
        side = with_a ? 1 : -1;
      }
      return a + place * (b - a);
    }

    /** A triangle with the level set's values at its corners. */
    struct Piece
    {
      std::array<Point, 3> corners;
      std::array<double, 3> values;
    };

    /** The line of its front, if it has one of some length. */
    std::optional<Segment> front_line(const Piece &piece, const LevelSet &level_set)
    {
      for(std::size_t i = 0; i < 3; ++i)
      {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        const bool negative = piece.values[i] < 0;
        if(negative == (piece.values[j] < 0) || negative == (piece.values[k] < 0))
          continue;
        const auto zero = [&](std::size_t other)
        {
          return zero_between(piece.corners[i], piece.corners[other], piece.values[i],
                              piece.values[other], level_set);
        };
        const Segment line{zero(j), zero(k)};
        if(line.length() > 0)
          return line;
      }
      return std::nullopt;
    }

    /** What is solid of a piece that a line divides. */
    Polygon solid_part(const Piece &piece, const std::optional<Segment> &line)
    {
      Polygon whole;
      for(const Point &corner : piece.corners)
        whole.add(corner);
      const auto largest = std::ranges::max_element(piece.values, {},
                                                    [](double v) { return std::abs(v); });
      if(!line)
        return *largest < 0 ? whole : Polygon();
      Gradient normal;
      normal[0] = line->end[1] - line->begin[1];
      normal[1] = line->begin[0] - line->end[0];
      LinearFunction side{line->begin, 0, normal};
      const std::size_t corner = static_cast<std::size_t>(largest - piece.values.begin());
      if((side(piece.corners[corner]) < 0) != (*largest < 0))
        side.gradient *= -1;
      return split(whole, side).negative;
    }

    /** Visit the pieces into which a triangle is divided. */
    template <typename Visit>
    void visit_pieces(const std::array<Point, 3> &corners, const LevelSet &level_set,
                      const Visit &visit)
    {
      const Gradient a = (corners[1] - corners[0]) / divisions,
                     b = (corners[2] - corners[0]) / divisions;
      std::array<std::array<double, divisions + 1>, divisions + 1> values;
      for(int i = 0; i <= divisions; ++i)
        for(int j = 0; i + j <= divisions; ++j)
          values[i][j] = level_set(corners[0] + i * a + j * b);
      for(int i = 0; i < divisions; ++i)
        for(int j = 0; i + j < divisions; ++j)
        {
          const Point origin = corners[0] + i * a + j * b;
          visit(Piece{{origin, origin + a, origin + b},
                      {values[i][j], values[i + 1][j], values[i][j + 1]}});
          if(i + j + 1 < divisions)
            visit(Piece{{origin + a, origin + a + b, origin + b},
                        {values[i + 1][j], values[i + 1][j + 1], values[i][j + 1]}});
        }
    }

    FineFront fine_front(const TriangleMesh &mesh, const Front &front,
                         const Values &distance, const LevelSet &level_set)
    {
      FineFront result{Values(mesh.nodes.size()), {}};
      for(unsigned int t = 0; t < mesh.triangles.size(); ++t)
      {
        const Triangle &triangle = mesh.triangles[t];
        const auto add = [&](const Point &point, double weight)
        {
          for(int i = 0; i < 3; ++i)
            result.solid_area[triangle.nodes[static_cast<std::size_t>(i)]]
                += weight * triangle.hat(i, point);
        };
        const bool near = std::ranges::any_of(
            triangle.nodes, [&](unsigned int node)
            { return std::abs(distance[node]) < divided * mesh.spacing; });
        if(!near)
          integrate(front.part(t, Phase::solid), add);
        else if(!triangle.part.empty())
          for(const Point *next = triangle.part.begin() + 2; next < triangle.part.end();
              ++next)
            visit_pieces({*triangle.part.begin(), next[-1], next[0]}, level_set,
                         [&](const Piece &piece)
                         {
                           const auto line = front_line(piece, level_set);
                           if(line)
                             result.segments.push_back(*line);
                           integrate(solid_part(piece, line), add);
                         });
      }
      return result;
    }
  } // namespace

  FrontState fitted_front(const TriangleMesh &mesh, const StepFrame &frame,
                          const Values &solid_area, double reach)
  {
    Values change(mesh.nodes.size());
    for(std::size_t node = 0; node < change.size(); ++node)
      change[node] = solid_area[node] - frame.front.solid_area[node];
    FrontMove move(mesh, frame, change, Values(mesh.nodes.size()));
    for(int i = 0; i < most_corrections && move.largest > settled_fit * mesh.spacing; ++i)
      move.approach(change);
    const Values nothing(mesh.nodes.size());
    return {with_distances(mesh, *move.front, frame.moved(move.increment, mesh.spacing),
                           reach),
            {nothing, nothing},
            move.debt};
  }

  FrontState initial_front(const TriangleMesh &mesh, const LevelSet &level_set,
                           double reach)
  {
    Values values;
    for(const Point &node : mesh.nodes)
      values.push_back(level_set(node));
    values = without_zeros(std::move(values), mesh.spacing);
    const Front interpolated(mesh, values);
    // Of the level set's own values none tells how far the front is: it may be steep.
    const Values nothing(mesh.nodes.size()),
        linear = distances(mesh, segments_of(interpolated), values, reach);
    const FineFront fine = fine_front(mesh, interpolated, linear, level_set);
    if(fine.segments.empty())
      return {linear, {nothing, nothing}, nothing};
    const StepFrame frame(mesh, distances(mesh, fine.segments, values, reach), 1);
    if(!frame.has_front())
      throw std::runtime_error("no triangle's corners lie on both sides of it");
    return fitted_front(mesh, frame, fine.solid_area, reach);
  }
} // namespace meltfront::reference_fem::cut::conservative
