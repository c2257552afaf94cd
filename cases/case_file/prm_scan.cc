#include <cases/case_file/prm_scan.h>
#include <cases/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace meltfront::cases
{
  namespace
  {
    constexpr const char *blanks = " \t";

    /** Bytes of the UTF-8 character at a position; 0 where there is none. */
    std::size_t character_size(const std::string &text, std::size_t at)
    {
      const auto byte = [&text](std::size_t i)
      { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
      const unsigned first = byte(at);
      std::size_t size = 0;
      if(first < 0x80)
        size = 1;
      else if(first >= 0xc2 && first < 0xe0)
        size = 2;
      else if(first >= 0xe0 && first < 0xf0)
        size = 3;
      else if(first >= 0xf0 && first < 0xf5)
        size = 4;
      for(std::size_t i = 1; i < size; ++i)
        if((byte(at + i) & 0xc0) != 0x80)
          return 0;
      const unsigned second = byte(at + 1);
      const bool overlong
          = (first == 0xe0 && second < 0xa0) || (first == 0xf0 && second < 0x90);
      const bool surrogate = first == 0xed && second >= 0xa0;
      const bool beyond_unicode = first == 0xf4 && second >= 0x90;
      return overlong || surrogate || beyond_unicode ? 0 : size;
    }

    bool is_text(const std::string &line)
    {
      for(std::size_t i = 0; i < line.size();)
      {
        const std::size_t size = character_size(line, i);
        const auto byte = static_cast<unsigned char>(line[i]);
        if(size == 0 || (byte < 0x20 && byte != '\t') || byte == 0x7f)
          return false;
        i += size;
      }
      return true;
    }

    /** A statement without comment, its continuation lines joined. */
    struct Statement
    {
      std::string text;
      int line = 0; ///< on which it begins
    };

    std::vector<Statement> statements(const std::string &text, const std::string &file)
    {
      std::vector<Statement> result;
      int line_number = 0;
      bool continues = false;
      std::size_t begin = text.starts_with("\xef\xbb\xbf") ? 3 : 0;
      while(begin < text.size())
      {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        std::string line = text.substr(begin, end - begin);
        begin = end + 1;
        ++line_number;
        if(!line.empty() && line.back() == '\r')
          line.pop_back();
        if(!is_text(line))
          throw InputError(fmt::format("{}:{}: the line is not UTF-8 text (it holds a "
                                       "control character or a broken one)",
                                       file, line_number));
        line = trimmed(line.substr(0, line.find('#')));
        const bool goes_on = !line.empty() && line.back() == '\\';
        if(goes_on)
          line = trimmed(line.substr(0, line.size() - 1));
        if(!continues)
          result.push_back({line, line_number});
        else if(!line.empty())
          result.back().text += " " + line;
        continues = goes_on;
      }
      return result;
    }

    /** What follows a word and a blank at the start of a statement. */
    std::optional<std::string> after_word(const std::string &statement,
                                          const std::string &word)
    {
      if(!statement.starts_with(word))
        return {};
      if(statement.size() == word.size())
        return "";
      if(statement[word.size()] != ' ' && statement[word.size()] != '\t')
        return {};
      return trimmed(statement.substr(word.size()));
    }

    /** Follows the statements of a file and keeps the subsection that it is in. */
    class Scanner
    {
    public:
      explicit Scanner(std::string file)
        : file(std::move(file))
      {
      }

      void take(const Statement &statement)
      {
        if(statement.text.empty())
          return;
        if(const auto assignment = after_word(statement.text, "set"))
          assign(*assignment, statement.line);
        else if(const auto name = after_word(statement.text, "subsection"))
          open(*name, statement.line);
        else if(statement.text == "end")
          close(statement.line);
        else
          fail(statement.line,
               fmt::format("'{}' is not 'set KEY = VALUE', 'subsection NAME', 'end' or a "
                           "comment",
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
        throw InputError(fmt::format("{}:{}: {}", file, line, problem));
      }

      std::string path() const
      {
        return opened.empty() ? std::string() : opened.back().path;
      }

      void assign(const std::string &assignment, int line)
      {
        const std::size_t equals = assignment.find('=');
        if(equals == std::string::npos)
          fail(line, fmt::format("'set {}' has no '= VALUE'", quotable(assignment)));
        const std::string key = trimmed(assignment.substr(0, equals));
        if(key.empty())
          fail(line, "'set' has no key before '='");
        const auto [first, is_new] = first_lines.emplace(path() + "\n" + key, line);
        if(!is_new)
          fail(line, fmt::format("{} is set a second time, after line {}",
                                 name_of_key(path(), key), first->second));
        scan.assignments.push_back(
            {path(), key, trimmed(assignment.substr(equals + 1)), line});
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
      std::string file;
      std::vector<Opened> opened;
      std::map<std::string, int> first_lines;
      PrmScan scan;
    };
  } // namespace

  PrmScan scan_prm(const std::string &text, const std::string &file)
  {
    Scanner scanner(file);
    for(const Statement &statement : statements(text, file))
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

  std::string trimmed(const std::string &text)
  {
    const std::size_t first = text.find_first_not_of(blanks);
    if(first == std::string::npos)
      return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
  }
} // namespace meltfront::cases
