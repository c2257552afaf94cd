#ifndef meltfront_verification_report_plot_layout_h
#define meltfront_verification_report_plot_layout_h

#include <verification/report/plot.h>

#include <cstddef>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /** Size of a plot and of its margins, in units of the SVG. */
  struct Canvas
  {
    double width, height;
    double left, right, top, bottom;
    int font;
  };

  Canvas canvas_of(const Plot &plot);

  /** A guide in the plot's coordinates; its label stands at (x1, y1). */
  struct GuideLine
  {
    double x0, y0, x1, y1;
    bool left;                 ///< the label begins (rather than ends) at its place
    double offset_x, offset_y; ///< of the label, in characters
  };

  /**
   * Guides leave the upper end of the data (the coarsest or the cheapest level) and run
   * to the edge of the plot.
   */
  GuideLine guide_line(const Plot &plot, const Guide &guide);

  /** Where the label of a curve stands: right of the plot, at a height of its own. */
  struct EndLabel
  {
    std::size_t curve;
    double x, y;   ///< last point of the curve
    double height; ///< of the label, as a share of the plot's height
  };

  std::vector<EndLabel> end_labels(const Plot &plot, const Canvas &canvas);

  /** Tics of a logarithmic axis: decades labelled; also 2 and 5 where the range is short.
   */
  std::string logarithmic_tics(double lower, double upper, bool small);

  inline constexpr std::size_t longest_label = 16;

  /** Text cut to so many characters, with an ellipsis. */
  std::string shortened(const std::string &utf8, std::size_t length);
} // namespace meltfront::verification

#endif
