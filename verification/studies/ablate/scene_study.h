#ifndef meltfront_verification_studies_ablate_scene_study_h
#define meltfront_verification_studies_ablate_scene_study_h

#include <cases/case.h>
#include <cases/method.h>
#include <verification/judge/matrix_result.h>
#include <verification/matrix/matrix.h>
#include <verification/matrix/runner.h>

#include <string>
#include <vector>

/** What the studies of one scene share: which method at which resolutions, and how two
 * runs differ. */
namespace meltfront::verification
{
  struct StudySettings
  {
    std::string case_name; ///< of the library, or a file
    std::string method{};  ///< empty: first_capable()
    int n = 0;             ///< finest resolution; 0: as `within` allows
    double within = 60;    ///< processor time of all runs together, about (s)
    RunnerOptions runner{};
    std::vector<const cases::Method *> methods{}; ///< in the order of tables
    CaseLoader load_case{};
  };

  /**
   * The first method that takes a scene: fem-enthalpy, sph, rkpm-tracked, fem-fitted
   * (from the cheapest at an error of 1e-2 on), then all others that are no forms as
   * published.
   * @throws cases::Refusal with every reason if there is none
   */
  const cases::Method &first_capable(const cases::Case &c,
                                     const std::vector<const cases::Method *> &methods);

  /** The method that settings name, or the first that takes the case. */
  const cases::Method &method_of(const StudySettings &settings, const cases::Case &c);

  /** n/2, n/sqrt(2) and n, rounded, each once. */
  std::vector<int> three_levels(int n);

  /**
   * The finest n at which so many runs stay within the time: from a pilot run of a scene
   * (n = 40 along a line, 24 in the plane, 12 in space), by the growth of its
   * time with n (method_prior()); at least the
   * pilot's, at most 8 times that along a line, 4 times in the plane, 3 in space. The
   * pilot's record stays in the directory.
   * @throws cases::NumericalError or Refusal with the run's message if the pilot fails
   */
  int resolution_within(const StudySettings &settings, const cases::Case &c,
                        const cases::Method &method, double runs);

  /** Processor seconds of a run, set-up and stepping. */
  double processor_seconds(const RunRecord &run);

  /** The run of a case at n; null if there is none. */
  const RunRecord *find_run(const MatrixResult &result, const std::string &case_name,
                            int n);

  /** Root mean square over 96 times of the difference of fronts (m), of those times at
   * which both have one; NaN if there is none. @param volume of the domain */
  double front_difference(const RunRecord &one, const RunRecord &other, double volume);

  /** Root mean square over the probes of the difference of temperatures at the end (K).
   */
  double temperature_difference(const RunRecord &one, const RunRecord &other);

  /** Of a finished run: front and solid volume at the end; NaN where there is none. Where
   * all is solid or all is liquid there is no front, whatever place a record gives it.
   * @param volume of the domain */
  double end_front(const RunRecord &run, double volume);
  double end_volume(const RunRecord &run);
} // namespace meltfront::verification

#endif
