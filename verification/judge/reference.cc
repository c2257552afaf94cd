#include <cases/numbers.h>
#include <verification/judge/ladder.h>
#include <verification/judge/reference.h>
#include <verification/judge/refinement.h>
#include <verification/measure/formulas/run_statistics.h>
#include <verification/measure/measure.h>
#include <verification/record/label.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace meltfront::verification
{
  namespace
  {
    using cases::nan;
    constexpr std::size_t levels_of_index = 3;
    constexpr const char *series_error = "solid_volume_rms_error";

    /** The reference and the next coarser runs of its label, finest first. */
    std::vector<const RunRecord *> reference_levels(const MatrixResult &result,
                                                    const StoredCase &record)
    {
      std::vector<const RunRecord *> levels;
      for(const RunRecord &run : result.runs)
        if(run.case_name == record.name() && run.status == RunStatus::finished
           && canonical_label(run.label) == canonical_label(record.reference->label)
           && run.n <= record.reference->n
           && std::ranges::none_of(levels, [&run](const RunRecord *other)
                                   { return other->n == run.n; }))
          levels.push_back(&run);
      std::ranges::sort(levels, std::ranges::greater(), &RunRecord::n);
      if(levels.empty() || levels.front()->n != record.reference->n)
        return {};
      levels.resize(std::min(levels.size(), levels_of_index));
      return levels;
    }

    /** As of any run; differences over time are those of the solid's volume. */
    double bar_of(const std::vector<const RunRecord *> &levels,
                  const Refinement &refinement, const std::string &name)
    {
      std::vector<BarLevel> values;
      std::vector<double> differences;
      for(auto run = levels.rbegin(); run != levels.rend(); ++run)
      {
        if(run != levels.rbegin())
          differences.push_back(name.starts_with("solid_volume") ? course_difference(
                                    **std::prev(run), **run, &RunSeries::solid_volume)
                                                                 : nan);
        values.push_back(
            {refinement.of(**run), (*run)->cost.steps, (*run)->quantity(name)});
      }
      const BarConstants constants = bar_constants(*levels.front());
      const BarTrust &trust
          = name.starts_with("solid_volume") ? constants.volume : constants.front;
      return error_bar(values, differences,
                       bar_recipe(constants, trust, std::abs(values.back().value),
                                  refinement.in_time()))
          .bar;
    }

    ReferenceTrust trust_in(const StoredCase &record,
                            const std::vector<const RunRecord *> &levels,
                            const std::string &name)
    {
      const Refinement refinement(levels);
      ReferenceTrust trust;
      trust.case_name = record.name();
      trust.label = levels.front()->label;
      trust.quantity = name;
      trust.symbol = refinement.symbol();
      for(const RunRecord *run : levels)
      {
        trust.n.push_back(run->n);
        trust.abscissa.push_back(refinement.of(*run));
        trust.values.push_back(run->quantity(name));
      }
      const bool different = std::ranges::is_sorted(trust.abscissa, std::less_equal());
      if(levels.size() == levels_of_index && different && trust.abscissa.front() > 0)
        trust.convergence = extrapolate(trust.abscissa, trust.values);
      if(different && trust.abscissa.front() > 0)
        trust.bar = bar_of(levels, refinement, name);
      return trust;
    }

    double series_difference(const RunSeries &series, const RunSeries &reference)
    {
      ErrorStatistics errors;
      const std::size_t size = std::min(series.time.size(), series.solid_volume.size());
      if(reference.solid_volume.size() != reference.time.size() || size == 0)
        return nan;
      const double tolerance = 1e-9 * (series.time.back() - series.time.front());
      for(std::size_t i = 0; i < size; ++i)
        errors.add(series.solid_volume[i]
                   - interpolated(reference.time, reference.solid_volume, series.time[i],
                                  tolerance));
      return errors.mean_over_time();
    }

    void compare(RunRecord &run, const RunRecord &reference,
                 const std::vector<ReferenceTrust> &trusts)
    {
      for(const ReferenceTrust &trust : trusts)
      {
        const double error
            = std::abs(run.quantity(trust.quantity) - trust.values.front());
        run.quantities[trust.quantity + "_error"] = error;
        run.quantities[trust.quantity + "_bars"] = error / trust.bar;
      }
      run.quantities[series_error] = series_difference(run.series, reference.series);
    }

    std::string named(const StoredCase &record)
    {
      return fmt::format("{}: the reference, {} at n = {},", record.name(),
                         record.reference->label, record.reference->n);
    }

    void compare_case(MatrixResult &result, const StoredCase &record)
    {
      const auto of_case
          = [&](const RunRecord &run) { return run.case_name == record.name(); };
      for(RunRecord &run : result.runs)
        if(of_case(run) && run.status == RunStatus::finished)
          for(const Quantity &known : all_quantities())
            if(known.from_reference)
              run.quantities[known.name] = nan;
      const auto levels = reference_levels(result, record);
      if(levels.empty())
      {
        if(std::ranges::any_of(result.runs, of_case))
          result.omissions.push_back(named(record)
                                     + " did not run or did not finish: nothing was "
                                       "compared with it");
        return;
      }
      if(levels.size() < levels_of_index)
        result.omissions.push_back(named(record)
                                   + " has fewer than two coarser runs beside it: its "
                                     "error bar is that of two levels or none");
      std::vector<ReferenceTrust> trusts;
      for(const Quantity &known : all_quantities())
        if(known.compared && std::isfinite(levels.front()->quantity(known.name)))
          trusts.push_back(trust_in(record, levels, known.name));
      for(RunRecord &run : result.runs)
        if(of_case(run) && run.status == RunStatus::finished
           && !is_reference(record, run))
          compare(run, *levels.front(), trusts);
      result.references.insert(result.references.end(), trusts.begin(), trusts.end());
    }
  } // namespace

  bool is_derived_quantity(const std::string &name)
  {
    const auto &known = all_quantities();
    const auto found = std::ranges::find(known, name, &Quantity::name);
    return found != known.end() && found->from_reference;
  }

  bool is_reference(const StoredCase &record, const RunRecord &run)
  {
    return record.reference && run.case_name == record.name()
           && run.n == record.reference->n
           && canonical_label(run.label) == canonical_label(record.reference->label);
  }

  void compare_with_references(MatrixResult &result)
  {
    result.references.clear();
    for(const StoredCase &record : result.cases)
      if(record.reference)
        compare_case(result, record);
  }
} // namespace meltfront::verification
