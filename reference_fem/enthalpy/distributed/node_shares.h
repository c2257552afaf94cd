#ifndef meltfront_reference_fem_enthalpy_distributed_node_shares_h
#define meltfront_reference_fem_enthalpy_distributed_node_shares_h

#include <reference_fem/enthalpy/distributed/box_lattice.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>

namespace meltfront::reference_fem
{
  /**
   * The nodes of a lattice that are this rank's: deal.II and p4est share out blocks of
   * 2^k cells a side along a space-filling curve. A node goes with the cell whose lower
   * corner it is, or, on an upper side, with the last one before it.
   */
  dealii::IndexSet own_nodes(const BoxLattice &lattice, MPI_Comm communicator);
} // namespace meltfront::reference_fem

#endif
