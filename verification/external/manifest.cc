#include <cases/error.h>
#include <cases/scene.h>
#include <verification/external/command.h>
#include <verification/external/manifest.h>
#include <verification/external/protocol.h>
#include <verification/record/json_values.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace meltfront::verification::external
{
  namespace
  {
    using nlohmann::json;

    /** The value of an enumeration that a word of the schema stands for. */
    template <typename Value>
    Value value_of(const std::string &word, std::size_t count)
    {
      for(std::size_t i = 0; i < count; ++i)
        if(cases::to_string(static_cast<Value>(i)) == word)
          return static_cast<Value>(i);
      throw cases::InputError(fmt::format("'{}' is not known", quoted(word)));
    }

    template <typename Value>
    std::vector<Value> values_of(const json &words, std::size_t count)
    {
      std::vector<Value> values;
      for(const auto &word : words)
        values.push_back(value_of<Value>(word.get<std::string>(), count));
      return values;
    }

    std::vector<int> dimensions_in(const json &shape)
    {
      std::vector<int> values;
      for(const auto &dimension : shape.at("dimensions"))
        values.push_back(whole_number_in<int>(dimension));
      return values;
    }

    constexpr auto n_shapes
        = static_cast<std::size_t>(cases::DomainShape::axisymmetric) + 1;
    constexpr auto n_problems
        = static_cast<std::size_t>(cases::ProblemKind::particle_solid) + 1;

    cases::Capabilities capabilities_in(const json &manifest)
    {
      cases::Capabilities result;
      result.needs_symmetry = manifest.value("needs_symmetry", false);
      result.problems = values_of<cases::ProblemKind>(
          manifest.value("problems", json::array({"stefan"})), n_problems);
      result.effects = values_of<cases::Effect>(manifest.at("effects"), cases::n_effects);
      for(const auto &shape : manifest.at("shapes"))
        result.shapes.push_back(
            {value_of<cases::DomainShape>(shape.at("shape"), n_shapes),
             dimensions_in(shape),
             values_of<cases::BoundaryKind>(shape.at("walls"), cases::n_boundary_kinds)});
      result.front_origins = values_of<cases::FrontOrigin>(manifest.at("front_origins"),
                                                           cases::n_front_origins);
      if(const auto fronts = manifest.find("most_fronts"); fronts != manifest.end())
        result.most_fronts = whole_number_in<int>(*fronts);
      if(const auto threads = manifest.find("most_threads"); threads != manifest.end())
        result.most_threads = whole_number_in<int>(*threads);
      result.conserves_heat = manifest.value("conserves_heat", true);
      if(const auto overshoot = manifest.find("overshoot"); overshoot != manifest.end())
        result.overshoot = {overshoot->at("at_twenty").get<double>(),
                            overshoot->at("order").get<double>()};
      return result;
    }

    cases::OptionDeclaration option_in(const json &option)
    {
      cases::OptionDeclaration result;
      result.key = option.at("key");
      result.description = option.at("description");
      const json &value = option.at("default");
      if(value.is_boolean())
        result.default_value = value.get<bool>();
      else if(value.is_number_integer())
        result.default_value = value.get<long>();
      else if(value.is_number())
        result.default_value = value.get<double>();
      else
        result.default_value = value.get<std::string>();
      result.unit = option.value("unit", value.is_number() ? "1" : "");
      result.lower = option.value("lower", result.lower);
      result.upper = option.value("upper", result.upper);
      result.choices = option.value("choices", result.choices);
      return result;
    }

    Sampling sampling_in(const json &manifest)
    {
      Sampling result;
      const json samples = manifest.value("samples", json::object());
      result.expressions = samples.value("expressions", result.expressions);
      result.at_vertices = samples.value("places", "cells") == "vertices";
      result.times = samples.value("times", result.times);
      return result;
    }

    json parsed(const std::string &text)
    {
      try
      {
        return json::parse(text);
      }
      catch(const json::exception &error)
      {
        throw cases::InputError(
            fmt::format("is not valid JSON: {}", quoted(error.what())));
      }
    }

    Manifest manifest_in(const std::string &text)
    {
      const json written = parsed(text);
      if(const std::string breach = breach_of_protocol(written, "manifest");
         !breach.empty())
        throw cases::InputError(
            fmt::format("is not as protocol.schema.json says: {}", breach));
      Manifest result;
      result.text = text;
      result.name = written.at("name");
      if(const auto command = written.find("command"); command != written.end())
        result.command = command->is_string() ? words_of(command->get<std::string>())
                                              : command->get<std::vector<std::string>>();
      result.requirements = written.value("requires", result.requirements);
      result.capabilities = capabilities_in(written);
      for(const auto &option : written.value("options", json::array()))
        result.options.push_back(option_in(option));
      result.sampling = sampling_in(written);
      return result;
    }
  } // namespace

  std::string manifest_path(const std::string &name_or_path)
  {
    if(name_or_path.find('/') != std::string::npos || name_or_path.ends_with(".json"))
      return name_or_path;
    std::vector<std::string> known;
    for(const char *const folder : {"examples", "benchmarks"})
      for(const auto &file : std::filesystem::directory_iterator(folder_path(folder)))
        if(file.path().extension() == ".json")
        {
          known.push_back(file.path().stem().string());
          if(known.back() == name_or_path)
            return file.path().string();
        }
    throw cases::InputError(
        fmt::format("there is no manifest '{}' among the examples and benchmarks, the "
                    "nearest is '{}'; one of your own is named by its path, with a '/' "
                    "or '.json'",
                    quoted(name_or_path), cases::nearest_name(name_or_path, known)));
  }

  Manifest read_manifest(const std::string &path)
  {
    std::ifstream in(path);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    if(!in)
      throw cases::InputError(fmt::format("the manifest {} cannot be read", path));
    try
    {
      Manifest result = manifest_in(text);
      result.folder
          = std::filesystem::absolute(path).parent_path().lexically_normal().string();
      return result;
    }
    catch(const cases::InputError &error)
    {
      throw cases::InputError(fmt::format("the manifest {}: {}", path, error.what()));
    }
  }
} // namespace meltfront::verification::external
