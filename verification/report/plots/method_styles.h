#ifndef meltfront_verification_report_plots_method_styles_h
#define meltfront_verification_report_plots_method_styles_h

#include <verification/report/page/markup.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /** Shapes of markers, the same in gnuplot's plots and in the page's keys. */
  enum class Marker
  {
    circle,
    square,
    triangle,
    triangle_down,
    diamond,
    pentagon
  };

  /** How lines and points of a label look in every plot of a page. */
  struct LineStyle
  {
    static constexpr int ink = -1;  ///< colour of the exact solution: that of the text
    static constexpr int grey = -2; ///< colour of guides

    int colour = ink; ///< index into palette(), or ink, or grey
    Marker marker = Marker::circle;
    bool open = false; ///< the marker is not filled
    int dash = 0;      ///< 0 solid, 1 dashed, 2 dotted, 3 dash-dotted
  };

  /** A colour for light and for dark pages. */
  struct Colour
  {
    std::string light; ///< `#0072b2`
    std::string dark;
  };

  /** Seven colours that colour-blind readers can tell apart, after Okabe and Ito 2008. */
  const std::array<Colour, 7> &palette();

  /**
   * One colour and one marker per method in every plot of a page. A method as published
   * (`sph-2005`) has the colour and the shape of its corrected form, dashed and open;
   * variants of a method (`sph[jitter=0.2]`) have its colour with other dashes and
   * shapes.
   */
  class MethodStyles
  {
  public:
    /** Styles for labels in the order in which they first appear. */
    explicit MethodStyles(const std::vector<std::string> &labels);

    LineStyle style(const std::string &label) const;

    /** A piece of the label's line with its marker, and the label. */
    Markup key(const std::string &label) const;

    /** The keys of all labels in one line. */
    Markup legend(const std::vector<std::string> &labels) const;

  private:
    std::map<std::string, LineStyle> styles;
  };

  /** The method of which a label is a form: `sph` for `sph-2005[step_factor=0.9]`. */
  std::string base_method(const std::string &label);

  /** gnuplot's number of a marker. */
  int point_type(Marker marker, bool open);
} // namespace meltfront::verification

#endif
