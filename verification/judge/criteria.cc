#include <cases/numbers.h>
#include <verification/judge/criteria.h>
#include <verification/judge/reference.h>
#include <verification/judge/refinement.h>
#include <verification/measure/measure.h>
#include <verification/record/label.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

namespace meltfront::verification
{
  namespace
  {
    using cases::nan;
    constexpr int fewest_levels = 4;
    constexpr double infinity = std::numeric_limits<double>::infinity();

    using Runs = std::vector<const RunRecord *>;

    /** The runs that a criterion is about. */
    Runs runs_of(const MatrixResult &result, const StoredCase &record,
                 const cases::Criterion &criterion)
    {
      Runs runs;
      const bool at_one_n = criterion.statistic == cases::Statistic::value
                            || criterion.statistic == cases::Statistic::median
                            || criterion.statistic == cases::Statistic::failure;
      const bool derived = is_derived_quantity(criterion.quantity);
      for(const RunRecord &run : result.runs)
        if(run.case_name == record.name() && label_matches(criterion.method, run.label)
           && !(derived && is_reference(record, run))
           && (at_one_n ? run.n == criterion.n
                        : run.n >= criterion.n_from && run.n <= criterion.n_to))
          runs.push_back(&run);
      return runs;
    }

    int different_resolutions(const Runs &runs)
    {
      std::vector<int> n;
      for(const RunRecord *run : runs)
        if(std::ranges::find(n, run->n) == n.end())
          n.push_back(run->n);
      return static_cast<int>(n.size());
    }

    /** By an error that the method saw itself, not by a crash or for want of time. */
    bool failed_numerically(const RunRecord &run)
    {
      return run.status == RunStatus::failed && !run.provenance.contains("ended");
    }

    /** Whether a criterion says that the run is known to fail. */
    bool known_to_fail(const MatrixResult &result, const RunRecord &run)
    {
      for(const StoredCase &record : result.cases)
        for(const cases::Criterion &criterion : record.criteria)
        {
          if(criterion.statistic != cases::Statistic::failure)
            continue;
          const Runs runs = runs_of(result, record, criterion);
          if(std::ranges::find(runs, &run) != runs.end())
            return failed_numerically(run);
        }
      return false;
    }

    OrderFit fit_over(const StoredCase &record, const Runs &runs,
                      const std::string &quantity)
    {
      const Refinement refinement(runs);
      ErrorLevels levels;
      for(const RunRecord *run : runs)
        if(run->status != RunStatus::refused)
        {
          levels.abscissa.push_back(
              run->status == RunStatus::finished ? refinement.of(*run) : nan);
          levels.error.push_back(table_value(*run, quantity));
        }
      return fit_levels(levels, record, quantity, *runs.front(), refinement);
    }

    /** The order, unless the fit says that there is none where convergence is asked for.
     */
    Judgement order_over(const StoredCase &record, const Runs &runs,
                         const cases::Criterion &criterion)
    {
      const OrderFit fit = fit_over(record, runs, criterion.quantity);
      if(fit.levels < fewest_levels)
        return {nan, "", false};
      const bool convergence_asked = criterion.lower > 0;
      const bool clean = fit.verdict == OrderVerdict::clean || !convergence_asked;
      return {fit.order, clean ? "" : to_string(fit.verdict), false};
    }

    double worst_over(const Runs &runs, const std::string &quantity)
    {
      double worst = nan;
      for(const RunRecord *run : runs)
      {
        if(run->status == RunStatus::refused)
          continue;
        const double value = table_value(*run, quantity);
        if(std::isnan(value))
          return nan;
        worst = std::fmax(worst, value);
      }
      return worst;
    }

    double mean_over(const Runs &runs, const std::string &quantity)
    {
      double sum = 0;
      for(const RunRecord *run : runs)
        sum += table_value(*run, quantity);
      return sum / static_cast<double>(runs.size());
    }

    /** How far a value is beyond a criterion's bounds, negative within them. */
    double beyond(double value, const cases::Criterion &criterion)
    {
      return std::isnan(value)
                 ? infinity
                 : std::max(criterion.lower - value, value - criterion.upper);
    }

    /** The value of the seed that is furthest beyond the bounds, or least within them. */
    double worst_of_seeds(const Runs &runs, const cases::Criterion &criterion)
    {
      double worst = table_value(*runs.front(), criterion.quantity);
      for(const RunRecord *run : runs)
        if(const double value = table_value(*run, criterion.quantity);
           beyond(value, criterion) > beyond(worst, criterion))
          worst = value;
      return worst;
    }

    double median_over(const Runs &runs, const std::string &quantity)
    {
      std::vector<double> values;
      for(const RunRecord *run : runs)
        values.push_back(table_value(*run, quantity));
      if(std::ranges::any_of(values, [](double value) { return std::isnan(value); }))
        return nan;
      std::ranges::sort(values);
      const std::size_t half = values.size() / 2;
      return values.size() % 2 == 1 ? values[half]
                                    : 0.5 * (values[half - 1] + values[half]);
    }

    /** Why a bound on a difference from a reference says nothing; empty if it does. */
    std::string reference_remark(const MatrixResult &result, const StoredCase &record,
                                 const cases::Criterion &criterion)
    {
      constexpr std::string_view ending = "_error";
      if(!is_derived_quantity(criterion.quantity) || !criterion.quantity.ends_with(ending)
         || std::isinf(criterion.upper) || criterion.statistic == cases::Statistic::order)
        return {};
      std::string of
          = criterion.quantity.substr(0, criterion.quantity.size() - ending.size());
      if(of == "solid_volume_rms")
        of = "solid_volume_end"; // of the same series
      for(const ReferenceTrust &trust : result.references)
        if(trust.case_name == record.name() && trust.quantity == of)
        {
          const double bar = trust.bar;
          return bar <= criterion.upper ? ""
                 : std::isnan(bar)
                     ? "the reference's error bar is not known"
                     : fmt::format("the reference's error bar, {:.2g}, exceeds the bound",
                                   bar);
        }
      return "there is no reference";
    }

    Judgement value_of(const StoredCase &record, const Runs &runs,
                       const cases::Criterion &criterion)
    {
      switch(criterion.statistic)
      {
      case cases::Statistic::order:
        return order_over(record, runs, criterion);
      case cases::Statistic::worst:
        return {worst_over(runs, criterion.quantity), "", false};
      case cases::Statistic::median:
        return {median_over(runs, criterion.quantity), "", false};
      case cases::Statistic::failure:
        return {std::ranges::all_of(runs, [](const RunRecord *run)
                                    { return failed_numerically(*run); })
                    ? 1.
                    : 0.,
                "", false};
      default:
        return {record.scene.problem == cases::ProblemKind::particle_solid
                    ? mean_over(runs, criterion.quantity)
                    : worst_of_seeds(runs, criterion),
                "", false};
      }
    }

    /** Whether a label has been refused everywhere, or measures no such quantity at all:
     * then a criterion on any method does not concern it. */
    bool nothing_to_judge(const Runs &runs, const std::string &quantity)
    {
      return std::ranges::all_of(runs,
                                 [&quantity](const RunRecord *run)
                                 {
                                   return run->status == RunStatus::refused
                                          || (run->status == RunStatus::finished
                                              && std::isnan(table_value(*run, quantity)));
                                 });
    }

    /** A criterion on any method as one on each label of the case that it concerns. */
    std::vector<cases::Criterion> criteria_on_labels(const MatrixResult &result,
                                                     const StoredCase &record,
                                                     const cases::Criterion &criterion)
    {
      if(criterion.method != cases::any_method)
        return {criterion};
      std::vector<cases::Criterion> list;
      for(const RunRecord &run : result.runs)
      {
        if(run.case_name != record.name()
           || std::ranges::find(list, run.label, &cases::Criterion::method) != list.end())
          continue;
        cases::Criterion on_label = criterion;
        on_label.method = run.label;
        if(why_not_judged(result, record, on_label).empty()
           && !nothing_to_judge(runs_of(result, record, on_label), criterion.quantity))
          list.push_back(on_label);
      }
      return list.empty() ? std::vector{criterion} : list;
    }

    std::string omission(const RunRecord &run)
    {
      return fmt::format("{}, {}, n = {}{}: {}: {}", run.case_name, run.label, run.n,
                         run.seed == 1 ? "" : fmt::format(", seed {}", run.seed),
                         to_string(run.status), run.message);
    }
  } // namespace

  std::string quantity_text(const cases::Criterion &criterion)
  {
    if(criterion.statistic == cases::Statistic::failure)
      return fmt::format("fails at n={}", criterion.n);
    if(criterion.statistic == cases::Statistic::value)
      return fmt::format("{} at n={}", criterion.quantity, criterion.n);
    if(criterion.statistic == cases::Statistic::median)
      return fmt::format("median {} at n={}", criterion.quantity, criterion.n);
    const bool all
        = criterion.n_from <= 0 && criterion.n_to == std::numeric_limits<int>::max();
    return fmt::format(
        "{} {}{}", criterion.statistic == cases::Statistic::order ? "order of" : "worst",
        criterion.quantity,
        all ? "" : fmt::format(" over n={}..{}", criterion.n_from, criterion.n_to));
  }

  std::string why_not_judged(const MatrixResult &result, const StoredCase &record,
                             const cases::Criterion &criterion)
  {
    const Runs runs = runs_of(result, record, criterion);
    if(runs.empty())
      return "the matrix has no such run";
    if(criterion.statistic == cases::Statistic::order
       && different_resolutions(runs) < fewest_levels)
      return "an order needs four resolutions and the matrix has fewer";
    return {};
  }

  Judgement judge(const MatrixResult &result, const StoredCase &record,
                  const cases::Criterion &criterion)
  {
    Judgement judgement = value_of(record, runs_of(result, record, criterion), criterion);
    if(judgement.remark.empty())
      judgement.remark = reference_remark(result, record, criterion);
    judgement.passed
        = judgement.remark.empty() && beyond(judgement.value, criterion) <= 0;
    return judgement;
  }

  std::map<std::string, double> run_columns(const RunRecord &run)
  {
    static const std::vector<Quantity> told = []
    {
      std::vector<Quantity> list = all_quantities();
      std::erase_if(list, [](const Quantity &quantity) { return !quantity.of_run; });
      return list;
    }();
    std::map<std::string, double> values;
    for(const Quantity &quantity : told)
      values[quantity.name]
          = quantity.of_run({run.description, run.cost, run.peak_memory_mb});
    return values;
  }

  double table_value(const RunRecord &run, const std::string &name)
  {
    if(run.status != RunStatus::finished)
      return nan;
    if(const auto found = run.quantities.find(name); found != run.quantities.end())
      return found->second;
    const auto all = run_columns(run);
    const auto found = all.find(name);
    return found == all.end() ? nan : found->second;
  }

  namespace
  {
    /** Hold a criterion on a label against the runs of a case. */
    void judge_on_label(MatrixResult &result, const StoredCase &record,
                        const cases::Criterion &criterion)
    {
      const std::string reason = why_not_judged(result, record, criterion);
      if(!reason.empty())
      {
        result.omissions.push_back(fmt::format("{}, {}: {}: not judged: {}",
                                               record.name(), criterion.method,
                                               quantity_text(criterion), reason));
        return;
      }
      const Judgement judgement = judge(result, record, criterion);
      result.criteria.push_back({record.name(), criterion.method,
                                 quantity_text(criterion), judgement.value,
                                 criterion.lower, criterion.upper, judgement.passed,
                                 criterion.expected_failure, judgement.remark});
      result.passed = result.passed && judgement.passed;
    }

    /** The case of a family that is furthest beyond a criterion's bounds, or nearest to
     * them; null where the matrix says nothing on any. */
    const StoredCase *worst_member(const MatrixResult &result,
                                   const FamilyCriterion &family)
    {
      const StoredCase *worst = nullptr;
      double furthest = -infinity;
      for(const StoredCase &record : result.cases)
      {
        if(!in_family(family.family, record.name())
           || !why_not_judged(result, record, family.criterion).empty())
          continue;
        const Judgement judgement = judge(result, record, family.criterion);
        const double distance = judgement.remark.empty()
                                    ? beyond(judgement.value, family.criterion)
                                    : infinity;
        if(!worst || distance > furthest)
        {
          worst = &record;
          furthest = distance;
        }
      }
      return worst;
    }

    void judge_family(MatrixResult &result, const FamilyCriterion &family)
    {
      const StoredCase *worst = worst_member(result, family);
      if(worst)
      {
        judge_on_label(result, *worst, family.criterion);
        result.criteria.back().quantity += ", worst of " + family.family;
      }
      else
        result.omissions.push_back(fmt::format(
            "{}, {}: {}: not judged: the matrix has no such runs", family.family,
            family.criterion.method, quantity_text(family.criterion)));
    }
  } // namespace

  void evaluate(MatrixResult &result)
  {
    result.criteria.clear();
    result.passed = std::any_of(result.runs.begin(), result.runs.end(),
                                [](const RunRecord &run)
                                { return run.status == RunStatus::finished; });
    if(!result.passed)
      result.omissions.push_back("no run finished: nothing was judged");
    for(const RunRecord &run : result.runs)
      if(run.status != RunStatus::finished)
      {
        result.omissions.push_back(omission(run));
        result.passed
            = result.passed
              && (run.status == RunStatus::refused || known_to_fail(result, run));
      }
    for(const StoredCase &record : result.cases)
      for(const cases::Criterion &written : record.criteria)
        for(const cases::Criterion &criterion :
            criteria_on_labels(result, record, written))
          judge_on_label(result, record, criterion);
    for(const FamilyCriterion &family : result.family_criteria)
      judge_family(result, family);
    result.findings = judge_findings(result, result.claims);
    result.passed
        = result.passed && std::ranges::all_of(result.findings, &FindingResult::holds);
  }
} // namespace meltfront::verification
