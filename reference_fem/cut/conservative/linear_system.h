#ifndef meltfront_reference_fem_cut_conservative_linear_system_h
#define meltfront_reference_fem_cut_conservative_linear_system_h

#include <reference_fem/cut/sparse_system.h>

#include <Eigen/SparseCore>

#include <vector>

namespace meltfront::reference_fem::cut::conservative
{
  /**
   * Solve a sparse system directly (UMFPACK, Davis 2004, rows and columns scaled by their
   * largest entries).
   * @throws std::runtime_error where it is singular or the solution is not finite
   * @throws cases::OutOfMemory
   */
  LocalVector solve(long unknowns, const std::vector<Eigen::Triplet<double>> &entries,
                    const LocalVector &load);
} // namespace meltfront::reference_fem::cut::conservative

#endif
