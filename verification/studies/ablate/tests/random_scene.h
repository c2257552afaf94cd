#ifndef meltfront_verification_studies_ablate_tests_random_scene_h
#define meltfront_verification_studies_ablate_tests_random_scene_h

#include <cases/scene.h>

#include <cstdint>

namespace meltfront::verification::tests
{
  /**
   * A scene whose effects are weak: slabs, squares and disks of unit side that freeze or
   * melt from one wall or two, from one phase or two, with properties of the phases that
   * differ, or vary with temperature, by 1e-4 to 1e-1, and with walls, sources and fluxes
   * as weak. The same for a seed and an index.
   */
  cases::Scene random_weak_scene(std::uint64_t seed, std::uint64_t index);
} // namespace meltfront::verification::tests

#endif
