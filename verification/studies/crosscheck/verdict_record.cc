#include <verification/record/json_values.h>
#include <verification/studies/crosscheck/verdict_record.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace meltfront::verification
{
  namespace
  {
    nlohmann::json json_of_remarks(const std::vector<Remark> &remarks)
    {
      nlohmann::json list = nlohmann::json::array();
      for(const Remark &remark : remarks)
        list.push_back(
            {{"method", remark.method}, {"n", remark.n}, {"reason", remark.reason}});
      return list;
    }

    nlohmann::json json_of_contradiction(const Contradiction &contradiction)
    {
      nlohmann::json json{{"quantity", contradiction.quantity},
                          {"time", contradiction.time_share},
                          {"scale", json_of(contradiction.scale)},
                          {"excess", json_of(contradiction.excess)},
                          {"suspected", contradiction.suspects}};
      for(const Statement &statement : contradiction.statements)
      {
        json["methods"].push_back(statement.method);
        json["values"].push_back(json_of(statement.estimate.value));
        json["bars"].push_back(json_of(statement.estimate.bar));
      }
      return json;
    }

    /** What one scene makes different in a sentence is left out. */
    std::string reason_without_numbers(const std::string &reason)
    {
      std::string text;
      bool in_number = false;
      for(const char c : reason)
      {
        const bool digit = c >= '0' && c <= '9';
        if(!digit)
          text += c;
        else if(!in_number)
          text += '#';
        in_number = digit;
      }
      return text;
    }
  } // namespace

  nlohmann::json json_of(const SceneVerdict &verdict)
  {
    return {{"outcome", to_string(verdict.outcome)},
            {"compared", verdict.compared},
            {"refusals", json_of_remarks(verdict.refusals)},
            {"failures", json_of_remarks(verdict.failures)},
            {"too_coarse", json_of_remarks(verdict.too_coarse)},
            {"out_of_time", json_of_remarks(verdict.out_of_time)},
            {"bars", json_of(verdict.bars)},
            {"closest_call", json_of(verdict.closest_call)},
            {"contradiction", verdict.contradiction
                                  ? json_of_contradiction(*verdict.contradiction)
                                  : nlohmann::json()}};
  }

  std::string said_of(const SceneVerdict &verdict)
  {
    std::string text = to_string(verdict.outcome);
    switch(verdict.outcome)
    {
    case SceneOutcome::suspect:
      return fmt::format("{}: {} in '{}', {:.3g} times the bars", text,
                         fmt::join(verdict.contradiction->suspects, ", "),
                         verdict.contradiction->quantity, verdict.contradiction->excess);
    case SceneOutcome::failed:
      return fmt::format("{}: {}", text,
                         verdict.failures.empty() ? verdict.out_of_time.front().reason
                                                  : verdict.failures.front().reason);
    case SceneOutcome::refused:
      return fmt::format("{}: by all but {}", text,
                         verdict.compared.empty() ? "one or none"
                                                  : verdict.compared.front());
    default:
      return fmt::format("{}: {}", text, fmt::join(verdict.compared, ", "));
    }
  }

  std::string said_of(const Contradiction &contradiction)
  {
    std::string text
        = fmt::format("Suspect: {}, which {} the others in '{}' at {} of the duration\n"
                      "by {:.3g} times both error bars (scale of the quantity {:.4g}):\n",
                      fmt::join(contradiction.suspects, ", "),
                      contradiction.suspects.size() == 1 ? "contradicts" : "contradict",
                      contradiction.quantity, contradiction.time_share,
                      contradiction.excess, contradiction.scale);
    for(const Statement &statement : contradiction.statements)
      text += fmt::format("  {}: {:.7g} +- {:.2g}{}\n", statement.method,
                          statement.estimate.value, statement.estimate.bar,
                          statement.estimate.converging ? "" : " (not converging)");
    return text;
  }

  void SummaryOfVerdicts::add_remarks(const std::string &scene,
                                      const nlohmann::json &remarks, nlohmann::json &to)
  {
    for(nlohmann::json remark : remarks)
    {
      remark["scene"] = scene;
      to.push_back(remark);
    }
  }

  void SummaryOfVerdicts::add(const std::string &scene, const nlohmann::json &verdict)
  {
    ++scenes;
    ++outcomes[verdict.at("outcome")];
    closest_call = std::max(closest_call, number_in(verdict.at("closest_call")));
    for(const std::string method : verdict.at("compared"))
      ++compared[method];
    for(const auto &[method, bar] : named_numbers_in(verdict.at("bars")))
      bars[method].push_back(bar);
    for(const nlohmann::json &refusal : verdict.at("refusals"))
      ++refusals[refusal.at("method")][reason_without_numbers(refusal.at("reason"))];
    add_remarks(scene, verdict.at("failures"), failures);
    add_remarks(scene, verdict.at("too_coarse"), too_coarse);
    add_remarks(scene, verdict.at("out_of_time"), out_of_time);
    if(verdict.at("contradiction").is_null())
      return;
    nlohmann::json suspect = verdict.at("contradiction");
    suspect["scene"] = scene;
    suspect["file"] = fmt::format("suspects/{}.prm", scene);
    suspects.push_back(suspect);
  }

  nlohmann::json SummaryOfVerdicts::json() const
  {
    nlohmann::json json{
        {"scenes", scenes},           {"suspects", suspects},
        {"failures", failures},       {"too_coarse", too_coarse},
        {"out_of_time", out_of_time}, {"refusals", refusals},
        {"compared", compared},       {"closest_call", json_of(closest_call)}};
    for(auto [method, list] : bars)
    {
      std::ranges::sort(list);
      json["median_bars"][method] = json_of(list[list.size() / 2]);
    }
    for(const char *outcome : {"agreed", "refused", "failed", "suspect"})
      json[outcome] = outcomes.contains(outcome) ? outcomes.at(outcome) : 0;
    return json;
  }
} // namespace meltfront::verification
