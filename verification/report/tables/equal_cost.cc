#include <verification/report/tables/cost_at_error.h>
#include <verification/report/tables/equal_cost.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    /** The groups of a table by dimension, a row for each label with an error. */
    template <typename Row>
    std::vector<RowGroup> by_dimension(const CaseRuns &runs, const Row &row)
    {
      std::vector<RowGroup> groups;
      for(const int dimension : dimensions_of(runs))
      {
        RowGroup group{fmt::format("in {}D", dimension), {}, {}};
        for(const LabelRuns &label : runs.labels)
          if(const WorkPrecision measured = relative_work_precision(label, runs);
             label.dimension() == dimension && !measured.error.empty())
            group.rows.push_back(row(label, measured));
        if(!group.rows.empty())
          groups.push_back(std::move(group));
      }
      return groups;
    }

    double least_error_within(const WorkPrecision &measured, double seconds)
    {
      double least = std::nan("");
      for(std::size_t i = 0; i < measured.error.size(); ++i)
        if(measured.cost[i] <= seconds)
          least = std::fmin(least, measured.error[i]);
      return least;
    }
  } // namespace

  std::vector<double> wanted_errors(const std::vector<CaseRuns> &cases)
  {
    std::vector<double> wanted{1e-2, 1e-3, 1e-4};
    for(const double finer : {1e-5, 1e-6, 1e-7, 1e-8})
      if(std::ranges::any_of(
             cases, [&wanted](const CaseRuns &runs)
             { return cheapest(runs, wanted.back()).reach != Reach::not_reached; }))
        wanted.push_back(finer);
    return wanted;
  }

  Table cost_at_equal_error(const CaseRuns &runs, const std::vector<double> &wanted)
  {
    Table table;
    table.group_heading = "method";
    table.columns = {{"", "", false}};
    for(const double error : wanted)
      table.columns.push_back({fmt::format("{:.0e}", error), "s", true});
    table.columns.push_back({"finest n", "", true});
    table.columns.push_back({"its set-up", "s", true});
    table.columns.push_back({"its steps", "s", true});
    table.groups
        = by_dimension(runs,
                       [&](const LabelRuns &label, const WorkPrecision &measured)
                       {
                         std::vector<Cell> row{{label.label}};
                         for(const double error : wanted)
                         {
                           const CostAtError found = cost_at_error(measured, error);
                           if(found.reach == Reach::not_reached)
                             row.push_back({NumberText()});
                           else
                             row.push_back({prose_number(found.cost, 2),
                                            cheapest(runs, error).label == label.label});
                         }
                         const RunRecord &finest = *label.finest();
                         row.push_back({NumberText{grouped(finest.n), {}}});
                         row.push_back({prose_number(finest.cost.setup_cpu, 2)});
                         row.push_back({prose_number(finest.cost.stepping_cpu, 2)});
                         return row;
                       });
    return table;
  }

  Table error_at_equal_cost(const CaseRuns &runs)
  {
    constexpr double budgets[] = {1e-3, 1e-2, 1e-1, 1, 10};
    Table table;
    table.group_heading = "method";
    table.columns = {{"", "", false}};
    std::vector<double> best;
    for(const double seconds : budgets)
    {
      table.columns.push_back({"within " + duration_text(seconds), "", true});
      double &least = best.emplace_back(std::nan(""));
      for(const LabelRuns &label : runs.labels)
        least = std::fmin(
            least, least_error_within(relative_work_precision(label, runs), seconds));
    }
    table.groups
        = by_dimension(runs,
                       [&](const LabelRuns &label, const WorkPrecision &measured)
                       {
                         std::vector<Cell> row{{label.label}};
                         for(std::size_t b = 0; b < best.size(); ++b)
                         {
                           const double error = least_error_within(measured, budgets[b]);
                           row.push_back({number_text(error, 2, Notation::scientific),
                                          error == best[b]});
                         }
                         return row;
                       });
    return table;
  }
} // namespace meltfront::verification
