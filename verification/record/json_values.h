#ifndef meltfront_verification_record_json_values_h
#define meltfront_verification_record_json_values_h

#include <cases/position.h>

#include <nlohmann/json.hpp>

#include <map>
#include <string>
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

  /** @throws cases::OutputError if the file cannot be read or does not hold JSON. */
  nlohmann::json read_json(const std::string &path);

  /** Write a file under a temporary name and rename it, so that it is whole or absent.
   * @throws cases::OutputError */
  void write_atomically(const std::string &path, const std::string &text);
  void write_json(const std::string &path, const nlohmann::json &json);
} // namespace meltfront::verification

#endif
