#include <cases/data_folder.h>
#include <cases/error.h>
#include <verification/external/protocol.h>
#include <verification/record/json_values.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include <algorithm>
#include <cctype>
#include <map>
#include <memory>

namespace meltfront::verification::external
{
  namespace
  {
    using nlohmann::json;
    using Adapter = valijson::adapters::NlohmannJsonAdapter;

    /** The schema of one definition; the others are found through it. */
    const valijson::Schema &schema_of(const std::string &definition)
    {
      static std::map<std::string, std::unique_ptr<valijson::Schema>> known;
      std::unique_ptr<valijson::Schema> &schema = known[definition];
      if(!schema)
      {
        json document = read_json(folder_path("protocol.schema.json"));
        document["$ref"] = "#/definitions/" + definition;
        schema = std::make_unique<valijson::Schema>();
        valijson::SchemaParser().populateSchema(Adapter(document), *schema);
      }
      return *schema;
    }

    /** The validator spends a microsecond on a number: of long rows, which are looked
     * through here, it is shown the first. */
    json with_short_rows(const json &message)
    {
      constexpr std::size_t long_row = 16;
      if(message.is_array() && message.size() > long_row
         && std::ranges::all_of(message, [](const json &one) { return one.is_number(); }))
        return json::array({message.front()});
      if(!message.is_structured())
        return message;
      json shortened = message.is_array() ? json::array() : json::object();
      for(const auto &[key, value] : message.items())
        if(message.is_array())
          shortened.push_back(with_short_rows(value));
        else
          shortened[key] = with_short_rows(value);
      return shortened;
    }

    /** `[effects]`, `[0]` as `/effects/0`. */
    std::string pointer_to(const std::vector<std::string> &context)
    {
      std::string pointer;
      for(const std::string &part : context)
        if(part.size() > 2 && part.front() == '[')
          pointer += "/" + part.substr(1, part.size() - 2);
      return pointer;
    }
  } // namespace

  std::string folder_path(const std::string &name)
  {
    return cases::data_path("verification/external/" + name);
  }

  std::string breach_of_protocol(const json &message, const std::string &definition)
  {
    const json shown = with_short_rows(message);
    valijson::Validator validator;
    valijson::ValidationResults results;
    if(validator.validate(schema_of(definition), Adapter(shown), &results))
      return {};
    // The first is about the innermost value, what follows about what it stands in.
    valijson::ValidationResults::Error error{{}, "is not as the schema says."};
    results.popError(error);
    const std::string pointer = pointer_to(error.context);
    std::string reason = error.description;
    reason.front() = static_cast<char>(std::tolower(reason.front()));
    reason.erase(reason.find_last_not_of('.') + 1);
    const json::json_pointer place(pointer);
    if(pointer.empty() || !shown.contains(place))
      return reason;
    return fmt::format(
        "{}, {}: {}", pointer,
        quoted(shown.at(place).dump(-1, ' ', true, json::error_handler_t::replace)),
        reason);
  }

  std::string quoted(std::string text)
  {
    constexpr std::size_t longest = 200;
    if(text.size() > longest)
      text = text.substr(0, longest) + " ...";
    for(char &c : text)
      if(!std::isprint(static_cast<unsigned char>(c)))
        c = ' ';
    return text;
  }
} // namespace meltfront::verification::external
