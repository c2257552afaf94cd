#include <cases/case_file/prm_entry.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace meltfront::cases
{
  namespace
  {
    /** A range in words, with a blank in front; empty where everything is allowed. */
    std::string range(const PrmEntry &entry)
    {
      if(entry.lower == above_zero)
        return std::isfinite(entry.upper)
                   ? fmt::format(" greater than 0 and at most {}", entry.upper)
                   : " greater than 0";
      if(std::isfinite(entry.lower) && std::isfinite(entry.upper))
        return fmt::format(" from {} to {}", entry.lower, entry.upper);
      if(std::isfinite(entry.lower))
        return fmt::format(" of at least {}", entry.lower);
      return std::isfinite(entry.upper) ? fmt::format(" of at most {}", entry.upper) : "";
    }
  } // namespace

  std::unique_ptr<dealii::Patterns::PatternBase> pattern(const PrmEntry &entry)
  {
    using namespace dealii::Patterns;
    constexpr double largest = std::numeric_limits<double>::max();
    switch(entry.kind)
    {
    case PrmKind::number:
      return std::make_unique<Double>(std::max(entry.lower, -largest),
                                      std::min(entry.upper, largest));
    case PrmKind::integer:
      return std::make_unique<Integer>(
          static_cast<int>(std::max(entry.lower, Integer::min_int_value * 1.)),
          static_cast<int>(std::min(entry.upper, Integer::max_int_value * 1.)));
    case PrmKind::boolean:
      return std::make_unique<Selection>("true|false");
    case PrmKind::word:
      return std::make_unique<Selection>(
          fmt::format("{}", fmt::join(entry.choices, "|")));
    case PrmKind::numbers:
      return std::make_unique<List>(Double(), 1, entry.most_values);
    default:
      return std::make_unique<Anything>();
    }
  }

  std::string expectation(const PrmEntry &entry)
  {
    switch(entry.kind)
    {
    case PrmKind::number:
      return fmt::format("a number{}{}", range(entry),
                         entry.unit.empty() ? "" : " (" + entry.unit + ")");
    case PrmKind::integer:
      return "an integer" + range(entry);
    case PrmKind::boolean:
      return "true or false";
    case PrmKind::word:
      return fmt::format("one of {}", fmt::join(entry.choices, ", "));
    case PrmKind::numbers:
    {
      constexpr std::array words{"two",   "three", "four", "five",   "six",   "seven",
                                 "eight", "nine",  "ten",  "eleven", "twelve"};
      return fmt::format("one to {} numbers separated by commas",
                         words.at(entry.most_values - 2));
    }
    case PrmKind::file:
      return "the name of a file";
    default:
      return entry.formula        ? "an expression"
             : entry.unit.empty() ? "a text"
                                  : fmt::format("an expression ({})", entry.unit);
    }
  }

  std::string acceptable_text(const PrmEntry &entry)
  {
    if(!entry.default_value.empty() || entry.kind == PrmKind::text
       || entry.kind == PrmKind::file)
      return entry.default_value;
    if(entry.kind == PrmKind::word)
      return entry.choices.front();
    if(entry.kind == PrmKind::boolean)
      return "false";
    return fmt::format("{}", std::isfinite(entry.lower) ? entry.lower : 0);
  }
} // namespace meltfront::cases
