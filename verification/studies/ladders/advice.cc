#include <verification/record/json_values.h>
#include <verification/studies/ladders/advice.h>
#include <verification/studies/ladders/method_priors.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace meltfront::verification
{
  namespace
  {
    using cases::nan;

    constexpr double margin_of_coarse = 1.5, margin_of_fine = 1.25;
    constexpr double fine_error = 1e-3;
    constexpr double least_order = 0.5;
    constexpr double farthest = 8; ///< beyond the finest pilot: extrapolated

    double margin(double wanted)
    {
      return wanted >= fine_error ? margin_of_coarse : margin_of_fine;
    }

    /** The error of a ladder's finest level as its levels tell, and how it falls. */
    struct ErrorModel
    {
      double error = nan; ///< relative
      double order = nan;
      int n = 0; ///< of the finest level

      double at(int other) const
      {
        return error * std::pow(static_cast<double>(n) / other, order);
      }

      /** Least n that is expected to reach an error. */
      int resolution_for(double wanted) const
      {
        const double exact = margin(wanted) * n * std::pow(error / wanted, 1 / order);
        return static_cast<int>(std::ceil(std::min(exact, 1e7)));
      }
    };

    /** Differences between neighbouring levels to the model of the error. */
    ErrorModel model_of(const std::vector<int> &n, const std::vector<double> &differences,
                        double order, double lowest_order)
    {
      ErrorModel model;
      const std::size_t levels = n.size();
      if(levels < 2 || !(differences.back() >= 0))
        return model;
      model.n = n.back();
      model.order = levels > 2 ? order : lowest_order;
      if(levels > 2)
      {
        const auto ratio
            = [&](std::size_t k) { return static_cast<double>(n[k]) / n[k - 1]; };
        const double observed
            = observed_order(differences[levels - 3] / differences[levels - 2],
                             ratio(levels - 1), ratio(levels - 2));
        if(std::isfinite(observed))
          model.order = std::clamp(observed, least_order, order);
      }
      const double refined = static_cast<double>(n[levels - 1]) / n[levels - 2];
      model.error = differences.back() / (std::pow(refined, model.order) - 1);
      return model;
    }

    std::optional<Ladder> ladder_of(const std::vector<Ladder> &ladders,
                                    const std::string &method)
    {
      const auto found = std::ranges::find(ladders, method, &Ladder::label);
      return found == ladders.end() ? std::nullopt : std::optional(*found);
    }

    std::vector<int> resolutions_of(const Ladder &ladder)
    {
      std::vector<int> n;
      for(const RunRecord *run : ladder.levels)
        n.push_back(run->n);
      return n;
    }

    bool has_front(const Ladder &ladder)
    {
      const auto &front = ladder.levels.back()->series.front;
      return !front.empty() && std::isfinite(front.back());
    }

    /** Else by the solid's volume: the record's front is that of a circle or a ball of
     * this volume where it has no single coordinate (bars_of() gives none, either). */
    bool judged_by_front(const Ladder &ladder)
    {
      const RunRecord &finest = *ladder.levels.back();
      const bool one_coordinate
          = finest.probes.empty() || !finest.probes.front().coordinate.empty();
      return has_front(ladder) && (one_coordinate || !finest.series.front_exact.empty());
    }

    /** Levels that are near another tell no order: the difference is that of two errors
     * which are nearly the same. */
    Ladder well_apart(const Ladder &ladder)
    {
      constexpr double least_ratio = 1.4;
      Ladder apart = ladder;
      apart.levels.clear();
      for(auto level = ladder.levels.rbegin(); level != ladder.levels.rend(); ++level)
        if(apart.levels.empty() || apart.levels.front()->n >= least_ratio * (*level)->n)
          apart.levels.insert(apart.levels.begin(), *level);
      return apart;
    }

    ErrorModel front_model(const Ladder &all)
    {
      const Ladder ladder = well_apart(all);
      const auto course
          = judged_by_front(ladder) ? &RunSeries::front : &RunSeries::solid_volume;
      const RunRecord &finest = *ladder.levels.back();
      const auto &values = finest.series.*course;
      const double size = values.empty() ? nan : std::abs(values.back());
      std::vector<double> differences;
      for(std::size_t k = 0; k + 1 < ladder.levels.size(); ++k)
        differences.push_back(
            course_difference(*ladder.levels[k], *ladder.levels[k + 1], course) / size);
      const MethodPrior prior = method_prior(ladder.method, finest.description.dimension);
      return model_of(resolutions_of(ladder), differences, prior.order,
                      prior.lowest_order);
    }

    ErrorModel temperature_model(const Ladder &all)
    {
      const Ladder ladder = well_apart(all);
      const auto &probes = ladder.levels.back()->probes;
      double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
      for(const TemperatureProbe &probe : probes)
      {
        lowest = std::min(lowest, probe.temperature);
        highest = std::max(highest, probe.temperature);
      }
      std::vector<double> differences;
      for(std::size_t k = 0; k + 1 < ladder.levels.size(); ++k)
      {
        double squares = 0;
        for(std::size_t i = 0; i < probes.size(); ++i)
        {
          const double d = ladder.levels[k]->probes[i].temperature
                           - ladder.levels[k + 1]->probes[i].temperature;
          squares += d * d / static_cast<double>(probes.size());
        }
        differences.push_back(std::sqrt(squares) / (highest - lowest));
      }
      const double order = bar_constants(*ladder.levels.back()).temperature.order;
      return model_of(resolutions_of(ladder), differences, order, std::min(order, 2.));
    }

    /** The level that reaches the errors: one that is there, or a finer one. */
    int resolution_for(const Ladder &ladder, const ErrorModel &front,
                       const ErrorModel &temperature, const WantedErrors &wanted)
    {
      int n = front.resolution_for(wanted.front);
      if(std::isfinite(wanted.temperature))
        n = std::max(n, temperature.resolution_for(wanted.temperature));
      for(const RunRecord *run : ladder.levels)
        if(run->n >= n)
          return run->n;
      return n + n % 2;
    }

    double cpu_seconds_of(const RunRecord &run)
    {
      return run.cost.setup_cpu + run.cost.stepping_cpu;
    }

    double predicted_cpu(const Ladder &ladder, int n)
    {
      const RunRecord *nearest = ladder.levels.back();
      for(const RunRecord *run : ladder.levels)
        if(run->n == n)
          nearest = run;
      const double growth
          = method_prior(ladder.method, nearest->description.dimension).growth;
      return cpu_seconds_of(*nearest)
             * std::pow(static_cast<double>(n) / nearest->n, growth);
    }

    /** Labels that contradict the consensus on the front, or the solid's volume. */
    std::vector<std::string> contradicting(const std::vector<Answer> &answers)
    {
      std::vector<std::string> labels;
      for(const Answer &answer : answers)
        if((answer.quantity == "front" || answer.quantity == "solid_volume")
           && answer.consensus.agreed)
          for(const MethodAnswer &one : answer.methods)
            if(one.distance_in_bars > 1)
              labels.push_back(one.label);
      return labels;
    }

    /** The largest n that a method can make in so much time, and its error there. */
    MethodForecast best_within(const Ladder &ladder, const cases::Method *method,
                               double seconds)
    {
      const ErrorModel model = front_model(ladder);
      const RunRecord &finest = *ladder.levels.back();
      const double growth
          = method_prior(ladder.method, finest.description.dimension).growth;
      const double n = finest.n * std::pow(seconds / cpu_seconds_of(finest), 1 / growth);
      MethodForecast forecast{method, static_cast<int>(std::clamp(n, 2., 1e7))};
      forecast.n = std::max(forecast.n - forecast.n % 2, finest.n);
      forecast.error = model.at(forecast.n);
      forecast.seconds = predicted_cpu(ladder, forecast.n);
      return forecast;
    }

    const RunRecord &level_at(const Ladder &ladder, int n)
    {
      return **std::ranges::find(ladder.levels, n, &RunRecord::n);
    }

    /** Relative to the front; NaN without an exact one. */
    double true_error(const Ladder &ladder, int n)
    {
      const RunRecord &run = level_at(ladder, n);
      const auto &exact = run.series.front_exact;
      if(!has_front(ladder) || exact.empty())
        return nan;
      // Few steps have no root mean square.
      const double rms = run.quantity("front_rms");
      return (std::isfinite(rms) ? rms : run.quantity("front_end"))
             / std::abs(exact.back());
    }

    /** Of a level, relative: its distance from the finest and the error bar of that. */
    double told_error(const Ladder &ladder, int n)
    {
      const bool front = judged_by_front(ladder);
      for(const QuantityBar &known : bars_of(ladder))
        if(known.quantity == (front ? front_course : "solid_volume"))
          return (known.bar.bar
                  + course_difference(level_at(ladder, n), *ladder.levels.back(),
                                      front ? &RunSeries::front
                                            : &RunSeries::solid_volume))
                 / known.scale;
      return nan;
    }

    void take_outcome(const MatrixResult &result, const MethodForecast &chosen,
                      Advice &advice)
    {
      for(const RunRecord &run : result.runs)
        if(run.method == chosen.method->name() && run.n == chosen.n)
        {
          if(run.status != RunStatus::finished)
          {
            advice.explanation
                += fmt::format(" The run {}: {}.", to_string(run.status), run.message);
            advice.reachable = false;
            return;
          }
          advice.options = run.options;
          advice.seconds = cpu_seconds_of(run);
        }
      const Ladder ladder = *ladder_of(ladders_of(result), chosen.method->name());
      advice.error = true_error(ladder, chosen.n);
      advice.error_is_true = std::isfinite(advice.error);
      if(!advice.error_is_true)
        advice.error = told_error(ladder, chosen.n);
    }

    /** Whether a forecast's run is there, or there is time for it. */
    bool fits_into_time(const LadderGrowth &growth, const MethodForecast &forecast)
    {
      return growth.finest(*forecast.method)->n >= forecast.n
             || forecast.seconds <= growth.seconds_left();
    }

    /** What the time allows, of the method with the least error in it. */
    MethodForecast best_of_all(const LadderGrowth &growth,
                               const std::vector<MethodForecast> &all)
    {
      const std::vector<Ladder> ladders = ladders_of(growth.result());
      MethodForecast best{nullptr};
      for(const MethodForecast &one : all)
      {
        const MethodForecast possible
            = best_within(*ladder_of(ladders, one.method->name()), one.method,
                          growth.seconds_left() / 2);
        if(one.doubt.empty() && (!best.method || possible.error < best.error))
          best = possible;
      }
      return best;
    }

    /** Run what was chosen. */
    void make_chosen(LadderGrowth &growth, MethodForecast chosen, Advice &advice)
    {
      chosen.n = growth.fitting(*chosen.method, chosen.n);
      advice.method = chosen.method->name();
      advice.n = chosen.n;
      advice.predicted_error = chosen.error;
      advice.predicted_seconds = chosen.seconds;
      if(chosen.n > farthest * growth.finest(*chosen.method)->n)
        advice.explanation += fmt::format(
            " Extrapolated: n = {} is more than {} times the finest pilot.", chosen.n,
            farthest);
      growth.make(*chosen.method, chosen.n);
      take_outcome(growth.result(), chosen, advice);
    }

    /** Once more, finer, where the run's difference from the pilots tells a larger error
     * than is wanted. */
    void refine_if_short(LadderGrowth &growth, const MethodForecast &first,
                         const WantedErrors &wanted, Advice &advice)
    {
      const auto seen = [&] {
        return front_model(*ladder_of(ladders_of(growth.result()), first.method->name()));
      };
      const ErrorModel told = seen();
      if(!(told.at(first.n) > wanted.front))
        return;
      MethodForecast finer{first.method, told.resolution_for(wanted.front)};
      finer.error = told.at(finer.n);
      finer.seconds = predicted_cpu(
          *ladder_of(ladders_of(growth.result()), first.method->name()), finer.n);
      if(finer.n > first.n && finer.seconds <= growth.seconds_left())
      {
        Advice second = advice;
        second.explanation
            += fmt::format(" n = {} came out short and was refined.", first.n);
        make_chosen(growth, finer, second);
        if(second.reachable)
          advice = second;
      }
      const double error = seen().at(advice.n);
      if(error > wanted.front)
      {
        advice.reachable = false;
        advice.explanation += fmt::format(
            " The run's difference from the pilots tells an error of {:.2g}.", error);
      }
    }
  } // namespace

  void to_json(nlohmann::json &json, const Advice &advice)
  {
    json = {{"method", advice.method},
            {"n", advice.n},
            {"options", advice.options},
            {"predicted_error", json_of(advice.predicted_error)},
            {"predicted_seconds", json_of(advice.predicted_seconds)},
            {"error", json_of(advice.error)},
            {"error_is_true", advice.error_is_true},
            {"seconds", json_of(advice.seconds)},
            {"reachable", advice.reachable},
            {"explanation", advice.explanation},
            {"forecasts", nlohmann::json::array()}};
    for(const MethodForecast &one : advice.forecasts)
      json["forecasts"].push_back({{"method", one.method->name()},
                                   {"n", one.n},
                                   {"error", json_of(one.error)},
                                   {"seconds", json_of(one.seconds)},
                                   {"doubt", one.doubt}});
  }

  std::vector<MethodForecast> forecasts(const LadderGrowth &growth,
                                        const StoredCase &record,
                                        const WantedErrors &wanted)
  {
    const std::vector<Ladder> ladders = ladders_of(growth.result());
    const auto outliers = contradicting(answers_of(growth.result(), record));
    std::vector<MethodForecast> all;
    for(const GrowingLadder &one : growth.ladders())
    {
      const auto ladder = ladder_of(ladders, one.method->name());
      if(!ladder || ladder->levels.size() < 2)
        continue;
      const ErrorModel front = front_model(*ladder);
      if(!std::isfinite(front.error))
        continue;
      MethodForecast forecast{one.method};
      forecast.n = resolution_for(*ladder, front, temperature_model(*ladder), wanted);
      forecast.error = front.at(forecast.n);
      forecast.seconds = predicted_cpu(*ladder, forecast.n);
      if(std::ranges::find(outliers, ladder->label) != outliers.end())
        forecast.doubt = "contradicts the other methods";
      all.push_back(std::move(forecast));
    }
    std::ranges::stable_sort(all, {},
                             [](const MethodForecast &one)
                             { return std::pair(!one.doubt.empty(), one.seconds); });
    return all;
  }

  Advice advise(LadderGrowth &growth, const WantedErrors &wanted)
  {
    // Two levels are what a forecast needs, a third tells the time better where it is
    // cheap.
    for(const double share : {0.5, 0.3, 0.05})
      growth.grow(share);
    Advice advice;
    if(growth.result().cases.empty())
    {
      advice.explanation = "No method takes this case.";
      return advice;
    }
    advice.forecasts = forecasts(growth, growth.result().cases.front(), wanted);
    if(advice.forecasts.empty() || !advice.forecasts.front().doubt.empty())
    {
      advice.explanation = "No method gave two levels that tell an error.";
      return advice;
    }
    const auto possible = std::ranges::find_if(
        advice.forecasts, [&](const MethodForecast &one)
        { return one.doubt.empty() && fits_into_time(growth, one); });
    advice.reachable = possible != advice.forecasts.end();
    const MethodForecast chosen
        = advice.reachable ? *possible : best_of_all(growth, advice.forecasts);
    if(!advice.reachable)
      advice.explanation = fmt::format(
          "An error of {:.2g} is out of reach within the time: {:.2g} is what it allows.",
          wanted.front, chosen.error);
    make_chosen(growth, chosen, advice);
    if(advice.reachable)
      refine_if_short(growth, chosen, wanted, advice);
    return advice;
  }
} // namespace meltfront::verification
