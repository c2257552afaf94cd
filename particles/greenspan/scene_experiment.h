#ifndef meltfront_particles_greenspan_scene_experiment_h
#define meltfront_particles_greenspan_scene_experiment_h

#include <cases/method.h>
#include <cases/option_binder.h>
#include <cases/scene.h>
#include <particles/greenspan/experiments.h>

namespace meltfront::particles::greenspan
{
  /** The options of a solid of particles. */
  struct SolidOptions
  {
    void bind(cases::OptionBinder &options);

    long interval = 100;
    double skin = 0.3;
    NeighbourRows::Search search = NeighbourRows::Search::automatic;
    double step_factor = 1;
    std::string checkpoint;
    long checkpoint_interval = 10000;
  };

  /** The force of a scene's particles. */
  PairForce force_of(const cases::PairLaw &law);

  /** Number of particles of a solid or a bar, but for those at the edge of a round one.
   */
  double particles_of(const cases::ParticleSolid &solid, int n);

  /** What a run of a solid of particles or of a bar takes. */
  cases::Demand solid_demand(const cases::Scene &scene,
                             const cases::Resolution &resolution);

  /**
   * The experiment that a scene of the kind `particle solid` describes.
   *
   * The resolution's n is checked against a table's number of particles, or makes a
   * triangle or a rectangle with so many particles on its base, laid to rest there if the
   * scene does not leave that to the run; a disk, an outline or a ball of about n
   * spacings, or a block of n cells along each side. The seed disturbs what the scene
   * lets it disturb and chooses the velocities and the bath's noise.
   *
   * @throws Refusal if n does not fit, or if the time step is to be scaled where base or
   * source act once per step
   */
  Experiment experiment_of(const cases::Scene &scene,
                           const cases::Resolution &resolution);
} // namespace meltfront::particles::greenspan

#endif
