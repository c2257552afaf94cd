#ifndef meltfront_verification_studies_ablate_ablate_h
#define meltfront_verification_studies_ablate_ablate_h

#include <verification/studies/ablate/scene_study.h>

#include <nlohmann/json.hpp>

namespace meltfront::verification
{
  /**
   * A scene with each effect that is on taken out in turn.
   *
   * As a matrix (run_matrix()): the case as written and, for each effect, the case with
   * `Effects/NAME = off`, by one method at three_levels(). Of front (at the end, and root
   * mean square over time), solid volume and temperature (root mean square over the
   * probes at the end) stands the change at the finest level, with an error bar of its
   * own from the changes at all levels, and in error bars of the full scene (bars_of();
   * of temperatures the root mean square of the probes' bars); beside it the bound that
   * was known before (bound_of_effect()), processor time that the finest run saves and
   * bytes that the effect's code holds.
   *
   * An effect whose removal leaves nothing that could be solved is refused with a
   * sentence, here or by the method; the others go on.
   *
   * Also written to DIR/ablate.json, beside what run_matrix() writes:
   *
   *   {case, method, n: [..], full: {QUANTITY: {value, bar, converging}}, effects:
   *    [{effect, reason, refused | changes: {QUANTITY: {change, bar, in_bars, bound}},
   *      bound: {front, temperature, words}, seconds_saved, bytes_saved}]}
   *
   * with the quantities front (m), front_over_time (m), solid_volume, temperature (K);
   * null where something is not known. Bounds are absolute.
   *
   * @throws cases::Refusal for a scene that conducts no heat, or that no method takes
   */
  nlohmann::json ablate(const StudySettings &settings);

  /** The object as a table to read. */
  std::string ablation_text(const nlohmann::json &ablation);
} // namespace meltfront::verification

#endif
