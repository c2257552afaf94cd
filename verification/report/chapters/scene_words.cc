#include <verification/report/chapters/scene_words.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>

namespace meltfront::verification
{
  std::string words(const cases::Boundary &boundary)
  {
    switch(boundary.kind)
    {
    case cases::BoundaryKind::fixed_temperature:
      return boundary.exact ? "temperature of the exact solution"
                            : "fixed temperature " + boundary.value.expression;
    case cases::BoundaryKind::flux:
      return boundary.exact ? "heat flux of the exact solution"
                            : "heat flux inward " + boundary.value.expression;
    case cases::BoundaryKind::heat_transfer:
      return fmt::format(
          "heat transfer with the ambient temperature {}, coefficient {:.6g}",
          boundary.exact ? "that makes the exact solution's flux"
                         : boundary.value.expression,
          boundary.heat_transfer_coefficient);
    case cases::BoundaryKind::radiation:
      return fmt::format("radiation with the ambient temperature {}, emissivity times "
                         "Stefan-Boltzmann constant {:.6g}",
                         boundary.exact ? "that makes the exact solution's flux"
                                        : boundary.value.expression,
                         boundary.emission_coefficient);
    default:
      return cases::to_string(boundary.kind);
    }
  }

  std::string short_words(const cases::Boundary &boundary)
  {
    if(boundary.kind != cases::BoundaryKind::fixed_temperature)
      return words(boundary);
    if(boundary.exact)
      return "exact temperature";
    const std::string &expression = boundary.value.expression;
    char *end = nullptr;
    const double number = std::strtod(expression.c_str(), &end);
    return "T = " + (*end == 0 ? fmt::format("{:.4g}", number) : expression);
  }

  std::vector<std::string> wall_words(const cases::Scene &scene)
  {
    std::vector<std::string> result;
    for(const cases::Side side : scene.sides())
      result.push_back(fmt::format("{}: {}", name_of(scene.domain, side),
                                   words(scene.boundary(side))));
    return result;
  }

  std::vector<std::string> source_words(const cases::Scene &scene)
  {
    const int dimension = scene.domain.dimension;
    const char *unit = scene.units != "SI" ? "" : dimension == 3 ? " W" : " W/m";
    std::vector<std::string> result;
    for(const cases::PointSource &source : scene.sources)
    {
      const auto begin = source.position.begin();
      const std::string place
          = source.path ? source.path->expression
                        : fmt::format(
                            "{}", fmt::join(begin, begin + std::max(dimension, 1), ", "));
      // "exact" is a word for a number that the exact solution knows.
      const std::string strength
          = source.expression == "exact"
                ? fmt::format("that of the exact solution, {:.7g}{} at the end",
                              source.power(scene.end_time), unit)
                : source.expression + unit;
      result.push_back(fmt::format("at ({}): {}", place, strength));
    }
    return result;
  }

  std::string words(const cases::InitialState &state)
  {
    if(state.exact)
      return "the exact solution at the start time";
    std::string result = "temperature " + state.temperature.expression;
    if(state.front)
      result += fmt::format("; solid where {} < 0", state.front->expression);
    if(state.solid_fraction_at_melting != 0)
      result += fmt::format("; solid fraction {} where it is the melting point",
                            state.solid_fraction_at_melting);
    return result;
  }

  std::string words(const cases::Inclusion &inclusion)
  {
    const std::string &where = inclusion.level_set.expression;
    return fmt::format("conductivity {:.6g} {}", inclusion.conductivity,
                       inclusion.material ? "in the " + where
                                          : "where " + where + " < 0");
  }
} // namespace meltfront::verification
