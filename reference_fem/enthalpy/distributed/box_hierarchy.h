#ifndef meltfront_reference_fem_enthalpy_distributed_box_hierarchy_h
#define meltfront_reference_fem_enthalpy_distributed_box_hierarchy_h

#include <reference_fem/enthalpy/distributed/rank_level.h>
#include <reference_fem/enthalpy/mesh.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace meltfront::reference_fem
{
  /**
   * A box meshed on several ranks: the cells of make_mesh(), shared out by p4est along a
   * space-filling curve, and the coarser meshes in which 2^dim cells are one.
   *
   * The Discretisation has the rank's own nodes only (volumes, positions, wall nodes, so
   * that the effects' loops and sums are the rank's part), but the sites of its own
   * cells, some of which are nodes of other ranks. Its conduction matrix is that of the
   * finest level.
   */
  class RankMesh : public Mesh
  {
  public:
    /** Finest first. What they hold moves out. */
    virtual std::vector<RankLevel> take_levels() = 0;

    /** Number of a node, or of a site, in the whole mesh, along x first: the same
     * whatever the ranks are. */
    virtual std::uint64_t number_at(const cases::Position &node) const = 0;

    /** Number of nodes of all ranks. */
    virtual std::uint64_t n_nodes() const = 0;
  };

  /**
   * Mesh a box, at the same time on all ranks of a communicator.
   * @throws cases::Refusal of a shape or side that it does not mesh, and of an n that
   * cannot be halved to a coarse mesh of at most 4096 cells, which every rank keeps
   */
  std::unique_ptr<RankMesh> make_rank_mesh(const cases::Scene &scene, int n,
                                           MPI_Comm communicator);
} // namespace meltfront::reference_fem

#endif
