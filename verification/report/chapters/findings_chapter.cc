#include <verification/record/label.h>
#include <verification/report/chapters/case_parts.h>
#include <verification/report/chapters/chapters.h>
#include <verification/report/plots/curve_labels.h>
#include <verification/report/plots/plot_data.h>
#include <verification/report/plots/plot_layout.h>
#include <verification/report/plots/variation_plots.h>
#include <verification/report/tables/convergence_table.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    /** What an evidence measured: one number, or least and greatest of several cases. */
    Markup measured(const EvidenceResult &evidence)
    {
      if(evidence.values.empty())
        return badge("bad", "not measured");
      const Markup least = number_markup(evidence.least()),
                   greatest = number_markup(evidence.greatest());
      return least.html() == greatest.html() ? least : least + text(" to ") + greatest;
    }

    Markup sentence(const FindingResult &finding)
    {
      Markup words;
      for(const ClaimPiece &piece :
          pieces_of_claim(finding.claim, finding.evidence.size()))
        words
            += piece.evidence < 0
                   ? text(piece.words)
                   : measured(finding.evidence[static_cast<std::size_t>(piece.evidence)]);
      return (finding.holds() ? badge("good", "holds")
                              : badge("bad", "not borne out by this run"))
             + text(" ") + words;
    }

    /** One row for each evidence: what was measured, the bound, cases that break it. */
    Markup evidence_table(const std::vector<FindingResult> &findings)
    {
      Markup head;
      for(const char *heading :
          {"", "finding", "cases", "method", "quantity", "measured", "bound", ""})
        head += element("th", std::string(heading));
      Markup rows;
      for(std::size_t f = 0; f < findings.size(); ++f)
        for(const EvidenceResult &evidence : findings[f].evidence)
        {
          const cases::Criterion &criterion = evidence.evidence.criterion;
          CriterionResult bound;
          bound.lower = criterion.lower;
          bound.upper = criterion.upper;
          std::string remark = criterion.expected_failure.empty()
                                   ? ""
                                   : "expected failure: " + criterion.expected_failure;
          if(evidence.values.size() > 1)
            for(const EvidenceValue &value : evidence.values)
              if(!value.passed)
                remark += fmt::format("{}{}: {}", remark.empty() ? "" : "; ",
                                      value.case_name, plain_number(value.value));
          for(const EvidenceValue &value : evidence.values)
            if(!value.remark.empty())
              remark += fmt::format("{}{}", remark.empty() ? "" : "; ", value.remark);
          rows += element("tr",
                          element("td", evidence.passed() ? badge("good", "PASS")
                                                          : badge("bad", "FAIL"))
                              + element("td", std::to_string(f + 1))
                              + element("td", evidence.evidence.cases)
                              + element("td", criterion.method)
                              + element("td", evidence.quantity)
                              + element("td", {{"class", "number"}}, measured(evidence))
                              + element("td", {{"class", "number"}}, bound_of(bound))
                              + element("td", remark))
                  + Markup("\n");
        }
      return element("div", {{"class", "scroll plain"}},
                     element("table", element("thead", element("tr", head))
                                          + element("tbody", rows)));
    }

    std::string axis_label(const StoredCase &record, const std::string &quantity)
    {
      if(quantity == "cpu_seconds")
        return "CPU time (s)"; // also where the case's own quantities have no unit
      for(const Quantity &known : table_quantities())
        if(known.name == quantity)
        {
          const std::string words = known.name == "h"    ? "spacing h"
                                    : known.name == "dt" ? "time step dt"
                                    : known.error        ? "error of " + known.heading
                                                         : known.heading;
          return with_unit(words,
                           known.unit == "relative" ? "" : unit_of(record, known.unit));
        }
      return quantity;
    }

    Curve curve_of(const StoredCase &record, const LabelRuns &runs,
                   const Picture &picture)
    {
      Curve curve;
      for(const Level &level : runs.levels)
        if(level.finished)
        {
          curve.x.push_back(level.value(picture.against));
          curve.y.push_back(level.value(picture.quantity));
        }
      const OrderFit fit = order_of(record, runs, picture.quantity);
      if(picture.against == runs.refinement.symbol() && std::isfinite(fit.order))
        curve.exponent = fmt::format("{}^{:.2f}", picture.against, fit.order);
      return curve;
    }

    Plot plot_of(const std::vector<CaseRuns> &all, const Picture &picture)
    {
      Plot plot;
      plot.description = picture.caption;
      plot.x.logarithmic = plot.y.logarithmic = true;
      std::vector<const CaseRuns *> chosen;
      for(const CaseRuns &runs : all)
        if(label_matches(picture.cases, runs.record->name()))
          chosen.push_back(&runs);
      for(const CaseRuns *runs : chosen)
      {
        plot.x.label = axis_label(*runs->record, picture.against);
        plot.y.label = axis_label(*runs->record, picture.quantity);
        for(const LabelRuns &label : runs->labels)
          if(std::ranges::any_of(picture.runs, [&label](const std::string &pattern)
                                 { return label_matches(pattern, label.label); }))
          {
            plot.curves.push_back(curve_of(*runs->record, label, picture));
            plot.curves.back().label
                = chosen.size() == 1 ? label.label : runs->record->name();
          }
      }
      shorten_labels(plot);
      if(picture.against == "h" || picture.against == "dt")
        plot.guides = {{1, picture.against}, {2, picture.against}};
      return plot;
    }

    /** Curves of one method have colours of their own here; a key where their labels do
     * not fit beside the lines. */
    Markup figure_of(const ReportContext &context, const std::vector<CaseRuns> &all,
                     const Picture &picture, const std::string &name)
    {
      Plot plot = plot_of(all, picture);
      std::vector<std::string> labels;
      for(const Curve &curve : plot.curves)
        labels.push_back(curve.label);
      const MethodStyles styles(labels);
      for(Curve &curve : plot.curves)
        curve.style = styles.style(curve.label);
      const bool fits = std::ranges::all_of(labels, [](const std::string &label)
                                            { return label.size() <= longest_label; });
      return context.plots.figure(
          name, plot, text(picture.caption) + (fits ? Markup() : styles.legend(labels)));
    }

    Markup pictures(const ReportContext &context)
    {
      std::vector<CaseRuns> all = context.runs;
      all.insert(all.end(), context.variations.begin(), context.variations.end());
      std::vector<Markup> figures;
      for(const Picture &picture : context.result.pictures)
        figures.push_back(figure_of(context, all, picture,
                                    fmt::format("finding-{}", figures.size() + 1)));
      Markup content;
      for(std::size_t i = 0; i < figures.size(); i += 2)
        content += pair(figures[i], i + 1 < figures.size() ? figures[i + 1] : Markup());
      return content;
    }

    Markup map_of(const ReportContext &context, const VariationGroup &group,
                  const std::string &label)
    {
      return context.plots.figure(
          fmt::format("{}-{}-map", group.file_name(), label),
          variation_map_script(group, label),
          fmt::format("Map of the error of {} over {}", label, group.title()),
          text(fmt::format("{}, {}: for each pair of values the front's error on the "
                           "finest level (root mean square over the exact front at the "
                           "end; darker: larger), the order fitted over all levels or "
                           "what keeps them from having one, and in brackets V h/α: "
                           "above 1 the thermal layer at the front is thinner than the "
                           "spacing.",
                           group.title(), label)));
    }

    /** Maps of groups with two axes, and where accuracy is lost. */
    Markup maps(const ReportContext &context)
    {
      Markup content;
      for(const VariationGroup &group : variation_groups(context.variations))
      {
        if(group.axes.size() != 2)
          continue;
        const std::string &label = group.labels.front();
        content += pair(
            map_of(context, group, label),
            context.plots.figure(
                group.file_name() + "-layer", error_against_peclet(group, label),
                text(fmt::format("{}, {}: the front's error at every n of every pair of "
                                 "values, against the spacing over the thickness of the "
                                 "thermal layer at the front; one colour for each {}.",
                                 group.title(), label, group.axes[0].heading))));
      }
      return content;
    }
  } // namespace

  Markup findings_chapter(const ReportContext &context)
  {
    const std::vector<FindingResult> &findings = context.result.findings;
    std::vector<Markup> sentences;
    for(const FindingResult &finding : findings)
      sentences.push_back(sentence(finding));
    Markup content;
    if(!findings.empty())
      content += element("p", "What the runs show. The numbers in the sentences are "
                              "measured; each sentence rests on criteria that were held "
                              "against these runs, and is marked where they fail.")
                 + list("ol", sentences)
                 + folded("What each finding rests on", evidence_table(findings));
    content += pictures(context) + maps(context);
    return content.empty() ? content : element("h2", "Findings") + content;
  }
} // namespace meltfront::verification
