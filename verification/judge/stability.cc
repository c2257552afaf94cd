#include <verification/judge/median_course.h>
#include <verification/judge/stability.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace meltfront::verification
{
  namespace
  {
    constexpr double least_defect_bound = 1e-12;
    constexpr double unit_of_rounding = 0x1p-53;
    constexpr double round_off_balance = 1e-6; ///< of the harness's check of those who
                                               ///< conserve heat
    constexpr double largest_backstep = 1e-9;  ///< of the domain's side
    constexpr double spacings_of_error = 2;
    constexpr const char *front_error = "front", *temperature_error = "temperature",
                         *solid_error = "solid";

    /** Multiples of the stability limit that a run was made to step by without a guard;
     * 0 for one that was guarded. */
    double unguarded_factor(const RunRecord &run)
    {
      const auto limit = run.options.find("step_limit");
      const auto factor = run.options.find("step_factor");
      return limit != run.options.end() && limit->second == "stability"
                     && factor != run.options.end()
                 ? std::stod(factor->second)
                 : 0;
    }

    bool finite(const std::vector<double> &values)
    {
      return std::ranges::all_of(values,
                                 [](double value) { return std::isfinite(value); });
    }

    double volume_of(const cases::Domain &domain, int dimension)
    {
      double volume = 1;
      for(int d = 0; d < dimension; ++d)
        volume *= domain.upper[d] - domain.lower[d];
      return volume;
    }

    /** Judges the runs of one case. */
    class CaseJudge
    {
    public:
      CaseJudge(const StoredCase &record, const std::vector<const RunRecord *> &runs)
        : record(record)
        , others(runs)
      {
      }

      StabilityVerdict judge(const RunRecord &run) const
      {
        StabilityVerdict verdict{run.case_name, run.label, run.n, "failed", run.message};
        const double factor = unguarded_factor(run);
        if(run.status == RunStatus::refused && !run.message.empty())
          verdict.verdict = "refused";
        if(run.status == RunStatus::failed && factor >= 1 && !run.message.empty())
          verdict.verdict = "caught";
        if(run.status != RunStatus::finished)
          return verdict;
        verdict.measures = measures(run);
        verdict.reason = reason_not_held(run, verdict.measures);
        if(factor > 1)
          verdict.reason = fmt::format(
              "a result of steps of {:g} times the stability limit was returned", factor);
        if(verdict.reason.empty())
          verdict.verdict = "held";
        else if(factor == 1) // where nothing grows and nothing decays
          verdict.verdict = "caught";
        return verdict;
      }

    private:
      std::vector<StabilityMeasure> measures(const RunRecord &run) const
      {
        std::vector<StabilityMeasure> list;
        for(const Check &check : run.checks)
          list.push_back({check.name, check.value, check.bound});
        const auto balance = std::ranges::find(run.checks, "heat balance", &Check::name);
        if(balance != run.checks.end() && balance->bound <= round_off_balance)
          list.push_back({"heat budget",
                          std::min(run.quantity("budget_defect"), balance->value),
                          std::max(least_defect_bound,
                                   unit_of_rounding
                                       * std::max(double(run.cost.steps), contrast()))});
        const double side = record.scene.domain.side();
        if(record.measurement.monotone_front && record.scene.changes_phase())
          list.push_back({"front moved back", run.quantity("front_backsteps") / side,
                          largest_backstep});
        list.push_back(error(run));
        std::ranges::stable_sort(list, std::greater(), &StabilityMeasure::share);
        return list;
      }

      /** Of the conductivities: the fluxes of the better conductor are rounded by so much
       * of those of the other. */
      double contrast() const
      {
        const auto [poorer, better]
            = std::minmax(record.scene.material.solid.conductivity,
                          record.scene.material.liquid.conductivity);
        return better / poorer;
      }

      StabilityMeasure error(const RunRecord &run) const
      {
        const double side = record.scene.domain.side();
        const double spacing = run.description.spacing / side;
        const auto measure = [spacing](const std::string &name, double value, double way)
        {
          const double most = spacings_of_error * spacing;
          return StabilityMeasure{
              name, value,
              std::isfinite(way) ? std::min(most, std::max(way / 2, spacing)) : most};
        };
        if(!record.exact)
        {
          const double volume
              = volume_of(record.scene.domain, record.scene.domain.dimension);
          return measure(fmt::format("{} off the median of {} methods", solid_error,
                                     others.others(run.method)),
                         others.distance(run) / volume, others.course() / volume);
        }
        if(record.exact->mushy())
          return measure(solid_error, error_of_mush(run) / side, cases::nan);
        if(!record.exact->has_front())
          return measure(temperature_error, run.quantity("temperature_l2"), cases::nan);
        double front = run.quantity("front_rms");
        if(std::isnan(front)) // too few steps for an average
          front = run.quantity("front_end");
        return measure(front_error, front / side, way_of_front(run.series) / side);
      }

      /** The solid's volume less the exact one at the end (m). */
      double error_of_mush(const RunRecord &run) const
      {
        const cases::Domain &domain = record.scene.domain;
        const double exact = record.exact->solid_volume(domain.lower[0], domain.upper[0],
                                                        record.scene.end_time);
        return std::abs(run.quantity("solid_volume_end") - exact);
      }

      static double way_of_front(const RunSeries &series)
      {
        if(series.front_exact.empty() || !finite(series.front_exact))
          return cases::nan;
        const auto [least, largest] = std::ranges::minmax(series.front_exact);
        return largest - least;
      }

      /** Why a finished run does not count as held; empty if it does. */
      std::string reason_not_held(const RunRecord &run,
                                  const std::vector<StabilityMeasure> &measures) const
      {
        const RunSeries &series = run.series;
        if(series.time.empty()
           || (record.scene.changes_phase() && !finite(series.solid_volume))
           || !finite(series.temperature_min) || !finite(series.temperature_max))
          return "phases or temperature are not finite";
        const StabilityMeasure &worst = measures.front();
        if(worst.share() <= 1)
          return {};
        if(std::isnan(worst.value))
          return fmt::format("{} is not known", worst.name);
        return fmt::format("{} is {:.3g}, more than {:.3g}", worst.name, worst.value,
                           worst.bound);
      }

      const StoredCase &record;
      MedianCourse others;
    };
  } // namespace

  bool is_error(const StabilityMeasure &measure)
  {
    return measure.name == front_error || measure.name == temperature_error
           || measure.name.starts_with(solid_error);
  }

  double StabilityMeasure::share() const
  {
    if(!(value <= bound)) // NaN too
      return std::isfinite(value) && bound > 0 ? value / bound
                                               : std::numeric_limits<double>::infinity();
    return bound > 0 ? value / bound : 0;
  }

  std::vector<StabilityVerdict> judge_stability(const MatrixResult &result)
  {
    std::map<std::string, std::vector<const RunRecord *>> runs_of;
    for(const RunRecord &run : result.runs)
      if(unguarded_factor(run) <= 1)
        runs_of[run.case_name].push_back(&run);
    std::map<std::string, CaseJudge> judges;
    for(const StoredCase &record : result.cases)
      judges.try_emplace(record.name(), record, runs_of[record.name()]);
    std::vector<StabilityVerdict> verdicts;
    for(const RunRecord &run : result.runs)
      if(const auto judge = judges.find(run.case_name); judge != judges.end())
        verdicts.push_back(judge->second.judge(run));
    return verdicts;
  }
} // namespace meltfront::verification
