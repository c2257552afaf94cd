#ifndef meltfront_particles_level_set_front_methods_h
#define meltfront_particles_level_set_front_methods_h

#include <cases/method.h>

#include <memory>
#include <vector>

namespace meltfront::particles
{
  /**
   * Methods that carry a front along with a given velocity, on a grid of n cells along x:
   * `level-set` alone, and corrected by markers, `level-set-particle`,
   * `level-set-particle-corrected` and `level-set-interpolative`.
   */
  std::vector<std::unique_ptr<cases::Method>> make_level_set_methods();
} // namespace meltfront::particles

#endif
