#include <verification/measure/checks/scene_quadrature.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace meltfront::verification
{
  namespace
  {
    /** Along each direction of a domain of one, two or three dimensions. */
    constexpr int cells_along[] = {256, 16, 8};
    constexpr int points_around = 64;

    struct LinePoint
    {
      double place, weight;
    };

    /** Gauss's two points in each of equal cells. */
    std::vector<LinePoint> points_between(double lower, double upper, int cells)
    {
      const double offset = 0.5 / std::numbers::sqrt3;
      const double width = (upper - lower) / cells;
      std::vector<LinePoint> points;
      for(int cell = 0; cell < cells; ++cell)
        for(const double s : {0.5 - offset, 0.5 + offset})
          points.push_back({lower + (cell + s) * width, width / 2});
      return points;
    }

    /** All points with those of a line in one more direction. */
    std::vector<QuadraturePoint> extruded(const std::vector<QuadraturePoint> &points,
                                          int d, const std::vector<LinePoint> &line)
    {
      std::vector<QuadraturePoint> result;
      for(const LinePoint &along : line)
        for(QuadraturePoint point : points)
        {
          point.place[d] = along.place;
          point.weight *= along.weight;
          result.push_back(point);
        }
      return result;
    }

    int cells_of(const cases::Domain &domain)
    {
      return cells_along[domain.dimension - 1];
    }

    int cells_of_walls(const cases::Domain &domain)
    {
      return cells_along[std::max(domain.dimension - 2, 0)];
    }

    /** What the points of a rectangle's section stand for: each its circle. */
    void turn_about_axis(const cases::Domain &domain,
                         std::vector<QuadraturePoint> &points)
    {
      if(domain.shape == cases::DomainShape::axisymmetric)
        for(QuadraturePoint &point : points)
          point.weight *= 2 * std::numbers::pi * point.place[0];
    }

    std::vector<QuadraturePoint> around(double radius, double weight, int divisions)
    {
      const int count = points_around * divisions;
      std::vector<QuadraturePoint> result;
      for(int i = 0; i < count; ++i)
      {
        const double angle = 2 * std::numbers::pi * (i + 0.5) / count;
        result.push_back(
            {{radius * std::cos(angle), radius * std::sin(angle), 0}, weight / count});
      }
      return result;
    }

    /** How often parts of a mesh's cells are halved for so many divisions. */
    int levels_of(int divisions)
    {
      return static_cast<int>(std::bit_width(static_cast<unsigned int>(divisions))) - 1;
    }

    cases::Symmetry symmetry_of(const cases::Domain &domain)
    {
      return domain.dimension == 2 ? cases::Symmetry::cylindrical
                                   : cases::Symmetry::spherical;
    }
  } // namespace

  double volume_of(const cases::Domain &domain)
  {
    if(domain.outline)
      return domain.outline->area();
    if(domain.mesh)
      return domain.mesh->volume();
    if(domain.round())
      return cases::volume_between(symmetry_of(domain), domain.inner_radius,
                                   domain.radius);
    if(domain.shape == cases::DomainShape::axisymmetric)
      return cases::volume_between(cases::Symmetry::cylindrical, domain.lower[0],
                                   domain.upper[0])
             * (domain.upper[1] - domain.lower[1]);
    double volume = 1;
    for(int d = 0; d < domain.dimension; ++d)
      volume *= domain.upper[d] - domain.lower[d];
    return volume;
  }

  double area_of(const cases::Domain &domain, cases::Side side)
  {
    if(domain.outline)
      return domain.outline->perimeter();
    if(domain.mesh)
      return domain.mesh->area(static_cast<int>(index_of_mesh_wall(side)));
    if(domain.round())
    {
      const double radius
          = side == cases::Side::inner ? domain.inner_radius : domain.radius;
      return domain.dimension == 2 ? 2 * std::numbers::pi * radius
                                   : 4 * std::numbers::pi * radius * radius;
    }
    if(domain.shape == cases::DomainShape::axisymmetric)
    {
      const bool across = side == cases::Side::y_min || side == cases::Side::y_max;
      const double radius
          = side == cases::Side::x_min ? domain.lower[0] : domain.upper[0];
      return across ? cases::volume_between(cases::Symmetry::cylindrical, domain.lower[0],
                                            domain.upper[0])
                    : 2 * std::numbers::pi * radius * (domain.upper[1] - domain.lower[1]);
    }
    double area = 1;
    for(int d = 0; d < domain.dimension; ++d)
      if(d != static_cast<int>(side) / 2)
        area *= domain.upper[d] - domain.lower[d];
    return area;
  }

  std::vector<QuadraturePoint> points_over(const cases::Domain &domain, int divisions)
  {
    std::vector<QuadraturePoint> points;
    if(domain.mesh)
      domain.mesh->visit_volume(levels_of(divisions),
                                [&points](const cases::Position &place, double weight) {
                                  points.push_back({place, weight});
                                });
    else if(domain.rectangular())
    {
      points.push_back({{}, 1});
      for(int d = 0; d < domain.dimension; ++d)
        points = extruded(points, d,
                          points_between(domain.lower[d], domain.upper[d],
                                         divisions * cells_of(domain)));
      turn_about_axis(domain, points);
    }
    else if(domain.round() && domain.dimension == 2)
      for(const LinePoint &ray : points_between(domain.inner_radius, domain.radius,
                                                divisions * cells_of(domain)))
        for(const QuadraturePoint &point :
            around(ray.place, 2 * std::numbers::pi * ray.place * ray.weight, divisions))
          points.push_back(point);
    return points;
  }

  std::vector<QuadraturePoint> points_on(const cases::Domain &domain, cases::Side side,
                                         int divisions)
  {
    if(domain.round() && domain.dimension == 2)
      return around(side == cases::Side::inner ? domain.inner_radius : domain.radius,
                    area_of(domain, side), divisions);
    if(domain.mesh)
    {
      std::vector<QuadraturePoint> points;
      domain.mesh->visit_wall(cases::index_of_mesh_wall(side), levels_of(divisions),
                              [&points](const cases::Position &place, double weight) {
                                points.push_back({place, weight});
                              });
      return points;
    }
    if(!domain.rectangular())
      return {};
    const int normal = static_cast<int>(side) / 2;
    std::vector<QuadraturePoint> points{{{}, 1}};
    points[0].place[normal]
        = static_cast<int>(side) % 2 == 0 ? domain.lower[normal] : domain.upper[normal];
    for(int d = 0; d < domain.dimension; ++d)
      if(d != normal)
        points = extruded(points, d,
                          points_between(domain.lower[d], domain.upper[d],
                                         divisions * cells_of_walls(domain)));
    turn_about_axis(domain, points);
    return points;
  }

  double point_distance_over(const cases::Domain &domain)
  {
    return domain.side() / (2 * cells_of(domain));
  }

  double point_distance_on_walls(const cases::Domain &domain)
  {
    return domain.round() ? domain.side() * std::numbers::pi / points_around
                          : domain.side() / (2 * cells_of_walls(domain));
  }

  double integral(const std::vector<QuadraturePoint> &points, const cases::Field &field,
                  double time)
  {
    double sum = 0;
    for(const QuadraturePoint &point : points)
      sum += point.weight * field(point.place, time);
    return sum;
  }

  std::vector<QuadraturePoint> resolving_points(
      const std::function<std::vector<QuadraturePoint>(int divisions)> &points,
      const cases::Field &field, double start, double end)
  {
    constexpr double settled = 2e-2;
    constexpr std::size_t most_points = 70000;
    constexpr double times[] = {0.013, 0.271, 0.523, 0.787, 1};
    std::vector<QuadraturePoint> coarse = points(1);
    for(int divisions = 2; !coarse.empty(); divisions *= 2)
    {
      std::vector<QuadraturePoint> fine = points(divisions);
      double change = 0;
      for(const double share : times)
      {
        const double time = start + share * (end - start);
        double magnitude = 0;
        for(const QuadraturePoint &point : fine)
          magnitude += point.weight * std::abs(field(point.place, time));
        if(magnitude > 0)
          change = std::max(change, std::abs(integral(fine, field, time)
                                             - integral(coarse, field, time))
                                        / magnitude);
      }
      if(change <= settled)
        return coarse;
      coarse = std::move(fine);
      if(coarse.size() > most_points)
        return {};
    }
    return coarse;
  }
} // namespace meltfront::verification
