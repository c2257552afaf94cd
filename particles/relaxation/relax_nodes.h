#ifndef meltfront_particles_relaxation_relax_nodes_h
#define meltfront_particles_relaxation_relax_nodes_h

#include <particles/relaxation/conjugate_gradients.h>
#include <particles/relaxation/lennard_jones.h>
#include <particles/scattered/node_set.h>

namespace meltfront::particles
{
  /** The box of a slab or a box. */
  CoordinateBox coordinate_box(const cases::Domain &domain);

  /**
   * Move the inner nodes of a set, random ones say, to a minimum of the Lennard-Jones
   * energy with the nodes on the walls as fixed neighbours. The length of the potential
   * is a multiple of the largest spacing of the lattice that the set was made from: below
   * 0.95 of it voids remain, above 1 it does not matter.
   *
   * @param parameters whose length is replaced
   * @throws cases::InputError if two nodes are at the same place.
   */
  Descent relax_inner_nodes(NodeSet &nodes, const cases::Domain &domain,
                            LennardJonesRelaxation parameters,
                            double length_over_spacing);

  /** The same as the report has it: the length is the spacing. */
  void relax_inner_nodes(NodeSet &nodes, const cases::Scene &scene);
} // namespace meltfront::particles

#endif
