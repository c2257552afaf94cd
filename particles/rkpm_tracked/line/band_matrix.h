#ifndef meltfront_particles_rkpm_tracked_line_band_matrix_h
#define meltfront_particles_rkpm_tracked_line_band_matrix_h

#include <cstddef>
#include <span>
#include <vector>

namespace meltfront::particles::rkpm_tracked
{
  /** A square matrix with few diagonals, solved by elimination with row exchanges. */
  class BandMatrix
  {
  public:
    /** Make it zero, with `below` and `above` diagonals beside the main one. */
    void reset(std::size_t size, std::size_t below, std::size_t above);

    /** An entry within the band. */
    double &operator()(std::size_t row, std::size_t column)
    {
      return entries[row * width + column + lower - row];
    }

    /**
     * Solve for a right side, which becomes the solution; the matrix is used up.
     * @return false if it is singular
     */
    bool solve(std::span<double> right_side);

  private:
    std::size_t n = 0, lower = 0, reach = 0, width = 0; ///< reach: above, with fill
    std::vector<double> entries;
  };
} // namespace meltfront::particles::rkpm_tracked

#endif
