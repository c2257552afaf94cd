#ifndef meltfront_reference_fem_enthalpy_distributed_rank_level_h
#define meltfront_reference_fem_enthalpy_distributed_rank_level_h

#include <reference_fem/enthalpy/conduction_matrix.h>

#include <deal.II/base/partitioner.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <memory>
#include <vector>

namespace meltfront::reference_fem
{
  /** A number for each node of a rank: its own ones, then the ghosts, which are those of
   * other ranks that its rows reach. */
  using RankVector = dealii::LinearAlgebra::distributed::Vector<double>;

  /** Linear interpolation from a mesh to the next finer one. */
  class LevelTransfer
  {
  public:
    virtual ~LevelTransfer() = default;

    /** fine += P coarse, own nodes. */
    virtual void interpolate(const RankVector &coarse, RankVector &fine) const = 0;

    /** coarse += P' fine, own nodes. */
    virtual void restrict_to(const RankVector &fine, RankVector &coarse) const = 0;
  };

  /** What a rank has of a mesh of the hierarchy. */
  struct RankLevel
  {
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> nodes;
    ConductionMatrix conduction; ///< rows of the own nodes; columns name ghosts, too
    std::vector<char> free;      ///< of the own nodes: 0 where a wall prescribes values
    std::unique_ptr<LevelTransfer> coarser; ///< to the next mesh; null at the coarsest

    std::size_t n_own() const
    {
      return nodes->locally_owned_size();
    }
    std::size_t n_with_ghosts() const
    {
      return n_own() + nodes->n_ghost_indices();
    }
    MPI_Comm communicator() const
    {
      return nodes->get_mpi_communicator();
    }
  };
} // namespace meltfront::reference_fem

#endif
