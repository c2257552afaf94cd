#include <verification/studies/crosscheck/scene_maker.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace meltfront::verification
{
  std::string SceneMaker::bent_level()
  {
    const double length = substance.length, width = shape == "box" ? upper[1] : length;
    const auto disk = [&](double shift_x, double shift_y, double radius)
    {
      const double middle = shape == "box" ? 0.5 : 0;
      return fmt::format("sqrt((x - {})^2 + (y - {})^2) - {}",
                         words(length * (middle + shift_x)),
                         words(width * (middle + shift_y)), words(radius));
    };
    const double smaller = std::min(length, width);
    if(shape == "shell")
      return disk(0.3 * first / length * random.uniform(-1, 1),
                  0.3 * first / length * random.uniform(-1, 1),
                  first + (length - first) * random.uniform(0.4, 0.7));
    switch(random.below(3))
    {
    case 0:
    {
      const double centre = shape == "box" ? 0.5 : 0;
      const double size = smaller * random.uniform(0.2, 0.35);
      return fmt::format("{}*(sqrt(((x - {})/{})^2 + ((y - {})/{})^2) - 1)", words(size),
                         words(length * centre), words(size * random.uniform(1, 1.3)),
                         words(width * centre), words(size * random.uniform(0.7, 1)));
    }
    case 1:
    {
      const double reach = shape == "box" ? 0.25 : 0.4;
      return fmt::format("min({}, {})",
                         disk(-reach * random.uniform(0.9, 1.1),
                              random.uniform(-0.1, 0.1),
                              smaller * random.uniform(0.1, 0.17)),
                         disk(reach * random.uniform(0.9, 1.1), random.uniform(-0.1, 0.1),
                              smaller * random.uniform(0.1, 0.17)));
    }
    default:
      // A wave from wall to wall.
      return fmt::format("x - {} - {}*cos({}*y)",
                         words(length
                               * (shape == "box" ? random.uniform(0.3, 0.7)
                                                 : random.uniform(-0.3, 0.3))),
                         words(0.1 * width),
                         words(std::numbers::pi / width * (1 + random.below(2))));
    }
  }

  void SceneMaker::bend_front()
  {
    if(dimension != 2 || shape == "outline" || !draft.value(initial, "front").size()
       || draft.value("Scene/Domain", "shape") == "axisymmetric"
       || substance.liquid_density != substance.solid_density || !random.chance(0.5))
      return;
    const double sign = random_sign();
    const std::string level = bent_level();
    const double slope = substance.temperature_scale / substance.length;
    const auto rise = [&]
    { return words(random.chance(0.15) ? 0. : -sign * slope * random.uniform(0.3, 2)); };
    const std::string inside = rise(), outside = rise();
    draft.set(initial, "temperature",
              fmt::format("{} + ({})*min({}, 0) + ({})*max({}, 0)",
                          words(substance.melting_temperature), inside, level, outside,
                          level),
              {words(substance.melting_temperature)});
    draft.set(initial, "front", sign < 0 ? level : fmt::format("-({})", level));
  }

  /** Corners about the origin, within a circle of a radius: any, a star, an L, or a disk
   * with a slit to its middle. */
  std::vector<std::array<double, 2>> SceneMaker::polygon(double size)
  {
    std::vector<std::array<double, 2>> corners; // radius over size, angle
    const int kind = random.below(4);
    switch(kind)
    {
    case 0:
      for(int i = 0, count = 3 + random.below(6); i < count; ++i)
        corners.push_back(
            {random.uniform(0.6, 1), (i + random.uniform(-0.25, 0.25)) / count});
      break;
    case 1:
    {
      const double inner = random.uniform(0.45, 0.65);
      for(int i = 0, count = 2 * (4 + random.below(3)); i < count; ++i)
        corners.push_back({i % 2 == 0 ? 1 : inner, double(i) / count});
      break;
    }
    case 2:
      corners = {{0.2, 0.125}, {0.9, 0.28},  {0.95, 0.42},
                 {1, 0.625},   {0.95, 0.83}, {0.9, 0.97}};
      break;
    default:
    {
      const double half = random.uniform(0.004, 0.02);
      for(int i = 1; i < 8; ++i)
        corners.push_back({0.95, i / 8.});
      corners.insert(corners.end(), {{0.95, 1 - half}, {0.1, 0.99}, {0.1, 1.01}});
      corners.push_back({0.95, 1 + half});
    }
    }
    const double turn = random.uniform(0, 2 * std::numbers::pi);
    for(auto &corner : corners)
    {
      const double radius = size * corner[0],
                   angle = turn + 2 * std::numbers::pi * corner[1];
      corner = {radius * std::cos(angle), radius * std::sin(angle)};
    }
    return corners;
  }

  void SceneMaker::bound_by_polygon()
  {
    if(dimension != 2 || (shape != "outline" && shape != "ball")
       || draft.has("Scene/Source 1") || draft.has("Scene/Inclusion")
       || substance.liquid_density != substance.solid_density
       || !random.chance(shape == "ball" ? 0.4 : 0.7))
      return;
    std::string corners;
    for(const auto &[x, y] : polygon(substance.length * (shape == "ball" ? 1 : 0.5)))
      corners += fmt::format("{}{}, {}", corners.empty() ? "" : "; ", words(x), words(y));
    shape = "outline";
    const std::string here = "Scene/Domain";
    draft.set(here, "shape", shape);
    draft.remove(here, "radius");
    draft.remove(here, "polar radius");
    draft.set(here, "corners", corners);
  }

  /** 1 on a stretch of a wall, -0.5 on the rest. */
  std::string SceneMaker::patch(const std::string &along)
  {
    const double end = along == "y" && shape == "box" ? upper[1] : substance.length;
    const double begin = shape == "box" ? 0 : -end;
    const double middle = begin + (end - begin) * random.uniform(0.1, 0.9);
    const double half = (end - begin) * random.uniform(0.05, 0.3);
    return fmt::format("if(({0} > {1}) && ({0} < {2}), 1, -0.5)", along,
                       words(middle - half), words(middle + half));
  }

  void SceneMaker::vary_along_walls()
  {
    if(dimension < 2 || problem == Problem::alloy
       || draft.value("Scene/Domain", "shape") == "axisymmetric")
      return;
    for(const std::string &side : sides())
    {
      const std::string here = "Scene/Walls/" + side;
      const std::string kind = draft.value(here, "kind");
      const char *key = kind == "fixed temperature" ? "temperature"
                        : kind == "flux"            ? "flux"
                        : kind == "heat transfer" || kind == "radiation"
                            ? "ambient temperature"
                            : nullptr;
      if(!key || !random.chance(0.3))
        continue;
      const std::string course = draft.value(here, key);
      const std::string along
          = side.starts_with("y") || side == "outer" || side == "inner" ? "x" : "y";
      const std::string wave = random.chance(0.35)
                                   ? patch(along)
                                   : fmt::format("cos({}*{} + {})",
                                                 words(std::numbers::pi / substance.length
                                                       * random.uniform(0.5, 2.5)),
                                                 along, words(random.uniform(0, 3)));
      draft.set(here, key,
                kind == "flux" ? fmt::format("({})*(1 + {}*{})", course,
                                             words(random.uniform(0.2, 1)), wave)
                               : fmt::format("{} + {}*{}", course,
                                             words(substance.temperature_scale
                                                   * random.uniform(0.1, 0.5)),
                                             wave),
                {course});
    }
  }
} // namespace meltfront::verification
