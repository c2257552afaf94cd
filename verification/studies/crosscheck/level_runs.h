#ifndef meltfront_verification_studies_crosscheck_level_runs_h
#define meltfront_verification_studies_crosscheck_level_runs_h

#include <cases/case.h>
#include <cases/method.h>
#include <verification/record/run_record.h>
#include <verification/studies/crosscheck/state_course.h>

#include <functional>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /** What one method made of a scene at one resolution. */
  struct LevelRun
  {
    std::string method;
    int n = 0;
    RunStatus status = RunStatus::failed;
    std::string message{};    ///< of a refusal or failure
    bool out_of_time = false; ///< it was ended at its time limit: status failed
    bool crashed = false;     ///< it ended without a word: status failed
    double spacing = 0;       ///< h (m)
    StateCourse course{};     ///< of a finished run
  };

  void to_json(nlohmann::json &json, const LevelRun &run);
  void from_json(const nlohmann::json &json, LevelRun &run);

  /** A run that is to be made. */
  struct LevelPlan
  {
    const cases::Method *method;
    int n;
    long steps = 0; ///< of its steps_option(); 0: as many as it takes by itself
  };

  /** How runs are made. */
  struct LevelLimits
  {
    int jobs = 1;       ///< processes at once
    double within = 20; ///< longest time of a run (processor s; and 10 times that by the
                        ///< clock)
    std::function<void(const std::string &running)> show{}; ///< told now and then
  };

  /**
   * Make the runs, each in a process of its own that is ended at the time limit, and
   * return them in the order of the plan. The harness judges them as it does every run
   * (run_one).
   */
  std::vector<LevelRun> make_level_runs(const cases::Case &c,
                                        const std::vector<LevelPlan> &plan,
                                        const LevelLimits &limits);
} // namespace meltfront::verification

#endif
