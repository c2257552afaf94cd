#ifndef meltfront_verification_report_plots_plot_layout_h
#define meltfront_verification_report_plots_plot_layout_h

#include <verification/report/plots/plot.h>

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

  /** A guide in the plot's coordinates, and its label in those of the SVG. */
  struct GuideLine
  {
    double x0, y0, x1, y1;
    double label_x, label_y; ///< centre of the label, from the upper left corner
  };

  /**
   * Guides leave the upper end of the data (the coarsest or the cheapest level) and run
   * to the edge of the plot; their labels stand beside them where the curves, the other
   * guides and the labels already placed are farthest.
   */
  std::vector<GuideLine> guide_lines(const Plot &plot, const Canvas &canvas);

  /** Where the label of a curve stands: right of the plot, at a height of its own. */
  struct EndLabel
  {
    std::size_t curve;
    double x, y;   ///< last point of the curve
    double height; ///< of the label, as a share of the plot's height
  };

  std::vector<EndLabel> end_labels(const Plot &plot, const Canvas &canvas);

  /** The distance of tics on a linear axis: 1, 2 or 5 times a power of ten. */
  double linear_step(double lower, double upper, int most);

  /** Tics of a logarithmic axis: decades labelled; also 2 and 5 where the range is short.
   */
  std::string logarithmic_tics(double lower, double upper, bool small);

  inline constexpr std::size_t longest_label = 16;

  /** Text cut to so many characters, with an ellipsis; of a label with options, which
   * differ at the end, the end is kept. */
  std::string shortened(const std::string &utf8, std::size_t length);
} // namespace meltfront::verification

#endif
