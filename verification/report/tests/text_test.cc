#include <verification/report/page/markup.h>
#include <verification/report/page/number_text.h>
#include <verification/report/tables/table.h>

#include <gtest/gtest.h>

#include <cmath>

namespace meltfront::verification
{
  TEST(Markup, PlainTextIsEscaped)
  {
    EXPECT_EQ(escape("<a href=\"x\">'&'</a>"),
              "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;&lt;/a&gt;");
    EXPECT_EQ(text("1 < 2").html(), "1 &lt; 2");
    EXPECT_EQ(element("p", {{"title", "a\"b"}}, text("&")).html(),
              "<p title=\"a&quot;b\">&amp;</p>");
  }

  TEST(Markup, ControlCharactersAreDropped)
  {
    EXPECT_EQ(escape(std::string_view("a\0b\x1b[1m\n", 8)), "ab[1m\n");
  }

  TEST(Markup, DataAddressHoldsTheContent)
  {
    EXPECT_EQ(data_address("text/csv", "a,b\n1 %"),
              "data:text/csv;charset=utf-8,a,b%0A1%20%25");
  }

  TEST(Markup, NamesOfFilesHoldNoPath)
  {
    EXPECT_EQ(plain_name("../a b<c>-1.5"), ".._a_b_c_-1.5");
    EXPECT_EQ(plain_name(""), "_");
  }

  TEST(NumberText, SignificantDigits)
  {
    EXPECT_EQ(number_text(0.0012345).plain(), "1.23e-3");
    EXPECT_EQ(number_text(0.012345).plain(), "0.0123");
    EXPECT_EQ(number_text(1234.5).plain(), "1234");
    EXPECT_EQ(number_text(12345.).plain(), "1.23e4");
    EXPECT_EQ(number_text(-2.5, 2).plain(), "-2.5");
    EXPECT_EQ(number_text(0).plain(), "0");
    EXPECT_EQ(number_text(0.5, 3, Notation::scientific).plain(), "5.00e-1");
  }

  TEST(NumberText, NotANumberAndInfinityHaveWords)
  {
    EXPECT_EQ(number_text(std::nan("")).plain(), "n/a");
    EXPECT_EQ(number_text(std::nan("")).markup().html(), "\u2013");
    EXPECT_EQ(number_text(INFINITY).plain(), "\u221e");
    EXPECT_EQ(number_text(-INFINITY).tex(), "-\\infty");
    EXPECT_EQ(duration_text(std::nan("")), "n/a");
  }

  TEST(NumberText, MarkupAndTex)
  {
    EXPECT_EQ(number_text(1.35e-3).markup().html(), "1.35\u00b710<sup>\u22123</sup>");
    EXPECT_EQ(number_text(1.35e-3).tex(), "1.35\\cdot10^{-3}");
    EXPECT_EQ(number_text(1e-4, 1).markup().html(), "10<sup>\u22124</sup>");
  }

  TEST(NumberText, RunningNumbersHaveNoIdleZeros)
  {
    EXPECT_EQ(plain_number(475000, 6), "475000");
    EXPECT_EQ(plain_number(2.2, 4), "2.2");
    EXPECT_EQ(plain_number(1, 4), "1");
    EXPECT_EQ(plain_number(100, 4), "100");
    EXPECT_EQ(plain_number(3.335e8, 4), "3.335e8");
    EXPECT_EQ(plain_number(0, 4), "0");
  }

  TEST(NumberText, ColumnsShareANotation)
  {
    EXPECT_EQ(column_notation({0.02, 35, std::nan("")}), Notation::plain);
    EXPECT_EQ(column_notation({0.02, 1e-3}), Notation::scientific);
  }

  TEST(NumberText, Durations)
  {
    EXPECT_EQ(duration_text(0.0123), "12 ms");
    EXPECT_EQ(duration_text(4.14), "4.1 s");
    EXPECT_EQ(duration_text(125), "2 min 5 s");
    EXPECT_EQ(duration_text(4320), "1 h 12 min");
    EXPECT_EQ(grouped(1234567), "1\u2009234\u2009567");
    EXPECT_EQ(grouped(1234), "1234");
  }

  namespace
  {
    Table small_table()
    {
      Table table;
      table.group_heading = "method";
      table.columns = {{"n", "", true}, {"error", "m", true}, {"note", "", false}};
      RowGroup &group = table.groups.emplace_back();
      group.label = "a_b|c";
      group.rows
          = {{{NumberText{"8", ""}}, {NumberText{"1.5", ""}}, {std::string("x < y & z")}},
             {{NumberText{"16", ""}}, {NumberText{"0.25", ""}, true}, {std::string()}}};
      group.summary
          = {{{std::string("order")}, {Power{"h", "1.57", "0.05", ""}}, {std::string()}}};
      return table;
    }
  } // namespace

  TEST(Table, Markdown)
  {
    EXPECT_EQ(table_markdown(small_table()),
              "| method  |     n |      error (m) | note       |\n"
              "|---------|------:|---------------:|------------|\n"
              "| a\\_b\\|c |     8 |            1.5 | x \\< y & z |\n"
              "| a\\_b\\|c |    16 |       **0.25** |            |\n"
              "| a\\_b\\|c | order | h^1.57 +- 0.05 |            |\n");
  }

  TEST(Table, Tex)
  {
    EXPECT_EQ(table_tex(small_table()), "\\begin{tabular}{lrrl}\n"
                                        "\\toprule\n"
                                        "method & n & error (m) & note \\\\\n"
                                        "\\midrule\n"
                                        "a\\_b|c & $8$ & $1.5$ & x $<$ y \\& z \\\\\n"
                                        "a\\_b|c & $16$ & $\\mathbf{0.25}$ &  \\\\\n"
                                        "a\\_b|c & order & $h^{1.57} \\pm 0.05$ &  \\\\\n"
                                        "\\bottomrule\n"
                                        "\\end{tabular}\n");
  }

  TEST(Table, PageAlignsNumbersOnThePoint)
  {
    const std::string html = table_markup(small_table()).html();
    // One decimal less is one figure space more.
    EXPECT_NE(html.find(">1.5\u2007<"), std::string::npos);
    EXPECT_NE(html.find("<b>0.25</b>"), std::string::npos);
    EXPECT_NE(html.find("x &lt; y &amp; z"), std::string::npos);
    EXPECT_NE(html.find("<i>h</i><sup>1.57</sup> \u00b1 0.05"), std::string::npos);
  }
} // namespace meltfront::verification
