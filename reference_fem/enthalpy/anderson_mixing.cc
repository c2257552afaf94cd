#include <reference_fem/enthalpy/anderson_mixing.h>

#include <algorithm>

namespace meltfront::reference_fem
{
  AndersonMixing::AndersonMixing(Eigen::Index size, int depth)
    : depth(depth)
    , mapped_changes(size, depth)
    , residual_changes(size, depth)
    , last_mapped(size)
    , last_residual(size)
    , residual(size)
  {
  }

  void AndersonMixing::restart()
  {
    first = true;
    stored = 0;
  }

  void AndersonMixing::advance(Eigen::VectorXd &x, const Eigen::VectorXd &mapped)
  {
    constexpr double divergence = 2;
    residual = mapped - x;
    const double norm = residual.norm();
    // Where G is not smooth the past may mislead.
    if(!first && norm > divergence * last_norm)
      restart();
    if(!first)
    {
      // The oldest column is the one to go: columns take turns.
      const int column = stored % depth;
      mapped_changes.col(column) = mapped - last_mapped;
      residual_changes.col(column) = residual - last_residual;
      ++stored;
    }
    first = false;
    last_norm = norm;
    last_mapped = mapped;
    last_residual = residual;
    x = mapped;
    const int used = std::min(stored, depth);
    if(used == 0)
      return;
    const Eigen::VectorXd weights
        = residual_changes.leftCols(used).colPivHouseholderQr().solve(residual);
    if(weights.allFinite())
      x -= mapped_changes.leftCols(used) * weights;
  }

  long AndersonMixing::bytes() const
  {
    return static_cast<long>(
        (mapped_changes.size() + residual_changes.size() + 3 * residual.size())
        * sizeof(double));
  }
} // namespace meltfront::reference_fem
