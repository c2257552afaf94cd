#include <cases/case_file/prm_lines.h>
#include <cases/case_file/prm_scan.h>

#include <algorithm>

namespace meltfront::cases
{
  namespace
  {
    bool goes_on(const std::string &line)
    {
      const std::string statement = trimmed(line.substr(0, line.find('#')));
      return !statement.empty() && statement.back() == '\\';
    }
  } // namespace

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
} // namespace meltfront::cases
