#include <reference_fem/enthalpy/multigrid.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem
{
  template <class Level>
  Multigrid<Level>::Multigrid(const std::vector<Level> &levels,
                              const ConductionMatrix &network)
    : levels(levels)
    , work(levels.size())
    , diagonal(levels.front().size())
  {
    matrices.reserve(levels.size());
    for(std::size_t l = 0; l < levels.size(); ++l)
    {
      if(l == 0)
        matrices.emplace_back(levels[0], network);
      else
      {
        matrices.emplace_back(levels[l]);
        work[l].right_side.resize(levels[l].size());
        work[l].x.resize(levels[l].size());
      }
      work[l].inverse_diagonal.resize(levels[l].size());
    }
  }

  template <class Level>
  void Multigrid<Level>::take(const ConductionMatrix &network)
  {
    matrices.front().take(network);
  }

  template <class Level>
  void Multigrid<Level>::set_up(const std::vector<double> &heat_capacity, double scale,
                                const std::vector<char> &active_nodes,
                                bool with_coarse_levels)
  {
    active = &active_nodes;
    coarse = with_coarse_levels;
    for(std::size_t i = 0; i < diagonal.size(); ++i)
    {
      diagonal[i]
          = active_nodes[i] ? heat_capacity[i] * scale + matrices[0].diagonal[i] : 0;
      work[0].inverse_diagonal[i] = diagonal[i] > 0 ? 1 / diagonal[i] : 0;
    }
    if(coarse)
      set_up_below();
  }

  template <class Level>
  void Multigrid<Level>::set_up_below()
  {
    for(std::size_t l = 1; l < levels.size(); ++l)
    {
      matrices[l].restrict_from(matrices[l - 1],
                                l == 1 ? diagonal : matrices[l - 1].diagonal,
                                l == 1 ? active->data() : nullptr);
      for(std::size_t i = 0; i < levels[l].size(); ++i)
        work[l].inverse_diagonal[i]
            = matrices[l].diagonal[i] > 0 ? 1 / matrices[l].diagonal[i] : 0;
    }
    factorise_coarsest();
  }

  template <class Level>
  void Multigrid<Level>::multiply(const std::vector<double> &x,
                                  std::vector<double> &y) const
  {
    std::fill(y.begin(), y.end(), 0);
    matrices.front().subtract_product(diagonal, x, y);
    for(std::size_t i = 0; i < y.size(); ++i)
      y[i] = (*active)[i] ? -y[i] : 0;
  }

  /** Cholesky's factor; where truncation leaves coarse functions that depend on each
   * other a pivot vanishes, and its unknown is left out. */
  template <class Level>
  void Multigrid<Level>::factorise_coarsest()
  {
    const typename Level::Matrix &matrix = matrices.back();
    const std::vector<double> &of_level = levels.size() == 1 ? diagonal : matrix.diagonal;
    const std::size_t n = levels.back().size();
    constexpr double smallest_pivot = 1e-13;
    factor.assign(n * n, 0);
    std::vector<double> unit(n), column(n);
    for(std::size_t j = 0; j < n; ++j)
    {
      unit.assign(n, 0);
      unit[j] = of_level[j] > 0 ? -1 : 0;
      column.assign(n, 0);
      matrix.subtract_product(of_level, unit, column);
      for(std::size_t i = j; i < n; ++i)
        factor[i * n + j] = of_level[i] > 0 ? column[i] : 0;
    }
    for(std::size_t j = 0; j < n; ++j)
    {
      double &pivot = factor[j * n + j];
      for(std::size_t k = 0; k < j; ++k)
        pivot -= factor[j * n + k] * factor[j * n + k];
      if(!(pivot > smallest_pivot * of_level[j]))
      {
        for(std::size_t i = j; i < n; ++i)
          factor[i * n + j] = 0;
        continue;
      }
      pivot = std::sqrt(pivot);
      for(std::size_t i = j + 1; i < n; ++i)
      {
        double &entry = factor[i * n + j];
        for(std::size_t k = 0; k < j; ++k)
          entry -= factor[i * n + k] * factor[j * n + k];
        entry /= pivot;
      }
    }
  }

  template <class Level>
  void Multigrid<Level>::solve_coarsest(const std::vector<double> &right_side,
                                        std::vector<double> &x) const
  {
    const std::size_t n = right_side.size();
    for(std::size_t i = 0; i < n; ++i)
    {
      const double pivot = factor[i * n + i];
      double value = right_side[i];
      for(std::size_t k = 0; k < i; ++k)
        value -= factor[i * n + k] * x[k];
      x[i] = pivot > 0 ? value / pivot : 0;
    }
    for(std::size_t i = n; i-- > 0;)
    {
      const double pivot = factor[i * n + i];
      for(std::size_t k = i + 1; k < n; ++k)
        x[i] -= factor[k * n + i] * x[k];
      x[i] = pivot > 0 ? x[i] / pivot : 0;
    }
  }

  template <class Level>
  void Multigrid<Level>::precondition(const std::vector<double> &right_side,
                                      std::vector<double> &x)
  {
    cycle(0, right_side, x);
  }

  template <class Level>
  void Multigrid<Level>::cycle(std::size_t l, const std::vector<double> &right_side,
                               std::vector<double> &x)
  {
    if(coarse && l + 1 == levels.size())
    {
      solve_coarsest(right_side, x);
      return;
    }
    const std::vector<double> &inverse = work[l].inverse_diagonal;
    const auto relax = [&](std::size_t i, double b) { return inverse[i] * b; };
    std::fill(x.begin(), x.end(), 0);
    matrices[l].sweep(true, right_side, x, relax);
    if(coarse)
      correct_coarsely(l, right_side, x);
    matrices[l].sweep(false, right_side, x, relax);
  }

  template <class Level>
  void Multigrid<Level>::correct_coarsely(std::size_t l,
                                          const std::vector<double> &right_side,
                                          std::vector<double> &x)
  {
    Work &below = work[l + 1];
    const char *mask = l == 0 ? active->data() : nullptr;
    matrices[l].restrict_residual(l == 0 ? diagonal : matrices[l].diagonal, mask,
                                  right_side, x, below.right_side);
    cycle(l + 1, below.right_side, below.x);
    levels[l].add_interpolated(below.x, mask, x);
  }

  template class Multigrid<LatticeLevel>;
  template class Multigrid<NestedLevel>;
} // namespace meltfront::reference_fem
