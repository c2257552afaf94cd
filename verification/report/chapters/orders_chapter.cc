#include <verification/record/label.h>
#include <verification/report/chapters/chapters.h>
#include <verification/report/tables/convergence_table.h>
#include <verification/report/tables/table.h>

#include <algorithm>

namespace meltfront::verification
{
  namespace
  {
    bool sets_degree(const LabelRuns &runs)
    {
      const auto options = options_of(runs.label);
      return std::any_of(options.begin(), options.end(),
                         [](const auto &option) { return option.first == "degree"; });
    }

    /** The tables of all cases, of those labels that are chosen. */
    template <typename Chosen>
    Markup tables(const ReportContext &context, const Chosen &chosen)
    {
      Markup content;
      for(const CaseRuns &runs : context.runs)
      {
        CaseRuns some = runs;
        std::erase_if(some.labels,
                      [&chosen](const LabelRuns &label) { return !chosen(label); });
        const Table table = orders_table(some);
        if(!table.empty())
          content += element("h4", case_link(runs.record->name()))
                     + table_markup(table, [&context](const std::string &label)
                                    { return context.styles.key(label); });
      }
      return content;
    }
  } // namespace

  Markup orders_chapter(const ReportContext &context)
  {
    const Markup in_time = tables(context, [](const LabelRuns &label)
                                  { return label.refinement.in_time(); });
    const Markup by_degree
        = tables(context, [](const LabelRuns &label)
                 { return !label.refinement.in_time() && sets_degree(label); });
    Markup content;
    if(!in_time.empty())
      content += element("h3", "Orders of the time schemes") + in_time;
    if(!by_degree.empty())
      content += element("h3", "Orders of the elements by degree") + by_degree;
    if(content.empty())
      return content;
    return element("h2", "Orders of schemes and elements")
           + element("p", "Exponents fitted over at least four levels, of dt where the "
                          "spacing was kept and of h elsewhere, without levels at "
                          "round-off; the least error that was reached, and what it "
                          "took.")
           + content;
  }
} // namespace meltfront::verification
