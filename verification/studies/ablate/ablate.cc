#include <cases/domain_measure.h>
#include <cases/effect_bounds.h>
#include <cases/error.h>
#include <cases/scene_heat.h>
#include <verification/judge/ladder.h>
#include <verification/record/json_values.h>
#include <verification/studies/ablate/ablate.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace meltfront::verification
{
  namespace
  {
    using nlohmann::json;

    /** What changes, by its name in ablate.json. */
    struct Quantity
    {
      const char *name;
      /** Of QuantityBar; empty: the root mean square of the bars of all probes. */
      const char *bar;
      /** Null where only changes are known. @param volume of the domain */
      double (*value)(const RunRecord &, double volume);
      double (*change)(const RunRecord &full, const RunRecord &without, double volume);
    };

    constexpr Quantity quantities[]
        = {{"front", "front", end_front,
            [](const RunRecord &full, const RunRecord &without, double volume)
            { return end_front(without, volume) - end_front(full, volume); }},
           {"front_over_time", front_course, nullptr,
            [](const RunRecord &full, const RunRecord &without, double volume)
            { return front_difference(full, without, volume); }},
           {"solid_volume", "solid_volume",
            [](const RunRecord &run, double) { return end_volume(run); },
            [](const RunRecord &full, const RunRecord &without, double)
            { return end_volume(without) - end_volume(full); }},
           {"temperature", "", nullptr,
            [](const RunRecord &full, const RunRecord &without, double)
            { return temperature_difference(full, without); }}};

    /** Why an effect cannot be taken out of a scene, one sentence; else empty. */
    std::string why_not_removable(const cases::Scene &scene, cases::Effect effect)
    {
      using cases::Effect;
      if(effect == Effect::metastable_phase)
        return "it is a state of the start and no process: nothing can be left out";
      if(effect == Effect::phase_change && scene.alloy)
        return "solutes shift the melting temperature: without latent heat there is no "
               "front to which they matter; take out the solute first";
      const auto fixes_temperature = [&](cases::BoundaryKind kind)
      {
        return kind == cases::BoundaryKind::fixed_temperature
               || kind == cases::BoundaryKind::heat_transfer
               || kind == cases::BoundaryKind::radiation;
      };
      if(scene.problem == cases::ProblemKind::poisson)
      {
        cases::Scene without = scene;
        without.effect_choices[effect] = cases::EffectChoice::off;
        without = cases::simulated_scene(without, cases::effects_called_for(without));
        if(std::ranges::none_of(without.sides(),
                                [&](cases::Side side) {
                                  return fixes_temperature(without.boundary(side).kind);
                                }))
          return "the steady temperature would be known up to a constant only";
      }
      return {};
    }

    MatrixBlock block_of(const StudySettings &settings, const cases::Method &method,
                         const std::vector<int> &levels)
    {
      return {{settings.case_name}, {method.name()}, levels, {}};
    }

    std::string setting_of(cases::Effect effect)
    {
      return fmt::format("Effects/{}", cases::to_string(effect));
    }

    struct Bars
    {
      std::map<std::string, ErrorBar> by_name;
      ErrorBar temperature; ///< root mean square of the probes' bars
    };

    Bars bars_of_case(const MatrixResult &result, const std::string &case_name)
    {
      Bars bars;
      double sum = 0;
      int probes = 0;
      for(const Ladder &ladder : ladders_of(result))
        if(ladder.case_name == case_name)
          for(const QuantityBar &one : bars_of(ladder))
          {
            bars.by_name[one.quantity] = one.bar;
            if(one.quantity.starts_with("temperature at"))
            {
              sum += one.bar.bar * one.bar.bar;
              ++probes;
              bars.temperature.converging
                  = one.bar.converging && (probes == 1 || bars.temperature.converging);
            }
          }
      if(probes > 0)
        bars.temperature.bar = std::sqrt(sum / probes);
      return bars;
    }

    ErrorBar bar_of(const Bars &bars, const Quantity &quantity)
    {
      if(*quantity.bar == '\0')
        return bars.temperature;
      const auto found = bars.by_name.find(quantity.bar);
      return found == bars.by_name.end() ? ErrorBar() : found->second;
    }

    json number(double value)
    {
      return std::isfinite(value) ? json(value) : json();
    }

    /** The bar of a change: what is common to the errors of both scenes cancels. */
    double bar_of_change(const std::vector<const RunRecord *> &full,
                         const std::vector<const RunRecord *> &without,
                         const Quantity &quantity, double volume)
    {
      std::vector<BarLevel> levels;
      std::vector<double> differences;
      for(std::size_t i = 0; i < full.size(); ++i)
      {
        levels.push_back({full[i]->description.spacing, full[i]->cost.steps,
                          quantity.change(*full[i], *without[i], volume)});
        if(i > 0)
          differences.push_back(cases::nan);
      }
      const BarConstants constants = bar_constants(*full.back());
      const bool temperature = *quantity.bar == '\0';
      return error_bar(levels, differences,
                       bar_recipe(constants,
                                  temperature ? constants.temperature : constants.front,
                                  std::abs(levels.back().value)))
          .bar;
    }

    /** A relative bound in the unit of a quantity. */
    double absolute(const cases::EffectBound &bound, const Quantity &quantity,
                    const cases::Scene &scene, double range, double volume)
    {
      const std::string name = quantity.name;
      if(name == "temperature")
        return bound.temperature * range;
      if(name == "solid_volume")
        return scene.symmetry == cases::Symmetry::planar ? bound.front * volume
                                                         : cases::infinity;
      return bound.front * scene.domain.side();
    }

    /** Runs of a case at all levels, coarse to fine; empty, with the reason, if one did
     * not finish. */
    std::vector<const RunRecord *> levels_of(const MatrixResult &result,
                                             const std::string &case_name,
                                             const std::vector<int> &levels,
                                             std::string &reason)
    {
      std::vector<const RunRecord *> runs;
      for(const int n : levels)
      {
        const RunRecord *run = find_run(result, case_name, n);
        if(run && run->status == RunStatus::finished)
          runs.push_back(run);
        else
        {
          reason = run ? run->message : "it did not run";
          return {};
        }
      }
      return runs;
    }

    double bytes_of(const RunRecord &run, cases::Effect effect)
    {
      for(const cases::EffectCost &cost : run.cost.effects)
        if(cost.effect == effect)
          return static_cast<double>(cost.bytes);
      return 0;
    }

    /** One ablation in the making. */
    struct Study
    {
      const StudySettings &settings;
      cases::Case the_case;
      const cases::Method &method;
      std::vector<int> levels;
      MatrixResult result{};

      std::string name() const
      {
        return short_case_name(settings.case_name);
      }

      json row(const cases::EffectDecision &decision,
               const std::vector<const RunRecord *> &full, const Bars &bars) const;
    };

    json Study::row(const cases::EffectDecision &decision,
                    const std::vector<const RunRecord *> &full, const Bars &bars) const
    {
      const cases::Scene &scene = the_case.scene;
      json row{{"effect", cases::to_string(decision.effect)},
               {"reason", decision.reason}};
      std::string refused = why_not_removable(scene, decision.effect);
      std::vector<const RunRecord *> without;
      if(refused.empty())
        without = levels_of(
            result, fmt::format("{}[{}=off]", name(), cases::to_string(decision.effect)),
            levels, refused);
      cases::Scene other = scene;
      other.effect_choices[decision.effect] = cases::EffectChoice::off;
      const cases::Scene with = cases::simulated_scene(
          scene, cases::effects_within(scene, the_case.effect_tolerance));
      const cases::EffectBound bound = cases::bound_of_effect(
          decision.effect, with,
          cases::simulated_scene(
              other, cases::effects_within(other, the_case.effect_tolerance)));
      row["bound"] = {{"front", number(bound.front)},
                      {"temperature", number(bound.temperature)},
                      {"words", bound.words}};
      if(without.empty())
      {
        row["refused"] = refused;
        return row;
      }
      const cases::TemperatureBounds given = cases::given_temperatures(with);
      const double volume = cases::volume_of(scene.domain);
      for(const Quantity &quantity : quantities)
      {
        const double change = quantity.change(*full.back(), *without.back(), volume);
        const double bar = bar_of(bars, quantity).bar;
        row["changes"][quantity.name]
            = {{"change", number(change)},
               {"bar", number(bar_of_change(full, without, quantity, volume))},
               {"in_bars", number(std::abs(change) / bar)},
               {"bound", number(absolute(bound, quantity, scene,
                                         given.upper - given.lower, volume))}};
      }
      row["seconds_saved"]
          = processor_seconds(*full.back()) - processor_seconds(*without.back());
      row["bytes_saved"] = bytes_of(*full.back(), decision.effect);
      return row;
    }

    Matrix matrix_of(const Study &study,
                     const std::vector<cases::EffectDecision> &decisions)
    {
      Matrix matrix;
      matrix.name = "ablate-" + study.the_case.scene.name;
      matrix.title = fmt::format("{} without each of its effects", study.the_case.title);
      matrix.time_limit = std::max(1., study.settings.within);
      matrix.blocks.push_back(block_of(study.settings, study.method, study.levels));
      for(const cases::EffectDecision &decision : decisions)
        if(decision.on
           && why_not_removable(study.the_case.scene, decision.effect).empty())
        {
          matrix.blocks.push_back(matrix.blocks.front());
          matrix.blocks.back().variations = {{setting_of(decision.effect), {"off"}}};
        }
      return matrix;
    }

    json summary(const Study &study, const std::vector<cases::EffectDecision> &decisions)
    {
      std::string reason;
      const std::vector<const RunRecord *> full
          = levels_of(study.result, study.name(), study.levels, reason);
      if(full.empty())
        throw cases::Refusal(fmt::format("the scene with all its effects has no result "
                                         "to compare with: {}",
                                         reason));
      const Bars bars = bars_of_case(study.result, study.name());
      json all{{"case", study.name()},
               {"method", study.method.name()},
               {"n", study.levels},
               {"seconds", processor_seconds(*full.back())}};
      for(const Quantity &quantity : quantities)
      {
        const ErrorBar bar = bar_of(bars, quantity);
        all["full"][quantity.name]
            = {{"value",
                number(quantity.value ? quantity.value(
                           *full.back(), cases::volume_of(study.the_case.scene.domain))
                                      : cases::nan)},
               {"bar", number(bar.bar)},
               {"converging", bar.converging}};
      }
      all["effects"] = json::array();
      for(const cases::EffectDecision &decision : decisions)
        if(decision.on)
          all["effects"].push_back(study.row(decision, full, bars));
      return all;
    }
  } // namespace

  json ablate(const StudySettings &settings)
  {
    const cases::Case c = settings.load_case(settings.case_name);
    if(!c.scene.conducts_heat())
      throw cases::Refusal(
          fmt::format("the case '{}' conducts no heat: neither a front that freezes nor "
                      "a temperature could change",
                      c.scene.name));
    const cases::Method &method = method_of(settings, c);
    const std::vector<cases::EffectDecision> decisions
        = cases::effects_within(c.scene, c.effect_tolerance).decisions();
    const auto on = std::ranges::count_if(decisions, &cases::EffectDecision::on);
    // Three levels of n/2, n/sqrt(2) and n cost about 1.7 finest runs.
    const int n = settings.n > 0 ? settings.n
                                 : resolution_within(settings, c, method,
                                                     1.7 * static_cast<double>(on + 1));
    Study study{settings, c, method, three_levels(n)};
    RunnerOptions options = settings.runner;
    json all;
    options.conclude = [&](MatrixResult &result)
    {
      study.result = result;
      all = summary(study, decisions);
      write_json(settings.runner.directory + "/ablate.json", all);
      if(settings.runner.conclude)
        settings.runner.conclude(result);
    };
    run_matrix(matrix_of(study, decisions), options, settings.load_case,
               [&method](const std::string &) -> const cases::Method &
               { return method; });
    return all;
  }
} // namespace meltfront::verification
