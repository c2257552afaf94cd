#ifndef meltfront_verification_report_plots_gnuplot_h
#define meltfront_verification_report_plots_gnuplot_h

#include <verification/report/page/markup.h>

#include <string>

namespace meltfront::verification
{
  /**
   * Run gnuplot on a script that plots to its standard output and return what it wrote.
   * @throws cases::OutputError if gnuplot is missing or rejects the script.
   */
  std::string run_gnuplot(const std::string &script);

  /** Quoted text for a script, with the characters of gnuplot's enhanced mode taken
   * literally. */
  std::string gnuplot_text(const std::string &plain);

  /**
   * gnuplot's SVG as a part of a page: the colours of the palette, of ink and of lines
   * become variables of the page's style, so that they suit light and dark; markers refer
   * to marker_definitions(); no identifier and no address is left in it.
   */
  Markup inline_svg(const std::string &svg, const std::string &description);

  /** The markers that all plots of a page share; stands once in the page. */
  Markup marker_definitions();

  /** Colours of scripts that inline_svg() knows, besides the palette and black. */
  namespace plot_colours
  {
    inline constexpr const char *page = "#fefefe";
    inline constexpr const char *axis = "#8a9199";
    inline constexpr const char *grid = "#e4e7ea";
    inline constexpr const char *guide = "#a8afb6";
    inline constexpr const char *solid = "#3b7fc4";
    inline constexpr const char *liquid = "#d9822b";
    inline constexpr const char *solid_area = "#d6e6f5";
    inline constexpr const char *liquid_area = "#fdf1e3";
  } // namespace plot_colours
} // namespace meltfront::verification

#endif
