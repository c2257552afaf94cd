#include <verification/judge/coverage.h>
#include <verification/report/chapters/chapters.h>
#include <verification/report/page/number_text.h>
#include <verification/report/tables/table.h>

#include <fmt/format.h>

namespace meltfront::verification
{
  namespace
  {
    Table coverage_table(const std::vector<Coverage> &coverage)
    {
      Table table;
      table.group_heading = "method";
      table.columns = {{"quantity", "", false},
                       {"levels", "", true},
                       {"bars", "", true},
                       {"truth within", "%", true},
                       {"bar over error, median", "", true},
                       {"not converging", "", true}};
      for(const Coverage &row : coverage)
      {
        if(table.groups.empty() || table.groups.back().label != row.method)
          table.groups.push_back({row.method, {}, {}});
        table.groups.back().rows.push_back(
            {{row.quantity},
             {NumberText{grouped(row.levels), {}}},
             {NumberText{grouped(row.instances), {}}},
             {prose_number(100 * row.share())},
             {prose_number(row.median_bar_over_error)},
             {NumberText{grouped(row.not_converging), {}}}});
      }
      return table;
    }
  } // namespace

  Markup coverage_chapter(const ReportContext &context)
  {
    const std::vector<Coverage> coverage = coverage_of(context.result);
    if(coverage.empty())
      return {};
    return element("h2", "How far error bars can be trusted")
           + element("p",
                     "Every label whose levels are refined gives each quantity an error "
                     "bar that knows no exact solution. Where there is one, the true "
                     "error is held against it: how often it lies within the bar (90 % "
                     "wanted), and how many times larger the bar is (4 at most wanted).")
           + table_markup(coverage_table(coverage))
           + linked_csv(context, "coverage", coverage_csv(coverage));
  }
} // namespace meltfront::verification
