#ifndef meltfront_particles_sph_discretisation_h
#define meltfront_particles_sph_discretisation_h

#include <cases/scene.h>
#include <particles/core/kernels.h>
#include <particles/core/neighbour_list.h>
#include <particles/core/particle_storage.h>
#include <particles/core/relaxation.h>
#include <particles/relaxation/conjugate_gradients.h>
#include <particles/sph/own_particles.h>
#include <particles/sph/parameters.h>

#include <functional>
#include <span>
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

  /** A circle or a sphere about the origin that bounds a ball or a shell. */
  struct RoundWall
  {
    const cases::Boundary *boundary;
    double radius; ///< m
    bool inner;    ///< the domain is outside of it

    /** How deep in the domain a place is at a distance from the origin; negative beyond
     * the wall (m). */
    double depth(double distance) const
    {
      return inner ? distance - radius : radius - distance;
    }

    /**
     * The depth in which steady conduction is linear (m): with the wall's radius R and
     * the distance r it is R |ln(r/R)| in the plane and R |1 - R/r| in space, nearly the
     * depth itself next to the wall, and negative beyond it.
     */
    double conductive_depth(double distance, int dimension) const;

    /**
     * Whether the temperature is known beyond the wall: that of an exact solution. Within
     * a hole it is not asked for, where it may be infinite.
     */
    bool known_beyond() const
    {
      return boundary->exact && !inner
             && boundary->kind == cases::BoundaryKind::fixed_temperature;
    }

    /** Its area (m^(d-1)). */
    double area(int dimension) const;

    /** What it encloses (m^d). */
    double enclosed(int dimension) const;
  };

  /** A particle beside a wall that bends, and the volume that it stands for over that of
   * a cell of the lattice; a ring about an axis, and its circumference (m). */
  struct WallCell
  {
    std::uint32_t particle;
    double share;
  };

  /** A scene as particles: where they are and what each stands for. */
  struct Discretisation
  {
    Discretisation(const cases::Scene &scene, const SphParameters &parameters);

    /** Keep some of the particles only, by their numbers in ascending order, of which
     * this process computes those that `own` tells. For particles that all stand for a
     * cell.
     */
    void keep(std::span<const std::uint32_t> numbers, OwnParticles own);

    /** Whether cells are no squares (cubes). */
    bool stretched() const;

    /** True if a particle lies on the wall (edge layout). */
    bool on_wall(const PlaneWall &wall, std::size_t particle) const;

    /** Of a ball or a shell: the round wall nearest to a place at a distance from the
     * origin. */
    const RoundWall &nearest_round_wall(double distance) const;

    /** Add the lattice points that are no particles, up to a support beyond a round wall.
     */
    void add_points_beyond(const RoundWall &wall, ParticleStorage &points) const;

    const cases::Scene &scene;
    int dimension;
    LatticeLayout layout;
    double spacing; ///< dp (m)
    /** Sides of the lattice's cells (m): the spacing, but for sides of a box that are no
     * whole number of it, which so many cells fill as nearly fit. */
    std::array<double, 3> cell;
    SmoothingKernel kernel;
    bool displaced;        ///< the particles are not on a lattice
    Relaxation relaxation; ///< of the particles, where they were relaxed
    Descent descent;       ///< of their energy, where that was minimised
    ParticleStorage particles;
    /** Lattice points beyond round walls within reach of the particles: they hold the
     * walls' values. None beyond insulated walls. */
    ParticleStorage ghosts;
    Periodicity periodicity;
    std::vector<PlaneWall> walls;       ///< of a slab or a box, without the periodic ones
    std::vector<RoundWall> round_walls; ///< of a ball or a shell
    double particle_volume;             ///< of a cell (m^d); of a ring the section
    double cross_section;               ///< of the strip that stands for a slab, else 1
    std::vector<double> weights;        ///< volumes in the measure of the scene
    /** All particles about an axis. Else: the lattice's cells cover more or less of a
     * ball, a shell or an outline than there is. The particles within a spacing of a wall
     * share the difference alike, so that weights add up to the domain. */
    std::vector<WallCell> wall_cells;
    /** Particles on a wall of prescribed temperature (edge layout), which hold its value.
     */
    std::vector<std::uint32_t> dirichlet;
    OwnParticles own; ///< of the particles: all, unless processes share them

  private:
    void fit_cells(const SphParameters &parameters);
    void require_whole_cells(const SphParameters &parameters) const;
    void fill_slab_or_box(const SphParameters &parameters);
    void fill_ball_or_shell();
    double least_depth(const RoundWall &wall) const;
    void share_what_cells_miss();
    void share_the_rest(const RoundWall &wall);
    /** Share what cells leave out of a domain (m^d). */
    void share_beside_wall(const std::function<double(const cases::Position &)> &depth,
                           double missing);
    void fill_outline();
    void turn_about_axis(const SphParameters &parameters);
    void disturb(const SphParameters &parameters);
    void scatter_in_box(const SphParameters &parameters);
    ParticleStorage lattice_around_box() const;
    void find_dirichlet_particles();
  };
} // namespace meltfront::particles

#endif
