#include <cases/case_file/prm_attachment.h>
#include <verification/report/chapters/chapters.h>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>

namespace meltfront::verification
{
  namespace
  {
    std::string joined(const std::set<std::string> &values)
    {
      std::string result;
      for(const std::string &value : values)
        result += (result.empty() ? "" : "; ") + value;
      return result;
    }

    std::set<std::string> values_of(const MatrixResult &result, const std::string &key)
    {
      std::set<std::string> values;
      for(const RunRecord &run : result.runs)
      {
        const auto found = run.provenance.find(key);
        if(found != run.provenance.end() && !found->second.empty())
          values.insert(found->second);
      }
      return values;
    }

    /** Numbers as text, ascending. */
    template <typename Number>
    std::string numbers(const std::set<Number> &values)
    {
      std::string result;
      for(const Number value : values)
        result += fmt::format("{}{}", result.empty() ? "" : ", ", value);
      return result;
    }

    /** The same with runs of three and more neighbours as `1 to 200`. */
    std::string ranges(const std::set<std::uint64_t> &values)
    {
      std::string result;
      for(auto first = values.begin(); first != values.end();)
      {
        auto last = first;
        while(std::next(last) != values.end() && *std::next(last) == *last + 1)
          ++last;
        if(*last - *first < 2)
          last = first;
        result += fmt::format("{}{}", result.empty() ? "" : ", ", *first);
        if(last != first)
          result += fmt::format(" to {}", *last);
        first = std::next(last);
      }
      return result;
    }

    Markup environment(const MatrixResult &result)
    {
      std::set<int> threads, repeats;
      std::set<std::uint64_t> seeds;
      for(const RunRecord &run : result.runs)
      {
        threads.insert(run.threads);
        repeats.insert(run.repeats);
        seeds.insert(run.seed);
      }
      Markup rows;
      const auto add = [&rows](const std::string &what, const std::string &value)
      {
        if(!value.empty())
          rows
              += element("tr", element("td", what) + element("td", value)) + Markup("\n");
      };
      std::set<std::string> versions = values_of(result, "program_version");
      if(!result.program_version.empty())
        versions.insert(result.program_version);
      add("program", joined(versions));
      add("report made from", result.date);
      add("processor", joined(values_of(result, "cpu")));
      add("compiler", joined(values_of(result, "compiler")));
      add("flags", joined(values_of(result, "flags")));
      add("particle methods compiled for", joined(values_of(result, "kernels")));
      add("packages", joined(values_of(result, "packages")));
      add("threads per run", numbers(threads));
      add("times are the least of", repeats.empty() ? "" : numbers(repeats) + " runs");
      add("seeds", ranges(seeds));
      add("command line", joined(values_of(result, "command_line")));
      return element("div", {{"class", "scroll plain"}},
                     element("table", element("tbody", rows)));
    }

    Markup case_files(const std::vector<StoredCase> &records)
    {
      Markup content;
      std::set<std::string> varied;
      for(const StoredCase &record : records)
      {
        // Of the variations of a case one text says it all, beside their table.
        if(!record.variation.empty() && !varied.insert(record.variation_of).second)
          continue;
        const Markup summary
            = text(record.name() + "  ")
              + element("span", {{"class", "hash"}}, text("SHA-256 " + record.hash));
        content += element("details",
                           element("summary", summary)
                               + element("pre", cases::without_attachments(record.text)));
      }
      return content;
    }
  } // namespace

  Markup provenance_chapter(const ReportContext &context)
  {
    Markup content = element("h2", "Provenance") + environment(context.result);
    if(!context.result.cases.empty())
      content += element("h3", "Case files") + case_files(context.result.cases);
    return content;
  }
} // namespace meltfront::verification
