#include <cases/reported_scalars.h>
#include <verification/record/label.h>
#include <verification/report/chapters/chapters.h>
#include <verification/report/tables/convergence_table.h>
#include <verification/report/tables/ensemble_table.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    const double nan = std::nan("");

    /** Names and meanings of all that may stand in the table. */
    std::vector<cases::ReportedScalar> table_scalars(const StoredCase &record)
    {
      std::vector<cases::ReportedScalar> list;
      const std::vector<double> &intermediate_times
          = record.measurement.intermediate_times;
      const double step = record.scene.particle_solid->time_step;
      const auto solid = [&](const std::string &suffix, double time)
      {
        list.push_back(
            {"solid_" + suffix,
             fmt::format("solid particles at step {:.0f}",
                         std::round((time - record.scene.start_time) / step))});
      };
      for(std::size_t intermediate = 0; intermediate < intermediate_times.size();
          ++intermediate)
        solid(std::to_string(intermediate + 1), intermediate_times[intermediate]);
      solid("end", record.scene.end_time);
      list.insert(list.end(), cases::reported_scalars().begin(),
                  cases::reported_scalars().end());
      return list;
    }

    bool is_of_one_particle(const std::string &quantity)
    {
      return quantity.starts_with("fluid_end_");
    }

    double printed_value(const StoredCase &record, const std::string &label, int n,
                         const std::string &quantity)
    {
      for(const cases::PrintedValue &printed : record.printed)
        if(printed.quantity == quantity && printed.n == n
           && label_matches(printed.method, label))
          return printed.value;
      return nan;
    }

    const CriterionResult *criterion_on(const MatrixResult &result,
                                        const StoredCase &record,
                                        const std::string &label, int n,
                                        const std::string &quantity)
    {
      const std::string words = fmt::format("{} at n={}", quantity, n);
      for(const CriterionResult &criterion : result.criteria)
        if(criterion.case_name == record.name() && label_matches(criterion.method, label)
           && (criterion.quantity == words || criterion.quantity == "median " + words))
          return &criterion;
      return nullptr;
    }

    EnsembleRow row_of(const SeedMean &value)
    {
      EnsembleRow row;
      row.mean = value.mean;
      row.runs = value.count;
      row.deviation = value.count > 1 ? value.spread : nan;
      row.standard_error = row.deviation / std::sqrt(value.count);
      return row;
    }

    /** Cells of a table that is written with badges or without. */
    template <typename Value>
    bool any(const std::vector<EnsembleGroup> &groups, const Value &value)
    {
      for(const EnsembleGroup &group : groups)
        for(const EnsembleRow &row : group.rows)
          if(value(row))
            return true;
      return false;
    }

    /** Which columns have values. */
    struct Columns
    {
      explicit Columns(const std::vector<EnsembleGroup> &groups)
        : printed(any(groups,
                      [](const EnsembleRow &row) { return std::isfinite(row.printed); }))
        , spread(any(groups, [](const EnsembleRow &row) { return row.runs > 1; }))
        , criteria(any(groups, [](const EnsembleRow &row) { return row.criterion; }))
      {
      }

      bool printed, spread, criteria;
    };

    NumberText value_text(double value)
    {
      return prose_number(value, 4);
    }

    NumberText deviation_text(double value)
    {
      return std::isfinite(value) ? NumberText{fmt::format("{:+.1f}", value), {}}
                                  : NumberText();
    }

    std::string bound_words(const EnsembleRow &row)
    {
      if(!row.criterion)
        return {};
      const double lower = row.criterion->lower, upper = row.criterion->upper;
      if(std::isfinite(lower) && std::isfinite(upper))
        return fmt::format("{} to {}", plain_number(lower, 6), plain_number(upper, 6));
      if(std::isfinite(upper))
        return "<= " + plain_number(upper, 6);
      return ">= " + plain_number(lower, 6);
    }

    std::vector<Column> headings(const Columns &columns)
    {
      std::vector<Column> list{{"reported scalar", "", false}};
      if(columns.printed)
        list.push_back({"printed", "", true});
      list.push_back({columns.spread ? "mean" : "value", "", true});
      if(columns.spread)
      {
        list.push_back({"standard deviation", "", true});
        list.push_back({"standard error", "", true});
        if(columns.printed)
          list.push_back({"printed − mean", "standard deviations", true});
        list.push_back({"runs", "", true});
      }
      if(columns.criteria)
      {
        list.push_back({"bounds", "", false});
        list.push_back({"", "", false});
      }
      return list;
    }

    std::vector<Cell> cells(const EnsembleRow &row, const Columns &columns)
    {
      std::vector<Cell> list{{row.meaning}};
      if(columns.printed)
        list.push_back({value_text(row.printed)});
      list.push_back({value_text(row.mean)});
      if(columns.spread)
      {
        list.push_back({prose_number(row.deviation, 3)});
        list.push_back({prose_number(row.standard_error, 2)});
        if(columns.printed)
          list.push_back({deviation_text(row.printed_deviation())});
        list.push_back({NumberText{grouped(row.runs), {}}});
      }
      if(columns.criteria)
      {
        list.push_back({bound_words(row)});
        list.push_back({verdict_of(row)});
      }
      return list;
    }

    Markup number_cell(const NumberText &number)
    {
      return element("td", {{"class", "number"}},
                     number.digits.empty() ? text("–") : number.markup());
    }

    Markup row_markup(const EnsembleRow &row, const Columns &columns)
    {
      Markup markup = element("td", {{"title", row.quantity}}, text(row.meaning));
      if(columns.printed)
        markup += number_cell(value_text(row.printed));
      markup += element("td", {{"class", "number"}},
                        element("b", value_text(row.mean).markup()));
      if(columns.spread)
      {
        markup += number_cell(prose_number(row.deviation, 3))
                  + number_cell(prose_number(row.standard_error, 2));
        if(columns.printed)
          markup += number_cell(deviation_text(row.printed_deviation()));
        markup += number_cell({grouped(row.runs), {}});
      }
      if(columns.criteria)
        markup += element("td", {{"class", "number"}},
                          row.criterion ? bound_of(*row.criterion, 6) : Markup())
                  + element("td", row.criterion
                                      ? badge(row.criterion->passed ? "good" : "bad",
                                              verdict_of(row))
                                      : Markup());
      return element("tr", markup) + Markup("\n");
    }
  } // namespace

  double EnsembleRow::printed_deviation() const
  {
    return deviation > 0 ? (printed - mean) / deviation : nan;
  }

  std::vector<EnsembleGroup> ensemble(const MatrixResult &result, const CaseRuns &runs)
  {
    const StoredCase &record = *runs.record;
    const bool several = runs.labels.size() > 1;
    std::vector<EnsembleGroup> groups;
    for(const LabelRuns &label : runs.labels)
      for(const Level &level : label.levels)
      {
        EnsembleGroup group{fmt::format("{}, n = {}", label.label, level.n), {}};
        for(const cases::ReportedScalar &scalar : table_scalars(record))
        {
          const auto found = level.values.find(scalar.name);
          if(found == level.values.end())
            continue;
          EnsembleRow row = row_of(found->second);
          row.quantity = scalar.name;
          row.meaning = scalar.meaning;
          row.printed = printed_value(record, label.label, level.n, scalar.name);
          row.criterion = criterion_on(result, record, label.label, level.n, scalar.name);
          const bool asked = row.criterion || std::isfinite(row.printed);
          if(asked || (!several && !is_of_one_particle(scalar.name)))
            group.rows.push_back(row);
        }
        if(!group.rows.empty())
          groups.push_back(group);
      }
    return groups;
  }

  std::string verdict_of(const EnsembleRow &row)
  {
    return !row.criterion ? "" : row.criterion->passed ? "PASS" : "FAIL";
  }

  Markup ensemble_markup(const std::vector<EnsembleGroup> &groups)
  {
    const Columns columns(groups);
    Markup head;
    for(const Column &column : headings(columns))
      head += element(
          "th",
          column.numeric || column.heading == "bounds" ? Attributes{{"class", "number"}}
                                                       : Attributes{},
          text(column.heading)
              + (column.unit.empty()
                     ? Markup()
                     : element("span", {{"class", "unit"}}, text(column.unit))));
    Markup bodies;
    for(const EnsembleGroup &group : groups)
    {
      Markup rows;
      if(groups.size() > 1)
        rows += element("tr", {{"class", "group"}},
                        element("th",
                                {{"colspan", std::to_string(headings(columns).size())}},
                                element("span", group.label)));
      for(const EnsembleRow &row : group.rows)
        rows += row_markup(row, columns);
      bodies += element("tbody", rows);
    }
    return element("div", {{"class", "scroll plain"}},
                   element("table", element("thead", element("tr", head)) + bodies));
  }

  Table ensemble_table(const std::vector<EnsembleGroup> &groups)
  {
    const Columns columns(groups);
    Table table;
    table.group_heading = "method";
    table.columns = headings(columns);
    for(const EnsembleGroup &group : groups)
    {
      RowGroup &rows = table.groups.emplace_back();
      rows.label = group.label;
      for(const EnsembleRow &row : group.rows)
        rows.rows.push_back(cells(row, columns));
    }
    return table;
  }

  std::string ensemble_csv(const std::vector<EnsembleGroup> &groups)
  {
    std::string csv = "runs_of,quantity,meaning,printed,mean,standard_deviation,"
                      "standard_error,runs,lower,upper,verdict\n";
    const auto number = [](double value)
    { return std::isfinite(value) ? fmt::format("{:.12g}", value) : std::string("nan"); };
    for(const EnsembleGroup &group : groups)
      for(const EnsembleRow &row : group.rows)
        csv += fmt::format(
            "{},{},{},{},{},{},{},{},{},{},{}\n", csv_field(group.label), row.quantity,
            csv_field(row.meaning), number(row.printed), number(row.mean),
            number(row.deviation), number(row.standard_error), row.runs,
            number(row.criterion ? row.criterion->lower : nan),
            number(row.criterion ? row.criterion->upper : nan), verdict_of(row));
    return csv;
  }

  std::vector<FluidParticle> fluid_particles(const Level &level)
  {
    std::vector<FluidParticle> list;
    for(int particle = 1; particle <= cases::most_named_particles; ++particle)
    {
      const auto found = level.values.find(fmt::format("fluid_end_{}", particle));
      if(found == level.values.end() || !(found->second.mean > 0))
        continue;
      const SeedMean &share = found->second;
      list.push_back({particle, static_cast<int>(std::lround(share.mean * share.count)),
                      share.mean});
    }
    std::ranges::stable_sort(list, std::greater(), &FluidParticle::share);
    return list;
  }
} // namespace meltfront::verification
