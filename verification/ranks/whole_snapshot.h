#ifndef meltfront_verification_ranks_whole_snapshot_h
#define meltfront_verification_ranks_whole_snapshot_h

#include <cases/shared_run.h>

#include <mpi.h>

#include <array>
#include <cstdint>
#include <vector>

namespace meltfront::verification
{
  /**
   * Brings the ranks' parts of snapshots together on the first rank: sites in the order
   * of their numbers and cells in that of their first sites, so that nothing depends on
   * which rank has what. The mesh is sent once. Messages are of a megabyte: the first
   * rank holds the whole, and next to nothing beside it.
   */
  class WholeSnapshot
  {
  public:
    explicit WholeSnapshot(MPI_Comm communicator)
      : communicator(communicator)
    {
    }

    /**
     * To be called on all ranks. What it gives is whole on the first one, and lives until
     * the next call. Temperatures, solid fractions and budgets are taken over.
     */
    cases::Snapshot gather(const cases::Snapshot &snapshot, const cases::RankPart &part);

  private:
    void take_in_order(std::span<const double> own, std::vector<double> &whole) const;
    void gather_mesh(const cases::Snapshot &snapshot, const cases::RankPart &part);
    void gather_cells(const cases::Snapshot &snapshot, const cases::RankPart &part,
                      const std::vector<std::uint64_t> &numbers);

    MPI_Comm communicator;
    bool mesh_is_here = false;
    std::vector<unsigned int> place; ///< of the sites as they come, rank by rank
    std::array<std::vector<double>, 3> positions;
    std::vector<double> weights, temperature, solid_fraction;
    std::vector<unsigned int> cells;
  };
} // namespace meltfront::verification

#endif
