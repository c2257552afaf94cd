#ifndef meltfront_particles_sph_two_population_sph_two_population_h
#define meltfront_particles_sph_two_population_sph_two_population_h

#include <cases/method.h>

#include <memory>

namespace meltfront::particles
{
  /** `sph-two-population`: alloys, a liquid and an ice particle per site. */
  std::unique_ptr<cases::Method> make_sph_two_population();

  /** `sph-two-population-2005`: the same code set up as Monaghan, Huppert and Worster
   * (2005) computed, with the misprints of equations 4.10 and 4.15 corrected. It does not
   * converge to the mushy layer's solution. */
  std::unique_ptr<cases::Method> make_sph_two_population_2005();
} // namespace meltfront::particles

#endif
