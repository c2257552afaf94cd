#include <verification/report/plots/case_plots.h>

#include <verification/report/plots/curve_labels.h>
#include <verification/report/plots/plot_data.h>
#include <verification/report/tables/convergence_table.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    /** A curve over the finest run of every label. */
    template <typename Value>
    void add_finest(Plot &plot, const CaseRuns &runs, const MethodStyles &styles,
                    const Value &value)
    {
      for(const LabelRuns &label : runs.labels)
        if(const RunRecord *run = label.finest())
        {
          Curve &curve = plot.curves.emplace_back();
          curve.label = label.label;
          curve.style = styles.style(label.label);
          for(const std::size_t i : thinned(run->series.time.size()))
          {
            curve.x.push_back(run->series.time[i]);
            curve.y.push_back(value(run->series, i));
          }
        }
      shorten_labels(plot);
    }

    /** The exact front of the run that sampled it most often. */
    void add_exact_front(Plot &plot, const CaseRuns &runs)
    {
      const RunSeries *longest = nullptr;
      for(const LabelRuns &label : runs.labels)
        if(const RunRecord *run = label.finest();
           run && !run->series.front_exact.empty()
           && (!longest || run->series.front_exact.size() > longest->front_exact.size()))
          longest = &run->series;
      if(!longest)
        return;
      Curve &curve = plot.curves.emplace_back();
      curve.label = "exact";
      curve.markers = false;
      for(const std::size_t i : thinned(longest->time.size()))
      {
        curve.x.push_back(longest->time[i]);
        curve.y.push_back(entry(longest->front_exact, i));
      }
    }

    std::string error_label(const StoredCase &record, const std::string &error)
    {
      if(error.starts_with("shape"))
        return "mismatch of the region, relative";
      if(error.starts_with("consensus"))
        return "distance from the consensus, relative";
      const std::string unit = error.starts_with("front") ? "m" : volume_unit(record);
      if(error.starts_with("temperature"))
        return "temperature error, RMS over the largest";
      const char *words = error == "front_rms"   ? "front error, RMS"
                          : error == "front_end" ? "front error, end"
                                                 : "solid's error, end";
      return with_unit(words, unit_of(record, unit));
    }

    /** The abscissa of a level; of a run without a description, the h that it would have
     * had. */
    double abscissa_of(const Level &level, const StoredCase &record,
                       const std::string &name)
    {
      if(level.finished || name != "h")
        return level.value(name);
      const double h = level.runs.front()->description.spacing;
      return h > 0 ? h : record.scene.domain.side() / level.n;
    }

    /** The errors of one label, and marks for what did not finish. */
    void add_errors(Plot &plot, const CaseRuns &runs, const LabelRuns &label,
                    const LineStyle &style, const std::string &abscissa,
                    const std::string &error, double scale)
    {
      Curve curve;
      curve.label = label.label;
      curve.style = style;
      bool several_seeds = false;
      for(const Level &level : label.levels)
      {
        const double x = abscissa_of(level, *runs.record, abscissa);
        if(!level.finished)
        {
          plot.failed.push_back({x, style});
          continue;
        }
        curve.x.push_back(x);
        curve.y.push_back(
            (error == main_error(runs) ? shown_error(level, runs) : level.value(error))
            * scale);
        curve.spread.push_back(level.spread(error) * scale);
        several_seeds = several_seeds || level.finished_count > 1;
      }
      if(!several_seeds)
        curve.spread.clear();
      const OrderFit fit = order_of(*runs.record, label, error);
      if(abscissa == label.refinement.symbol() && std::isfinite(fit.order)
         && fit.verdict != OrderVerdict::too_few_levels)
        curve.exponent = fmt::format("{}^{:.2f}", abscissa, fit.order);
      plot.curves.push_back(std::move(curve));
    }

    /** Errors against h or dt, of the labels that refine it; against anything else, of
     * all. */
    Plot error_plot(const CaseRuns &runs, const MethodStyles &styles,
                    const std::string &abscissa, double scale)
    {
      const bool resolution = abscissa == "h" || abscissa == "dt";
      const bool few_steps = abscissa == "dt" && runs.has("front_end")
                             && runs.record->scene.changes_phase();
      const std::string error = few_steps ? "front_end" : main_error(runs);
      Plot plot;
      plot.x.logarithmic = plot.y.logarithmic = true;
      plot.y.label = error_label(*runs.record, error);
      for(const LabelRuns &label : runs.labels)
        if(!resolution || label.refinement.symbol() == abscissa)
          add_errors(plot, runs, label, styles.style(label.label), abscissa, error,
                     scale);
      shorten_labels(plot);
      return plot;
    }

    bool has_several_levels(const CaseRuns &runs)
    {
      return std::any_of(runs.labels.begin(), runs.labels.end(),
                         [](const LabelRuns &label) { return label.levels.size() > 1; });
    }
  } // namespace

  Plot error_against_spacing(const CaseRuns &runs, const MethodStyles &styles)
  {
    Plot plot = error_plot(runs, styles, "h", 1);
    plot.description = "Error against spacing, " + runs.record->name();
    plot.x.label = with_unit("spacing h", unit_of(*runs.record, "m"));
    if(has_several_levels(runs))
      plot.guides = {{1, "h"}, {2, "h"}};
    return plot;
  }

  Plot error_against_time_step(const CaseRuns &runs, const MethodStyles &styles)
  {
    Plot plot = error_plot(runs, styles, "dt", 1);
    plot.description = "Error against time step, " + runs.record->name();
    plot.x.label = with_unit("time step dt", unit_of(*runs.record, "s"));
    if(has_several_levels(runs))
      plot.guides = {{2, "dt"}, {4, "dt"}};
    return plot;
  }

  Plot error_against_cost(const CaseRuns &runs, const MethodStyles &styles)
  {
    Plot plot = error_plot(runs, styles, "cpu_seconds", 1);
    plot.description = "Error against CPU time, " + runs.record->name();
    plot.x.label = "CPU time t (s)";
    if(dimensions_of(runs).size() > 1)
      for(std::size_t i = 0; i < plot.curves.size(); ++i)
        plot.curves[i].label
            = fmt::format("{}D {}", runs.labels[i].dimension(), plot.curves[i].label);
    if(has_several_levels(runs))
      plot.guides = {{-0.5, "t"}, {-1, "t"}};
    return plot;
  }

  Plot small_work_precision(const CaseRuns &runs, const MethodStyles &styles,
                            int dimension, const std::string &cost)
  {
    CaseRuns some = runs;
    std::erase_if(some.labels, [dimension](const LabelRuns &label)
                  { return label.dimension() != dimension; });
    const bool seconds = cost == "cpu_seconds";
    Plot plot = error_plot(some, styles, cost, 1 / main_error_scale(runs));
    plot.heading = fmt::format("{}, {}D", runs.record->name(), dimension);
    plot.description = fmt::format("Relative error against {}, {}",
                                   seconds ? "CPU time" : "work", plot.heading);
    plot.small = true;
    plot.x.label = seconds ? "CPU time (s)" : "work (entries touched)";
    plot.y.label = "relative error";
    return plot;
  }

  Plot front_against_time(const CaseRuns &runs, const MethodStyles &styles)
  {
    Plot plot;
    plot.description = "Front against time, " + runs.record->name();
    plot.x.label = with_unit("time", unit_of(*runs.record, "s"));
    plot.y.label = with_unit("front", unit_of(*runs.record, "m"));
    add_finest(plot, runs, styles,
               [](const RunSeries &series, std::size_t i)
               { return entry(series.front, i); });
    add_exact_front(plot, runs);
    return plot;
  }

  Plot front_of_resolutions(const CaseRuns &runs, const LabelRuns &label)
  {
    Plot plot;
    plot.description = "Front against time of all resolutions, " + runs.record->name();
    plot.x.label = with_unit("time", unit_of(*runs.record, "s"));
    plot.y.label = with_unit("front", unit_of(*runs.record, "m"));
    std::vector<std::string> names;
    for(const Level &level : label.levels)
      names.push_back(fmt::format("n = {}", level.n));
    const MethodStyles styles(names);
    for(const Level &level : label.levels)
    {
      if(!level.finished)
        continue;
      Curve &curve = plot.curves.emplace_back();
      curve.label = fmt::format("n = {}", level.n);
      curve.style = styles.style(curve.label);
      const RunSeries &series = level.finished->series;
      for(const std::size_t i : thinned(series.time.size()))
      {
        curve.x.push_back(series.time[i]);
        curve.y.push_back(entry(series.front, i));
      }
    }
    add_exact_front(plot, runs);
    return plot;
  }

  Plot front_error_against_time(const CaseRuns &runs, const MethodStyles &styles)
  {
    Plot plot;
    plot.description = "Front error against time, " + runs.record->name();
    plot.x.label = with_unit("time", unit_of(*runs.record, "s"));
    plot.y.label = with_unit("|front − exact front|", unit_of(*runs.record, "m"));
    plot.y.logarithmic = true;
    add_finest(plot, runs, styles,
               [](const RunSeries &series, std::size_t i) {
                 return std::abs(entry(series.front, i) - entry(series.front_exact, i));
               });
    return plot;
  }

  Plot solid_against_time(const CaseRuns &runs, const MethodStyles &styles)
  {
    Plot plot;
    plot.description = "Volume that is solid against time, " + runs.record->name();
    plot.x.label = with_unit("time", unit_of(*runs.record, "s"));
    plot.y.label = with_unit("solid", unit_of(*runs.record, volume_unit(*runs.record)));
    add_finest(plot, runs, styles,
               [](const RunSeries &series, std::size_t i)
               { return entry(series.solid_volume, i); });
    return plot;
  }

  Plot budget_against_time(const CaseRuns &runs, const MethodStyles &styles)
  {
    Plot plot;
    plot.description = "Defect of the heat budget against time, " + runs.record->name();
    plot.x.label = with_unit("time", unit_of(*runs.record, "s"));
    plot.y.label = "relative heat budget defect";
    plot.y.logarithmic = true;
    static constexpr double round_off = 1e-17;
    add_finest(plot, runs, styles,
               [](const RunSeries &series, std::size_t i)
               {
                 const double defect = entry(series.budget_defect, i);
                 return std::isnan(defect) ? defect
                                           : std::max(std::abs(defect), round_off);
               });
    return plot;
  }
} // namespace meltfront::verification
