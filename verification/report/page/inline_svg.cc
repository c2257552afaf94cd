#include <verification/report/plots/gnuplot.h>
#include <verification/report/plots/method_styles.h>

#include <fmt/format.h>

#include <regex>

namespace meltfront::verification
{
  namespace
  {
    void replace_all(std::string &in, const std::string &what, const std::string &by)
    {
      for(std::size_t at = in.find(what); at != std::string::npos;
          at = in.find(what, at + by.size()))
        in.replace(at, what.size(), by);
    }

    /** `#0072b2` in gnuplot's two spellings, `rgb(0,114,178)` and `rgb(  0, 114, 178)`.
     */
    void replace_colour(std::string &svg, const std::string &hex, const std::string &by)
    {
      const int red = std::stoi(hex.substr(1, 2), nullptr, 16);
      const int green = std::stoi(hex.substr(3, 2), nullptr, 16);
      const int blue = std::stoi(hex.substr(5, 2), nullptr, 16);
      replace_all(svg, fmt::format("rgb({},{},{})", red, green, blue), by);
      replace_all(svg, fmt::format("rgb({:3d}, {:3d}, {:3d})", red, green, blue), by);
    }

    void replace_colours(std::string &svg)
    {
      for(std::size_t c = 0; c < palette().size(); ++c)
        replace_colour(svg, palette()[c].light, fmt::format("var(--series-{})", c));
      const std::pair<const char *, const char *> lines[]
          = {{plot_colours::page, "var(--page)"},
             {plot_colours::axis, "var(--axis)"},
             {plot_colours::grid, "var(--grid)"},
             {plot_colours::guide, "var(--guide)"},
             {"#000000", "currentColor"},
             {plot_colours::solid, "var(--solid)"},
             {plot_colours::liquid, "var(--liquid)"},
             {plot_colours::solid_area, "var(--solid-area)"},
             {plot_colours::liquid_area, "var(--liquid-area)"}};
      for(const auto &[colour, variable] : lines)
        replace_colour(svg, colour, variable);
    }

    /** The definitions of gnuplot's SVG, its markers among them. */
    std::pair<std::size_t, std::size_t> definitions(const std::string &svg)
    {
      const std::string closing = "</defs>";
      const std::size_t begin = svg.find("<defs>");
      const std::size_t end = svg.find(closing);
      if(begin == std::string::npos || end == std::string::npos)
        return {0, 0};
      return {begin, end + closing.size()};
    }
  } // namespace

  Markup inline_svg(const std::string &svg, const std::string &description)
  {
    std::string body = svg;
    const auto [begin, end] = definitions(body);
    body.erase(begin, end - begin);
    static const std::regex view_box("viewBox=\"([^\"]*)\"");
    std::smatch found;
    const std::string box
        = std::regex_search(body, found, view_box) ? found[1].str() : "0 0 640 420";
    body.erase(0, body.find("<g id=\"gnuplot_canvas\""));
    body.erase(body.rfind("</svg>"));
    replace_colours(body);
    // gnuplot sets the colour of each group; without it, black is the page's ink.
    static const std::regex group_colour(" color=\"(black|white)\"");
    static const std::regex black("(['\"])black\\1");
    static const std::regex title("<title>[^<]*</title>");
    static const std::regex identifier(" id=(\"[^\"]*\"|'[^']*')");
    static const std::regex empty_group("<g [^>]*>\\s*</g>\\s*");
    static const std::regex font(" font-family=\"[^\"]*\"");
    body = std::regex_replace(body, group_colour, "");
    body = std::regex_replace(body, black, "$1currentColor$1");
    body = std::regex_replace(body, title, "");
    body = std::regex_replace(body, identifier, "");
    body = std::regex_replace(body, empty_group, "");
    body = std::regex_replace(body, font, "");
    replace_all(body, "xlink:href", "href");
    return element("svg",
                   {{"viewBox", box}, {"role", "img"}, {"aria-label", description}},
                   Markup(body));
  }

  Markup marker_definitions()
  {
    const std::string svg
        = run_gnuplot("set terminal svg size 100,100\nunset border\nunset tics\n"
                      "unset key\nset xrange [0:1]\nset yrange [0:1]\nplot -1\n");
    const auto [begin, end] = definitions(svg);
    std::string body = svg.substr(begin, end - begin);
    static const std::regex filter("<filter[^]*?</filter>\\s*");
    body = std::regex_replace(body, filter, "");
    replace_all(body, "xlink:href", "href");
    return element("svg",
                   {{"width", "0"},
                    {"height", "0"},
                    {"class", "definitions"},
                    {"aria-hidden", "true"}},
                   Markup(body))
           + Markup("\n");
  }
} // namespace meltfront::verification
