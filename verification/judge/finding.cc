#include <cases/error.h>
#include <cases/numbers.h>
#include <verification/judge/criteria.h>
#include <verification/judge/finding.h>
#include <verification/record/label.h>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace meltfront::verification
{
  namespace
  {
    using cases::nan;

    /** Bounds on both sides tell what an order was, of a clean fit or not. */
    bool brackets_order(const cases::Criterion &criterion)
    {
      return criterion.statistic == cases::Statistic::order
             && std::isfinite(criterion.lower) && std::isfinite(criterion.upper);
    }

    bool judge_bracket(const MatrixResult &result, const StoredCase &record,
                       cases::Criterion criterion)
    {
      const double lower = criterion.lower;
      criterion.lower = -std::numeric_limits<double>::infinity(); // asks no convergence
      const Judgement judgement = judge(result, record, criterion);
      return judgement.passed && judgement.value >= lower;
    }

    EvidenceResult judged(const MatrixResult &result, const Evidence &evidence)
    {
      EvidenceResult values{evidence, quantity_text(evidence.criterion), {}};
      for(const StoredCase &record : result.cases)
        if(label_matches(evidence.cases, record.name())
           && why_not_judged(result, record, evidence.criterion).empty())
        {
          Judgement judgement = judge(result, record, evidence.criterion);
          if(brackets_order(evidence.criterion))
            judgement.passed = judge_bracket(result, record, evidence.criterion);
          values.values.push_back(
              {record.name(), judgement.value, judgement.passed, judgement.remark});
        }
      return values;
    }

    std::string measured_text(const EvidenceResult &evidence)
    {
      if(evidence.values.empty())
        return "(not measured)";
      const std::string least = fmt::format("{:.3g}", evidence.least()),
                        greatest = fmt::format("{:.3g}", evidence.greatest());
      const auto remark = std::ranges::find_if(evidence.values, [](const auto &value)
                                               { return !value.remark.empty(); });
      return (least == greatest ? least : least + " to " + greatest)
             + (remark == evidence.values.end() ? "" : " (" + remark->remark + ")");
    }
  } // namespace

  bool EvidenceResult::passed() const
  {
    return !values.empty() && std::ranges::all_of(values, &EvidenceValue::passed);
  }

  double EvidenceResult::least() const
  {
    double result = nan;
    for(const EvidenceValue &value : values)
      result = std::fmin(result, value.value);
    return result;
  }

  double EvidenceResult::greatest() const
  {
    double result = nan;
    for(const EvidenceValue &value : values)
      result = std::fmax(result, value.value);
    return result;
  }

  bool FindingResult::holds() const
  {
    return std::ranges::all_of(evidence, &EvidenceResult::passed);
  }

  std::vector<ClaimPiece> pieces_of_claim(const std::string &claim,
                                          std::size_t evidence_count)
  {
    std::vector<ClaimPiece> pieces;
    for(std::size_t begin = 0; begin < claim.size();)
    {
      const std::size_t open = std::min(claim.find('{', begin), claim.size());
      if(open > begin)
        pieces.push_back({claim.substr(begin, open - begin), -1});
      if(open == claim.size())
        break;
      const std::size_t close = std::min(claim.find('}', open), claim.size() - 1);
      const std::string inside = claim.substr(open + 1, close - open - 1);
      std::size_t number = 0;
      const auto [end, failure]
          = std::from_chars(inside.data(), inside.data() + inside.size(), number);
      if(failure != std::errc() || end != inside.data() + inside.size()
         || claim[close] != '}' || number < 1 || number > evidence_count)
        throw cases::InputError(fmt::format(
            "holds '{{{}}}', which is not the number in braces of what it rests on, 1 to "
            "{}",
            inside, evidence_count));
      pieces.push_back({"", static_cast<int>(number) - 1});
      begin = close + 1;
    }
    return pieces;
  }

  std::string claim_text(const FindingResult &finding)
  {
    std::string text;
    for(const ClaimPiece &piece : pieces_of_claim(finding.claim, finding.evidence.size()))
      text += piece.evidence < 0
                  ? piece.words
                  : measured_text(
                      finding.evidence[static_cast<std::size_t>(piece.evidence)]);
    return text;
  }

  std::vector<FindingResult> judge_findings(const MatrixResult &result,
                                            const std::vector<Finding> &findings)
  {
    std::vector<FindingResult> results;
    for(const Finding &finding : findings)
    {
      FindingResult &one = results.emplace_back();
      one.claim = finding.claim;
      for(const Evidence &evidence : finding.evidence)
        one.evidence.push_back(judged(result, evidence));
    }
    return results;
  }
} // namespace meltfront::verification
