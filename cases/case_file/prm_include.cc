#include <cases/case_file/prm_include.h>
#include <cases/case_file/prm_scan.h>
#include <cases/case_file/prm_statement.h>
#include <cases/error.h>
#include <cases/options.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace meltfront::cases
{
  namespace
  {
    namespace fs = std::filesystem;

    constexpr std::uintmax_t largest_text = 4 << 20;

    std::vector<std::string> raw_lines(const std::string &text)
    {
      std::vector<std::string> lines;
      for(std::size_t begin = 0; begin < text.size();)
      {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        lines.push_back(text.substr(begin, end - begin));
        begin = end + 1;
      }
      return lines;
    }

    /** Files below a folder, as an `include` would name them. */
    std::vector<std::string> files_below(const std::string &folder)
    {
      std::vector<std::string> names;
      std::error_code failure;
      for(const auto &entry : fs::recursive_directory_iterator(folder, failure))
        if(entry.path().extension() == ".prm")
          names.push_back(entry.path().lexically_relative(folder).string());
      return names;
    }

    /** A path that is the same however a file is named. */
    fs::path same_file(const fs::path &path)
    {
      std::error_code failure;
      const fs::path result = fs::weakly_canonical(path, failure);
      return failure ? path : result;
    }

    /** Puts texts together, file by file. */
    class Includer
    {
    public:
      Includer(const std::string &library, PrmText &result)
        : library(library)
        , result(result)
      {
      }

      void add(const std::string &text, const std::string &file)
      {
        const int reading = static_cast<int>(result.files.size());
        result.files.push_back(quotable(file));
        result.paths.push_back(file);
        open.push_back(same_file(file));
        const std::vector<std::string> lines = raw_lines(text);
        int next = 1;
        for(const PrmStatement &statement : prm_statements(text, quotable(file)))
          if(const auto name = after_word(statement.text, "include"))
          {
            add_lines(lines, next, statement.line, reading);
            next = statement.last_line + 1;
            include(*name, fs::path(file).parent_path(), {reading, statement.line});
          }
        add_lines(lines, next, static_cast<int>(lines.size()) + 1, reading);
        open.pop_back();
      }

    private:
      void add_line(const std::string &line, const PrmOrigin &origin)
      {
        result.text += line + "\n";
        result.origins.push_back(origin);
      }

      void add_lines(const std::vector<std::string> &lines, int first, int end,
                     int reading)
      {
        for(int i = first; i < end; ++i)
          add_line(lines[static_cast<std::size_t>(i - 1)], {reading, i});
      }

      [[noreturn]] void fail(const PrmOrigin &at, const std::string &problem) const
      {
        throw InputError(fmt::format("{}:{}: {}",
                                     result.files[static_cast<std::size_t>(at.reading)],
                                     at.line, problem));
      }

      void include(const std::string &name, const fs::path &folder, const PrmOrigin &at)
      {
        if(name.empty())
          fail(at, "'include' names no file");
        const std::string path = find(name, folder, at);
        if(std::ranges::find(open, same_file(path)) != open.end())
          fail(at, fmt::format("'{}' includes itself", quotable(name)));
        std::string text = read_prm_text(path);
        if(text.starts_with("\xef\xbb\xbf"))
          text.erase(0, 3);
        if(result.text.size() + text.size() > largest_text)
          fail(at, "with what it includes the file is larger than 4 MB, which no "
                   "parameter file is");
        check_balance(text, path);
        add_line("# include " + name, at);
        add(text, path);
        // A comment also ends a statement that the file's last line leaves open.
        add_line("# end of " + name, at);
      }

      std::string find(const std::string &name, const fs::path &folder,
                       const PrmOrigin &at) const
      {
        std::error_code failure;
        for(const fs::path &path : {folder / name, library / name})
          if(fs::exists(path, failure))
            return path.string();
        const std::vector<std::string> there = files_below(library);
        const std::string advice
            = there.empty() ? ""
                            : fmt::format("; the nearest of the library is '{}'",
                                          nearest_name(name.substr(0, 200), there));
        fail(at, fmt::format("there is no file '{}' to include, neither beside this file "
                             "nor in the library{}",
                             quotable(name), advice));
      }

      /** An included file closes the subsections that it opens, and no others. */
      static void check_balance(const std::string &text, const std::string &file)
      {
        std::vector<PrmStatement> opened;
        for(const PrmStatement &statement : prm_statements(text, quotable(file)))
          if(after_word(statement.text, "subsection"))
            opened.push_back(statement);
          else if(statement.text == "end")
          {
            if(opened.empty())
              throw InputError(
                  fmt::format("{}:{}: 'end' closes no subsection of this file",
                              quotable(file), statement.line));
            opened.pop_back();
          }
        if(!opened.empty())
          throw InputError(fmt::format("{}:{}: '{}' has no 'end' in this file",
                                       quotable(file), opened.back().line,
                                       quotable(opened.back().text)));
      }

      fs::path library;
      PrmText &result;
      std::vector<fs::path> open; ///< files that are being read, the innermost last
    };

    PrmOrigin origin_of(const PrmText &text, int line)
    {
      const int last = static_cast<int>(text.origins.size());
      return line >= 1 && line <= last ? text.origins[static_cast<std::size_t>(line - 1)]
                                       : PrmOrigin{0, line};
    }
  } // namespace

  std::string PrmText::place(int line) const
  {
    const PrmOrigin origin = origin_of(*this, line);
    return fmt::format("{}:{}", files[static_cast<std::size_t>(origin.reading)],
                       origin.line);
  }

  const std::string &PrmText::path(int line) const
  {
    return paths[static_cast<std::size_t>(reading(line))];
  }

  int PrmText::reading(int line) const
  {
    return origin_of(*this, line).reading;
  }

  std::string read_prm_text(const std::string &path)
  {
    return read_text_file(path, largest_text, "parameter file");
  }

  std::string read_text_file(const std::string &path, std::uintmax_t largest,
                             const std::string &what)
  {
    std::error_code failure;
    const auto status = fs::status(path, failure);
    if(!fs::exists(status))
      throw OutputError(fmt::format("{}: there is no such file", quotable(path)));
    if(!fs::is_regular_file(status))
      throw OutputError(
          fmt::format("{}: is not a file that can be read", quotable(path)));
    if(fs::file_size(path, failure) > largest)
      throw InputError(fmt::format("{}:1: the file is larger than {} MB, which no {} is",
                                   quotable(path), largest >> 20, what));
    std::ifstream stream(path, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    if(!stream)
      throw OutputError(fmt::format("{}: cannot be read", quotable(path)));
    return text;
  }

  PrmText plain_text(const std::string &text, const std::string &file)
  {
    PrmText result{text, {quotable(file)}, {file}, {}};
    const int lines = static_cast<int>(std::ranges::count(text, '\n')) + 1;
    for(int line = 1; line <= lines; ++line)
      result.origins.push_back({0, line});
    return result;
  }

  PrmText expand_includes(const std::string &text, const std::string &file,
                          const std::string &library)
  {
    PrmText result;
    Includer(library, result).add(text, file);
    return result.files.size() == 1 ? plain_text(text, file) : result;
  }
} // namespace meltfront::cases
