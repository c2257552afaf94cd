#include <verification/judge/criteria.h>
#include <verification/report/chapters/chapters.h>
#include <verification/report/page/front_page.h>
#include <verification/report/page/markup.h>
#include <verification/report/page/number_text.h>
#include <verification/report/page/page_style.h>
#include <verification/report/plots/gnuplot.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    std::string words_of(const CriterionResult &criterion)
    {
      std::string words
          = fmt::format("{}: {}: {} = {:.3g}", criterion.case_name, criterion.method,
                        criterion.quantity, criterion.value);
      if(const std::string remarks = remarks_on(criterion); !remarks.empty())
        words += fmt::format(" ({})", remarks);
      return words;
    }

    /** What is not met, below the matrix's name: a narrow screen shows it, too. */
    Markup failures(const MatrixLine &line)
    {
      if(line.failed.empty())
        return {};
      std::vector<Markup> items;
      for(const std::string &words : line.failed)
        items.push_back(text(words));
      return element("details",
                     element("summary", fmt::format("{} not met", items.size()))
                         + list("ul", items));
    }

    Markup row(const MatrixLine &line)
    {
      const auto figure = [](const std::string &words) {
        return element("td", {{"class", "number"}}, text(words));
      };
      return element(
          "tr", element("td", line.passed ? badge("good", "PASS") : badge("bad", "FAIL"))
                    + element("td", element("a", {{"href", line.link}}, text(line.matrix))
                                        + text(" ") + text(line.title) + failures(line))
                    + figure(fmt::format("{} of {}", line.held, line.criteria))
                    + figure(std::to_string(line.finished))
                    + figure(std::to_string(line.refused))
                    + figure(std::to_string(line.broken))
                    + figure(duration_text(line.cpu_seconds)));
    }

    Markup table(const std::vector<MatrixLine> &lines)
    {
      Markup head = element("th", std::string()) + element("th", std::string("matrix"));
      for(const char *heading :
          {"criteria held", "runs finished", "refused", "failed", "CPU time"})
        head += element("th", {{"class", "number"}}, text(heading));
      Markup rows;
      for(const MatrixLine &line : lines)
        rows += row(line) + Markup("\n");
      return element("div", {{"class", "scroll plain"}},
                     element("table", element("thead", element("tr", head))
                                          + element("tbody", rows)));
    }

    Markup verdict(const std::vector<MatrixLine> &lines)
    {
      long criteria = 0, held = 0;
      double seconds = 0;
      for(const MatrixLine &line : lines)
      {
        criteria += line.criteria;
        held += line.held;
        seconds += line.cpu_seconds;
      }
      const auto passed = std::ranges::count_if(lines, &MatrixLine::passed);
      const bool all = passed == static_cast<long>(lines.size());
      return element("p", {{"class", all ? "verdict good" : "verdict bad"}},
                     text(fmt::format("{} of {} matrices pass, {} of {} criteria hold",
                                      passed, lines.size(), held, criteria)))
             + element("p",
                       "Processor time of all runs: " + duration_text(seconds) + ".");
    }
  } // namespace

  MatrixLine matrix_line(const MatrixResult &result, const std::string &link)
  {
    MatrixLine line;
    line.matrix = result.name;
    line.title = result.title;
    line.link = link;
    line.passed = result.passed;
    line.criteria = static_cast<long>(result.criteria.size());
    for(const CriterionResult &criterion : result.criteria)
      if(criterion.passed)
        ++line.held;
      else
        line.failed.push_back(words_of(criterion));
    for(const FindingResult &finding : result.findings)
      if(!finding.holds())
        line.failed.push_back("finding: " + claim_text(finding));
    for(const StabilityVerdict &verdict : result.stability)
      if(verdict.verdict == "failed")
        line.failed.push_back(fmt::format("{}: {}, n = {}: {}", verdict.case_name,
                                          verdict.label, verdict.n, verdict.reason));
    for(const RunRecord &run : result.runs)
    {
      line.finished += run.status == RunStatus::finished;
      line.refused += run.status == RunStatus::refused;
      line.broken += run.status == RunStatus::failed;
      const double seconds = table_value(run, "cpu_seconds");
      line.cpu_seconds += std::isfinite(seconds) ? seconds : 0;
    }
    return line;
  }

  std::string line_text(const MatrixLine &line)
  {
    std::string text = fmt::format(
        "{:20} {}  {:3} of {:3} criteria  {:4} runs{}  {:8.1f} s CPU\n", line.matrix,
        line.passed ? "PASSED" : "FAILED", line.held, line.criteria, line.finished,
        line.refused + line.broken > 0
            ? fmt::format(" ({} refused, {} failed)", line.refused, line.broken)
            : "",
        line.cpu_seconds);
    for(const std::string &words : line.failed)
      text += fmt::format("    {}\n", words);
    return text;
  }

  void write_front_page(const std::vector<MatrixLine> &lines, const std::string &path)
  {
    const Markup head = page_head("meltfront: all matrices");
    const Markup body
        = element("main", element("section", element("h1", std::string("All matrices"))
                                                 + verdict(lines) + table(lines)));
    write_file(path, (Markup("<!DOCTYPE html>\n")
                      + element("html", {{"lang", "en"}},
                                element("head", head) + element("body", body)))
                             .html()
                         + "\n");
  }
} // namespace meltfront::verification
