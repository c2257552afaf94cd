#include <cases/case_file/prm_lines.h>
#include <cases/case_file/prm_scan.h>
#include <cases/case_file/prm_table.h>
#include <cases/case_file/value_units.h>
#include <cases/error.h>
#include <cases/options.h>

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>

namespace meltfront::cases
{
  namespace
  {
    namespace fs = std::filesystem;

    /** A column as the header names it. */
    struct Column
    {
      std::string name, unit;
    };

    class CsvTable
    {
    public:
      CsvTable(const std::string &path, std::string shown)
        : shown(std::move(shown))
        , lines(lines_of(read_prm_text(path)))
      {
        if(!lines.empty() && lines[0].starts_with("\xef\xbb\xbf"))
          lines[0].erase(0, 3);
        skip();
        if(at == lines.size())
          fail("holds no header");
        for(const char one : {';', '\t'})
          if(lines[at].find(one) != std::string::npos)
            separator = one;
        for(const std::string &cell : cells())
          columns.push_back(column(cell));
        if(columns.size() < 2)
          fail("needs two columns or more, separated by commas, semicolons or tabs");
      }

      const std::vector<Column> &header() const
      {
        return columns;
      }

      /** The next line's cells; none at the end. */
      std::optional<std::vector<std::string>> next()
      {
        if(at < lines.size())
          ++at;
        skip();
        if(at == lines.size())
          return {};
        std::vector<std::string> row = cells();
        if(row.size() != columns.size())
          fail(fmt::format("has {} cells, and the header names {} columns", row.size(),
                           columns.size()));
        return row;
      }

      [[noreturn]] void fail(const std::string &problem) const
      {
        throw InputError(fmt::format(
            "names a table that cannot be used: {}:{}: {}", shown,
            std::max<std::size_t>(std::min(at + 1, lines.size()), 1), problem));
      }

      /** A cell in SI units. @param unit of the key, or of what the table is over */
      double number(const std::string &cell, const Column &of,
                    const std::string &unit) const
      {
        double value = 0;
        const char *const end = cell.data() + cell.size();
        const auto [stop, error] = std::from_chars(cell.data(), end, value);
        if(cell.empty() || error != std::errc() || stop != end || !std::isfinite(value))
          fail(fmt::format("'{}' is no number", quotable(cell)));
        if(of.unit.empty())
          return value;
        try
        {
          return std::strtod(in_units_of(cell + " " + of.unit, unit).text.c_str(),
                             nullptr);
        }
        catch(const InputError &problem)
        {
          fail(fmt::format("the column '{}' {}", of.name, problem.what()));
        }
      }

    private:
      void skip()
      {
        while(at < lines.size()
              && (trimmed(lines[at]).empty() || trimmed(lines[at])[0] == '#'))
          ++at;
      }

      std::vector<std::string> cells() const
      {
        std::vector<std::string> result = split_list(lines[at], separator);
        for(std::string &cell : result)
          if(cell.size() >= 2 && cell.front() == '"' && cell.back() == '"')
            cell = trimmed(cell.substr(1, cell.size() - 2));
        return result;
      }

      Column column(const std::string &cell) const
      {
        const std::size_t open = cell.find('(');
        if(open == std::string::npos || cell.back() != ')')
          fail(fmt::format("the header's '{}' needs its unit in brackets behind it, "
                           "'time (h)', or (1) if it has none",
                           quotable(cell)));
        const std::string unit = trimmed(cell.substr(open + 1, cell.size() - open - 2));
        return {trimmed(cell.substr(0, open)), unit == "1" ? "" : unit};
      }

      std::string shown;
      std::vector<std::string> lines;
      std::size_t at = 0;
      char separator = ',';
      std::vector<Column> columns;
    };

    std::string path_of_table(const std::string &file, const std::string &beside,
                              const std::string &library)
    {
      std::error_code failure;
      for(const fs::path &path : {fs::path(beside).parent_path() / file, fs::path(file),
                                  fs::path(library) / file})
        if(fs::is_regular_file(path, failure))
          return path.string();
      throw InputError(fmt::format("names the table '{}', which is neither beside this "
                                   "file nor where the program was started",
                                   quotable(file)));
    }

    std::size_t wanted_column(const CsvTable &table, const std::string &name)
    {
      const std::vector<Column> &columns = table.header();
      std::vector<std::string> names;
      for(std::size_t i = 1; i < columns.size(); ++i)
        if(columns[i].name == name)
          return i;
        else
          names.push_back(columns[i].name);
      if(name.empty() && columns.size() == 2)
        return 1;
      if(name.empty())
        table.fail("has several columns: 'table FILE column NAME' says which");
      table.fail(fmt::format("has no column '{}'; the nearest is '{}'", quotable(name),
                             nearest_name(name.substr(0, 200), names)));
    }
  } // namespace

  PrmTable read_table(const std::string &words, const std::string &beside,
                      const std::string &library, const PrmEntry &entry)
  {
    const std::string word = " column ";
    const std::size_t split = words.find(word);
    const std::string file = trimmed(words.substr(0, split));
    const std::string name
        = split == std::string::npos ? "" : trimmed(words.substr(split + word.size()));
    CsvTable table(path_of_table(file, beside, library), quotable(file));
    const std::size_t wanted = wanted_column(table, name);
    const Column &over = table.header()[0], &value = table.header()[wanted];
    PrmTable result;
    double before = -INFINITY;
    while(const auto row = table.next())
    {
      const double a = table.number((*row)[0], over, entry.table_over);
      const double b = table.number((*row)[wanted], value, entry.unit);
      if(!(a > before))
        table.fail(fmt::format("{:.6g} comes after {:.6g}: '{}' must ascend", a, before,
                               over.name));
      before = a;
      result.points
          += fmt::format("{}{:.17g}: {:.17g}", result.points.empty() ? "" : ", ", a, b);
    }
    for(const Column *column : {&over, &value})
      if(!column->unit.empty())
        result.units.push_back(column->unit);
    result.origin = quotable(fmt::format("{}: {} over {}", file, value.name, over.name));
    return result;
  }
} // namespace meltfront::cases
