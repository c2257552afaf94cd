#include <cases/case_file/case_file.h>
#include <verification/record/hash.h>
#include <verification/record/stored_case.h>

#include <nlohmann/json.hpp>

#include <map>
#include <utility>

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

  namespace
  {
    /** A text is read once: to solve for its exact solution may take seconds, and studies
     * read what they have written again and again. */
    const cases::Case &case_of_text(const std::string &text, const std::string &name,
                                    bool varied)
    {
      static std::map<std::pair<std::string, std::string>, cases::Case> known;
      const auto found = known.find({name, text});
      if(found != known.end())
        return found->second;
      return known
          .emplace(std::pair(name, text),
                   varied ? cases::read_varied_text(text, name)
                          : cases::read_case_text(text, name + ".prm"))
          .first->second;
    }
  } // namespace

  void from_json(const nlohmann::json &json, StoredCase &record)
  {
    const std::string name = json.at("name"), text = json.at("text"),
                      base = json.at("variation_of");
    record = {case_of_text(text, name, !base.empty()), json.at("hash"), base,
              json.at("variation")};
  }
} // namespace meltfront::verification
