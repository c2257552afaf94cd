#include <verification/report/tables/convergence_table.h>
#include <verification/report/tables/growth.h>

#include <fmt/format.h>

#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    /** Coarse levels are held by a least number of steps and by overheads: growth is that
     * of the finest levels, as many as a fit needs. */
    constexpr std::size_t fitted_levels = 4;

    /** What the finest levels of a label cost, each where it finished. */
    struct Costs
    {
      int dimension = 1, coarsest = 0, finest = 0;
      std::vector<double> unknowns, cells, steps, work, seconds;
    };

    Costs costs_of(const LabelRuns &label)
    {
      Costs costs;
      std::vector<const Level *> levels;
      for(const Level &level : label.levels)
        if(level.finished && level.value("unknowns") > 0)
          levels.push_back(&level);
      if(levels.size() > fitted_levels)
        levels.erase(levels.begin(), levels.end() - fitted_levels);
      for(const Level *level : levels)
      {
        const RunRecord &run = *level->finished;
        costs.coarsest = costs.coarsest == 0 ? run.n : costs.coarsest;
        costs.finest = run.n;
        costs.dimension = run.description.dimension;
        costs.unknowns.push_back(level->value("unknowns"));
        costs.cells.push_back(1 / run.description.spacing);
        costs.steps.push_back(static_cast<double>(run.cost.steps));
        costs.work.push_back(static_cast<double>(run.cost.work));
        costs.seconds.push_back(run.cost.stepping_cpu);
      }
      return costs;
    }

    Cell theory(const Costs &costs)
    {
      // Counts have no noise: two levels tell their law.
      const std::size_t last = costs.steps.size() - 1;
      const double rate = std::log(costs.steps[last] / costs.steps[last - 1])
                          / std::log(costs.cells[last] / costs.cells[last - 1]);
      if(!std::isfinite(rate))
        return {NumberText()};
      constexpr double whole = 0.15;
      const bool lawful = std::abs(rate - std::round(rate)) < whole;
      const double k = lawful ? std::round(rate) : rate;
      return {Power{"N", fmt::format("{:.3g}", 1 + k / costs.dimension), "",
                    fmt::format("steps ~ h^{:.3g}", 0 - k)}};
    }
  } // namespace

  OrderFit fit_growth(const std::vector<double> &sizes,
                      const std::vector<double> &amounts)
  {
    std::vector<double> spacings;
    for(const double size : sizes)
      spacings.push_back(1 / size);
    OrderFit fit = fit_order(spacings, amounts);
    fit.order = -fit.order;
    if(std::isfinite(fit.order) && fit.verdict != OrderVerdict::too_few_levels)
      fit.verdict = OrderVerdict::clean;
    return fit;
  }

  Table growth_table(const std::vector<CaseRuns> &cases)
  {
    Table table;
    table.group_heading = "case";
    table.columns
        = {{"method", "", false},      {"dimension", "", true}, {"n", "", false},
           {"CPU of steps", "", true}, {"work", "", true},      {"steps", "", true},
           {"theory", "", true}};
    for(const CaseRuns &runs : cases)
    {
      RowGroup group{runs.record->name(), {}, {}};
      for(const LabelRuns &label : runs.labels)
      {
        const Costs costs = costs_of(label);
        const OrderFit seconds = fit_growth(costs.unknowns, costs.seconds);
        if(seconds.verdict != OrderVerdict::clean)
          continue;
        group.rows.push_back({{label.label},
                              {NumberText{grouped(costs.dimension), {}}},
                              {fmt::format("{} to {}", costs.coarsest, costs.finest)},
                              order_cell(seconds, "N"),
                              order_cell(fit_growth(costs.unknowns, costs.work), "N"),
                              order_cell(fit_growth(costs.unknowns, costs.steps), "N"),
                              theory(costs)});
      }
      if(!group.rows.empty())
        table.groups.push_back(std::move(group));
    }
    return table;
  }
} // namespace meltfront::verification
