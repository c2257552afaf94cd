#include <verification/judge/ladder.h>
#include <verification/measure/formulas/run_statistics.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meltfront::verification
{
  namespace
  {
    using cases::nan;

    constexpr std::size_t counted_levels = 3;
    constexpr int common_times = 96;
    constexpr double left_out_share = 0.05;   ///< of the duration, at its start
    constexpr double near_share = 0.1 + 1e-9; ///< of the length: places near another
    constexpr double smallest_error = 1e-12;  ///< of a quantity's size

    using Values = std::vector<double>;

    double root_mean_square(const Values &one, const Values &other, std::size_t first)
    {
      ErrorStatistics differences;
      for(std::size_t i = first; i < one.size(); ++i)
        differences.add(one[i] - other[i]);
      return differences.root_mean_square();
    }

    /** Levels over each other: their values at times that they share. */
    class CommonCourse
    {
    public:
      CommonCourse(const std::vector<const RunRecord *> &levels,
                   Values RunSeries::*quantity)
      {
        double first = -std::numeric_limits<double>::infinity(), last = -first;
        for(const RunRecord *run : levels)
          if(const Values &time = run->series.time; !time.empty())
          {
            first = std::max(first, time.front());
            last = std::min(last, time.back());
          }
        const double start = first + left_out_share * (last - first);
        for(const RunRecord *run : levels)
        {
          const RunSeries &series = run->series;
          Values at_times;
          if((series.*quantity).size() == series.time.size() && !series.time.empty())
            at_times = read(series.time, series.*quantity, start, last);
          at_levels.push_back(std::move(at_times));
        }
      }

      /** D between neighbouring levels. @param last_half only of the duration */
      Values differences(bool last_half) const
      {
        Values found;
        for(std::size_t k = 0; k + 1 < at_levels.size(); ++k)
          found.push_back(at_levels[k].empty() || at_levels[k + 1].empty()
                              ? nan
                              : root_mean_square(at_levels[k], at_levels[k + 1],
                                                 last_half ? common_times / 2 : 0));
        return found;
      }

    private:
      static Values read(const Values &time, const Values &values, double start,
                         double last)
      {
        const double origin = time.front();
        const auto clock = [&](double t) { return std::sqrt(std::max(0., t - origin)); };
        Values roots(time.size());
        std::ranges::transform(time, roots.begin(), clock);
        const double tolerance = 1e-9 * roots.back();
        Values read_values;
        for(int i = 0; i < common_times; ++i)
        {
          const double t = start + i * (last - start) / (common_times - 1);
          read_values.push_back(
              interpolated(roots, values, std::min(clock(t), roots.back()), tolerance));
        }
        return read_values;
      }

      std::vector<Values> at_levels;
    };

    BarLevel level_of(const RunRecord &run, bool in_time, double value)
    {
      return {in_time ? run.description.time_step : run.description.spacing,
              run.cost.steps, value};
    }

    /** A level of the two finest and the same at half its step; nothing where there are
     * none. */
    class StepCheck
    {
    public:
      StepCheck(const Ladder &ladder, const std::vector<const RunRecord *> &levels,
                double order)
        : order(order)
      {
        const auto first = levels.end() - std::min<long>(2, std::ssize(levels));
        if(ladder.half_step
           && std::find(first, levels.end(), ladder.whole_step) != levels.end())
        {
          runs = {ladder.whole_step, ladder.half_step};
          to_finest
              = std::pow(steps_of(*ladder.whole_step) / steps_of(*levels.back()), order);
        }
      }

      bool measured() const
      {
        return !runs.empty();
      }

      const std::vector<const RunRecord *> &of() const
      {
        return runs;
      }

      /** Of the finest level by its time step. */
      double error(double difference, double norm) const
      {
        return to_finest
               * error_of_step(difference, norm, steps_of(*runs[1]) / steps_of(*runs[0]),
                               order);
      }

    private:
      double order;
      std::vector<const RunRecord *> runs; ///< at the step and at half of it
      double to_finest = 1; ///< error of the finest level's step over that of runs[0]
    };

    void set_error(QuantityBar &known)
    {
      if(!std::isnan(known.exact))
        known.error = std::max(std::abs(known.bar.value - known.exact),
                               smallest_error * known.scale);
    }

    /** The quantity of a series at its end, and of the front its course. */
    class SeriesBars
    {
    public:
      SeriesBars(const Ladder &ladder, const std::vector<const RunRecord *> &levels)
        : ladder(ladder)
        , levels(levels)
        , constants(bar_constants(*levels.back()))
        , step(ladder, levels, constants.order_in_time)
      {
      }

      std::vector<QuantityBar> all() const
      {
        std::vector<QuantityBar> bars;
        const RunRecord &finest = *levels.back();
        if(one_coordinate())
          add("front", &RunSeries::front, constants.front,
              finest.series.front_exact.empty() ? nan : finest.series.front_exact.back(),
              bars);
        add_course(bars);
        add("solid_volume", &RunSeries::solid_volume, constants.volume,
            finest.solid_volume_exact, bars);
        add("heat", &RunSeries::heat, constants.heat, finest.heat_exact, bars);
        for(QuantityBar &bar : bars)
        {
          if(const double unseen = finest.quantity(bar.quantity + "_unseen"); unseen > 0)
            add_unseen(unseen, bar.bar);
          if(bar.quantity == "heat")
            bar.bar.bar = std::max(bar.bar.bar, heat_missing(finest));
        }
        return bars;
      }

    private:
      /** Else the record's front is that of a circle or ball of the solid's volume. */
      bool one_coordinate() const
      {
        const auto &probes = levels.back()->probes;
        return probes.empty() || !probes.front().coordinate.empty();
      }

      /** Levels that all miss a layer at a wall, what is left of a body, or heat, agree
       * without being right. */
      static void add_unseen(double unseen, ErrorBar &bar)
      {
        if(!(bar.bar < unseen))
          return;
        bar.bar = unseen;
        bar.remark += bar.remark.empty() ? "" : "; ";
        bar.remark += "a layer at a wall, a body, or heat that the budget lacks, of "
                      "which no site tells";
      }

      /** What the budget of a run lacks or has too much at its end (J/m^2, J/m or J): an
       * error that it tells itself, of whatever levels do not. */
      static double heat_missing(const RunRecord &run)
      {
        const Values &heat = run.series.heat, &defect = run.series.budget_defect;
        if(heat.empty() || defect.empty())
          return 0;
        const double size = std::max({std::abs(heat.front()), std::abs(heat.back()),
                                      std::abs(heat.back() - heat.front())});
        return size * std::abs(defect.back());
      }

      static double end_of(const RunRecord &run, Values RunSeries::*quantity)
      {
        const Values &values = run.series.*quantity;
        return values.empty() ? nan : values.back();
      }

      void add(const char *name, Values RunSeries::*quantity, const BarTrust &trust,
               double exact, std::vector<QuantityBar> &bars) const
      {
        std::vector<BarLevel> values;
        for(const RunRecord *run : levels)
        {
          const double end = end_of(*run, quantity);
          if(!std::isfinite(end))
            return;
          values.push_back(level_of(*run, ladder.in_time, end));
        }
        QuantityBar known;
        known.quantity = name;
        known.scale = std::abs(values.back().value);
        BarRecipe recipe = bar_recipe(constants, trust, known.scale, ladder.in_time);
        if(step.measured())
          recipe.time_error = step.error(
              end_of(*step.of()[0], quantity) - end_of(*step.of()[1], quantity),
              CommonCourse(step.of(), quantity).differences(true).front());
        known.bar
            = error_bar(values, CommonCourse(levels, quantity).differences(true), recipe);
        known.exact = exact;
        set_error(known);
        bars.push_back(known);
      }

      /** Its value is zero, the difference from what is found: the bar is of the root
       * mean square error over time. */
      void add_course(std::vector<QuantityBar> &bars) const
      {
        if(bars.empty() || bars.back().quantity != "front" || levels.size() < 2)
          return;
        const Values differences
            = CommonCourse(levels, &RunSeries::front).differences(false);
        // Each level's distance from the finest stands for its value: their differences
        // are those over time.
        std::vector<BarLevel> values;
        double distance = 0;
        for(std::size_t k = levels.size(); k-- > 0;)
        {
          values.insert(values.begin(), level_of(*levels[k], ladder.in_time, distance));
          if(k > 0)
            distance += differences[k - 1];
        }
        QuantityBar known;
        known.quantity = front_course;
        known.scale = bars.back().scale;
        BarRecipe recipe
            = bar_recipe(constants, constants.front, known.scale, ladder.in_time);
        if(step.measured())
        {
          const double difference
              = CommonCourse(step.of(), &RunSeries::front).differences(false).front();
          recipe.time_error = step.error(difference, difference);
        }
        known.bar = error_bar(values, differences, recipe);
        const double rms = levels.back()->quantity("front_rms");
        if(std::isfinite(rms))
          known.error = std::max(rms, smallest_error * known.scale);
        bars.push_back(known);
      }

      const Ladder &ladder;
      const std::vector<const RunRecord *> &levels;
      BarConstants constants;
      StepCheck step;
    };

    std::string probe_name(const TemperatureProbe &probe)
    {
      return probe.coordinate.empty()
                 ? fmt::format("temperature at ({:.6g})", fmt::join(probe.place, ", "))
                 : fmt::format("temperature at {} = {:.6g}", probe.coordinate,
                               probe.place.front());
    }

    double distance(const Values &one, const Values &other)
    {
      double squares = 0;
      for(std::size_t d = 0; d < one.size(); ++d)
        squares += (one[d] - other[d]) * (one[d] - other[d]);
      return std::sqrt(squares);
    }

    /** Temperatures at the places that all levels have. */
    class TemperatureBars
    {
    public:
      TemperatureBars(const Ladder &ladder, const std::vector<const RunRecord *> &levels)
        : ladder(ladder)
        , levels(levels)
        , constants(bar_constants(*levels.back()))
        , step(ladder, levels, constants.order_in_time)
      {
        const auto &probes = levels.back()->probes;
        for(std::size_t i = 0; i < probes.size(); ++i)
          if(std::ranges::all_of(levels,
                                 [&](const RunRecord *run)
                                 {
                                   return run->probes.size() == probes.size()
                                          && std::isfinite(run->probes[i].temperature);
                                 }))
            places.push_back(i);
      }

      std::vector<QuantityBar> all() const
      {
        std::vector<QuantityBar> bars;
        if(places.empty())
          return bars;
        double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
        const Values differences = differences_of_levels(0, true);
        for(const std::size_t i : places)
        {
          lowest = std::min(lowest, finest(i).temperature);
          highest = std::max(highest, finest(i).temperature);
        }
        for(const std::size_t i : places)
          bars.push_back(bar_at(i, highest - lowest, differences));
        return bars;
      }

    private:
      const TemperatureProbe &finest(std::size_t i) const
      {
        return levels.back()->probes[i];
      }

      /** D of two runs over places near one of them, or all. */
      double difference(const RunRecord &one, const RunRecord &other, std::size_t around,
                        bool everywhere) const
      {
        const double length
            = distance(finest(places.front()).place, finest(places.back()).place);
        ErrorStatistics found;
        for(const std::size_t i : places)
          if(everywhere
             || distance(finest(i).place, finest(around).place) <= near_share * length)
            found.add(one.probes[i].temperature - other.probes[i].temperature);
        return found.root_mean_square();
      }

      Values differences_of_levels(std::size_t around, bool everywhere) const
      {
        Values differences;
        for(std::size_t k = 0; k + 1 < levels.size(); ++k)
          differences.push_back(
              difference(*levels[k], *levels[k + 1], around, everywhere));
        return differences;
      }

      double time_error(std::size_t i) const
      {
        const RunRecord &whole = *step.of()[0], &half = *step.of()[1];
        if(half.probes.size() != whole.probes.size())
          return nan;
        return step.error(whole.probes[i].temperature - half.probes[i].temperature,
                          difference(whole, half, i, false));
      }

      QuantityBar bar_at(std::size_t i, double range, const Values &differences) const
      {
        std::vector<BarLevel> values;
        for(const RunRecord *run : levels)
          values.push_back(level_of(*run, ladder.in_time, run->probes[i].temperature));
        BarRecipe recipe
            = bar_recipe(constants, constants.temperature, range, ladder.in_time);
        recipe.local_differences = differences_of_levels(i, false);
        if(step.measured())
          recipe.time_error = time_error(i);
        QuantityBar known;
        known.quantity = probe_name(finest(i));
        known.scale = range;
        known.bar = error_bar(values, differences, recipe);
        known.exact = finest(i).temperature_exact;
        set_error(known);
        return known;
      }

      const Ladder &ladder;
      const std::vector<const RunRecord *> &levels;
      BarConstants constants;
      StepCheck step;
      std::vector<std::size_t> places; ///< numbers of probes
    };
  } // namespace

  std::vector<QuantityBar> bars_of(const Ladder &ladder)
  {
    const std::size_t count = std::min(ladder.levels.size(), counted_levels);
    const std::vector<const RunRecord *> levels(ladder.levels.end() - count,
                                                ladder.levels.end());
    std::vector<QuantityBar> bars = SeriesBars(ladder, levels).all();
    for(QuantityBar &bar : TemperatureBars(ladder, levels).all())
      bars.push_back(std::move(bar));
    return bars;
  }

  double course_difference(const RunRecord &one, const RunRecord &other,
                           std::vector<double> RunSeries::*quantity)
  {
    return CommonCourse({&one, &other}, quantity).differences(false).front();
  }
} // namespace meltfront::verification
