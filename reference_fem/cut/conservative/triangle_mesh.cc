#include <reference_fem/cut/conservative/triangle_mesh.h>

#include <cases/error.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace meltfront::reference_fem::cut::conservative
{
  Gradient Triangle::gradient(const Values &field) const
  {
    Gradient sum;
    for(std::size_t i = 0; i < 3; ++i)
      sum += field[nodes[i]] * gradients[i];
    return sum;
  }

  double Triangle::value(const Values &field, const Point &point) const
  {
    double sum = 0;
    for(int i = 0; i < 3; ++i)
      sum += field[nodes[static_cast<std::size_t>(i)]] * hat(i, point);
    return sum;
  }

  LinearFunction Triangle::function(const Values &field) const
  {
    return {centre, value(field, centre), gradient(field)};
  }

  TriangleMesh::TriangleMesh(const cases::Domain &domain, int n)
  {
    if(domain.dimension != dim)
      throw cases::Refusal("fem-cut simulates boxes, disks and annuli in two dimensions: "
                           "no slabs, and not in three dimensions");
    const bool round = domain.round();
    Gradient extent;
    for(int d = 0; d < dim; ++d)
    {
      lower[d] = round ? -domain.radius : domain.lower[d];
      extent[d] = round ? 2 * domain.radius : domain.upper[d] - domain.lower[d];
    }
    for(int d = 0; d < dim; ++d)
    {
      number[d] = static_cast<unsigned int>(
          std::max(1L, std::lround(extent[d] / (extent[0] / n))));
      size[d] = extent[d] / number[d];
      if(round)
      {
        // The polygon that has the disk's area reaches beyond it.
        lower[d] -= size[d];
        number[d] += 2;
      }
    }
    spacing = std::min(size[0], size[1]);
    const unsigned int row = number[0] + 1;
    for(unsigned int j = 0; j <= number[1]; ++j)
      for(unsigned int i = 0; i < row; ++i)
        nodes.emplace_back(lower[0] + i * size[0], lower[1] + j * size[1]);
    for(unsigned int j = 0; j < number[1]; ++j)
      for(unsigned int i = 0; i < number[0]; ++i)
      {
        const unsigned int a = j * row + i, b = a + 1, c = a + row, d = c + 1;
        squares.push_back({a, b, c, d});
        add_triangle({a, b, d});
        add_triangle({a, d, c});
      }
    if(round)
    {
      cut_rim(domain, true);
      if(domain.shape == cases::DomainShape::shell)
        cut_rim(domain, false);
    }
    else
      add_box_walls(domain);
    find_inner_edges();
  }

  void TriangleMesh::add_triangle(const std::array<unsigned int, 3> &corners)
  {
    Triangle triangle{corners, {}, {}, 0, {}};
    std::array<Point, 3> place;
    for(std::size_t i = 0; i < 3; ++i)
    {
      place[i] = nodes[corners[i]];
      triangle.centre += place[i] / 3;
      triangle.part.add(place[i]);
    }
    triangle.area = triangle.part.area();
    for(std::size_t i = 0; i < 3; ++i)
    {
      const Gradient opposite = place[(i + 2) % 3] - place[(i + 1) % 3];
      triangle.gradients[i][0] = -opposite[1] / (2 * triangle.area);
      triangle.gradients[i][1] = opposite[0] / (2 * triangle.area);
    }
    triangles.push_back(triangle);
  }

  double TriangleMesh::area() const
  {
    double sum = 0;
    for(const Triangle &triangle : triangles)
      sum += triangle.part.area();
    return sum;
  }

  void TriangleMesh::cut_rim(const cases::Domain &domain, const bool outer)
  {
    const double radius = outer ? domain.radius : domain.inner_radius;
    const double sign = outer ? 1 : -1, exact = std::numbers::pi * radius * radius;
    const std::vector<Triangle> before = triangles;
    const double whole = area();
    double of_polygon = radius;
    Values values(nodes.size());
    // The area is nearly quadratic in the radius: Newton's method, to round-off.
    constexpr int most_corrections = 8;
    for(int correction = 0; correction < most_corrections; ++correction)
    {
      for(std::size_t i = 0; i < nodes.size(); ++i)
        values[i] = sign * (nodes[i].norm() - of_polygon);
      for(std::size_t t = 0; t < triangles.size(); ++t)
        triangles[t].part = split(before[t].part, before[t].function(values)).negative;
      const double enclosed = outer ? area() : whole - area();
      if(std::abs(exact - enclosed) <= 1e-14 * exact)
        break;
      of_polygon += (exact - enclosed) / (2 * std::numbers::pi * radius);
    }
    const std::size_t first = walls.size();
    double length = 0;
    for(unsigned int t = 0; t < triangles.size(); ++t)
    {
      Triangle &triangle = triangles[t];
      const LinearFunction function = triangle.function(values);
      const Split halves = split(before[t].part, function);
      if(!halves.positive.empty())
        triangle.whole = false;
      if(!halves.crossed)
        continue;
      walls.push_back({t, halves.line, function.gradient / function.gradient.norm(),
                       outer ? cases::Side::outer : cases::Side::inner});
      length += halves.line.length();
    }
    for(std::size_t wall = first; wall < walls.size(); ++wall)
      walls[wall].share = 2 * std::numbers::pi * radius / length;
  }

  void TriangleMesh::add_box_walls(const cases::Domain &domain)
  {
    for(unsigned int t = 0; t < triangles.size(); ++t)
      for(std::size_t i = 0; i < 3; ++i)
      {
        const Point &begin = nodes[triangles[t].nodes[i]],
                    &end = nodes[triangles[t].nodes[(i + 1) % 3]];
        for(int d = 0; d < dim; ++d)
          for(const bool upper : {false, true})
          {
            const double wall = upper ? domain.upper[d] : domain.lower[d];
            const double near = 1e-6 * size[d];
            if(std::abs(begin[d] - wall) > near || std::abs(end[d] - wall) > near)
              continue;
            Gradient normal;
            normal[d] = upper ? 1 : -1;
            walls.push_back(
                {t, {begin, end}, normal, static_cast<cases::Side>(2 * d + upper)});
          }
      }
  }

  void TriangleMesh::find_inner_edges()
  {
    std::map<std::pair<unsigned int, unsigned int>, unsigned int> open;
    for(unsigned int t = 0; t < triangles.size(); ++t)
      for(std::size_t i = 0; i < 3; ++i)
      {
        if(triangles[t].part.empty())
          continue;
        const auto ends
            = std::minmax(triangles[t].nodes[i], triangles[t].nodes[(i + 1) % 3]);
        const auto [found, first] = open.try_emplace(ends, t);
        if(first)
          continue;
        const Gradient along = nodes[ends.second] - nodes[ends.first];
        Gradient normal;
        normal[0] = along[1] / along.norm();
        normal[1] = -along[0] / along.norm();
        inner_edges.push_back({{found->second, t}, normal, along.norm()});
      }
  }

  unsigned int TriangleMesh::triangle_at(const Point &point) const
  {
    std::array<unsigned int, dim> square;
    Gradient inside;
    for(int d = 0; d < dim; ++d)
    {
      const double place = (point[d] - lower[d]) / size[d];
      square[d]
          = static_cast<unsigned int>(std::clamp(std::floor(place), 0., number[d] - 1.));
      inside[d] = place - square[d];
    }
    return 2 * (square[1] * number[0] + square[0]) + (inside[1] > inside[0] ? 1 : 0);
  }
} // namespace meltfront::reference_fem::cut::conservative
