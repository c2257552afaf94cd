#include <cases/case_file/vary_case.h>
#include <cases/domain_measure.h>
#include <cases/error.h>
#include <cases/numbers.h>
#include <verification/judge/ladder.h>
#include <verification/record/json_values.h>
#include <verification/studies/sensitivity/sensitivity.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace meltfront::verification
{
  namespace
  {
    using nlohmann::json;

    json number(double value)
    {
      return std::isfinite(value) ? json(value) : json();
    }

    json as_json(const Derivative &derivative)
    {
      return {{"derivative", number(derivative.value)},
              {"error", number(derivative.error)},
              {"step", derivative.step}};
    }

    /** A case with one datum changed. */
    struct ChangedCase
    {
      std::string name;
      cases::CaseSettings settings;
    };

    /** Runs of one datum at a resolution: at -s_k and +s_k for each step. */
    using Pairs = std::vector<std::array<const RunRecord *, 2>>;

    template <typename Read>
    std::vector<std::array<double, 2>> values(const Pairs &pairs, Read read)
    {
      std::vector<std::array<double, 2>> result;
      for(const auto &[below, above] : pairs)
        result.push_back({read(*below), read(*above)});
      return result;
    }

    /** That of the temperature: root mean squares over the probes of derivatives and
     * errors, with the step that is best for most. */
    Derivative of_temperature(const Pairs &fine, const Pairs &coarse)
    {
      const auto probe = [](const Pairs &pairs, std::size_t i)
      {
        std::vector<std::array<double, 2>> result;
        for(const auto &[below, above] : pairs)
          result.push_back(
              {below->probes.at(i).temperature, above->probes.at(i).temperature});
        return result;
      };
      const std::size_t probes = fine[0][0]->probes.size();
      Derivative all;
      for(std::size_t i = 0; i < probes; ++i)
      {
        const Derivative one = derivative(probe(fine, i), probe(coarse, i));
        all.value += one.value * one.value / static_cast<double>(probes);
        all.error += one.error * one.error / static_cast<double>(probes);
        all.step = one.step;
      }
      all.value = std::sqrt(all.value);
      all.error = std::sqrt(all.error);
      return all;
    }

    class Study
    {
    public:
      explicit Study(const StudySettings &settings)
        : settings(settings)
        , the_case(settings.load_case(settings.case_name))
        , method(checked_method())
        , name(short_case_name(settings.case_name))
        , data(data_of(the_case, left_out))
      {
        const double runs = 1.7 + 1.3 * 2 * relative_steps.size() * data.size();
        finest = settings.n > 0 ? settings.n
                                : resolution_within(settings, the_case, method, runs);
        coarse = three_levels(finest).front();
        prepare();
      }

      json make()
      {
        RunnerOptions options = settings.runner;
        json all;
        options.conclude = [&](MatrixResult &result)
        {
          all = summary(result);
          write_json(settings.runner.directory + "/sensitivity.json", all);
        };
        run_matrix(
            matrix(), options, [this](const std::string &wanted) { return load(wanted); },
            [this](const std::string &) -> const cases::Method & { return method; });
        return all;
      }

    private:
      const cases::Method &checked_method() const
      {
        if(!the_case.scene.conducts_heat())
          throw cases::Refusal(fmt::format("the case '{}' conducts no heat: there is no "
                                           "front or temperature to be sensitive",
                                           the_case.scene.name));
        return method_of(settings, the_case);
      }

      std::string name_of(const Datum &datum, double s) const
      {
        std::string words = datum.name;
        std::ranges::replace(words, '/', '.');
        std::ranges::replace(words, ' ', '_');
        return fmt::format("{}@{}{:+}", name, words, s);
      }

      /** The changed cases; steps from the first on that makes no scene are left out. */
      void prepare()
      {
        for(const Datum &datum : data)
          try
          {
            for(const double step : relative_steps)
            {
              std::map<std::string, cases::Case> pair;
              for(const double s : {-step, step})
              {
                const std::string wanted = name_of(datum, s);
                pair[wanted]
                    = cases::vary_case(the_case, wanted, {{datum.key, datum.changed(s)}});
              }
              changed_cases.merge(pair);
            }
          }
          catch(const cases::InputError &error)
          {
            refused[datum.name] = error.what();
          }
      }

      cases::Case load(const std::string &wanted) const
      {
        const auto found = changed_cases.find(wanted);
        return found != changed_cases.end() ? found->second
                                            : cases::vary_case(the_case, name, {});
      }

      Matrix matrix() const
      {
        Matrix matrix;
        matrix.name = "sensitivity-" + name;
        matrix.title = fmt::format("{}: sensitivity to its data", the_case.title);
        matrix.time_limit = std::max(1., settings.within);
        matrix.blocks = {{{name}, {method.name()}, three_levels(finest), {}}};
        MatrixBlock block{{}, {method.name()}, {coarse, finest}, {}};
        for(const auto &[wanted, changed] : changed_cases)
          block.cases.push_back(wanted);
        if(!block.cases.empty())
          matrix.blocks.push_back(block);
        return matrix;
      }

      /** Of the smallest steps, as many as finished. @param reason told what ended them
       */
      Pairs pairs_of(const MatrixResult &result, const Datum &datum, int n,
                     std::string &reason) const
      {
        Pairs pairs;
        for(const double step : relative_steps)
        {
          const std::array<const RunRecord *, 2> pair{
              find_run(result, name_of(datum, -step), n),
              find_run(result, name_of(datum, step), n)};
          for(const RunRecord *run : pair)
            if(!run)
              return pairs;
            else if(run->status != RunStatus::finished)
            {
              reason = run->message;
              return pairs;
            }
          pairs.push_back(pair);
        }
        return pairs;
      }

      json row(const MatrixResult &result, const Datum &datum, double front_bar) const
      {
        json row{{"key", datum.key},
                 {"name", datum.name},
                 {"value", datum.value},
                 {"scale", datum.scale},
                 {"of_scale", datum.of_scale}};
        std::string reason;
        if(const auto found = refused.find(datum.name); found != refused.end())
          reason = found->second;
        Pairs fine = pairs_of(result, datum, finest, reason),
              rough = pairs_of(result, datum, coarse, reason);
        const std::size_t steps = std::min(fine.size(), rough.size());
        if(steps < 2)
        {
          row["refused"] = reason;
          return row;
        }
        fine.resize(steps);
        rough.resize(steps);
        const auto front_of
            = [volume = cases::volume_of(the_case.scene.domain)](const RunRecord &run)
        { return end_front(run, volume); };
        const Derivative front
            = derivative(values(fine, front_of), values(rough, front_of));
        row["front"] = as_json(front);
        row["solid_volume"]
            = as_json(derivative(values(fine, end_volume), values(rough, end_volume)));
        row["temperature"] = as_json(of_temperature(fine, rough));
        row["worth_of_bar"] = number(front_bar / std::abs(front.value));
        return row;
      }

      json summary(const MatrixResult &result) const
      {
        const RunRecord *full = find_run(result, name, finest);
        if(!full || full->status != RunStatus::finished)
          throw cases::Refusal(fmt::format("the scene as written has no result: {}",
                                           full ? full->message : "it did not run"));
        json all{{"case", name}, {"method", method.name()}, {"n", finest}};
        for(const char *quantity : {"front", "solid_volume"})
          all[quantity] = {{"value", nullptr}, {"bar", nullptr}};
        double front_bar = cases::nan;
        for(const Ladder &ladder : ladders_of(result))
          if(ladder.case_name == name)
            for(const QuantityBar &one : bars_of(ladder))
              if(all.contains(one.quantity))
              {
                all[one.quantity]
                    = {{"value", number(one.bar.value)}, {"bar", number(one.bar.bar)}};
                if(one.quantity == "front")
                  front_bar = one.bar.bar;
              }
        std::vector<json> rows;
        for(const Datum &datum : data)
          rows.push_back(row(result, datum, front_bar));
        std::ranges::stable_sort(rows, std::greater(), weight);
        all["data"] = rows;
        all["left_out"] = left_out;
        return all;
      }

      /** What rows are sorted by. */
      static double weight(const json &row)
      {
        if(row.contains("refused"))
          return -1;
        const json &front = row.at("front").at("derivative");
        const json &other = row.at("temperature").at("derivative");
        return front.is_number()   ? std::abs(front.get<double>())
               : other.is_number() ? other.get<double>()
                                   : 0;
      }

      const StudySettings &settings;
      cases::Case the_case;
      const cases::Method &method;
      std::string name;
      std::vector<std::string> left_out;
      std::vector<Datum> data;
      int finest = 0, coarse = 0;
      std::map<std::string, std::string> refused; ///< by the datum's name
      std::map<std::string, cases::Case> changed_cases;
    };
  } // namespace

  Derivative derivative(std::span<const std::array<double, 2>> fine,
                        std::span<const std::array<double, 2>> coarse)
  {
    const auto central = [](std::span<const std::array<double, 2>> pairs, std::size_t k)
    { return (pairs[k][1] - pairs[k][0]) / (2 * relative_steps[k]); };
    const auto extrapolated
        = [&](std::span<const std::array<double, 2>> pairs, std::size_t k)
    { return (4 * central(pairs, k) - central(pairs, k + 1)) / 3; };
    Derivative best;
    best.value = best.error = cases::nan;
    for(std::size_t k = 0; k + 1 < fine.size(); ++k)
    {
      const double value = extrapolated(fine, k);
      const double error = std::abs(central(fine, k) - central(fine, k + 1))
                           + 2 * std::abs(value - extrapolated(coarse, k));
      if(std::isfinite(error) && !(error >= best.error))
        best = {value, error, relative_steps[k]};
    }
    return best;
  }

  json sensitivity(const StudySettings &settings)
  {
    return Study(settings).make();
  }
} // namespace meltfront::verification
