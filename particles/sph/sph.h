#ifndef meltfront_particles_sph_sph_h
#define meltfront_particles_sph_sph_h

#include <cases/method.h>

#include <memory>

namespace meltfront::particles
{
  /** `sph`: enthalpy SPH with the corrections that its README lists. */
  std::unique_ptr<cases::Method> make_sph();

  /** `sph-2005`: the same code set up as Monaghan, Huppert and Worster (2005) computed.
   */
  std::unique_ptr<cases::Method> make_sph_2005();
} // namespace meltfront::particles

#endif
