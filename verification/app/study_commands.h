#ifndef meltfront_verification_app_study_commands_h
#define meltfront_verification_app_study_commands_h

#include <string>
#include <vector>

namespace meltfront::verification
{
  struct StudyArguments
  {
    std::string case_name;
    std::vector<std::string> settings; ///< of the case, SUBSECTION/KEY=VALUE
    std::string method;                ///< empty: the first that takes the case
    int n = 0;                         ///< finest resolution; 0: as `within` allows
    double within = 60;                ///< processor time of all runs, about (s)
    std::string output; ///< directory; empty: results/ablate-CASE, sensitivity-CASE
    int jobs = 0;       ///< runs at once; 0: one per core
    double memory = 0;  ///< GB that a run may take; 0: what the machine has
  };

  /** A scene without each of its effects (verification/studies/ablate): a table, the
   * report of all runs and DIR/ablate.json. */
  int ablate(const StudyArguments &arguments);

  /** How a scene depends on its data (verification/studies/sensitivity): a table and
   * DIR/sensitivity.json. */
  int sensitivity(const StudyArguments &arguments);
} // namespace meltfront::verification

#endif
