#include <verification/report/tables/convergence_table.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    /** The quantities whose orders are compared, the one whose least value is shown
     * first. */
    std::vector<std::string> ordered_quantities(const CaseRuns &runs)
    {
      std::vector<std::string> wanted{"front_end", "front_rms", "temperature_l2"};
      if(!runs.record->exact)
        wanted = {"solid_volume_end_error", "solid_volume_rms_error",
                  "front_mode_end_error"};
      if(!runs.record->scene.changes_phase())
        wanted = {"temperature_rmse", "temperature_l2", "temperature_max"};
      std::erase_if(wanted, [&runs](const std::string &name) { return !runs.has(name); });
      return wanted;
    }

    const Level *best_level(const LabelRuns &runs, const std::string &quantity)
    {
      const Level *best = nullptr;
      for(const Level &level : runs.levels)
        if(std::isfinite(level.value(quantity))
           && (!best || level.value(quantity) < best->value(quantity)))
          best = &level;
      return best;
    }

    /** A group of one row: the label above its orders. */
    RowGroup orders_of_label(const CaseRuns &runs, const LabelRuns &label,
                             const std::vector<std::string> &quantities)
    {
      RowGroup group;
      group.label = label.label;
      std::vector<Cell> row{
          {label.refinement.in_time() ? std::string("time") : std::string("space")}};
      bool any = false;
      for(const std::string &quantity : quantities)
      {
        const OrderFit fit = order_of(*runs.record, label, quantity);
        row.push_back(order_cell(fit, label.refinement.symbol()));
        any = any || !std::holds_alternative<NumberText>(row.back().content);
      }
      const Level *best = best_level(label, quantities.front());
      if(!any || !best)
        return {};
      row.push_back(
          {number_text(best->value(quantities.front()), 2, Notation::scientific)});
      row.push_back({number_text(best->value("cpu_seconds"))});
      group.rows.push_back(row);
      return group;
    }
  } // namespace

  Table orders_table(const CaseRuns &runs)
  {
    Table table;
    const std::vector<std::string> quantities = ordered_quantities(runs);
    if(quantities.empty())
      return table;
    table.group_heading = "method";
    table.columns.push_back({"refined", "", false});
    for(const std::string &quantity : quantities)
      table.columns.push_back({"order of " + quantity_heading(quantity), "", true});
    const bool volume = quantities.front().starts_with("solid");
    table.columns.push_back(
        {"least " + quantity_heading(quantities.front()),
         unit_of(*runs.record, volume ? volume_unit(*runs.record) : "m"), true});
    table.columns.push_back({"CPU", "s", true});
    for(const LabelRuns &label : runs.labels)
      if(RowGroup group = orders_of_label(runs, label, quantities); !group.rows.empty())
        table.groups.push_back(std::move(group));
    return table;
  }
} // namespace meltfront::verification
