#include <verification/report/tables/convergence_table.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    using cases::PrintedValue;

    /** Printed values of one source, method and quantity, with what was measured. */
    struct PrintedSeries
    {
      std::string source, method, quantity;
      std::vector<int> n;
      std::vector<double> printed;
      std::vector<double> measured; ///< NaN where no run finished
    };

    double measured_value(const CaseRuns &runs, const PrintedValue &printed)
    {
      const LabelRuns *label = runs.find(printed.method);
      if(label)
        for(const Level &level : label->levels)
          if(level.n == printed.n)
            return level.value(printed.quantity);
      return std::nan("");
    }

    std::vector<PrintedSeries> printed_series(const CaseRuns &runs)
    {
      std::vector<PrintedSeries> list;
      for(const PrintedValue &value : runs.record->printed)
      {
        auto found = std::find_if(list.begin(), list.end(),
                                  [&value](const PrintedSeries &series)
                                  {
                                    return series.source == value.source
                                           && series.method == value.method
                                           && series.quantity == value.quantity;
                                  });
        if(found == list.end())
          found = list.insert(list.end(),
                              {value.source, value.method, value.quantity, {}, {}, {}});
        found->n.push_back(value.n);
        found->printed.push_back(value.value);
        found->measured.push_back(measured_value(runs, value));
      }
      return list;
    }

    double deviation(double measured, double printed)
    {
      return 100 * (measured - printed) / std::abs(printed);
    }

    /** The order in n: papers state it against the number of particles along a side. */
    Cell order_in_n(const std::vector<int> &n, const std::vector<double> &values)
    {
      std::vector<double> spacing, finite;
      for(std::size_t i = 0; i < n.size(); ++i)
        if(std::isfinite(values[i]))
        {
          spacing.push_back(1. / n[i]);
          finite.push_back(values[i]);
        }
      OrderFit fit = fit_order(spacing, finite);
      fit.order = -fit.order;
      return order_cell(fit, "n");
    }

    /** As many significant digits as the paper prints, at least three. */
    int printed_digits(const std::vector<double> &printed)
    {
      constexpr int least = 3, most = 8;
      int digits = least;
      for(const double value : printed)
        while(digits < most
              && std::stod(fmt::format("{:.{}e}", value, digits - 1)) != value)
          ++digits;
      return digits;
    }

    NumberText signed_percent(double value)
    {
      return std::isfinite(value) ? NumberText{fmt::format("{:+.1f}", value), {}}
                                  : NumberText();
    }
  } // namespace

  Table printed_table(const CaseRuns &runs)
  {
    Table table;
    table.group_heading = "source";
    table.columns = {{"n", "", true},
                     {"printed", "", true},
                     {"measured", "", true},
                     {"deviation", "%", true}};
    for(const PrintedSeries &series : printed_series(runs))
    {
      RowGroup &group = table.groups.emplace_back();
      group.label = fmt::format("{}: {}, {}", series.source, series.method,
                                quantity_heading(series.quantity));
      auto both = series.printed;
      both.insert(both.end(), series.measured.begin(), series.measured.end());
      const Notation notation = column_notation(both);
      const int digits = printed_digits(series.printed);
      for(std::size_t i = 0; i < series.n.size(); ++i)
        group.rows.push_back(
            {{NumberText{std::to_string(series.n[i]), {}}},
             {number_text(series.printed[i], digits, notation)},
             {number_text(series.measured[i], digits, notation)},
             {signed_percent(deviation(series.measured[i], series.printed[i]))}});
      if(series.n.size() > 1)
        group.summary.push_back({{std::string("order")},
                                 order_in_n(series.n, series.printed),
                                 order_in_n(series.n, series.measured),
                                 {std::string()}});
    }
    return table;
  }

  std::string printed_csv(const CaseRuns &runs)
  {
    std::string csv = "source,method,quantity,n,printed,measured,deviation_percent\n";
    const auto number = [](double value)
    { return std::isnan(value) ? std::string("nan") : fmt::format("{:.12g}", value); };
    for(const PrintedSeries &series : printed_series(runs))
      for(std::size_t i = 0; i < series.n.size(); ++i)
        csv += fmt::format("{},{},{},{},{},{},{}\n", csv_field(series.source),
                           csv_field(series.method), csv_field(series.quantity),
                           series.n[i], number(series.printed[i]),
                           number(series.measured[i]),
                           number(deviation(series.measured[i], series.printed[i])));
    return csv;
  }
} // namespace meltfront::verification
