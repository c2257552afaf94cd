#include <verification/report/chapters/case_parts.h>
#include <verification/report/plots/case_plots.h>
#include <verification/report/tables/convergence_table.h>
#include <verification/report/tables/table.h>

namespace meltfront::verification
{
  Markup convergence(const ReportContext &context, const CaseRuns &runs)
  {
    const StoredCase &record = *runs.record;
    const Table table = convergence_table(runs);
    const auto key
        = [&context](const std::string &label) { return context.styles.key(label); };
    if(table.empty())
      return element("p", "No run of this case is in the matrix.");
    const Table rates = pairwise_table(runs), orders = orders_table(runs);
    const bool several = orders.groups.size() > 1;
    return element(
               "p", {{"class", "nothing"}},
               text("Orders are fitted by least squares over at least four levels; ± is "
                    "the half width of their 95 % confidence interval (Student's t times "
                    "the "
                    "standard error): in h, or in dt where only the time step was "
                    "refined. Levels whose error is at round-off (10⁻¹³ of the domain's "
                    "side, 10⁻¹³ where relative) are left out of the fit. "
                    + std::string(record.scene.changes_phase()
                                      ? "Errors of the front are root mean squares over "
                                        "the run; bold"
                                      : "Bold")
                    + " is the least of a column."))
           + (several ? table_markup(orders, key) : Markup()) + table_markup(table, key)
           + linked_csv(context, record.name(), convergence_csv(runs))
           + (rates.empty() ? Markup()
                            : folded("Rates between neighbouring resolutions",
                                     table_markup(rates, key)));
  }

  Markup error_plots(const ReportContext &context, const CaseRuns &runs)
  {
    const std::string &name = runs.record->name();
    const Plot cost = error_against_cost(runs, context.styles);
    const std::string note
        = cost.failed.empty() ? "" : " A cross marks a run that failed or was refused.";
    std::vector<Markup> figures;
    if(const Plot plot = error_against_spacing(runs, context.styles);
       !plot.curves.empty())
      figures.push_back(context.plots.figure(
          name + "-error-spacing", plot,
          text("Error against spacing, with fitted orders; grey: reference slopes."
               + note)));
    if(const Plot plot = error_against_time_step(runs, context.styles);
       !plot.curves.empty())
      figures.push_back(context.plots.figure(
          name + "-error-time-step", plot,
          text("Error against time step at one spacing, with fitted orders; grey: "
               "reference slopes."
               + note)));
    figures.push_back(context.plots.figure(
        name + "-error-cost", cost,
        text("Error against CPU time: left and low is better; grey: reference slopes."
             + note)));
    Markup content;
    for(std::size_t i = 0; i < figures.size(); i += 2)
      content += pair(figures[i], i + 1 < figures.size() ? figures[i + 1] : Markup());
    return content;
  }
} // namespace meltfront::verification
