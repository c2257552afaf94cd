#include <reference_fem/cut/conservative/initial_front.h>

#include <reference_fem/cut/conservative/front_law.h>
#include <reference_fem/cut/conservative/linear_system.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem::cut::conservative
{
  namespace
  {
    using LevelSet = std::function<double(const Point &)>;

    /** Of an edge, for the exact area. */
    constexpr int divisions = 8;

    constexpr int most_corrections = 20;
    constexpr double settled = 1e-12; ///< spacings

    /** The linear function through values at the corners of a triangle. */
    LinearFunction through(const std::array<Point, 3> &corners,
                           const std::array<double, 3> &values)
    {
      const Gradient a = corners[1] - corners[0], b = corners[2] - corners[0];
      const double determinant = a[0] * b[1] - a[1] * b[0];
      const double along_a = values[1] - values[0], along_b = values[2] - values[0];
      Gradient gradient;
      gradient[0] = (along_a * b[1] - along_b * a[1]) / determinant;
      gradient[1] = (along_b * a[0] - along_a * b[0]) / determinant;
      return {corners[0], values[0], gradient};
    }

    /** Visit the solid parts of a triangle's pieces. */
    template <typename Visit>
    void visit_solid(const std::array<Point, 3> &corners, const LevelSet &level_set,
                     const Visit &visit)
    {
      const Gradient a = (corners[1] - corners[0]) / divisions,
                     b = (corners[2] - corners[0]) / divisions;
      const auto piece = [&](const std::array<Point, 3> &places)
      {
        std::array<double, 3> values;
        Polygon polygon;
        for(std::size_t i = 0; i < 3; ++i)
        {
          values[i] = level_set(places[i]);
          polygon.add(places[i]);
        }
        integrate(split(polygon, through(places, values)).negative, visit);
      };
      for(int i = 0; i < divisions; ++i)
        for(int j = 0; i + j < divisions; ++j)
        {
          const Point origin = corners[0] + i * a + j * b;
          piece({origin, origin + a, origin + b});
          if(i + j + 1 < divisions)
            piece({origin + a, origin + a + b, origin + b});
        }
    }

    /** Integral of each hat over what is solid. */
    Values exact_area(const TriangleMesh &mesh, const Front &front,
                      const Values &distance, const LevelSet &level_set)
    {
      Values result(mesh.nodes.size());
      for(unsigned int t = 0; t < mesh.triangles.size(); ++t)
      {
        const Triangle &triangle = mesh.triangles[t];
        const auto add = [&](const Point &point, double weight)
        {
          for(int i = 0; i < 3; ++i)
            result[triangle.nodes[static_cast<std::size_t>(i)]]
                += weight * triangle.hat(i, point);
        };
        const bool near
            = std::ranges::any_of(triangle.nodes, [&](unsigned int node)
                                  { return std::abs(distance[node]) < mesh.spacing; });
        if(!near)
          integrate(front.part(t, Phase::solid), add);
        else if(!triangle.part.empty())
          for(const Point *next = triangle.part.begin() + 2; next < triangle.part.end();
              ++next)
            visit_solid({*triangle.part.begin(), next[-1], next[0]}, level_set, add);
      }
      return result;
    }
  } // namespace

  FrontState initial_front(const TriangleMesh &mesh, const LevelSet &level_set,
                           double reach)
  {
    Values values;
    for(const Point &node : mesh.nodes)
      values.push_back(level_set(node));
    values = without_zeros(std::move(values), mesh.spacing);
    FrontState state;
    state.level_set = with_distances(mesh, Front(mesh, values), values, reach);
    state.heat.fill(Values(mesh.nodes.size()));
    state.debt.assign(mesh.nodes.size(), 0);
    const StepFrame frame(mesh, state.level_set, 1);
    if(!frame.has_front())
      return state;
    const Values exact = exact_area(mesh, frame.front, frame.level_set, level_set);
    Values change(mesh.nodes.size()), increment = change;
    for(std::size_t node = 0; node < change.size(); ++node)
      change[node] = exact[node] - frame.front.solid_area[node];
    double moved = 1;
    for(int i = 0; i < most_corrections && moved > settled; ++i)
    {
      const Front front(mesh, frame.moved(increment, mesh.spacing));
      std::vector<Eigen::Triplet<double>> entries;
      LocalVector load = LocalVector::Zero(frame.unknowns);
      for(const std::vector<int> &unknown : frame.temperature)
        for(const int row : unknown)
          if(row >= 0)
            entries.emplace_back(row, row, 1.);
      add_area_law(frame, front, change, increment, entries, load);
      moved = add_displacement(frame, front, mesh.spacing,
                               solve(frame.unknowns, entries, load), increment)
              / mesh.spacing;
    }
    state.level_set = frame.moved(increment, mesh.spacing);
    const Front front(mesh, state.level_set);
    state.debt = debt(frame, front, change, increment);
    state.level_set = with_distances(mesh, front, state.level_set, reach);
    return state;
  }
} // namespace meltfront::reference_fem::cut::conservative
