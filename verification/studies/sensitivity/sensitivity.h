#ifndef meltfront_verification_studies_sensitivity_sensitivity_h
#define meltfront_verification_studies_sensitivity_sensitivity_h

#include <verification/studies/ablate/scene_study.h>
#include <verification/studies/sensitivity/scene_data.h>

#include <nlohmann/json.hpp>

#include <array>
#include <span>

namespace meltfront::verification
{
  /** Relative changes of a datum: each twice the one before. A front that stands in a
   * cell and then jumps, by a tenth of a spacing, would drown smaller ones in noise: the
   * largest move it over cells. */
  inline constexpr std::array<double, 4> relative_steps{0.02, 0.04, 0.08, 0.16};

  /** A derivative with the error that it is stated with. */
  struct Derivative
  {
    double value = 0;
    double error = 0;
    double step = 0; ///< the smaller of the two relative steps it was taken with
  };

  /**
   * Derivative by central differences D_k of the relative_steps s_k at two resolutions.
   *
   * Of neighbouring steps, R_k = (4 D_k - D_(k+1))/3 is free of the error of second order
   * (Richardson). Its error is taken to be
   *
   *   |D_k - D_(k+1)| + 2 |R_k - R_k at n/2|,
   *
   * of which the first part holds the error of the differences and the noise of the
   * discretisation, which grows as 1/s, and the second that of the resolution with the
   * order 1 and the safety factor 2 for two levels. The pair of steps with the least
   * error is taken.
   *
   * @param fine, coarse values at -s_k and +s_k at n and n/2, one pair for each of the
   * smallest steps, at least two
   */
  Derivative derivative(std::span<const std::array<double, 2>> fine,
                        std::span<const std::array<double, 2>> coarse);

  /**
   * How front, solid volume and temperature at the end depend on each datum of a case:
   * derivative() with respect to a relative change of the datum (Datum::scale), all runs
   * by run_matrix(). Beside them the error bar of the front (bars_of()), and how large a
   * change of the datum it is worth.
   *
   * Also written to DIR/sensitivity.json:
   *
   *   {case, method, n, front: {value, bar}, solid_volume: {..}, data: [{key, name,
   * value, scale, of_scale, refused | front: {derivative, error, step}, solid_volume:
   * {..}, temperature: {..}, worth_of_bar}], left_out: [..]}
   *
   * sorted by the front's derivative (of the temperature's where there is no front),
   * largest first. Derivatives are per relative change: dX/ds at p (1 + s), or p + s
   * scale. That of the temperature is the root mean square over the probes (K).
   * worth_of_bar is the relative change of the datum that moves the front by its bar.
   *
   * A step that makes no scene, or none that the method takes, is left out with all
   * larger ones; a datum with fewer than two steps left is refused with the reason; the
   * others go on.
   *
   * @throws cases::Refusal for a scene that conducts no heat, or that no method takes
   */
  nlohmann::json sensitivity(const StudySettings &settings);

  /** The object as a table to read. */
  std::string sensitivity_text(const nlohmann::json &sensitivity);
} // namespace meltfront::verification

#endif
