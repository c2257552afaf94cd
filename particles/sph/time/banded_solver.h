#ifndef meltfront_particles_sph_time_banded_solver_h
#define meltfront_particles_sph_time_banded_solver_h

#include <cstddef>
#include <span>
#include <vector>

namespace meltfront::particles
{
  /**
   * Direct solution of systems A x = b with a few diagonals beside the main one, as of
   * particles along a line: work and memory grow in proportion to the unknowns.
   *
   * Elimination without exchange of rows, which is stable where columns are dominated by
   * their diagonal (Higham 2002, theorem 9.9), as those of implicit conduction are.
   */
  class BandedSolver
  {
  public:
    /** @param half_bandwidth diagonals on either side of the main one */
    BandedSolver(std::size_t unknowns, std::size_t half_bandwidth);

    /**
     * Take the matrix from products, product(x, A x): columns that are farther apart than
     * the band is wide share one, so that there are 2 half_bandwidth + 1 of them; and
     * factorise it.
     * @return false if a pivot is zero or not finite.
     */
    template <typename Product>
    bool factorise(const Product &product)
    {
      for(std::size_t first = 0; first < width; ++first)
      {
        for(std::size_t i = 0; i < n; ++i)
          comb[i] = i % width == first ? 1. : 0.;
        product(std::span<const double>(comb), std::span<double>(image));
        store_columns(first);
      }
      return eliminate();
    }

    /** x = A^-1 b in place. */
    void solve(std::span<double> x) const;

  private:
    /** A(row, row + offset - half_bandwidth) */
    double &entry(std::size_t row, std::size_t offset)
    {
      return entries[row * width + offset];
    }

    double entry(std::size_t row, std::size_t offset) const
    {
      return entries[row * width + offset];
    }

    void store_columns(std::size_t first);
    bool eliminate();

    std::size_t n, half, width;
    std::vector<double> entries; ///< by rows; the factors after eliminate()
    std::vector<double> comb, image;
  };
} // namespace meltfront::particles

#endif
