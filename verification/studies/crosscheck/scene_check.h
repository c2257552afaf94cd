#ifndef meltfront_verification_studies_crosscheck_scene_check_h
#define meltfront_verification_studies_crosscheck_scene_check_h

#include <verification/studies/crosscheck/contradiction.h>

namespace meltfront::verification
{
  /** What came of a scene. */
  enum class SceneOutcome
  {
    agreed,
    refused, ///< fewer than two methods take it
    failed,  ///< a method that takes it broke down, or two did not get through in time
    suspect  ///< methods contradict each other
  };

  const char *to_string(SceneOutcome outcome);

  /** A method and what it said. */
  struct Remark
  {
    std::string method;
    int n = 0; ///< at which resolution; 0: at any
    std::string reason;
  };

  struct SceneVerdict
  {
    SceneOutcome outcome = SceneOutcome::refused;
    std::vector<std::string> compared; ///< methods with two levels or more
    std::vector<Remark> refusals;      ///< one for each method that took no level
    std::vector<Remark> failures;
    std::vector<Remark> too_coarse; ///< failures where three finer runs finished
    std::vector<Remark> out_of_time;
    std::optional<Contradiction> contradiction;
    std::map<std::string, double> bars; ///< relative_bars()
    double closest_call = 0;            ///< largest_excess()
  };

  /** The resolutions for a scene, coarser in more dimensions: the three at which every
   * scene is run, and those of a second look. Each is about 1.6 times the one before,
   * even, and half of it has no divisor that the others have: a front near a quarter of
   * the domain would stand alike in the cells of 20, 32 and 52.
   */
  std::vector<int> crosscheck_resolutions(const cases::Scene &scene);

  /**
   * Run each method on a case at three resolutions and hold the results against each
   * other. Where some contradict the others, all that were compared run at twice and then
   * at four times the finest resolution too, and only what contradicts the others still
   * is suspect: coarse levels may lie before the range in which errors fall as they
   * should.
   *
   * Time is refined with space: a method that takes fewer steps by itself than grow with
   * n from the coarsest resolution is given as many (option `steps`), so that its error
   * bar holds the error of its steps.
   *
   * A failure at one of the three resolutions counts, one of a refinement does not; nor
   * does a run that is out of time, as long as two levels are left. A method that fails
   * at the coarsest resolutions and finishes at all finer ones runs at still finer ones
   * until three are done: it said that those were too coarse (`too_coarse`).
   */
  SceneVerdict check_scene(const cases::Case &c,
                           const std::vector<const cases::Method *> &methods,
                           const LevelLimits &limits);
} // namespace meltfront::verification

#endif
