#include <verification/report/plots/plot_data.h>
#include <verification/report/plots/seed_curves.h>
#include <verification/report/plots/solid_plots.h>

#include <cases/reported_scalars.h>
#include <verification/measure/formulas/order_fit.h>
#include <verification/report/plots/curve_labels.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    double solid_particles(const RunSeries &series, const std::size_t i)
    {
      return entry(series.solid_volume, i);
    }

    /** The frames of a paper that say how many particles are solid. */
    Curve printed_points(const StoredCase &record)
    {
      Curve curve;
      curve.label = "printed";
      curve.line = false;
      const std::vector<double> &intermediate_times
          = record.measurement.intermediate_times;
      for(const cases::PrintedValue &printed : record.printed)
        for(std::size_t intermediate = 0; intermediate <= intermediate_times.size();
            ++intermediate)
        {
          const bool end = intermediate == intermediate_times.size();
          if(printed.quantity
             != (end ? "solid_end" : fmt::format("solid_{}", intermediate + 1)))
            continue;
          curve.x.push_back(end ? record.scene.end_time
                                : intermediate_times[intermediate]);
          curve.y.push_back(printed.value);
        }
      return curve;
    }

    bool constant(const Plot &plot)
    {
      double least = INFINITY, most = -INFINITY;
      for(const Curve &curve : plot.curves)
        for(const double y : curve.y)
        {
          least = std::fmin(least, y);
          most = std::fmax(most, y);
        }
      return !(most > least);
    }

    struct EnergyError
    {
      double time_step, error;
    };

    /** Of all labels, largest step first. */
    std::vector<EnergyError> energy_errors(const CaseRuns &runs)
    {
      std::vector<EnergyError> errors;
      for(const LabelRuns &label : runs.labels)
        for(const Level &level : label.levels)
          if(std::isfinite(level.value("energy_error")) && level.value("dt") > 0)
            errors.push_back({level.value("dt"), level.value("energy_error")});
      std::ranges::stable_sort(errors, std::greater(), &EnergyError::time_step);
      return errors;
    }
  } // namespace

  Plot solid_particles_over_time(const CaseRuns &runs, const MethodStyles &styles)
  {
    Plot plot;
    plot.description = "Solid particles against time, " + runs.record->name();
    plot.x.label = with_unit("time", unit_of(*runs.record, "s"));
    plot.y.label = "solid particles";
    for(const LabelRuns &label : runs.labels)
      for(const Level &level : label.levels)
        if(level.finished)
        {
          Curve curve = mean_over_runs(level, solid_particles);
          curve.label = label.label;
          curve.style = styles.style(label.label);
          plot.curves.push_back(std::move(curve));
        }
    if(constant(plot))
    {
      plot.curves.clear();
      return plot;
    }
    shorten_labels(plot);
    if(Curve printed = printed_points(*runs.record); !printed.x.empty())
      plot.curves.push_back(std::move(printed));
    return plot;
  }

  Plot energy_over_temperature(const CaseRuns &runs, const MethodStyles &styles)
  {
    Plot plot;
    plot.description = "Energy of a particle against temperature, " + runs.record->name();
    plot.x.label = with_unit("temperature", unit_of(*runs.record, "K"));
    plot.y.label = "energy of a particle";
    for(const LabelRuns &label : runs.labels)
      for(const Level &level : label.levels)
      {
        Curve curve;
        curve.label = label.label;
        curve.style = styles.style(label.label);
        for(int stage = 1; stage <= cases::most_stages; ++stage)
        {
          const std::string energy = fmt::format("energy_stage_{}", stage);
          const double temperature
              = level.value(fmt::format("temperature_stage_{}", stage));
          if(!std::isfinite(temperature + level.value(energy)))
            continue;
          curve.x.push_back(temperature);
          curve.y.push_back(level.value(energy));
          curve.spread.push_back(level.spread(energy));
        }
        if(level.finished_count < 2)
          curve.spread.clear();
        if(curve.x.size() > 1)
          plot.curves.push_back(std::move(curve));
      }
    shorten_labels(plot);
    return plot;
  }

  Plot energy_over_time_step(const CaseRuns &runs, const MethodStyles &styles)
  {
    Plot plot;
    plot.description = "Error of the energy against time step, " + runs.record->name();
    plot.x.logarithmic = plot.y.logarithmic = true;
    plot.x.label = with_unit("time step dt", unit_of(*runs.record, "s"));
    plot.y.label = "largest change of the energy";
    plot.guides = {{2, "dt"}};
    Curve &curve = plot.curves.emplace_back();
    for(const EnergyError &error : energy_errors(runs))
    {
      curve.x.push_back(error.time_step);
      curve.y.push_back(error.error);
    }
    const OrderFit fit = fit_order(curve.x, curve.y);
    curve.label = runs.labels.empty() ? "" : base_method(runs.labels.front().label);
    if(!runs.labels.empty())
      curve.style = styles.style(runs.labels.front().label);
    curve.style.dash = 0;
    if(std::isfinite(fit.order))
      curve.exponent = fmt::format("dt^{:.2f}", fit.order);
    return plot;
  }

  Table energy_table(const CaseRuns &runs)
  {
    const std::vector<EnergyError> errors = energy_errors(runs);
    Table table;
    if(errors.size() < 2)
      return table;
    table.columns = {{"dt", unit_of(*runs.record, "s"), true},
                     {"largest change of the energy", "", true},
                     {"over that of the next", "", true}};
    RowGroup &group = table.groups.emplace_back();
    for(std::size_t i = 0; i < errors.size(); ++i)
    {
      const double ratio
          = i + 1 < errors.size() ? errors[i].error / errors[i + 1].error : std::nan("");
      group.rows.push_back(
          {{number_text(errors[i].time_step, 3, Notation::scientific)},
           {number_text(errors[i].error, 4, Notation::scientific)},
           {std::isfinite(ratio) ? NumberText{fmt::format("{:.3f}", ratio), {}}
                                 : NumberText()}});
    }
    return table;
  }
} // namespace meltfront::verification
