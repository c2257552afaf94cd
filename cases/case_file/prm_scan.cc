#include <cases/case_file/prm_scan.h>
#include <cases/case_file/prm_statement.h>
#include <cases/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace meltfront::cases
{
  namespace
  {
    constexpr const char *blanks = " \t";

    /** Follows the statements of a file and keeps the subsection that it is in. */
    class Scanner
    {
    public:
      explicit Scanner(const PrmText &source)
        : source(source)
      {
      }

      void take(const PrmStatement &statement)
      {
        if(statement.text.empty())
          return;
        if(const auto assignment = after_word(statement.text, "set"))
          assign(*assignment, statement);
        else if(const auto name = after_word(statement.text, "subsection"))
          open(*name, statement.line);
        else if(statement.text == "end")
          close(statement.line);
        else
          fail(statement.line,
               fmt::format("'{}' is not 'set KEY = VALUE', 'subsection NAME', 'end', "
                           "'include FILE' or a comment",
                           quotable(statement.text)));
      }

      PrmScan finish()
      {
        if(!opened.empty())
          fail(opened.back().line,
               fmt::format("subsection '{}' has no 'end'", quotable(opened.back().path)));
        return std::move(scan);
      }

    private:
      struct Opened
      {
        std::string path;
        int line;
      };

      [[noreturn]] void fail(int line, const std::string &problem) const
      {
        throw InputError(fmt::format("{}: {}", source.place(line), problem));
      }

      std::string path() const
      {
        return opened.empty() ? std::string() : opened.back().path;
      }

      void assign(const std::string &assignment, const PrmStatement &statement)
      {
        const int line = statement.line;
        const std::size_t equals = assignment.find('=');
        if(equals == std::string::npos)
          fail(line, fmt::format("'set {}' has no '= VALUE'", quotable(assignment)));
        const std::string key = trimmed(assignment.substr(0, equals));
        if(key.empty())
          fail(line, "'set' has no key before '='");
        std::vector<PrmStatement> &before = set[path() + "\n" + key];
        if(!before.empty())
          override_statement(before, line, key);
        before.push_back(statement);
        scan.assignments.push_back(
            {path(), key, trimmed(assignment.substr(equals + 1)), line});
      }

      /** A file may set anew what another one has set: the later one counts. Entries of a
       * list, `criterion 1`, are not values of one key: none of them is to get lost. */
      void override_statement(const std::vector<PrmStatement> &before, int line,
                              const std::string &key)
      {
        for(const PrmStatement &one : before)
          if(source.reading(one.line) == source.reading(line))
            fail(line, fmt::format("{} is set a second time, after line {}",
                                   name_of_key(path(), key),
                                   source.origins[one.line - 1].line));
        const PrmStatement &last = before.back();
        if(std::isdigit(static_cast<unsigned char>(key.back())))
          fail(line, fmt::format("{} is set in {} too: number it otherwise",
                                 name_of_key(path(), key), source.place(last.line)));
        scan.overridden.emplace_back(last.line, last.last_line);
        std::erase_if(scan.assignments, [&last](const PrmAssignment &assignment)
                      { return assignment.line == last.line; });
      }

      void open(const std::string &name, int line)
      {
        if(name.empty())
          fail(line, "'subsection' has no name");
        if(opened.size() >= deepest)
          fail(line, fmt::format("subsections are nested more than {} deep", deepest));
        opened.push_back({opened.empty() ? name : path() + "/" + name, line});
        scan.subsections.emplace(path(), line);
      }

      void close(int line)
      {
        if(opened.empty())
          fail(line, "'end' closes no subsection");
        opened.pop_back();
      }

      static constexpr std::size_t deepest = 20;
      const PrmText &source;
      std::vector<Opened> opened;
      std::map<std::string, std::vector<PrmStatement>> set; ///< by subsection and key
      PrmScan scan;
    };
  } // namespace

  PrmScan scan_prm(const std::string &text, const std::string &file)
  {
    return scan_prm(plain_text(text, file));
  }

  PrmScan scan_prm(const PrmText &text)
  {
    Scanner scanner(text);
    for(const PrmStatement &statement : prm_statements(text.text, text.files.front()))
      scanner.take(statement);
    return scanner.finish();
  }

  std::string quotable(const std::string &text)
  {
    constexpr std::size_t longest = 60;
    std::string result;
    std::size_t characters = 0;
    for(std::size_t i = 0; i < text.size(); ++characters)
    {
      if(characters == longest)
        return result + "...";
      const std::size_t size = character_size(text, i);
      const auto byte = static_cast<unsigned char>(text[i]);
      if(size == 0 || byte < 0x20 || byte == 0x7f)
        result += '?';
      else
        result += text.substr(i, size);
      i += std::max<std::size_t>(size, 1);
    }
    return result;
  }

  std::string name_of_key(const std::string &subsection, const std::string &key)
  {
    return subsection.empty() ? fmt::format("key '{}' at the top level", quotable(key))
                              : fmt::format("key '{}' in subsection '{}'", quotable(key),
                                            quotable(subsection));
  }

  std::vector<std::string> split_list(const std::string &text, char separator)
  {
    std::vector<std::string> parts;
    std::size_t begin = 0;
    while(true)
    {
      const std::size_t end = text.find(separator, begin);
      parts.push_back(trimmed(text.substr(begin, end - begin)));
      if(end == std::string::npos)
        return parts;
      begin = end + 1;
    }
  }

  std::string parent_subsection(const std::string &path)
  {
    const std::size_t slash = path.rfind('/');
    return slash == std::string::npos ? std::string() : path.substr(0, slash);
  }

  std::string trimmed(const std::string &text)
  {
    const std::size_t first = text.find_first_not_of(blanks);
    if(first == std::string::npos)
      return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
  }
} // namespace meltfront::cases
