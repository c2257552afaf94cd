#ifndef meltfront_verification_judge_finding_h
#define meltfront_verification_judge_finding_h

#include <cases/case.h>

#include <nlohmann/json_fwd.hpp>

#include <limits>
#include <string>
#include <vector>

namespace meltfront::verification
{
  struct MatrixResult;

  /** What a finding rests on: a criterion that must hold in every case of a pattern. */
  struct Evidence
  {
    /** Name of a case, `bar`, or a pattern of varied ones, `bar[latent_heat=*]`. */
    std::string cases;
    cases::Criterion criterion;
  };

  /** A sentence on what a matrix shows, with the figures that it rests on. */
  struct Finding
  {
    std::string claim; ///< `{2}` stands for what the second evidence measured
    std::vector<Evidence> evidence;
  };

  /** A diagram that a matrix wants in its report: runs of some cases in one plot. */
  struct Picture
  {
    std::string caption;
    std::string cases;             ///< as in Evidence
    std::vector<std::string> runs; ///< labels, in which `*` stands for any value
    std::string quantity;          ///< a column of the table, over
    std::string against;           ///< another one
  };

  /** What an evidence measured in one case. */
  struct EvidenceValue
  {
    std::string case_name;
    double value = std::numeric_limits<double>::quiet_NaN();
    bool passed = false;
    std::string remark{}; ///< as CriterionResult::remark
  };

  struct EvidenceResult
  {
    Evidence evidence;
    std::string quantity; ///< `front_rms at n=40`, `order of front_rms`
    /** One for each case; none, and the evidence fails, where the matrix has no runs. */
    std::vector<EvidenceValue> values;

    bool passed() const;
    double least() const;
    double greatest() const;
  };

  /** A finding held against the runs. */
  struct FindingResult
  {
    std::string claim;
    std::vector<EvidenceResult> evidence;

    /** True if all of its evidence passes. */
    bool holds() const;
  };

  /** A part of a claim: plain text, or the place of what an evidence measured. */
  struct ClaimPiece
  {
    std::string words;
    int evidence = -1; ///< its index; -1: words
  };

  /** A claim cut at its `{1}`, `{2}`, ... @throws InputError for a number beyond the
   * count, and braces around anything else. */
  std::vector<ClaimPiece> pieces_of_claim(const std::string &claim,
                                          std::size_t evidence_count);

  /** The claim as plain text, with what was measured: a value, or least and greatest. */
  std::string claim_text(const FindingResult &finding);

  /** Hold findings against the runs of a matrix. */
  std::vector<FindingResult> judge_findings(const MatrixResult &result,
                                            const std::vector<Finding> &findings);

  void to_json(nlohmann::json &json, const Finding &finding);
  void from_json(const nlohmann::json &json, Finding &finding);
  void to_json(nlohmann::json &json, const Picture &picture);
  void from_json(const nlohmann::json &json, Picture &picture);
} // namespace meltfront::verification

#endif
