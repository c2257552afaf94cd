#include <cases/case_file/case_file.h>
#include <verification/record/hash.h>
#include <verification/record/stored_case.h>

#include <nlohmann/json.hpp>

namespace meltfront::verification
{
  StoredCase stored_case(const cases::Case &c, const std::string &variation_of,
                         const cases::CaseSettings &variation)
  {
    return {c, sha256(c.text), variation_of, variation};
  }

  void to_json(nlohmann::json &json, const StoredCase &record)
  {
    json = {{"name", record.name()},
            {"text", record.text},
            {"hash", record.hash},
            {"variation_of", record.variation_of},
            {"variation", record.variation}};
  }

  void from_json(const nlohmann::json &json, StoredCase &record)
  {
    const std::string name = json.at("name"), text = json.at("text"),
                      base = json.at("variation_of");
    record = {base.empty() ? cases::read_case_text(text, name + ".prm")
                           : cases::read_varied_text(text, name),
              json.at("hash"), base, json.at("variation")};
  }
} // namespace meltfront::verification
