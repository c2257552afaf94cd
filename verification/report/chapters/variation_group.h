#ifndef meltfront_verification_report_chapters_variation_group_h
#define meltfront_verification_report_chapters_variation_group_h

#include <verification/report/page/case_runs.h>

#include <string>
#include <vector>

namespace meltfront::verification
{
  /** What a matrix varies in a case. */
  struct VariationAxis
  {
    std::string key;                 ///< with its subsections
    std::string heading;             ///< `Stefan number`, `k_s/k_l`, or the key alone
    std::vector<std::string> values; ///< as shown, in the matrix's order
  };

  /** One case of a group: what it is, and its place on each axis. */
  struct Variation
  {
    const CaseRuns *runs = nullptr;
    std::vector<std::size_t> place; ///< index of its value, one for each axis
  };

  /** The cases that come from one by varying the same keys. */
  struct VariationGroup
  {
    std::string base;
    std::vector<VariationAxis> axes;
    std::vector<Variation> variations; ///< in the matrix's order
    std::vector<std::string> labels;   ///< of their runs, in the matrix's order

    /** `bar by Stefan number and k_s/k_l`. */
    std::string title() const;
    std::string file_name() const; ///< for plots and tables
  };

  /** The varied cases of a matrix, grouped. */
  std::vector<VariationGroup> variation_groups(const std::vector<CaseRuns> &variations);

  /**
   * V h/alpha: the front's largest mean speed between two snapshots (of the exact front
   * where there is one) times the spacing, over the smaller thermal diffusivity. Above 1
   * the thermal layer at the front, alpha/V, is thinner than the spacing. NaN without a
   * front.
   */
  double front_peclet_number(const StoredCase &record, const RunRecord &run);

  /** Something that runs noted between snapshots, and at which n. */
  struct RunWarning
  {
    std::string words;       ///< without its numbers: what stands before the first colon
    std::string resolutions; ///< `40, 80`
  };

  /** What a label's runs noted, each kind once. */
  std::vector<RunWarning> warnings_of(const LabelRuns &label);
} // namespace meltfront::verification

#endif
