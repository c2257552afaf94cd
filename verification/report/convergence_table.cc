#include <verification/report/convergence_table.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  const std::vector<Quantity> &table_quantities()
  {
    static const std::vector<Quantity> list = {
        {"h", "h", "m"},
        {"unknowns", "unknowns", "", false, true},
        {"steps", "steps", "", false, true},
        {"front_rms", "front, RMS", "m", true},
        {"front_end", "front, end", "m", true},
        {"front_isotherm_rms", "front by isotherm, RMS", "m", true},
        {"front_max_ice_rms", "largest frozen radius, RMS", "m", true, false, true},
        {"front_heat_loss_rms", "largest radius a quarter frozen, RMS", "m", true, false,
         true},
        {"front_late_max_relative", "front, late maximum", "relative", true, false, true},
        {"front_end_relative", "front, end", "relative", true, false, true},
        {"temperature_l2", "temperature, L2", "relative", true},
        {"temperature_max", "temperature, maximum", "relative", true},
        {"budget_defect", "heat budget defect", "relative"},
        {"cpu_seconds", "CPU", "s"},
        {"wall_seconds", "wall", "s"},
        {"peak_memory_mb", "memory", "MB"},
        {"work", "work", "entries"}};
    return list;
  }

  std::string quantity_heading(const std::string &name)
  {
    for(const Quantity &quantity : table_quantities())
      if(quantity.name == name)
        return quantity.heading;
    return name;
  }

  OrderFit order_of(const LabelRuns &runs, const std::string &quantity)
  {
    std::vector<double> h, errors;
    runs.finite_values(quantity, h, errors);
    return fit_order(h, errors);
  }

  Cell order_cell(const OrderFit &fit, const std::string &base)
  {
    if(fit.verdict == OrderVerdict::too_few_levels || !std::isfinite(fit.order))
      return {NumberText()};
    Power power{base, fmt::format("{:.2f}", fit.order), "", ""};
    if(std::isfinite(fit.standard_error))
      power.error = fmt::format("{:.2f}", fit.standard_error);
    if(fit.verdict != OrderVerdict::clean)
      power.remark = to_string(fit.verdict);
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

    /** True if a criterion or a printed value of the case names the quantity. */
    bool asked_for(const CaseRuns &runs, const Quantity &quantity)
    {
      const auto names_it
          = [&quantity](const auto &entry) { return entry.quantity == quantity.name; };
      const CaseRecord &record = *runs.record;
      return std::any_of(record.criteria.begin(), record.criteria.end(), names_it)
             || std::any_of(record.printed.begin(), record.printed.end(), names_it);
    }

    std::vector<FilledColumn> filled_columns(const CaseRuns &runs)
    {
      std::vector<FilledColumn> columns;
      for(const Quantity &quantity : table_quantities())
        if(runs.has(quantity.name) && (!quantity.special || asked_for(runs, quantity)))
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
        cell.content = number_text(value, 3, column.notation);
      cell.best = value == column.best;
      return cell;
    }

    std::vector<Cell> order_row(const LabelRuns &runs,
                                const std::vector<FilledColumn> &columns)
    {
      std::vector<Cell> row{{std::string("order")}};
      for(const FilledColumn &column : columns)
        row.push_back(column.quantity.error
                          ? order_cell(order_of(runs, column.quantity.name))
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
    {
      const std::string unit = column.quantity.unit == "m" ? unit_of(*runs.record, "m")
                                                           : column.quantity.unit;
      table.columns.push_back({column.quantity.heading, unit, true});
    }
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
      const auto orders = order_row(label, columns);
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
      if(quantity.error && runs.has(quantity.name)
         && (!quantity.special || asked_for(runs, quantity)))
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
                / std::log(coarse.value("h") / fine.value("h"));
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
    std::stable_partition(quantities.begin(), quantities.end(),
                          [](const Quantity &quantity) { return !quantity.special; });
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
