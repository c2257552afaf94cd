#include <cases/case_file/case_file.h>
#include <cases/case_file/prm_lines.h>
#include <cases/case_file/prm_scan.h>
#include <cases/case_file/vary_case.h>

#include <algorithm>

namespace meltfront::cases
{
  namespace
  {
    /** The statement within its subsections, all in new lines at the end. */
    void append_statement(std::vector<std::string> &lines, const std::string &subsection,
                          const std::string &statement)
    {
      const std::vector<std::string> names
          = subsection.empty() ? std::vector<std::string>() : split_list(subsection, '/');
      for(const std::string &name : names)
        lines.push_back("subsection " + name);
      lines.push_back(statement);
      lines.insert(lines.end(), names.size(), "end");
    }
  } // namespace

  std::string varied_text(const std::string &text, const std::string &file,
                          const CaseSettings &settings)
  {
    const PrmScan scan = scan_prm(text, file);
    std::vector<std::string> lines = lines_of(text);
    for(const auto &[path, value] : settings)
    {
      const std::size_t slash = path.rfind('/');
      const bool nested = slash != std::string::npos;
      const std::string subsection = nested ? path.substr(0, slash) : "";
      const std::string key = nested ? path.substr(slash + 1) : path;
      std::string statement = "set ";
      statement += key + " = " + value;
      const auto found = std::ranges::find_if(
          scan.assignments, [&](const PrmAssignment &assignment)
          { return assignment.subsection == subsection && assignment.key == key; });
      if(found == scan.assignments.end())
        append_statement(lines, subsection, statement);
      else
        replace_statement(lines, static_cast<std::size_t>(found->line - 1), statement);
    }
    return joined(lines);
  }

  std::string text_without_figures(const std::string &text, const std::string &file)
  {
    const PrmScan scan = scan_prm(text, file);
    std::vector<std::string> lines = lines_of(text);
    for(const PrmAssignment &assignment : scan.assignments)
      if(assignment.subsection == "Acceptance" || assignment.subsection == "Printed")
      {
        const auto first = static_cast<std::size_t>(assignment.line - 1);
        replace_statement(lines, first, "#" + lines[first]);
      }
    return joined(lines);
  }

  Case read_varied_text(const std::string &text, const std::string &name)
  {
    Case varied = read_case_text(text, name + ".prm");
    varied.criteria.clear();
    varied.printed.clear();
    varied.printed_figures.clear();
    return varied;
  }

  Case vary_case(const Case &base, const std::string &name, const CaseSettings &settings)
  {
    return read_varied_text(varied_text(base.text, name + ".prm", settings), name);
  }
} // namespace meltfront::cases
