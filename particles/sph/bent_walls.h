#ifndef meltfront_particles_sph_bent_walls_h
#define meltfront_particles_sph_bent_walls_h

#include <particles/sph/discretisation.h>

#include <optional>

namespace meltfront::particles
{
  /** Least depth in spacings that a particle counts with at a wall: those that are
   * displaced may come nearer or beyond. */
  constexpr double shallowest_depth = 0.2;

  /** The line from a particle through a wall that bends to a ghost beyond it. */
  struct LineToGhost
  {
    const cases::Boundary *boundary;
    cases::Position place; ///< where the wall's value is taken (m)
    double depth;          ///< of the particle, 0.2 spacings at the least (m)
    double across;         ///< between particle and ghost, along the wall's normal (m)
    /** Of the difference between the wall's value and the particle's: what lies between
     * ghost and particle. */
    double extension;
  };

  /**
   * How a ghost at a place follows a particle. Of a circle or a sphere the depth is that
   * in which steady conduction is linear (RoundWall). An outline is crossed by the line
   * itself, so that each particle is held by the wall that it sees, also beside corners;
   * a ghost inside, nearer to the wall than particles may be, by the wall next to it.
   */
  LineToGhost line_to_ghost(const Discretisation &discretisation,
                            const cases::Position &particle,
                            const cases::Position &ghost);

  /** The neighbours, within a kernel's support or two spacings, that each particle sees,
   * and those that an outline hides from it: across a notch, or about a corner. */
  struct NeighboursInSight
  {
    NeighboursInSight(const Discretisation &discretisation, NeighbourList neighbours);

    NeighbourList seen;
    std::optional<NeighbourList> hidden; ///< within an outline
  };
} // namespace meltfront::particles

#endif
