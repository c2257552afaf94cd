#ifndef meltfront_particles_moab_integral_moab_integral_h
#define meltfront_particles_moab_integral_moab_integral_h

#include <cases/method.h>

#include <memory>

namespace meltfront::particles
{
  /** `moab-integral`: conduction in the form that two integrations by parts give it
   * against a kernel, sums over particles in place of the integrals (Erickson et al.
   * 2016, SAND2016-9800, chapter 3), with weights of their own for each integral. */
  std::unique_ptr<cases::Method> make_moab_integral();
} // namespace meltfront::particles

#endif
