#include <cases/case_file/criterion_parser.h>
#include <verification/judge/finding.h>

#include <nlohmann/json.hpp>

namespace meltfront::verification
{
  void to_json(nlohmann::json &json, const Finding &finding)
  {
    json = {{"claim", finding.claim}, {"evidence", nlohmann::json::array()}};
    for(const Evidence &evidence : finding.evidence)
      json["evidence"].push_back({{"cases", evidence.cases},
                                  {"criterion", {{"text", evidence.criterion.text}}}});
  }

  void from_json(const nlohmann::json &json, Finding &finding)
  {
    finding = {};
    finding.claim = json.at("claim");
    for(const auto &evidence : json.at("evidence"))
      finding.evidence.push_back(
          {evidence.at("cases"),
           cases::parse_criterion(evidence.at("criterion").at("text"))});
  }

  void to_json(nlohmann::json &json, const Picture &picture)
  {
    json = {{"caption", picture.caption},
            {"cases", picture.cases},
            {"runs", picture.runs},
            {"quantity", picture.quantity},
            {"against", picture.against}};
  }

  void from_json(const nlohmann::json &json, Picture &picture)
  {
    picture.caption = json.at("caption");
    picture.cases = json.at("cases");
    json.at("runs").get_to(picture.runs);
    picture.quantity = json.at("quantity");
    picture.against = json.at("against");
  }
} // namespace meltfront::verification
