#ifndef meltfront_verification_report_plots_plot_h
#define meltfront_verification_report_plots_plot_h

#include <verification/report/plots/method_styles.h>

#include <limits>
#include <string>
#include <vector>

namespace meltfront::verification
{
  struct Axis
  {
    std::string label; ///< quantity and unit
    bool logarithmic = false;
    /** Range; NaN: chosen from the data. */
    double lower = std::numeric_limits<double>::quiet_NaN();
    double upper = std::numeric_limits<double>::quiet_NaN();
  };

  /** A line of a plot with the label that stands at its end. */
  struct Curve
  {
    std::string label;
    std::string exponent; ///< `h^1.33`, behind the label with a superscript; may be empty
    LineStyle style;
    std::vector<double> x, y;   ///< NaN breaks the line
    std::vector<double> spread; ///< error bars, as long as y, or empty
    bool band = false;          ///< the spread is drawn as an area instead
    bool line = true;
    bool markers = true;
  };

  /** A thin grey line of slope `exponent` in the log-log diagram. */
  struct Guide
  {
    double exponent = 1;
    std::string base; ///< what is raised to it in the label, `h`
  };

  /** A failed run: marked at the upper edge of the plot. */
  struct EdgeMark
  {
    double x = std::numeric_limits<double>::quiet_NaN(); ///< NaN: at the right edge
    LineStyle style;
  };

  /** A diagram, independent of how it is drawn. */
  struct Plot
  {
    std::string description; ///< one sentence: what screen readers say
    Axis x, y;
    std::vector<Curve> curves;
    std::vector<Guide> guides;
    std::vector<EdgeMark> failed;
    std::string heading; ///< inside the plot, for small multiples
    bool small = false;  ///< 320 x 230 without labels at the lines, instead of 640 x 420
  };

  /** True if no point of the plot can be drawn. */
  bool nothing_to_draw(const Plot &plot);

  /** The plot as a gnuplot script that writes SVG to its standard output. */
  std::string plot_script(const Plot &plot);

  /** The range of an axis: as given, or that of the data with a margin. */
  void choose_ranges(Plot &plot);

  /**
   * Positions moved apart as little as possible, so that any two are at least `gap` apart
   * and all lie between lower and upper (if there is room for all).
   */
  std::vector<double> spread_apart(const std::vector<double> &wanted, double gap,
                                   double lower, double upper);
} // namespace meltfront::verification

#endif
