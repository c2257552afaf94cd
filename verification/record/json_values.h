#ifndef meltfront_verification_record_json_values_h
#define meltfront_verification_record_json_values_h

#include <cases/position.h>

#include <nlohmann/json.hpp>

#include <concepts>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace meltfront::verification
{
  /** A double as JSON that reads back to the same bits: NaN as null, infinities as the
   * words `inf` and `-inf`, which JSON's numbers lack. */
  nlohmann::json json_of(double value);
  nlohmann::json json_of(const std::vector<double> &values);
  nlohmann::json json_of(const cases::Position &position);
  nlohmann::json json_of(const std::map<std::string, double> &values);

  /** Inverse of json_of. */
  double number_in(const nlohmann::json &json);
  std::vector<double> numbers_in(const nlohmann::json &json);
  cases::Position position_in(const nlohmann::json &json);
  std::map<std::string, double> named_numbers_in(const nlohmann::json &json);

  /** A whole number as it is written: JSON's library would cast any other, which for one
   * like 1e20 is undefined. @throws nlohmann::json::exception if it is none, or too large
   */
  template <std::integral T>
  T whole_number_in(const nlohmann::json &json)
  {
    using Integer = nlohmann::json::number_integer_t;
    const auto number = json.get_ref<const Integer &>();
    if constexpr(sizeof(T) < sizeof(Integer))
      if(!std::in_range<T>(number))
        throw nlohmann::json::other_error::create(
            501, std::to_string(number) + " is too large a number", &json);
    return static_cast<T>(number);
  }

  /** @throws cases::OutputError if the file cannot be read or does not hold JSON. */
  nlohmann::json read_json(const std::string &path);

  /** Write a file under a temporary name and rename it, so that it is whole or absent.
   * @throws cases::OutputError */
  void write_atomically(const std::string &path, const std::string &text);
  void write_json(const std::string &path, const nlohmann::json &json);
} // namespace meltfront::verification

#endif
