#include <cases/case_file/prm_scan.h>
#include <cases/case_file/value_units.h>
#include <cases/error.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <vector>

namespace meltfront::cases
{
  namespace
  {
    struct Unit
    {
      const char *name;
      const char *si;
      double factor;
    };

    constexpr Unit units[] = {{"nm", "m", 1e-9},
                              {"um", "m", 1e-6},
                              {"mm", "m", 1e-3},
                              {"cm", "m", 1e-2},
                              {"m", "m", 1},
                              {"km", "m", 1e3},
                              {"ns", "s", 1e-9},
                              {"us", "s", 1e-6},
                              {"ms", "s", 1e-3},
                              {"s", "s", 1},
                              {"min", "s", 60},
                              {"h", "s", 3600},
                              {"d", "s", 86400},
                              {"K", "K", 1},
                              {"degC", "K", 1},
                              {"J/kg", "J/kg", 1},
                              {"kJ/kg", "J/kg", 1e3},
                              {"MJ/kg", "J/kg", 1e6},
                              {"kg/m^3", "kg/m^3", 1},
                              {"g/cm^3", "kg/m^3", 1e3},
                              {"W/(m K)", "W/(m K)", 1},
                              {"mW/(m K)", "W/(m K)", 1e-3},
                              {"W/(cm K)", "W/(m K)", 1e2},
                              {"J/(kg K)", "J/(kg K)", 1},
                              {"kJ/(kg K)", "J/(kg K)", 1e3},
                              {"J/(g K)", "J/(kg K)", 1e3},
                              {"W/(m^2 K)", "W/(m^2 K)", 1},
                              {"kW/(m^2 K)", "W/(m^2 K)", 1e3},
                              {"W/m^2", "W/m^2", 1},
                              {"kW/m^2", "W/m^2", 1e3},
                              {"MW/m^2", "W/m^2", 1e6},
                              {"W/cm^2", "W/m^2", 1e4},
                              {"W/m^3", "W/m^3", 1},
                              {"kW/m^3", "W/m^3", 1e3},
                              {"MW/m^3", "W/m^3", 1e6},
                              {"W", "W", 1},
                              {"mW", "W", 1e-3},
                              {"kW", "W", 1e3},
                              {"W/m", "W/m", 1},
                              {"kW/m", "W/m", 1e3},
                              {"m/s", "m/s", 1},
                              {"cm/s", "m/s", 1e-2},
                              {"mm/s", "m/s", 1e-3},
                              {"m^2/s", "m^2/s", 1},
                              {"mm^2/s", "m^2/s", 1e-6}};

    const Unit *known_unit(const std::string &name)
    {
      const auto *const found = std::ranges::find_if(units, [&](const Unit &unit)
                                                     { return name == unit.name; });
      return found == std::end(units) ? nullptr : found;
    }

    struct NumberAndRest
    {
      double number;
      std::string rest;
    };

    /** A number and what stands behind it, if it could be a unit: words, no operators. */
    std::optional<NumberAndRest> split_number(const std::string &part)
    {
      NumberAndRest split{};
      const char *const end = part.data() + part.size();
      const auto [stop, error] = std::from_chars(part.data(), end, split.number);
      if(error != std::errc() || stop == end)
        return {};
      split.rest = trimmed(std::string(stop, end));
      if(split.rest.empty() || !std::isalpha(static_cast<unsigned char>(split.rest[0])))
        return {};
      return split;
    }

    bool measures(const Unit &unit, const std::vector<std::string> &wanted)
    {
      return std::ranges::find(wanted, unit.si) != wanted.end();
    }

    /** `m or s` as two. */
    std::vector<std::string> alternatives(const std::string &unit)
    {
      constexpr std::string_view between = " or ";
      std::vector<std::string> found;
      std::size_t begin = 0;
      for(std::size_t end; (end = unit.find(between, begin)) != std::string::npos;
          begin = end + between.size())
        found.push_back(unit.substr(begin, end - begin));
      found.push_back(unit.substr(begin));
      return found;
    }

    /** @param wanted null: any kind will do, and what is unknown stays */
    PlainValue convert(const std::string &text, const std::vector<std::string> *wanted)
    {
      PlainValue plain;
      for(const std::string &part : split_list(text, ','))
      {
        plain.text += plain.text.empty() ? "" : ", ";
        const auto split = split_number(part);
        const Unit *unit = split ? known_unit(split->rest) : nullptr;
        if(split && wanted && !(unit && measures(*unit, *wanted)))
        {
          std::vector<std::string> right;
          for(const Unit &one : units)
            if(measures(one, *wanted))
              right.emplace_back(one.name);
          throw InputError(
              fmt::format("has a number with '{}' behind it, which is {}; it may be {}",
                          quotable(split->rest),
                          unit ? "a unit of something else" : "no unit that is known",
                          right.empty() ? "no unit: this is a pure number"
                                        : fmt::format("{}", fmt::join(right, ", "))));
        }
        plain.text += unit ? fmt::format("{:.17g}", split->number * unit->factor) : part;
        if(unit)
          plain.unit = unit->name;
      }
      return plain.unit.empty() ? PlainValue{text, {}} : plain;
    }
  } // namespace

  PlainValue without_units(const std::string &text)
  {
    return convert(text, nullptr);
  }

  PlainValue in_units_of(const std::string &text, const std::string &unit)
  {
    const std::vector<std::string> wanted = alternatives(unit);
    return convert(text, &wanted);
  }

  bool is_number_with_unit(const std::string &text)
  {
    const auto split = split_number(text);
    return split && known_unit(split->rest);
  }

  bool is_temperature_scale(const std::string &unit)
  {
    const Unit *known = known_unit(unit);
    return known && std::string_view(known->si) == "K";
  }
} // namespace meltfront::cases
