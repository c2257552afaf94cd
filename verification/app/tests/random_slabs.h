#ifndef meltfront_verification_app_tests_random_slabs_h
#define meltfront_verification_app_tests_random_slabs_h

#include <cases/scene.h>

#include <cstdint>

namespace meltfront::verification::tests
{
  /**
   * A slab of unit length with any start and any walls: properties of the phases within a
   * factor of two of one, latent heat from 0.3 to 3; a uniform, linear or waving start
   * with up to three fronts; walls of all kinds whose values are constant, swing or jump.
   * The same for the same number, on any machine.
   */
  cases::Scene random_slab(std::uint64_t number);
} // namespace meltfront::verification::tests

#endif
