#ifndef meltfront_particles_rkpm_rkpm_h
#define meltfront_particles_rkpm_rkpm_h

#include <cases/method.h>

#include <memory>
#include <vector>

namespace meltfront::particles
{
  /** Collocation with reproducing kernels in its five forms: rkpm-point-collocation,
   * rkpm-fixed-point, rkpm-moving, rkpm-multiple-fixed, rkpm-derivative-free. */
  std::vector<std::unique_ptr<cases::Method>> make_rkpm_methods();
} // namespace meltfront::particles

#endif
