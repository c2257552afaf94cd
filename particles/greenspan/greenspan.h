#ifndef meltfront_particles_greenspan_greenspan_h
#define meltfront_particles_greenspan_greenspan_h

#include <cases/method.h>

#include <memory>

namespace meltfront::particles
{
  /**
   * Particles that bind each other and move by leapfrog (D. Greenspan, A particle model
   * of the Stefan problem, 1976). Of a table, n is its number of particles; of a triangle
   * or a rectangle, the particles on the base.
   */
  std::unique_ptr<cases::Method> make_greenspan();
} // namespace meltfront::particles

#endif
