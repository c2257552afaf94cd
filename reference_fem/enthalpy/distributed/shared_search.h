#ifndef meltfront_reference_fem_enthalpy_distributed_shared_search_h
#define meltfront_reference_fem_enthalpy_distributed_shared_search_h

#include <reference_fem/enthalpy/distributed/rank_level.h>
#include <reference_fem/enthalpy/line_search.h>

namespace meltfront::reference_fem
{
  /**
   * The length between 0 and 1 at which a convex functional is lowest, of which each rank
   * knows the part of its nodes: KinkedDerivative::lowest() without bringing all kinks
   * together. The derivative, which rises, is summed up at 16 lengths at a time, until
   * the bracket is 1e-6 wide or holds no kink; within it the derivative counts as a line.
   *
   * @param own the rank's part; its kinks are sorted
   */
  double lowest_of_all(KinkedDerivative &own, MPI_Comm communicator, Traffic &traffic);
} // namespace meltfront::reference_fem

#endif
