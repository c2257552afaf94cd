#ifndef meltfront_verification_report_tables_table_h
#define meltfront_verification_report_tables_table_h

#include <verification/report/page/markup.h>
#include <verification/report/page/number_text.h>

#include <functional>
#include <string>
#include <variant>
#include <vector>

namespace meltfront::verification
{
  /** A fitted exponent: `h^1.57 +- 0.05`; with the verdict on it unless it is clean. */
  struct Power
  {
    std::string base;     ///< `h` or `n`
    std::string exponent; ///< `1.57`
    std::string error;    ///< `0.05`; empty where it has none
    std::string remark;   ///< `stagnating`

    std::string plain() const;
  };

  /** What stands in one place of a table. */
  struct Cell
  {
    std::variant<std::string, NumberText, Power> content;
    bool best = false; ///< the best value of its column
  };

  struct Column
  {
    std::string heading;
    std::string unit;     ///< empty for a pure number
    bool numeric = false; ///< aligned on the decimal point
  };

  /** Rows that belong together (the resolutions of a method) and their summary rows. */
  struct RowGroup
  {
    std::string label; ///< stands once above the rows; empty for none
    std::vector<std::vector<Cell>> rows;
    std::vector<std::vector<Cell>> summary; ///< e.g. fitted orders
  };

  /** A table that is written in the same way to the page, to Markdown and to TeX. */
  struct Table
  {
    std::string caption;
    std::string group_heading; ///< what the groups' labels are: `method`
    std::vector<Column> columns;
    std::vector<RowGroup> groups;

    bool empty() const;
  };

  /** Turns a group's label into markup: the report puts the method's line and marker
   * before it. */
  using LabelMarkup = std::function<Markup(const std::string &)>;

  /** A table of the page in its own scrolling box. */
  Markup table_markup(const Table &table, const LabelMarkup &label_markup = text);

  /** A Markdown table, its columns padded to the same width. */
  std::string table_markdown(const Table &table);

  /** A LaTeX `tabular` with the rules of the package booktabs. */
  std::string table_tex(const Table &table);
} // namespace meltfront::verification

#endif
