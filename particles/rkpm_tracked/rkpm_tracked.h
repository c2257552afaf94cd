#ifndef meltfront_particles_rkpm_tracked_rkpm_tracked_h
#define meltfront_particles_rkpm_tracked_rkpm_tracked_h

#include <cases/method.h>

#include <memory>

namespace meltfront::particles
{
  /** The method `rkpm-tracked`: particles on the front, which move with the Stefan speed,
   * and collocation with reproducing kernels in each phase apart (Erickson et al. 2016,
   * SAND2016-9800, chapter 6). */
  std::unique_ptr<cases::Method> make_rkpm_tracked();
} // namespace meltfront::particles

#endif
