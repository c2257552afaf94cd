#ifndef meltfront_reference_fem_enthalpy_distributed_rank_level_h
#define meltfront_reference_fem_enthalpy_distributed_rank_level_h

#include <reference_fem/enthalpy/distributed/box_lattice.h>
#include <reference_fem/enthalpy/distributed/conduction_runs.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi_noncontiguous_partitioner.h>

#include <vector>

namespace meltfront::reference_fem
{
  /** What a run on several ranks has sent, for a model of what it would on more: numbers
   * of one rank. */
  struct Traffic
  {
    long exchanges = 0;  ///< of ghost values with all neighbours
    long reductions = 0; ///< over all ranks
    double sent = 0;     ///< numbers to neighbours

    template <class Archive>
    void serialize(Archive &archive, unsigned int)
    {
      archive &exchanges &reductions &sent;
    }
  };

  /**
   * What a rank has of a mesh of the hierarchy. Its nodes are its own ones in the order
   * of their numbers on the lattice, then the ghosts in theirs: all others that share a
   * cell with one of its own, or between which one of its own nodes of the next finer
   * mesh interpolates.
   *
   * Vectors have the own nodes and, where they are exchanged, the ghosts, too.
   */
  class RankLevel
  {
  public:
    /**
     * @param own numbers of the own nodes
     * @param finer the next finer mesh; null at the finest
     */
    RankLevel(const cases::Scene &scene, const BoxLattice &lattice,
              const dealii::IndexSet &own, const RankLevel *finer, MPI_Comm communicator);

    std::size_t n_own() const
    {
      return own.n_elements();
    }
    std::size_t n_with_ghosts() const
    {
      return own.n_elements() + ghosts.n_elements();
    }

    /** Bring the ghosts up to date. */
    void exchange(std::vector<double> &values, Traffic &traffic) const;

    /** The rank's number of a node; dealii::numbers::invalid_unsigned_int where it does
     * not have it. */
    unsigned int local(const BoxLattice::Place &node) const;

    /** Of an own node or a ghost. */
    BoxLattice::Place place(unsigned int node) const
    {
      return lattice.place_of(number(node));
    }

    /** Number on the lattice of an own node or a ghost. */
    std::uint64_t number(unsigned int node) const
    {
      return node < n_own()
                 ? own.nth_index_in_set(node)
                 : ghosts.nth_index_in_set(node - static_cast<unsigned int>(n_own()));
    }

    /** Numbers on the lattice of the own nodes. */
    const dealii::IndexSet &own_numbers() const
    {
      return own;
    }

    /** Those that are nodes of the next coarser mesh, by their numbers there. */
    dealii::IndexSet own_on_coarser() const;

    MPI_Comm communicator;
    BoxLattice lattice;
    ConductionRuns conduction;  ///< by the trapezoidal rule, of unit conductivity
    std::vector<char> free;     ///< of the own nodes: 0 where a wall prescribes values
    RunMatrix<2, 1> to_finer;   ///< P to the own nodes of the next finer mesh
    RunMatrix<1, 2> from_finer; ///< P' of its own nodes and ghosts to the own nodes

  private:
    void find_ghosts(const RankLevel *finer);
    void conduct(const cases::Scene &scene);
    void interpolate(const RankLevel &finer);

    dealii::IndexSet own, ghosts;
    dealii::Utilities::MPI::NoncontiguousPartitioner partitioner;
    bool shared; ///< other ranks have nodes, too
  };
} // namespace meltfront::reference_fem

#endif
