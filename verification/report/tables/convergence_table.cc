#include <verification/report/tables/convergence_table.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  const std::vector<Quantity> &table_quantities()
  {
    static const std::vector<Quantity> quantities = []
    {
      std::vector<Quantity> list = all_quantities();
      std::erase_if(list, [](const Quantity &quantity)
                    { return quantity.shown == Shown::nowhere; });
      return list;
    }();
    return quantities;
  }

  std::string quantity_heading(const std::string &name)
  {
    for(const Quantity &quantity : table_quantities())
      if(quantity.name == name)
        return quantity.heading;
    return name;
  }

  OrderFit order_of(const StoredCase &record, const LabelRuns &runs,
                    const std::string &quantity)
  {
    const RunRecord *finest = runs.finest();
    if(!finest)
      return {};
    return fit_levels(runs.errors(quantity), record, quantity, *finest, runs.refinement);
  }

  Cell order_cell(const OrderFit &fit, const std::string &base)
  {
    if(fit.verdict == OrderVerdict::too_few_levels || !std::isfinite(fit.order))
    {
      if(fit.left_out > 0)
        return {fit.remarks()};
      return {NumberText()};
    }
    Power power{base, fmt::format("{:.2f}", fit.order), "", ""};
    if(std::isfinite(fit.confidence))
      power.error = fmt::format("{:.2f}", fit.confidence);
    power.remark = fit.remarks();
    return {power};
  }

  namespace
  {
    std::vector<double> column_values(const CaseRuns &runs, const std::string &name)
    {
      std::vector<double> values;
      for(const LabelRuns &label : runs.labels)
        for(const Level &level : label.levels)
          values.push_back(level.value(name));
      return values;
    }

    double least(const std::vector<double> &values)
    {
      double result = std::nan("");
      for(const double value : values)
        if(std::isfinite(value) && !(value >= result))
          result = value;
      return result;
    }

    /** A column of the table with what its cells share. */
    struct FilledColumn
    {
      Quantity quantity;
      Notation notation;
      double best; ///< NaN: nothing is marked
    };

    bool asked_for(const StoredCase &record, const Quantity &quantity)
    {
      const auto names_it
          = [&quantity](const auto &entry) { return entry.quantity == quantity.name; };
      return std::any_of(record.criteria.begin(), record.criteria.end(), names_it)
             || std::any_of(record.printed.begin(), record.printed.end(), names_it);
    }

    bool has_column(const CaseRuns &runs, const Quantity &quantity)
    {
      if(!runs.has(quantity.name))
        return false;
      switch(quantity.shown)
      {
      case Shown::always:
        return true;
      case Shown::in_time:
        return std::any_of(runs.labels.begin(), runs.labels.end(),
                           [](const LabelRuns &label)
                           { return label.refinement.in_time(); });
      case Shown::without_exact:
        return !runs.record->exact || asked_for(*runs.record, quantity);
      default:
        return asked_for(*runs.record, quantity) || quantity.name == main_error(runs);
      }
    }

    /** The unit of a column in the case's own measure. */
    std::string unit_in(const StoredCase &record, const Quantity &quantity)
    {
      if(quantity.unit == "volume")
        return unit_of(record, volume_unit(record));
      return quantity.unit == "m" || quantity.unit == "K" ? unit_of(record, quantity.unit)
                                                          : quantity.unit;
    }

    std::vector<FilledColumn> filled_columns(const CaseRuns &runs)
    {
      std::vector<FilledColumn> columns;
      for(const Quantity &quantity : table_quantities())
        if(has_column(runs, quantity))
        {
          const auto values = column_values(runs, quantity.name);
          columns.push_back({quantity, column_notation(values),
                             quantity.error ? least(values) : std::nan("")});
        }
      return columns;
    }

    Cell value_cell(const Level &level, const FilledColumn &column)
    {
      const double value = level.value(column.quantity.name);
      Cell cell;
      if(column.quantity.whole && std::isfinite(value))
        cell.content = NumberText{grouped(std::lround(value)), {}};
      else
        cell.content = number_text(value, column.quantity.digits, column.notation);
      cell.best = value == column.best;
      return cell;
    }

    std::vector<Cell> order_row(const StoredCase &record, const LabelRuns &runs,
                                const std::vector<FilledColumn> &columns)
    {
      std::vector<Cell> row{{std::string("order")}};
      for(const FilledColumn &column : columns)
        row.push_back(column.quantity.error
                          ? order_cell(order_of(record, runs, column.quantity.name),
                                       runs.refinement.symbol())
                          : Cell{std::string()});
      row.push_back({std::string()});
      return row;
    }

    bool seeds_vary(const CaseRuns &runs)
    {
      for(const LabelRuns &label : runs.labels)
        for(const Level &level : label.levels)
          if(level.runs.size() > 1)
            return true;
      return false;
    }
  } // namespace

  Table convergence_table(const CaseRuns &runs)
  {
    const auto columns = filled_columns(runs);
    Table table;
    table.group_heading = "method";
    table.columns.push_back({"n", "", true});
    for(const FilledColumn &column : columns)
      table.columns.push_back(
          {column.quantity.heading, unit_in(*runs.record, column.quantity), true});
    table.columns.push_back({seeds_vary(runs) ? "runs" : "run", "", false});
    for(const LabelRuns &label : runs.labels)
    {
      RowGroup &group = table.groups.emplace_back();
      group.label = label.label;
      for(const Level &level : label.levels)
      {
        auto &row = group.rows.emplace_back();
        row.push_back({NumberText{std::to_string(level.n), {}}});
        for(const FilledColumn &column : columns)
          row.push_back(value_cell(level, column));
        row.push_back(
            {level.status()
             + (level.runs.size() > 1 ? fmt::format(" (mean of {})", level.finished_count)
                                      : "")});
      }
      const auto orders = order_row(*runs.record, label, columns);
      if(std::any_of(orders.begin(), orders.end(),
                     [](const Cell &cell)
                     { return std::holds_alternative<Power>(cell.content); }))
        group.summary.push_back(orders);
    }
    return table;
  }

  Table pairwise_table(const CaseRuns &runs)
  {
    std::vector<Quantity> quantities;
    for(const Quantity &quantity : table_quantities())
      if(quantity.error && has_column(runs, quantity))
        quantities.push_back(quantity);
    Table table;
    table.group_heading = "method";
    table.columns.push_back({"from n to n", "", false});
    for(const Quantity &quantity : quantities)
      table.columns.push_back({quantity.heading, "", true});
    for(const LabelRuns &label : runs.labels)
    {
      RowGroup group;
      group.label = label.label;
      for(std::size_t l = 0; l + 1 < label.levels.size(); ++l)
      {
        const Level &coarse = label.levels[l], &fine = label.levels[l + 1];
        std::vector<Cell> row{{fmt::format("{} to {}", coarse.n, fine.n)}};
        for(const Quantity &quantity : quantities)
        {
          const double rate
              = std::log(coarse.value(quantity.name) / fine.value(quantity.name))
                / std::log(coarse.value(label.refinement.symbol())
                           / fine.value(label.refinement.symbol()));
          row.push_back({std::isfinite(rate) ? NumberText{fmt::format("{:.2f}", rate), {}}
                                             : NumberText()});
        }
        group.rows.push_back(row);
      }
      if(!group.rows.empty())
        table.groups.push_back(group);
    }
    return table;
  }

  std::string csv_field(const std::string &plain)
  {
    if(plain.find_first_of(",\"\n\r") == std::string::npos)
      return plain;
    std::string quoted = "\"";
    for(const char c : plain)
      quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
  }

  std::string convergence_csv(const CaseRuns &runs)
  {
    const bool spread = seeds_vary(runs);
    std::vector<Quantity> quantities = table_quantities();
    std::stable_sort(quantities.begin(), quantities.end(),
                     [](const Quantity &a, const Quantity &b)
                     { return a.csv_rank < b.csv_rank; });
    std::string csv = "method,n";
    for(const Quantity &quantity : quantities)
      csv += "," + quantity.name;
    csv += spread ? ",status,seeds,front_rms_spread\n" : ",status\n";
    for(const LabelRuns &label : runs.labels)
      for(const Level &level : label.levels)
      {
        csv += fmt::format("{},{}", csv_field(label.label), level.n);
        for(const Quantity &quantity : quantities)
        {
          const double value = level.value(quantity.name);
          // printf writes the sign of a NaN, which other programs do not read.
          csv += std::isnan(value) ? ",nan" : fmt::format(",{:.12g}", value);
        }
        csv += ',';
        csv += csv_field(level.status());
        if(spread)
          csv += fmt::format(",{},{:.12g}", level.finished_count,
                             level.spread("front_rms"));
        csv += "\n";
      }
    return csv;
  }
} // namespace meltfront::verification
