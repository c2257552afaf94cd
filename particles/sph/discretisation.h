#ifndef meltfront_particles_sph_discretisation_h
#define meltfront_particles_sph_discretisation_h

#include <cases/scene.h>
#include <particles/core/kernels.h>
#include <particles/core/neighbour_list.h>
#include <particles/core/particle_storage.h>
#include <particles/core/relaxation.h>
#include <particles/relaxation/conjugate_gradients.h>
#include <particles/sph/parameters.h>

#include <vector>

namespace meltfront::particles
{
  /** A plane wall of a slab or a box. */
  struct PlaneWall
  {
    const cases::Boundary *boundary;
    int direction;     ///< of its normal
    double coordinate; ///< m

    cases::Position project(cases::Position position) const;
  };

  /** A scene as particles: where they are and what each stands for. */
  struct Discretisation
  {
    Discretisation(const cases::Scene &scene, const SphParameters &parameters);

    /** True if a particle lies on the wall (edge layout). */
    bool on_wall(const PlaneWall &wall, std::size_t particle) const;

    const cases::Scene &scene;
    int dimension;
    LatticeLayout layout;
    double spacing; ///< dp (m)
    SmoothingKernel kernel;
    bool displaced;        ///< the particles are not on a lattice
    Relaxation relaxation; ///< of the particles, where they were relaxed
    Descent descent;       ///< of their energy, where that was minimised
    ParticleStorage particles;
    /** Lattice points outside a ball within reach of its particles: they hold the rim's
     * values. */
    ParticleStorage ghosts;
    Periodicity periodicity;
    std::vector<PlaneWall> walls; ///< of a slab or a box, without the periodic ones
    double particle_volume;       ///< dp^d (m^d)
    double cross_section;         ///< of the strip that stands for a slab, else 1
    std::vector<double> weights;  ///< volumes in the measure of the scene
    /** Particles on a wall of prescribed temperature (edge layout), which hold its value.
     */
    std::vector<std::uint32_t> held;

  private:
    void fill_slab_or_box(const SphParameters &parameters);
    void fill_ball();
    void fill_outline();
    void disturb(const SphParameters &parameters);
    void scatter_in_box(const SphParameters &parameters);
    ParticleStorage lattice_around_box() const;
    void find_held_particles();
  };
} // namespace meltfront::particles

#endif
