#ifndef meltfront_particles_sph_mixture_sph_mixture_h
#define meltfront_particles_sph_mixture_sph_mixture_h

#include <cases/method.h>

#include <memory>

namespace meltfront::particles
{
  /** `sph-mixture`: alloys, one particle per site in local equilibrium. */
  std::unique_ptr<cases::Method> make_sph_mixture();
} // namespace meltfront::particles

#endif
