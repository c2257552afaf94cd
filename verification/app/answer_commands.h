#ifndef meltfront_verification_app_answer_commands_h
#define meltfront_verification_app_answer_commands_h

#include <limits>
#include <string>
#include <vector>

namespace meltfront::verification
{
  struct CompareArguments
  {
    std::string case_name;
    std::vector<std::string> settings; ///< METHOD.KEY=VALUE, SUBSECTION/KEY=VALUE
    double within = 0;            ///< seconds for all runs; 0: 60, or as resolutions take
    std::vector<int> resolutions; ///< empty: as many as the time allows
    std::string output;           ///< directory; empty: results/compare-CASE
    int jobs = 0;                 ///< runs at once; 0: one per core
    double memory = 0;            ///< GB that a run may take; 0: what the machine has
  };

  struct AdviseArguments
  {
    std::string case_name;
    std::vector<std::string> settings; ///< of the case, SUBSECTION/KEY=VALUE
    double front_error = 1e-3;
    double temperature_error = std::numeric_limits<double>::quiet_NaN(); ///< not asked
    double within = 60;
    std::string output; ///< directory; empty: results/advise-CASE
    int jobs = 0;
    double memory = 0;
  };

  /**
   * Every method that can on one case, level by level while time lasts: a page with
   * values and error bars, who agrees with whom, and the cheapest for wanted errors;
   * `answers.json`.
   * @return criterion_failed if methods contradict each other so that none is confirmed,
   * or none of several has an error bar; run_failed if none answered
   */
  int compare(const CompareArguments &arguments);

  /**
   * The cheapest method and resolution for a wanted error, then the run: prediction
   * beside what came out; `advice.json` and `answers.json`.
   * @return criterion_failed if the error is out of reach within the time
   */
  int advise(const AdviseArguments &arguments);
} // namespace meltfront::verification

#endif
