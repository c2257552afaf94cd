#include <verification/report/tables/table.h>

#include <fmt/format.h>

#include <algorithm>

namespace meltfront::verification
{
  namespace
  {
    /** Characters of UTF-8 text, for padding. */
    std::size_t length(const std::string &utf8)
    {
      return std::count_if(utf8.begin(), utf8.end(),
                           [](char c)
                           { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; });
    }

    std::string padded(const std::string &word, std::size_t width, bool to_the_right)
    {
      const std::string spaces(width - length(word), ' ');
      return to_the_right ? spaces + word : word + spaces;
    }

    std::string heading(const Column &column)
    {
      return column.unit.empty() ? column.heading
                                 : fmt::format("{} ({})", column.heading, column.unit);
    }

    std::string markdown_escaped(const std::string &plain)
    {
      std::string result;
      for(const char c : plain)
      {
        if(std::string_view("|*_`<>[]\\").find(c) != std::string_view::npos)
          result += '\\';
        result += c == '\n' ? ' ' : c;
      }
      return result;
    }

    std::string markdown_cell(const Cell &cell)
    {
      std::string written;
      if(const auto *plain = std::get_if<std::string>(&cell.content))
        written = markdown_escaped(*plain);
      else if(const auto *power = std::get_if<Power>(&cell.content))
        written = power->plain();
      else
        written = std::get<NumberText>(cell.content).plain();
      return cell.best ? "**" + written + "**" : written;
    }

    std::string tex_escaped(const std::string &plain)
    {
      std::string result;
      for(const char c : plain)
        if(c == '\\')
          result += "\\textbackslash{}";
        else if(c == '~' || c == '^')
          result += fmt::format("\\{}{{}}", c);
        else if(c == '<' || c == '>')
          result += fmt::format("${}$", c);
        else
        {
          if(std::string_view("&%$#_{}").find(c) != std::string_view::npos)
            result += '\\';
          result += c;
        }
      return result;
    }

    std::string tex_cell(const Cell &cell)
    {
      if(const auto *plain = std::get_if<std::string>(&cell.content))
        return tex_escaped(*plain);
      if(const auto *power = std::get_if<Power>(&cell.content))
        return fmt::format(
            "${}^{{{}}}{}${}", power->base, power->exponent,
            power->error.empty() ? "" : " \\pm " + power->error,
            power->remark.empty() ? "" : " (" + tex_escaped(power->remark) + ")");
      const std::string number = std::get<NumberText>(cell.content).tex();
      return cell.best ? "$\\mathbf{" + number + "}$" : "$" + number + "$";
    }

    /** All lines of the table as words, the group's label in the first column. */
    std::vector<std::vector<std::string>>
    lines(const Table &table, std::string (*cell_text)(const Cell &),
          std::string (*escaped)(const std::string &))
    {
      const bool labelled = !table.group_heading.empty();
      std::vector<std::vector<std::string>> result(1);
      if(labelled)
        result[0].push_back(escaped(table.group_heading));
      for(const Column &column : table.columns)
        result[0].push_back(escaped(heading(column)));
      for(const RowGroup &group : table.groups)
      {
        auto rows = group.rows;
        rows.insert(rows.end(), group.summary.begin(), group.summary.end());
        for(const auto &row : rows)
        {
          std::vector<std::string> &line = result.emplace_back();
          if(labelled)
            line.push_back(escaped(group.label));
          for(const Cell &cell : row)
            line.push_back(cell_text(cell));
        }
      }
      return result;
    }

    std::vector<bool> numeric_columns(const Table &table)
    {
      std::vector<bool> numeric;
      if(!table.group_heading.empty())
        numeric.push_back(false);
      for(const Column &column : table.columns)
        numeric.push_back(column.numeric);
      return numeric;
    }
  } // namespace

  std::string table_markdown(const Table &table)
  {
    const auto words = lines(table, markdown_cell, markdown_escaped);
    const std::vector<bool> numeric = numeric_columns(table);
    std::vector<std::size_t> width(numeric.size(), 3);
    for(const auto &line : words)
      for(std::size_t c = 0; c < line.size(); ++c)
        width[c] = std::max(width[c], length(line[c]));
    std::string result = table.caption.empty() ? "" : table.caption + "\n\n";
    for(std::size_t l = 0; l < words.size(); ++l)
    {
      for(std::size_t c = 0; c < words[l].size(); ++c)
        result += "| " + padded(words[l][c], width[c], numeric[c]) + " ";
      result += "|\n";
      if(l > 0)
        continue;
      for(std::size_t c = 0; c < numeric.size(); ++c)
        result += fmt::format("|{:-<{}}{}", "", width[c] + 1, numeric[c] ? ':' : '-');
      result += "|\n";
    }
    return result;
  }

  std::string table_tex(const Table &table)
  {
    const auto words = lines(table, tex_cell, tex_escaped);
    std::string alignment;
    for(const bool numeric : numeric_columns(table))
      alignment += numeric ? 'r' : 'l';
    std::string result = fmt::format("\\begin{{tabular}}{{{}}}\n\\toprule\n", alignment);
    std::size_t line = 0;
    const auto write_line = [&]
    {
      for(std::size_t c = 0; c < words[line].size(); ++c)
        result += (c == 0 ? "" : " & ") + words[line][c];
      result += " \\\\\n";
      ++line;
    };
    write_line();
    for(const RowGroup &group : table.groups)
    {
      result += "\\midrule\n";
      for(std::size_t r = 0; r < group.rows.size() + group.summary.size(); ++r)
        write_line();
    }
    return result + "\\bottomrule\n\\end{tabular}\n";
  }
} // namespace meltfront::verification
