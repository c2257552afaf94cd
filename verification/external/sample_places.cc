#include <cases/error.h>
#include <cases/outline.h>
#include <verification/external/sample_places.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meltfront::verification::external
{
  namespace
  {
    using cases::Position;
    using Points = std::vector<double>;

    /** The cells that spacings of side / n make of a length, at least one. */
    Points points_between(double lower, double upper, double spacing, bool at_vertices)
    {
      const int cells
          = std::max(1, static_cast<int>(std::lround((upper - lower) / spacing)));
      Points points;
      for(int i = 0; i < cells + (at_vertices ? 1 : 0); ++i)
        points.push_back(lower + (i + (at_vertices ? 0 : 0.5)) * (upper - lower) / cells);
      return points;
    }

    std::vector<Position> all_of(const std::array<Points, 3> &axes)
    {
      std::vector<Position> places;
      for(const double z : axes[2])
        for(const double y : axes[1])
          for(const double x : axes[0])
            places.push_back({x, y, z});
      return places;
    }

    bool along_radius(const cases::Scene &scene)
    {
      return scene.domain.round() && scene.symmetry != cases::Symmetry::none;
    }

    /** Corners of what holds the domain. */
    std::pair<Position, Position> box_of(const cases::Domain &domain)
    {
      if(!domain.round())
        return {domain.lower, domain.upper};
      const double r = domain.radius;
      return {{-r, -r, -r}, {r, r, r}};
    }

    bool holds(const cases::Domain &domain, const Position &place)
    {
      if(domain.outline)
        return domain.outline->inside(place);
      const double r = std::hypot(place[0], place[1], place[2]);
      return !domain.round() || (r <= domain.radius && r >= domain.inner_radius);
    }

    std::vector<Position> points_of_circle(double radius, int count)
    {
      std::vector<Position> places;
      for(int i = 0; i < count; ++i)
      {
        const double phi = 2 * std::numbers::pi * i / count;
        places.push_back({radius * std::cos(phi), radius * std::sin(phi), 0});
      }
      return places;
    }
  } // namespace

  std::vector<Position> places_in(const cases::Scene &scene, int n, bool at_vertices)
  {
    const cases::Domain &domain = scene.domain;
    const double spacing = domain.side() / n;
    std::array<Points, 3> axes{Points{0}, Points{0}, Points{0}};
    if(along_radius(scene))
    {
      axes[0] = points_between(domain.inner_radius, domain.radius, spacing, at_vertices);
      return all_of(axes);
    }
    const auto [lower, upper] = box_of(domain);
    for(int d = 0; d < domain.dimension; ++d)
      axes[d] = points_between(lower[d], upper[d], spacing, at_vertices);
    std::vector<Position> places = all_of(axes);
    std::erase_if(places, [&](const Position &place) { return !holds(domain, place); });
    return places;
  }

  std::vector<Position> places_on(const cases::Scene &scene, cases::Side side, int n,
                                  bool at_vertices)
  {
    const cases::Domain &domain = scene.domain;
    constexpr int points_of_side = 4;
    if(domain.rectangular())
    {
      const double spacing = domain.side() / n;
      const int normal = static_cast<int>(side) / 2;
      std::array<Points, 3> axes{Points{0}, Points{0}, Points{0}};
      for(int d = 0; d < domain.dimension; ++d)
        axes[d] = points_between(domain.lower[d], domain.upper[d], spacing, at_vertices);
      axes[normal] = {static_cast<int>(side) % 2 == 0 ? domain.lower[normal]
                                                      : domain.upper[normal]};
      return all_of(axes);
    }
    if(domain.outline)
      return domain.outline->points(points_of_side * n);
    const double radius
        = side == cases::Side::inner ? domain.inner_radius : domain.radius;
    if(along_radius(scene))
      return {{radius, 0, 0}};
    if(domain.dimension == 3)
      throw cases::Refusal(
          fmt::format("has no words for a wall of a ball in space that varies ({})",
                      to_string(side)));
    return points_of_circle(radius, points_of_side * n);
  }
} // namespace meltfront::verification::external
