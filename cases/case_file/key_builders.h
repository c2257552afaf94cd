#ifndef meltfront_cases_case_file_key_builders_h
#define meltfront_cases_case_file_key_builders_h

#include <cases/case_file/prm_file.h>
#include <cases/scene.h>

namespace meltfront::cases
{
  /** Subsections that several readers share. */
  inline const std::string domain_keys = "Scene/Domain";
  inline const std::string initial_keys = "Scene/Initial state";
  inline const std::string exact_keys = "Exact solution";

  /** Unit of temperatures: each scene on the scale that it likes. */
  inline constexpr const char *temperature_units = "K or degrees Celsius";

  /** Stands for a value that is the exact solution's. */
  inline constexpr const char *exact_value = "exact";

  /** The subsection of all walls, and that of one. */
  inline const std::string all_wall_keys = "Scene/Walls";
  std::string wall_keys(const Domain &domain, Side side);

  /** Keys of the kinds that case files have, each declared in one line. */
  PrmEntry text_key(const std::string &key, const std::string &description);

  /** An expression, or several separated by commas. */
  PrmEntry expression_key(const std::string &key, const std::string &unit,
                          const std::string &description);

  /** An expression of what has no unit, or whose unit does not matter. */
  PrmEntry formula_key(const std::string &key, const std::string &description);

  /** An expression in whose place a table may stand, over the temperature or the time.
   * @param over the unit of that */
  PrmEntry with_table(PrmEntry expression, const std::string &over);

  PrmEntry word_key(const std::string &key, const std::string &default_value,
                    std::vector<std::string> choices, const std::string &description);

  PrmEntry number_key(const std::string &key, const std::string &default_value,
                      const std::string &unit, const std::string &description,
                      double lower = -std::numeric_limits<double>::infinity(),
                      double upper = std::numeric_limits<double>::infinity());

  PrmEntry numbers_key(const std::string &key, const std::string &unit,
                       const std::string &description);

  /** The name of a file that becomes part of the text. */
  PrmEntry file_key(const std::string &key, const std::string &description);

  PrmEntry integer_key(const std::string &key, const std::string &default_value,
                       double lower, double upper, const std::string &description);
} // namespace meltfront::cases

#endif
