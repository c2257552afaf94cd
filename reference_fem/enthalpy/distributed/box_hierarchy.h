#ifndef meltfront_reference_fem_enthalpy_distributed_box_hierarchy_h
#define meltfront_reference_fem_enthalpy_distributed_box_hierarchy_h

#include <reference_fem/enthalpy/distributed/rank_level.h>
#include <reference_fem/enthalpy/mesh.h>

#include <memory>
#include <vector>

namespace meltfront::reference_fem
{
  /**
   * Meshes of a box on several ranks, the finest first: the cells of make_mesh(), and the
   * coarser meshes in which 2^dim cells are one. A node of a coarser mesh belongs to the
   * rank that has the node of the finer ones in its place.
   *
   * @throws cases::Refusal of a shape or side that it does not mesh, and of an n that
   * cannot be halved to a coarse mesh of at most 4096 cells, which every rank keeps
   */
  std::vector<RankLevel> make_rank_levels(const cases::Scene &scene, int n,
                                          MPI_Comm communicator);

  /**
   * A rank's part of the finest mesh as effects see it. The Discretisation has the rank's
   * own nodes only (volumes, positions, wall nodes, so that the effects' loops and sums
   * are the rank's part). Sites are these and then the ghosts, in the rank's numbers
   * (node_of_site stays empty), cells those whose lower corner is an own node.
   *
   * @param finest outlives what is made, as the scene does
   */
  std::unique_ptr<Mesh> make_rank_mesh(const cases::Scene &scene,
                                       const RankLevel &finest);
} // namespace meltfront::reference_fem

#endif
