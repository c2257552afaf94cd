#ifndef meltfront_particles_voronoi_fv_voronoi_fv_h
#define meltfront_particles_voronoi_fv_voronoi_fv_h

#include <cases/method.h>

#include <memory>

namespace meltfront::particles
{
  /** `voronoi-fv`: finite volumes on the Voronoi cells of particles, which may be relaxed
   * before. */
  std::unique_ptr<cases::Method> make_voronoi_fv();
} // namespace meltfront::particles

#endif
