#include <cases/error.h>
#include <verification/record/json_values.h>

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

namespace meltfront::verification
{
  nlohmann::json json_of(double value)
  {
    if(std::isnan(value))
      return nullptr;
    if(std::isinf(value))
      return value > 0 ? "inf" : "-inf";
    return value;
  }

  nlohmann::json json_of(const std::vector<double> &values)
  {
    nlohmann::json json = nlohmann::json::array();
    for(const double value : values)
      json.push_back(json_of(value));
    return json;
  }

  nlohmann::json json_of(const cases::Position &position)
  {
    return json_of(std::vector(position.begin(), position.end()));
  }

  nlohmann::json json_of(const std::map<std::string, double> &values)
  {
    nlohmann::json json = nlohmann::json::object();
    for(const auto &[name, value] : values)
      json[name] = json_of(value);
    return json;
  }

  double number_in(const nlohmann::json &json)
  {
    if(json.is_null())
      return std::numeric_limits<double>::quiet_NaN();
    if(json.is_string())
      return json.get<std::string>() == "inf" ? std::numeric_limits<double>::infinity()
                                              : -std::numeric_limits<double>::infinity();
    return json.get<double>();
  }

  std::vector<double> numbers_in(const nlohmann::json &json)
  {
    std::vector<double> values;
    for(const auto &value : json)
      values.push_back(number_in(value));
    return values;
  }

  cases::Position position_in(const nlohmann::json &json)
  {
    return {number_in(json.at(0)), number_in(json.at(1)), number_in(json.at(2))};
  }

  std::map<std::string, double> named_numbers_in(const nlohmann::json &json)
  {
    std::map<std::string, double> values;
    for(const auto &[name, value] : json.items())
      values[name] = number_in(value);
    return values;
  }

  nlohmann::json read_json(const std::string &path)
  {
    std::ifstream in(path);
    if(!in)
      throw cases::OutputError(fmt::format("cannot read {}", path));
    try
    {
      return nlohmann::json::parse(in);
    }
    catch(const nlohmann::json::exception &error)
    {
      throw cases::OutputError(
          fmt::format("{} is not valid JSON: {}", path, error.what()));
    }
  }

  void write_atomically(const std::string &path, const std::string &text)
  {
    const std::string temporary = path + ".part";
    std::error_code failure;
    std::filesystem::create_directories(std::filesystem::path(path).parent_path(),
                                        failure);
    {
      std::ofstream out(temporary, std::ios::binary);
      out << text;
      if(!out.flush())
        throw cases::OutputError(fmt::format("cannot write {}", temporary));
    }
    std::filesystem::rename(temporary, path, failure);
    if(failure)
      throw cases::OutputError(
          fmt::format("cannot write {}: {}", path, failure.message()));
  }

  void write_json(const std::string &path, const nlohmann::json &json)
  {
    // A message may hold bytes that are not UTF-8; they must not cost the whole record.
    write_atomically(
        path, json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + '\n');
  }
} // namespace meltfront::verification
