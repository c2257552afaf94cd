#ifndef meltfront_particles_greenspan_bar_bar_run_h
#define meltfront_particles_greenspan_bar_bar_run_h

#include <cases/run.h>
#include <cases/scene.h>

namespace meltfront::particles::greenspan
{
  /**
   * A slab of heat conduction as a bar of particles: x_min is the end of the hot bath,
   * x_max the beginning of the cold one; n is the number of columns of particles.
   *
   * What the observer gets are layers of particles in the continuum's terms: lengths are
   * masses per width over the density of the scene's solid, so that expansion drops out;
   * the front is where the order of the particles drops.
   *
   * @throws Refusal if the scene is none that a bar can be, or if n columns make a bar
   * whose length is not the slab's
   */
  std::unique_ptr<cases::Run> make_bar_run(const cases::Scene &scene,
                                           const cases::EffectSet &effects,
                                           const cases::Resolution &resolution);
} // namespace meltfront::particles::greenspan

#endif
