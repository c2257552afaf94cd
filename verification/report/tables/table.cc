#include <verification/report/tables/table.h>

#include <algorithm>

namespace meltfront::verification
{
  std::string Power::plain() const
  {
    return base + "^" + exponent + (error.empty() ? "" : " +- " + error)
           + (remark.empty() ? "" : " (" + remark + ")");
  }

  bool Table::empty() const
  {
    return std::all_of(groups.begin(), groups.end(),
                       [](const RowGroup &group)
                       { return group.rows.empty() && group.summary.empty(); });
  }

  namespace
  {
    /** Widths that the numbers of a column need on either side of the decimal point. */
    struct ColumnWidths
    {
      std::size_t decimals = 0;
      std::size_t exponent = 0;
    };

    std::size_t decimals(const NumberText &number)
    {
      const std::size_t point = number.digits.find('.');
      return point == std::string::npos ? 0 : number.digits.size() - point - 1;
    }

    ColumnWidths widths(const Table &table, std::size_t column)
    {
      ColumnWidths result;
      for(const RowGroup &group : table.groups)
        for(const auto &row : group.rows)
          if(const auto *number = std::get_if<NumberText>(&row[column].content))
          {
            result.decimals = std::max(result.decimals, decimals(*number));
            result.exponent = std::max(result.exponent, number->exponent.size());
          }
      return result;
    }

    std::string repeated(const char *character, std::size_t count)
    {
      std::string result;
      for(std::size_t i = 0; i < count; ++i)
        result += character;
      return result;
    }

    /** Spaces as wide as the digits that a number lacks to the right of the point. */
    Markup padding(const NumberText &number, const ColumnWidths &width)
    {
      constexpr const char *figure_space = "\u2007", *punctuation_space = "\u2008";
      const std::size_t own = decimals(number);
      std::string spaces;
      if(own == 0 && width.decimals > 0)
        spaces += punctuation_space;
      spaces += repeated(figure_space, width.decimals - own);
      Markup result = text(spaces);
      if(width.exponent == number.exponent.size())
        return result;
      if(number.exponent.empty())
        result += text(repeated(figure_space, 2) + punctuation_space);
      return result
             + element("sup",
                       repeated(figure_space, width.exponent - number.exponent.size()));
    }

    Markup power_markup(const Power &power)
    {
      Markup result
          = element("i", power.base) + element("sup", with_minus_sign(power.exponent));
      if(!power.error.empty())
        result += text(" \u00b1 " + power.error);
      if(!power.remark.empty())
        result += text(" ") + element("small", power.remark);
      return result;
    }

    Markup number_cell(const NumberText &number, const ColumnWidths &width)
    {
      if(number.digits.empty()) // no value: a dash at the edge of the column
        return number.markup();
      if(number.exponent.empty())
        return number.markup() + padding(number, width);
      // The mantissa's missing decimals belong before the power of ten.
      return number.markup()
             + padding({"0." + std::string(width.decimals, '0'), number.exponent}, width);
    }

    Markup cell_markup(const Cell &cell, const Column &column, const ColumnWidths &width)
    {
      Markup content;
      if(const auto *plain = std::get_if<std::string>(&cell.content))
        content = text(*plain);
      else if(const auto *power = std::get_if<Power>(&cell.content))
        content = power_markup(*power);
      else
        content = number_cell(std::get<NumberText>(cell.content), width);
      if(cell.best)
        content = element("b", content);
      return column.numeric ? element("td", {{"class", "number"}}, content)
                            : element("td", content);
    }

    Markup head_markup(const Table &table)
    {
      Markup cells;
      for(const Column &column : table.columns)
      {
        Markup heading = text(column.heading);
        if(!column.unit.empty())
          heading += element("span", {{"class", "unit"}}, text(column.unit));
        Attributes attributes{{"scope", "col"}};
        if(column.numeric)
          attributes.emplace_back("class", "number");
        cells += element("th", attributes, heading);
      }
      return element("thead", element("tr", cells));
    }
  } // namespace

  Markup table_markup(const Table &table, const LabelMarkup &label_markup)
  {
    std::vector<ColumnWidths> width;
    for(std::size_t c = 0; c < table.columns.size(); ++c)
      width.push_back(widths(table, c));
    const auto row_markup
        = [&](const std::vector<Cell> &row, const Attributes &attributes)
    {
      Markup cells;
      for(std::size_t c = 0; c < row.size(); ++c)
        cells += cell_markup(row[c], table.columns[c], width[c]);
      return element("tr", attributes, cells) + Markup("\n");
    };
    Markup content;
    if(!table.caption.empty())
      content += element("caption", table.caption);
    content += head_markup(table);
    for(const RowGroup &group : table.groups)
    {
      Markup rows;
      if(!group.label.empty())
        rows += element("tr", {{"class", "group"}},
                        element("th",
                                {{"scope", "rowgroup"},
                                 {"colspan", std::to_string(table.columns.size())}},
                                element("span", label_markup(group.label))))
                + Markup("\n");
      for(const auto &row : group.rows)
        rows += row_markup(row, {});
      for(const auto &row : group.summary)
        rows += row_markup(row, {{"class", "summary"}});
      content += element("tbody", rows) + Markup("\n");
    }
    return element("div", {{"class", "scroll"}}, element("table", content))
           + Markup("\n");
  }
} // namespace meltfront::verification
