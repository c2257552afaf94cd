#ifndef meltfront_verification_studies_crosscheck_verdict_record_h
#define meltfront_verification_studies_crosscheck_verdict_record_h

#include <verification/studies/crosscheck/scene_check.h>

#include <nlohmann/json.hpp>

#include <string>

namespace meltfront::verification
{
  /** A verdict as it is stored: `outcome`, `compared`, `refusals`, `failures`,
   * `too_coarse`, `out_of_time` [{method, n, reason}], `bars`, `contradiction` or null.
   */
  nlohmann::json json_of(const SceneVerdict &verdict);

  /** One line: `agreed: sph, fem-enthalpy`. */
  std::string said_of(const SceneVerdict &verdict);

  /** Some lines: which methods contradict which, in what, by how much. */
  std::string said_of(const Contradiction &contradiction);

  /** Adds up stored verdicts. */
  class SummaryOfVerdicts
  {
  public:
    void add(const std::string &scene, const nlohmann::json &verdict);

    /** As crosscheck() describes it. */
    nlohmann::json json() const;

  private:
    void add_remarks(const std::string &scene, const nlohmann::json &remarks,
                     nlohmann::json &to);

    std::map<std::string, int> outcomes;
    std::map<std::string, int> compared;
    std::map<std::string, std::vector<double>> bars; ///< by method, one for each scene
    std::map<std::string, std::map<std::string, int>> refusals; ///< by method and reason
    nlohmann::json suspects = nlohmann::json::array();
    nlohmann::json failures = nlohmann::json::array();
    nlohmann::json too_coarse = nlohmann::json::array();
    nlohmann::json out_of_time = nlohmann::json::array();
    int scenes = 0;
    double closest_call = 0; ///< largest of the scenes'
  };
} // namespace meltfront::verification

#endif
