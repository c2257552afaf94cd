#include <particles/sph/time/banded_solver.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles
{
  BandedSolver::BandedSolver(std::size_t unknowns, std::size_t half_bandwidth)
    : n(unknowns)
    , half(half_bandwidth)
    , width(2 * half_bandwidth + 1)
    , entries(unknowns * width)
    , comb(unknowns)
    , image(unknowns)
  {
  }

  void BandedSolver::store_columns(std::size_t first)
  {
    for(std::size_t column = first; column < n; column += width)
      for(std::size_t row = column - std::min(column, half);
          row <= std::min(column + half, n - 1); ++row)
        entry(row, column + half - row) = image[row];
  }

  bool BandedSolver::eliminate()
  {
    for(std::size_t pivot = 0; pivot < n; ++pivot)
    {
      double &diagonal = entry(pivot, half);
      if(!(std::abs(diagonal) > 0 && std::isfinite(diagonal)))
        return false;
      diagonal = 1 / diagonal; // kept inverted
      const std::size_t reach = std::min(half, n - 1 - pivot);
      for(std::size_t below = 1; below <= reach; ++below)
      {
        double &factor = entry(pivot + below, half - below);
        factor *= diagonal;
        for(std::size_t right = 1; right <= reach; ++right)
          entry(pivot + below, half + right - below)
              -= factor * entry(pivot, half + right);
      }
    }
    return true;
  }

  void BandedSolver::solve(std::span<double> x) const
  {
    for(std::size_t row = 1; row < n; ++row)
      for(std::size_t left = 1; left <= std::min(half, row); ++left)
        x[row] -= entry(row, half - left) * x[row - left];
    for(std::size_t row = n; row-- > 0;)
    {
      for(std::size_t right = 1; right <= std::min(half, n - 1 - row); ++right)
        x[row] -= entry(row, half + right) * x[row + right];
      x[row] *= entry(row, half);
    }
  }
} // namespace meltfront::particles
