#include <cases/case_file/prm_file.h>
#include <cases/options.h>

#include <deal.II/base/utilities.h>

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <limits>

namespace meltfront::cases
{
  double PrmFile::number_in(const std::string &text, const std::string &subsection,
                            const std::string &key) const
  {
    const double number = std::strtod(text.c_str(), nullptr);
    if(number != 0 && std::abs(number) < std::numeric_limits<double>::min())
      throw error(
          subsection, key,
          fmt::format("is {}, nearer to zero than what can be computed with ({:g})", text,
                      std::numeric_limits<double>::min()));
    return number;
  }

  double PrmFile::get_number(const std::string &subsection, const std::string &key) const
  {
    return number_in(value(subsection, key), subsection, key);
  }

  long PrmFile::get_integer(const std::string &subsection, const std::string &key) const
  {
    return dealii::Utilities::string_to_int(value(subsection, key));
  }

  bool PrmFile::get_boolean(const std::string &subsection, const std::string &key) const
  {
    return value(subsection, key) == "true";
  }

  std::string PrmFile::get_text(const std::string &subsection,
                                const std::string &key) const
  {
    return value(subsection, key);
  }

  std::vector<double> PrmFile::get_numbers(const std::string &subsection,
                                           const std::string &key) const
  {
    std::vector<double> numbers;
    for(const std::string &text : split_list(value(subsection, key), ','))
      numbers.push_back(number_in(text, subsection, key));
    return numbers;
  }

  std::vector<int> PrmFile::given_numbers(const std::string &subsection,
                                          const std::string &key) const
  {
    std::vector<int> numbers;
    for(const Declared &numbered : declared)
      if(numbered.subsection == subsection && numbered.entry.key == key)
        for(int i = 1; i <= numbered.count; ++i)
          if(given(subsection, fmt::format("{} {}", key, i)))
            numbers.push_back(i);
    return numbers;
  }
} // namespace meltfront::cases
