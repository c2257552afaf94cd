#include <reference_fem/enthalpy/distributed/rank_multigrid.h>

namespace meltfront::reference_fem
{
  RankMultigrid::RankMultigrid(const std::vector<RankLevel> &levels, Traffic &traffic)
    : levels(levels)
    , traffic(traffic)
    , systems(levels.size())
    , coarsest(levels.back())
  {
    for(std::size_t l = 0; l < levels.size(); ++l)
    {
      System &system = systems[l];
      system.diagonal.resize(levels[l].n_own());
      system.inverse.resize(levels[l].n_own());
      system.residual.resize(levels[l].n_with_ghosts());
      if(l > 0)
      {
        system.x.resize(levels[l].n_with_ghosts());
        system.right_side.resize(levels[l].n_own());
      }
    }
  }

  long RankMultigrid::entries() const
  {
    long sum = 0;
    for(const RankLevel &level : levels)
      sum += level.conduction.n_entries();
    return sum;
  }

  void RankMultigrid::set_up(const NewtonSystem &of_step, double scale)
  {
    for(std::size_t l = 0; l < levels.size(); ++l)
    {
      const RankLevel &level = levels[l];
      const std::vector<double> &stiffness = level.conduction.diagonal;
      System &system = systems[l];
      std::vector<double> &d = system.residual; // has ghosts
      if(l == 0)
        for(std::size_t i = 0; i < level.n_own(); ++i)
          d[i] = of_step.active[i] ? of_step.heat_capacity[i] * scale
                 : level.free[i]   ? stiffness[i]
                                   : 0;
      else
        level.from_finer.multiply(systems[l - 1].residual.data(),
                                  [&](std::size_t i, double sum) { d[i] = sum; });
      const std::vector<char> &active = l == 0 ? of_step.active : level.free;
      for(std::size_t i = 0; i < level.n_own(); ++i)
      {
        system.diagonal[i] = active[i] ? d[i] + stiffness[i] : 0;
        system.inverse[i] = active[i] ? 1 / system.diagonal[i] : 0;
      }
      if(l + 1 < levels.size())
        level.exchange(d, traffic);
    }
    coarsest.take(systems.back().residual);
    ++traffic.reductions;
  }

  void RankMultigrid::multiply(std::vector<double> &x, std::vector<double> &y)
  {
    levels.front().exchange(x, traffic);
    const double *const diagonal = systems.front().diagonal.data();
    const double *const values = x.data();
    double *const result = y.data();
    levels.front().conduction.multiply(
        values, [=](std::size_t i, double sum)
        { result[i] = diagonal[i] > 0 ? diagonal[i] * values[i] - sum : 0; });
  }

  void RankMultigrid::cycle(std::size_t l, const std::vector<double> &right_side,
                            std::vector<double> &x)
  {
    if(l + 1 == levels.size() && l > 0)
    {
      coarsest.solve(right_side, x);
      ++traffic.reductions;
      return;
    }
    const ConductionRuns &conduction = levels[l].conduction;
    const double *const inverse = systems[l].inverse.data();
    conduction.sweep_from_zero(right_side.data(), inverse, x.data());
    if(l + 1 < levels.size())
      correct_coarsely(l, x);
    levels[l].exchange(x, traffic);
    conduction.sweep(false, right_side.data(), x.data(),
                     [inverse](std::size_t i, double b) { return inverse[i] * b; });
  }

  void RankMultigrid::correct_coarsely(std::size_t l, std::vector<double> &x)
  {
    const RankLevel &level = levels[l], &coarse = levels[l + 1];
    System &below = systems[l + 1];
    std::vector<double> &residual = systems[l].residual;
    const double *const inverse = systems[l].inverse.data();
    double *const right_side = below.right_side.data(), *const values = x.data();
    level.exchange(x, traffic);
    level.conduction.residual_of_sweep(values, inverse, residual.data());
    level.exchange(residual, traffic);
    coarse.from_finer.multiply(residual.data(),
                               [=](std::size_t i, double sum) { right_side[i] = sum; });
    cycle(l + 1, below.right_side, below.x);
    coarse.exchange(below.x, traffic);
    coarse.to_finer.multiply(below.x.data(), [=](std::size_t i, double sum)
                             { values[i] += inverse[i] > 0 ? sum : 0; });
  }
} // namespace meltfront::reference_fem
