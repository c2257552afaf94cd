#include <reference_fem/cut/conservative/front.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem::cut::conservative
{
  namespace
  {
    /** Of the spacing: a node nearer to the front is moved off it. */
    constexpr double least_distance = 1e-10;

    double distance(const Point &point, const Segment &segment)
    {
      const Gradient along = segment.end - segment.begin;
      const double square = along.norm_square();
      const double place
          = square > 0 ? std::clamp((point - segment.begin) * along / square, 0., 1.) : 0;
      return point.distance(segment.begin + place * along);
    }

    /** Call visit(node, distance) for nodes within a reach of a segment, and some beyond
     * it. */
    template <typename Visit>
    void visit_distances(const TriangleMesh &mesh, const Segment &segment, double reach,
                         const Visit &visit)
    {
      mesh.visit_nodes_near(segment.begin, reach + segment.length(),
                            [&](unsigned int node)
                            { visit(node, distance(mesh.nodes[node], segment)); });
    }
  } // namespace

  Front::Front(const TriangleMesh &mesh, const Values &level_set)
    : location(mesh.triangles.size(), Location::outside)
    , solid_area(mesh.nodes.size())
    , mesh(mesh)
    , number_of_cut(mesh.triangles.size(), -1)
  {
    for(unsigned int t = 0; t < mesh.triangles.size(); ++t)
    {
      const Triangle &triangle = mesh.triangles[t];
      if(triangle.part.empty())
        continue;
      const auto negative = std::ranges::count_if(triangle.nodes, [&](unsigned int node)
                                                  { return level_set[node] < 0; });
      if(negative == 0 || negative == 3)
        location[t] = negative == 3 ? Location::solid : Location::liquid;
      else
      {
        const LinearFunction function = triangle.function(level_set);
        const Split halves = split(triangle.part, function);
        location[t] = Location::cut;
        number_of_cut[t] = static_cast<int>(cut.size());
        cut.push_back({t,
                       &triangle,
                       {halves.negative, halves.positive},
                       halves.line,
                       halves.crossed,
                       function.gradient / function.gradient.norm(),
                       function});
      }
      const auto add = [&](const Point &point, double weight)
      {
        for(int i = 0; i < 3; ++i)
          solid_area[triangle.nodes[static_cast<std::size_t>(i)]]
              += weight * triangle.hat(i, point);
      };
      if(location[t] != Location::liquid)
        integrate(part(t, Phase::solid), add);
      for(const Phase phase : phases)
        areas[index(phase)] += part(t, phase).area();
    }
  }

  const Polygon &Front::part(unsigned int triangle, Phase phase) const
  {
    static const Polygon nothing;
    if(location[triangle] == Location::cut)
      return cut_at(triangle).part[index(phase)];
    return CutGeometry::is(location[triangle], phase) ? mesh.triangles[triangle].part
                                                      : nothing;
  }

  Values without_zeros(Values level_set, double spacing)
  {
    for(double &value : level_set)
      if(std::abs(value) < least_distance * spacing)
        value = std::copysign(least_distance * spacing, value);
    return level_set;
  }

  Values volume_of_hats(const TriangleMesh &mesh)
  {
    Values result(mesh.nodes.size());
    for(const Triangle &triangle : mesh.triangles)
      integrate(triangle.part,
                [&](const Point &point, double weight)
                {
                  for(int i = 0; i < 3; ++i)
                    result[triangle.nodes[static_cast<std::size_t>(i)]]
                        += weight * triangle.hat(i, point);
                });
    return result;
  }

  std::vector<Segment> segments_of(const Front &front)
  {
    std::vector<Segment> result;
    for(const CutTriangle &cut : front.cut)
      if(cut.crossed)
        result.push_back(cut.segment);
    return result;
  }

  std::vector<Gradient> nearest_normals(const TriangleMesh &mesh, const Front &front,
                                        double reach)
  {
    std::vector<Gradient> result(mesh.nodes.size());
    Values nearest(mesh.nodes.size(), reach);
    for(const CutTriangle &cut : front.cut)
      if(cut.crossed)
        visit_distances(mesh, cut.segment, reach,
                        [&](unsigned int node, double found)
                        {
                          if(!(found < nearest[node]))
                            return;
                          nearest[node] = found;
                          result[node] = cut.normal;
                        });
    return result;
  }

  Values distances(const TriangleMesh &mesh, const std::vector<Segment> &segments,
                   const Values &signs, double reach)
  {
    Values result(signs.size());
    for(std::size_t i = 0; i < result.size(); ++i)
      result[i] = std::copysign(reach, signs[i]);
    for(const Segment &segment : segments)
      visit_distances(mesh, segment, reach,
                      [&](unsigned int node, double found)
                      {
                        if(found < std::abs(result[node]))
                          result[node] = std::copysign(found, signs[node]);
                      });
    return without_zeros(std::move(result), mesh.spacing);
  }

  Values with_distances(const TriangleMesh &mesh, const Front &front,
                        const Values &level_set, double reach)
  {
    Values result = distances(mesh, segments_of(front), level_set, reach);
    for(const CutTriangle &cut : front.cut)
      for(const unsigned int node : cut.place->nodes)
        result[node] = level_set[node];
    return result;
  }
} // namespace meltfront::reference_fem::cut::conservative
