#include <verification/judge/answers.h>
#include <verification/judge/refinement.h>
#include <verification/record/json_values.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace meltfront::verification
{
  namespace
  {
    using cases::nan;

    double cpu_seconds_of(const RunRecord &run)
    {
      return run.cost.setup_cpu + run.cost.stepping_cpu;
    }

    std::string unit_of_quantity(const StoredCase &record, const std::string &quantity)
    {
      if(record.scene.units != "SI")
        return {};
      const int dimension = measure_dimension(record);
      if(quantity.starts_with("front"))
        return "m";
      if(quantity == "solid_volume")
        return dimension == 1 ? "m" : fmt::format("m^{}", dimension);
      if(quantity == "heat")
        return dimension == 1 ? "J/m^2" : dimension == 2 ? "J/m" : "J";
      return "K";
    }

    /** Ladders of a case by label, each with its seeds. */
    std::vector<std::vector<Ladder>> ladders_by_label(const MatrixResult &result,
                                                      const StoredCase &record)
    {
      std::vector<std::vector<Ladder>> labels;
      for(Ladder &ladder : ladders_of(result))
      {
        if(ladder.case_name != record.name())
          continue;
        const auto known = std::ranges::find(labels, ladder.label,
                                             [](const std::vector<Ladder> &one)
                                             { return one.front().label; });
        if(known == labels.end())
          labels.push_back({std::move(ladder)});
        else
          known->push_back(std::move(ladder));
      }
      return labels;
    }

    /** The bars of the seed with the largest, widened by half the spread of the values.
     */
    std::vector<QuantityBar> bars_of_seeds(const std::vector<Ladder> &seeds)
    {
      std::vector<QuantityBar> bars = bars_of(seeds.front());
      for(QuantityBar &one : bars)
      {
        double lowest = one.bar.value, highest = one.bar.value;
        for(std::size_t s = 1; s < seeds.size(); ++s)
          for(const QuantityBar &other : bars_of(seeds[s]))
            if(other.quantity == one.quantity)
            {
              lowest = std::min(lowest, other.bar.value);
              highest = std::max(highest, other.bar.value);
              if(other.bar.bar > one.bar.bar)
                one = other;
            }
        one.bar.bar += (highest - lowest) / 2;
      }
      return bars;
    }

    /** What the error of a course is measured in. */
    std::vector<double> RunSeries::*course_of(const std::vector<Answer> &answers)
    {
      for(const Answer &answer : answers)
        if(answer.quantity == "front")
          return &RunSeries::front;
      return &RunSeries::solid_volume;
    }

    const Answer *answer_named(const std::vector<Answer> &answers,
                               const std::string &quantity)
    {
      const auto found = std::ranges::find(answers, quantity, &Answer::quantity);
      return found == answers.end() ? nullptr : &*found;
    }

    /** The label of the smallest bar among those that the consensus does not contradict;
     * null for none. */
    const MethodAnswer *most_trusted(const Answer &answer)
    {
      const MethodAnswer *best = nullptr;
      for(const MethodAnswer &one : answer.methods)
        if(one.distance_in_bars <= 1 && (!best || one.bar.bar < best->bar.bar))
          best = &one;
      return best;
    }

    std::vector<LevelError>
    errors_to_exact(const std::vector<std::vector<Ladder>> &labels, double scale)
    {
      std::vector<LevelError> errors;
      for(const auto &seeds : labels)
        for(const RunRecord *run : seeds.front().levels)
          errors.push_back(
              {run->label, run->n, run->description.dimension,
               (std::isnan(run->quantity("front_rms")) ? run->quantity("front_max")
                                                       : run->quantity("front_rms"))
                   / scale,
               cpu_seconds_of(*run)});
      return errors;
    }

    std::vector<LevelError>
    errors_to_consensus(const std::vector<std::vector<Ladder>> &labels,
                        const Answer &answer, std::vector<double> RunSeries::*course)
    {
      const MethodAnswer *trusted = most_trusted(answer);
      if(!trusted || !answer.consensus.agreed)
        return {};
      const RunRecord *reference = nullptr;
      double bar = trusted->bar.bar;
      for(const auto &seeds : labels)
        if(seeds.front().label == trusted->label)
        {
          reference = seeds.front().levels.back();
          // What is compared is the course, whose bar may be wider than that of the end.
          for(const QuantityBar &known : bars_of(seeds.front()))
            if(known.quantity == front_course && course == &RunSeries::front)
              bar = std::max(bar, known.bar.bar);
        }
      std::vector<LevelError> errors;
      for(const auto &seeds : labels)
        for(const RunRecord *run : seeds.front().levels)
          errors.push_back(
              {run->label, run->n, run->description.dimension,
               (course_difference(*run, *reference, course) + bar) / answer.scale,
               cpu_seconds_of(*run)});
      return errors;
    }
  } // namespace

  std::vector<Answer> answers_of(const MatrixResult &result, const StoredCase &record)
  {
    std::vector<Answer> answers;
    for(const std::vector<Ladder> &seeds : ladders_by_label(result, record))
      for(const QuantityBar &known : bars_of_seeds(seeds))
      {
        if(known.quantity == front_course)
          continue;
        auto place = std::ranges::find(answers, known.quantity, &Answer::quantity);
        if(place == answers.end())
        {
          place = answers.emplace(answers.end());
          place->quantity = known.quantity;
          place->unit = unit_of_quantity(record, known.quantity);
        }
        const RunRecord &finest = *seeds.front().levels.back();
        place->exact = known.exact;
        place->methods.push_back({finest.label, finest.method, finest.n,
                                  finest.description.dimension, known.bar,
                                  cpu_seconds_of(finest), known.error});
        place->scale = std::isnan(place->scale) ? known.scale
                                                : std::max(place->scale, known.scale);
      }
    for(Answer &answer : answers)
    {
      std::vector<AnswerInterval> intervals;
      for(const MethodAnswer &one : answer.methods)
        intervals.push_back({one.bar.value, one.bar.bar, one.bar.converging});
      answer.consensus = consensus_of(intervals);
      for(std::size_t i = 0; i < answer.methods.size(); ++i)
        answer.methods[i].distance_in_bars = answer.consensus.distance_in_bars[i];
    }
    return answers;
  }

  nlohmann::json answers_json(const std::vector<Answer> &answers)
  {
    nlohmann::json all = nlohmann::json::array();
    for(const Answer &answer : answers)
    {
      nlohmann::json one{{"quantity", answer.quantity},
                         {"unit", answer.unit},
                         {"consensus", json_of(answer.consensus.value)},
                         {"bar", json_of(answer.consensus.bar)},
                         {"agreed", answer.consensus.agreed},
                         {"support", answer.consensus.support},
                         {"exact", json_of(answer.exact)},
                         {"methods", nlohmann::json::array()}};
      for(const MethodAnswer &method : answer.methods)
        one["methods"].push_back({{"method", method.label},
                                  {"n", method.n},
                                  {"dimension", method.dimension},
                                  {"value", json_of(method.bar.value)},
                                  {"bar", json_of(method.bar.bar)},
                                  {"order", json_of(method.bar.order)},
                                  {"levels", method.bar.levels},
                                  {"converging", method.bar.converging},
                                  {"remark", method.bar.remark},
                                  {"distance_in_bars", json_of(method.distance_in_bars)},
                                  {"error", json_of(method.error)},
                                  {"cpu_seconds", json_of(method.cpu_seconds)}});
      all.push_back(std::move(one));
    }
    return all;
  }

  std::vector<LevelError> level_errors(const MatrixResult &result,
                                       const StoredCase &record)
  {
    const auto labels = ladders_by_label(result, record);
    const std::vector<Answer> answers = answers_of(result, record);
    const auto course = course_of(answers);
    const bool front = course == &RunSeries::front;
    const Answer *answer = answer_named(answers, front ? "front" : "solid_volume");
    if(!answer || !(answer->scale > 0))
      return {};
    std::vector<LevelError> errors
        = front && std::isfinite(answer->exact) && answer->exact != 0
              ? errors_to_exact(labels, std::abs(answer->exact))
              : errors_to_consensus(labels, *answer, course);
    std::erase_if(errors, [](const LevelError &one) { return !(one.error > 0); });
    for(LevelError &one : errors)
      one.quantity = front ? "front" : "solid volume";
    return errors;
  }

  const LevelError *cheapest_level(const std::vector<LevelError> &levels, double wanted)
  {
    const LevelError *best = nullptr;
    for(const LevelError &level : levels)
      if(level.error <= wanted && (!best || level.cpu_seconds < best->cpu_seconds))
        best = &level;
    return best;
  }
} // namespace meltfront::verification
