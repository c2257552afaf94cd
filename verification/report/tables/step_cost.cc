#include <verification/report/tables/convergence_table.h>
#include <verification/report/tables/growth.h>
#include <verification/report/tables/step_cost.h>

#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    /** Milliseconds of the least of a level's runs; NaN where none finished. */
    double milliseconds_per_step(const Level &level)
    {
      double least = std::nan("");
      for(const RunRecord *run : level.runs)
        if(run->status == RunStatus::finished && run->cost.steps > 0)
          least = std::fmin(least, 1e3 * run->cost.stepping_cpu
                                       / static_cast<double>(run->cost.steps));
      return least;
    }

    double first_label_at(const CaseRuns &runs, const int n)
    {
      for(const Level &level : runs.labels.front().levels)
        if(level.n == n)
          return milliseconds_per_step(level);
      return std::nan("");
    }

    Cell exponent_in_n(const LabelRuns &label)
    {
      std::vector<double> resolutions, costs;
      for(const Level &level : label.levels)
        if(const double milliseconds = milliseconds_per_step(level); milliseconds > 0)
        {
          resolutions.push_back(level.n);
          costs.push_back(milliseconds);
        }
      return order_cell(fit_growth(resolutions, costs), "n");
    }
  } // namespace

  Table step_cost_table(const CaseRuns &runs)
  {
    Table table;
    if(runs.labels.empty())
      return table;
    table.group_heading = "method";
    table.columns = {{"n", "", true},
                     {"a step", "ms", true},
                     {"over that of " + runs.labels.front().label, "", true}};
    for(const LabelRuns &label : runs.labels)
    {
      RowGroup group;
      group.label = label.label;
      for(const Level &level : label.levels)
      {
        const double milliseconds = milliseconds_per_step(level);
        const double ratio = milliseconds / first_label_at(runs, level.n);
        group.rows.push_back(
            {{NumberText{std::to_string(level.n), {}}},
             {number_text(milliseconds, 2, column_notation({milliseconds}))},
             {number_text(ratio, 2, column_notation({ratio}))}});
      }
      if(label.levels.size() >= 4)
        group.summary.push_back(
            {{std::string("growth")}, exponent_in_n(label), {std::string()}});
      table.groups.push_back(group);
    }
    return table;
  }
} // namespace meltfront::verification
