#include <reference_fem/enthalpy/lattice_multigrid.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem
{
  LatticeMultigrid::LatticeMultigrid(const std::vector<LatticeLevel> &levels,
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
    row.resize(static_cast<std::size_t>(levels.front().row_length()));
  }

  void LatticeMultigrid::take(const ConductionMatrix &network)
  {
    matrices.front().take(network);
  }

  void LatticeMultigrid::set_up(const std::vector<double> &heat_capacity, double scale,
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

  void LatticeMultigrid::set_up_below()
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

  void LatticeMultigrid::multiply(const std::vector<double> &x,
                                  std::vector<double> &y) const
  {
    const LatticeLevel &level = levels.front();
    std::fill(y.begin(), y.end(), 0);
    std::size_t first = 0;
    const auto n = static_cast<std::size_t>(level.row_length());
    for(int z = 0; z < level.line[2].nodes(); ++z)
      for(int y_row = 0; y_row < level.line[1].nodes(); ++y_row, first += n)
      {
        matrices.front().subtract_product(y_row, z, diagonal, x, y.data() + first);
        for(std::size_t i = first; i < first + n; ++i)
          y[i] = (*active)[i] ? -y[i] : 0;
      }
  }

  /** Cholesky's factor; where truncation leaves coarse functions that depend on each
   * other a pivot vanishes, and its unknown is left out. */
  void LatticeMultigrid::factorise_coarsest()
  {
    const LatticeLevel &level = levels.back();
    const LatticeMatrix &matrix = matrices.back();
    const std::vector<double> &of_level = levels.size() == 1 ? diagonal : matrix.diagonal;
    const std::size_t n = level.size();
    constexpr double smallest_pivot = 1e-13;
    factor.assign(n * n, 0);
    std::vector<double> unit(n), column(n);
    for(std::size_t j = 0; j < n; ++j)
    {
      unit.assign(n, 0);
      unit[j] = of_level[j] > 0 ? -1 : 0;
      column.assign(n, 0);
      const auto nx = static_cast<std::size_t>(level.row_length());
      for(int r = 0; r < level.rows(); ++r)
        matrix.subtract_product(r % level.line[1].nodes(), r / level.line[1].nodes(),
                                of_level, unit, column.data() + r * nx);
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

  void LatticeMultigrid::solve_coarsest(const std::vector<double> &right_side,
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

  void LatticeMultigrid::precondition(const std::vector<double> &right_side,
                                      std::vector<double> &x)
  {
    cycle(0, right_side, x);
  }

  void LatticeMultigrid::cycle(std::size_t l, const std::vector<double> &right_side,
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

  void LatticeMultigrid::correct_coarsely(std::size_t l,
                                          const std::vector<double> &right_side,
                                          std::vector<double> &x)
  {
    const LatticeMatrix &matrix = matrices[l];
    const LatticeLevel &level = levels[l];
    Work &below = work[l + 1];
    std::fill(below.right_side.begin(), below.right_side.end(), 0);
    const auto n = static_cast<std::size_t>(level.row_length());
    std::size_t first = 0;
    for(int z = 0; z < level.line[2].nodes(); ++z)
      for(int y = 0; y < level.line[1].nodes(); ++y, first += n)
      {
        std::copy_n(right_side.begin() + static_cast<std::ptrdiff_t>(first), n,
                    row.begin());
        matrix.subtract_product(y, z, l == 0 ? diagonal : matrix.diagonal, x, row.data());
        if(l == 0)
          for(std::size_t i = 0; i < n; ++i)
            row[i] = (*active)[first + i] ? row[i] : 0;
        level.restrict_row(y, z, row.data(), coarse_row, below.right_side);
      }
    cycle(l + 1, below.right_side, below.x);
    level.add_interpolated(below.x, l == 0 ? active->data() : nullptr, x);
  }
} // namespace meltfront::reference_fem
