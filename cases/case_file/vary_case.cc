#include <cases/case_file/case_file.h>
#include <cases/case_file/prm_scan.h>
#include <cases/case_file/vary_case.h>

#include <algorithm>

namespace meltfront::cases
{
  namespace
  {
    std::vector<std::string> lines_of(const std::string &text)
    {
      std::vector<std::string> lines;
      for(std::size_t begin = 0; begin < text.size();)
      {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        lines.push_back(text.substr(begin, end - begin));
        if(!lines.back().empty() && lines.back().back() == '\r')
          lines.back().pop_back();
        begin = end + 1;
      }
      return lines;
    }

    std::string joined(const std::vector<std::string> &lines)
    {
      std::string text;
      for(const std::string &line : lines)
        text += line + "\n";
      return text;
    }

    bool goes_on(const std::string &line)
    {
      const std::string statement = trimmed(line.substr(0, line.find('#')));
      return !statement.empty() && statement.back() == '\\';
    }

    /** Put another statement in place of the one that begins on a line; the lines on
     * which that went on are left empty. */
    void replace_statement(std::vector<std::string> &lines, std::size_t first,
                           const std::string &statement)
    {
      std::size_t last = first;
      while(last + 1 < lines.size() && goes_on(lines[last]))
        ++last;
      std::fill(lines.begin() + static_cast<std::ptrdiff_t>(first + 1),
                lines.begin() + static_cast<std::ptrdiff_t>(last + 1), std::string());
      lines[first] = statement;
    }

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
