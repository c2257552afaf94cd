#ifndef meltfront_particles_scattered_direct_solver_h
#define meltfront_particles_scattered_direct_solver_h

#include <particles/scattered/compressed_rows.h>

#include <cstdint>
#include <span>
#include <vector>

namespace meltfront::particles
{
  /** Sparse LU factors by UMFPACK (Davis 2004), with its iterative refinement. */
  class DirectSolver
  {
  public:
    /** @throws cases::OutOfMemory */
    explicit DirectSolver(const CompressedRows &matrix);
    ~DirectSolver();
    DirectSolver(const DirectSolver &) = delete;
    DirectSolver &operator=(const DirectSolver &) = delete;

    /** @return false for a singular matrix. @throws cases::OutOfMemory */
    bool solve(std::span<const double> right_hand_side, std::span<double> x) const;

    /** Least over largest entry on the diagonal of U; 0 for a singular matrix. */
    double reciprocal_condition() const
    {
      return rcond;
    }

    /** Entries of the factors over those of the matrix. */
    double fill() const
    {
      return factor_fill;
    }

  private:
    std::vector<std::int64_t> offsets, columns;
    std::vector<double> coefficients;
    void *numeric = nullptr;
    double rcond = 0, factor_fill = 0;
  };
} // namespace meltfront::particles

#endif
