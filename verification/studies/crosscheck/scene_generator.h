#ifndef meltfront_verification_studies_crosscheck_scene_generator_h
#define meltfront_verification_studies_crosscheck_scene_generator_h

#include <verification/studies/crosscheck/scene_draft.h>

#include <cstdint>

namespace meltfront::verification
{
  /**
   * A random scene in the language that heat methods know: shapes, walls of every kind,
   * constant, ramped, pulsed and switched, materials, starts in one phase, at the melting
   * point and with fronts, sources, volumetric source, inclusions, alloys; over about the
   * time that a front needs for a part of the domain. The same for the same arguments, on
   * any machine, whatever was made before.
   *
   * @param dimension 1 (slabs, and balls and shells that are symmetric), 2 or 3; 0: any,
   * most in one
   */
  SceneDraft random_scene(std::uint64_t seed, int index, int dimension = 0);

  /** `scene-SEED-INDEX`. */
  std::string scene_name(std::uint64_t seed, int index);
} // namespace meltfront::verification

#endif
