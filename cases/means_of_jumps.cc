#include <cases/expression_words.h>
#include <cases/mean_with_jumps.h>
#include <cases/means_of_jumps.h>
#include <cases/outline.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace meltfront::cases
{
  namespace
  {
    /** Parts of a line that are looked at, so that what is narrower is seen, and of each
     * direction of a square and of a cube about each of many places. */
    constexpr int parts_of_line = 4, parts_in_square = 2, parts_in_cube = 1;

    /** Halvings of a part in search of a jump. */
    constexpr int halvings_of_line = 12, halvings_in_square = 6;

    /** What of a wall is within half a width of a place, by one coordinate along the wall
     * or two. */
    struct Patch
    {
      struct Range
      {
        double from, to;
      };
      Range first;
      std::optional<Range> second;
      std::function<Position(double s, double t)> place;

      template <typename Value>
      double mean(const Value &value) const
      {
        const auto at = [&](const Position &p) { return value(place(p[0], p[1])); };
        return second ? mean_over_box(at, {}, {first.from, second->from, 0},
                                      {first.to, second->to, 0}, 2, parts_in_square,
                                      halvings_in_square)
                      : mean_over_box(at, {}, {first.from, 0, 0}, {first.to, 0, 0}, 1,
                                      parts_of_line, halvings_of_line);
      }
    };

    using PatchAbout = std::function<Patch(const Position &)>;

    /** A direction of a wall in a plane. */
    struct Direction
    {
      std::size_t d;
      double width, lower, upper;
      bool joined; ///< its ends are one

      Patch::Range about(double at) const
      {
        const double half = 0.5 * width;
        if(joined)
          return {at - half, at + half};
        return {std::clamp(at - half, lower, upper - half),
                std::clamp(at + half, lower + half, upper)};
      }

      double within(double coordinate) const
      {
        if(joined && coordinate < lower)
          return coordinate + (upper - lower);
        return joined && coordinate > upper ? coordinate - (upper - lower) : coordinate;
      }
    };

    PatchAbout patches_of_plane(const Scene &scene, Side side, double width)
    {
      const Domain &domain = scene.domain;
      std::vector<Direction> along;
      for(std::size_t d = 0; d < static_cast<std::size_t>(domain.dimension); ++d)
        if(d != static_cast<std::size_t>(side) / 2)
        {
          // As many widths as come nearest.
          const double length = domain.upper[d] - domain.lower[d];
          along.push_back(
              {d, length / std::max(1., std::round(length / width)), domain.lower[d],
               domain.upper[d],
               scene.boundary(static_cast<Side>(2 * d)).kind == BoundaryKind::periodic});
        }
      return [along](const Position &middle)
      {
        const Direction &first = along.front(), &second = along.back();
        const bool line = along.size() == 1;
        Patch patch{first.about(middle[first.d]), {}, {}};
        if(!line)
          patch.second = second.about(middle[second.d]);
        patch.place = [&first, &second, middle, line](double s, double t)
        {
          Position place = middle;
          place[first.d] = first.within(s);
          if(!line)
            place[second.d] = second.within(t);
          return place;
        };
        return patch;
      };
    }

    PatchAbout patches_of_circle(double radius, double width)
    {
      return [radius, reach = 0.5 * width / radius](const Position &middle)
      {
        const double at = std::atan2(middle[1], middle[0]);
        return Patch{
            {at - reach, at + reach}, {}, [radius](double angle, double) {
              return Position{radius * std::cos(angle), radius * std::sin(angle), 0};
            }};
      };
    }

    /** Squares of the tangent plane, seen from the centre. */
    PatchAbout patches_of_sphere(double radius, double width)
    {
      return [radius, reach = 0.5 * width](const Position &middle)
      {
        // A tangent across the axis that is farthest from the place, and one across both.
        const double distance = std::hypot(middle[0], middle[1], middle[2]);
        Position out, first{}, second{};
        for(std::size_t d = 0; d < 3; ++d)
          out[d] = middle[d] / distance;
        std::size_t axis = 0;
        for(const std::size_t d : {1u, 2u})
          if(std::abs(out[d]) < std::abs(out[axis]))
            axis = d;
        const std::size_t next = (axis + 1) % 3, last = (axis + 2) % 3;
        const double across = std::hypot(out[next], out[last]);
        first[next] = -out[last] / across;
        first[last] = out[next] / across;
        for(std::size_t d = 0; d < 3; ++d)
          second[d] = out[(d + 1) % 3] * first[(d + 2) % 3]
                      - out[(d + 2) % 3] * first[(d + 1) % 3];
        return Patch{{-reach, reach},
                     Patch::Range{-reach, reach},
                     [=](double s, double t)
                     {
                       Position place;
                       for(std::size_t d = 0; d < 3; ++d)
                         place[d] = radius * out[d] + s * first[d] + t * second[d];
                       const double scale
                           = radius / std::hypot(place[0], place[1], place[2]);
                       for(double &component : place)
                         component *= scale;
                       return place;
                     }};
      };
    }

    PatchAbout patches_of_outline(const std::shared_ptr<const Outline> &outline,
                                  double width)
    {
      return [outline, reach = 0.5 * width](const Position &middle)
      {
        const double at = outline->arc_length_at(middle);
        return Patch{{at - reach, at + reach}, {}, [&curve = *outline](double s, double) {
                       return curve.at(s);
                     }};
      };
    }

    /** Empty where nothing varies along a wall, or where it is not known how it runs. */
    PatchAbout patches_of(const Scene &scene, Side side, double width)
    {
      const Domain &domain = scene.domain;
      switch(domain.shape)
      {
      case DomainShape::box:
      case DomainShape::axisymmetric:
        return patches_of_plane(scene, side, width);
      case DomainShape::ball:
      case DomainShape::shell:
      {
        const double radius = side == Side::inner ? domain.inner_radius : domain.radius;
        return domain.dimension == 2 ? patches_of_circle(radius, width)
                                     : patches_of_sphere(radius, width);
      }
      case DomainShape::outline:
        return patches_of_outline(domain.outline, width);
      default:
        return {};
      }
    }

    /** What is averaged of a value that a wall gives, and the reverse. */
    double heat_of(const Boundary &wall, double value)
    {
      if(wall.kind != BoundaryKind::radiation)
        return value;
      const double absolute = value - wall.absolute_zero, square = absolute * absolute;
      return square * square;
    }

    double value_of(const Boundary &wall, double heat)
    {
      return wall.kind == BoundaryKind::radiation
                 ? wall.absolute_zero + std::sqrt(std::sqrt(heat))
                 : heat;
    }

    bool jumps(const Field &field)
    {
      return field.value && !field.constant && may_jump_with(field.expression, "xyz");
    }
  } // namespace

  Scene with_means_of_jumps(const Scene &scene,
                            const std::function<double(Side)> &width_on)
  {
    Scene result = scene;
    for(const Side side : scene.sides())
    {
      Boundary &wall = *result.boundaries[static_cast<std::size_t>(side)];
      if(wall.exact || !jumps(wall.value))
        continue;
      const PatchAbout patch_about = patches_of(scene, side, width_on(side));
      if(!patch_about)
        continue;
      wall.value.value = [wall, patch_about](const Position &place, double time)
      {
        const auto heat_at = [&](const Position &beside)
        { return heat_of(wall, wall.value(beside, time)); };
        return value_of(wall, patch_about(place).mean(heat_at));
      };
    }
    return result;
  }

  Field mean_release(const Scene &scene, double width)
  {
    const Field &release = *scene.volumetric_source;
    if(!jumps(release))
      return release;
    Field result = release;
    result.value = [release, domain = scene.domain,
                    half = 0.5 * width](const Position &middle, double time)
    {
      Position from = middle, to = middle;
      for(std::size_t d = 0; d < static_cast<std::size_t>(domain.dimension); ++d)
      {
        from[d] -= half;
        to[d] += half;
        if(domain.rectangular() && domain.upper[d] - domain.lower[d] > 2 * half)
        {
          from[d] = std::clamp(from[d], domain.lower[d], domain.upper[d] - half);
          to[d] = std::clamp(to[d], domain.lower[d] + half, domain.upper[d]);
        }
      }
      return mean_over_box([&](const Position &place) { return release(place, time); },
                           middle, from, to, domain.dimension, parts_in_cube,
                           halvings_in_square);
    };
    return result;
  }

  bool may_jump_at_start(const Scene &scene)
  {
    return !scene.initial.exact && !metastable_initial_phase(scene)
           && may_jump_with(scene.initial.temperature.expression, "xyz");
  }
} // namespace meltfront::cases
