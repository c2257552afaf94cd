#include <cases/case_file/key_builders.h>

#include <utility>

namespace meltfront::cases
{
  std::string wall_keys(const Domain &domain, Side side)
  {
    return all_wall_keys + "/" + name_of(domain, side);
  }

  PrmEntry text_key(const std::string &key, const std::string &description)
  {
    return {.key = key,
            .kind = PrmKind::text,
            .default_value = {},
            .unit = {},
            .description = description};
  }

  PrmEntry expression_key(const std::string &key, const std::string &unit,
                          const std::string &description)
  {
    PrmEntry entry = text_key(key, description);
    entry.unit = unit;
    return entry;
  }

  PrmEntry formula_key(const std::string &key, const std::string &description)
  {
    PrmEntry entry = text_key(key, description);
    entry.formula = true;
    return entry;
  }

  PrmEntry with_table(PrmEntry expression, const std::string &over)
  {
    expression.table_over = over;
    expression.description += over == "s" ? " Or a table over the time: points, 0: -5, "
                                            "3600: -10, or 'table FILE.csv'."
                                          : " Or 'table FILE.csv'.";
    return expression;
  }

  PrmEntry word_key(const std::string &key, const std::string &default_value,
                    std::vector<std::string> choices, const std::string &description)
  {
    PrmEntry entry = text_key(key, description);
    entry.kind = PrmKind::word;
    entry.default_value = default_value;
    entry.choices = std::move(choices);
    return entry;
  }

  PrmEntry number_key(const std::string &key, const std::string &default_value,
                      const std::string &unit, const std::string &description,
                      double lower, double upper)
  {
    PrmEntry entry = text_key(key, description);
    entry.kind = PrmKind::number;
    entry.default_value = default_value;
    entry.unit = unit;
    entry.lower = lower;
    entry.upper = upper;
    return entry;
  }

  PrmEntry numbers_key(const std::string &key, const std::string &unit,
                       const std::string &description)
  {
    PrmEntry entry = text_key(key, description);
    entry.kind = PrmKind::numbers;
    entry.unit = unit;
    return entry;
  }

  PrmEntry file_key(const std::string &key, const std::string &description)
  {
    PrmEntry entry = text_key(key, description);
    entry.kind = PrmKind::file;
    return entry;
  }

  PrmEntry integer_key(const std::string &key, const std::string &default_value,
                       double lower, double upper, const std::string &description)
  {
    PrmEntry entry = number_key(key, default_value, {}, description, lower, upper);
    entry.kind = PrmKind::integer;
    return entry;
  }

} // namespace meltfront::cases
