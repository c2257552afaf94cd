#include <particles/rkpm_tracked/line/band_matrix.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::rkpm_tracked
{
  void BandMatrix::reset(std::size_t size, std::size_t below, std::size_t above)
  {
    n = size;
    lower = below;
    reach = above + below; // exchanged rows fill the band to there
    width = lower + reach + 1;
    entries.assign(n * width, 0.);
  }

  bool BandMatrix::solve(std::span<double> right_side)
  {
    BandMatrix &a = *this;
    for(std::size_t k = 0; k < n; ++k)
    {
      const std::size_t last_row = std::min(k + lower, n - 1);
      const std::size_t last_column = std::min(k + reach, n - 1);
      std::size_t pivot = k;
      for(std::size_t i = k + 1; i <= last_row; ++i)
        if(std::abs(a(i, k)) > std::abs(a(pivot, k)))
          pivot = i;
      if(!(std::abs(a(pivot, k)) > 0))
        return false;
      if(pivot != k)
      {
        for(std::size_t j = k; j <= last_column; ++j)
          std::swap(a(k, j), a(pivot, j));
        std::swap(right_side[k], right_side[pivot]);
      }
      for(std::size_t i = k + 1; i <= last_row; ++i)
      {
        const double factor = a(i, k) / a(k, k);
        if(factor == 0)
          continue;
        for(std::size_t j = k + 1; j <= last_column; ++j)
          a(i, j) -= factor * a(k, j);
        right_side[i] -= factor * right_side[k];
      }
    }
    for(std::size_t k = n; k-- > 0;)
    {
      const std::size_t last_column = std::min(k + reach, n - 1);
      double sum = right_side[k];
      for(std::size_t j = k + 1; j <= last_column; ++j)
        sum -= a(k, j) * right_side[j];
      right_side[k] = sum / a(k, k);
    }
    return true;
  }
} // namespace meltfront::particles::rkpm_tracked
