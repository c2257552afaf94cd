#include <cases/error.h>
#include <verification/report/plots/gnuplot.h>
#include <verification/report/plots/method_styles.h>
#include <verification/report/plots/plot_layout.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace meltfront::verification
{
  TEST(SpreadApart, KeepsWhatHasRoom)
  {
    const std::vector<double> wanted{0.9, 0.1, 0.5};
    const auto apart = spread_apart(wanted, 0.1, 0, 1);
    for(std::size_t i = 0; i < wanted.size(); ++i)
      EXPECT_NEAR(apart[i], wanted[i], 1e-12);
  }

  TEST(SpreadApart, EqualPlacesShareTheirMiddle)
  {
    const auto apart = spread_apart({0.5, 0.5, 0.5}, 0.1, 0, 1);
    EXPECT_NEAR(apart[0], 0.4, 1e-12);
    EXPECT_NEAR(apart[1], 0.5, 1e-12);
    EXPECT_NEAR(apart[2], 0.6, 1e-12);
  }

  TEST(SpreadApart, StaysInside)
  {
    const auto apart = spread_apart({1, 1, 0.99}, 0.2, 0, 1);
    EXPECT_NEAR(apart[2], 0.6, 1e-12);
    EXPECT_NEAR(apart[0], 0.8, 1e-12);
    EXPECT_NEAR(apart[1], 1, 1e-12);
    const auto crowded = spread_apart({0, 0, 0, 0, 0}, 0.5, 0, 1);
    EXPECT_NEAR(crowded[4], 1, 1e-12);
  }

  TEST(PlotLayout, Tics)
  {
    EXPECT_DOUBLE_EQ(linear_step(0, 475000, 5), 100000);
    EXPECT_NEAR(linear_step(0, 0.0568, 5), 0.02, 1e-15);
    EXPECT_NE(logarithmic_tics(1e-4, 1, false).find("'10^{-3}' 0.001 0"),
              std::string::npos);
    EXPECT_NE(logarithmic_tics(0.011, 0.09, false).find("'2·10^{-2}' 0.02 0"),
              std::string::npos);
  }

  TEST(PlotLayout, RangesHoldAllPointsAndIgnoreWhatCannotBeDrawn)
  {
    Plot plot;
    plot.x.logarithmic = plot.y.logarithmic = true;
    plot.curves = {{"a", "", {}, {0.1, 0.01, 1e9}, {1, 100, std::nan("")}, {}}};
    plot.failed = {{0.001, {}}};
    choose_ranges(plot);
    EXPECT_LT(plot.x.lower, 0.001);
    EXPECT_GT(plot.x.lower, 1e-4);
    EXPECT_LT(plot.x.upper, 1);
    EXPECT_LT(plot.y.lower, 1);
    EXPECT_GT(plot.y.upper, 100);
  }

  TEST(PlotLayout, LongNamesKeepTheirDifferingEnd)
  {
    EXPECT_EQ(shortened("fem-enthalpy", 16), "fem-enthalpy");
    EXPECT_EQ(shortened("a-very-long-method-name", 8), "a-very-…");
    EXPECT_EQ(shortened("sph[dimension=2,jitter=0.2]", 14), "…2,jitter=0.2]");
  }

  TEST(MethodStyles, PublishedFormsAndVariantsShareTheColour)
  {
    const MethodStyles styles({"sph", "fem-enthalpy", "sph-2005", "sph[jitter=0.2]"});
    EXPECT_EQ(styles.style("sph-2005").colour, styles.style("sph").colour);
    EXPECT_EQ(styles.style("sph[jitter=0.2]").colour, styles.style("sph").colour);
    EXPECT_NE(styles.style("fem-enthalpy").colour, styles.style("sph").colour);
    EXPECT_NE(styles.style("fem-enthalpy").marker, styles.style("sph").marker);
    EXPECT_EQ(styles.style("sph").dash, 0);
    EXPECT_EQ(styles.style("sph-2005").dash, 1);
    EXPECT_TRUE(styles.style("sph-2005").open);
    EXPECT_NE(styles.style("sph[jitter=0.2]").marker, styles.style("sph").marker);
  }

  TEST(Gnuplot, NamesAreTakenLiterally)
  {
    EXPECT_EQ(gnuplot_text("it's a_b^c"), "'it''s a\\_b\\^c'");
    Plot plot;
    plot.x.label = "x_1 {y}";
    plot.curves = {{"<b>&'\"_^{@}~\\", "h^{1}", {}, {1, 2}, {1, 2}, {}}};
    const std::string svg = run_gnuplot(plot_script(plot));
    EXPECT_NE(svg.find("&lt;b>&amp;'\"_^{@}~\\"), std::string::npos);
    EXPECT_NE(svg.find("x_1 {y}"), std::string::npos);
  }

  TEST(Gnuplot, ARejectedScriptIsAnError)
  {
    EXPECT_THROW(run_gnuplot("plot nonsense\n"), cases::OutputError);
  }

  TEST(Gnuplot, AMissingProgramIsNamed)
  {
    const std::string path = std::getenv("PATH");
    setenv("PATH", "/nonexistent", 1);
    try
    {
      run_gnuplot("plot x\n");
      ADD_FAILURE() << "gnuplot was found";
    }
    catch(const cases::OutputError &error)
    {
      EXPECT_NE(std::string(error.what()).find("gnuplot"), std::string::npos);
      EXPECT_NE(std::string(error.what()).find("not installed"), std::string::npos);
    }
    setenv("PATH", path.c_str(), 1);
  }

  TEST(InlineSvg, ColoursFollowThePageAndNoIdentifierIsLeft)
  {
    Plot plot;
    plot.curves = {{"a", "", {0, Marker::square}, {1, 2}, {1, 2}, {}}};
    const std::string svg
        = inline_svg(run_gnuplot(plot_script(plot)), "a \"plot\"").html();
    EXPECT_EQ(svg.find(" id="), std::string::npos);
    EXPECT_EQ(svg.find("black"), std::string::npos);
    EXPECT_EQ(svg.find("rgb("), std::string::npos);
    EXPECT_EQ(svg.find("http"), std::string::npos);
    EXPECT_NE(svg.find("var(--series-0)"), std::string::npos);
    EXPECT_NE(svg.find("currentColor"), std::string::npos);
    EXPECT_NE(svg.find("aria-label=\"a &quot;plot&quot;\""), std::string::npos);
    EXPECT_NE(marker_definitions().html().find("id='gpPt4'"), std::string::npos);
  }
} // namespace meltfront::verification
