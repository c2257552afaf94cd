#include <verification/report/plots/plot.h>

#include <verification/report/plots/gnuplot.h>
#include <verification/report/plots/plot_layout.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace meltfront::verification
{
  namespace
  {
    using Script = std::back_insert_iterator<std::string>;

    std::string colour_of(const LineStyle &style)
    {
      if(style.colour == LineStyle::ink)
        return "black";
      return style.colour == LineStyle::grey ? plot_colours::guide
                                             : palette()[style.colour].light;
    }

    const char *dash_of(const LineStyle &style)
    {
      constexpr const char *dashes[] = {"solid", "(9,5)", "(2,4)", "(9,4,2,4)"};
      return dashes[style.dash];
    }

    void write_frame(Script out, const Plot &plot, const Canvas &canvas)
    {
      fmt::format_to(out,
                     "set encoding utf8\n"
                     "set terminal svg size {},{} dynamic enhanced font 'sans-serif,{}'\n"
                     "set lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\n"
                     "set tmargin at screen {:.5f}\nset bmargin at screen {:.5f}\n"
                     "unset key\nset border 3 lw 1 lc rgb '{}'\n"
                     "set tics nomirror scale 0.5,0.25 tc rgb 'black'\n"
                     "set grid xtics ytics lt 1 lw 1 lc rgb '{}'\n",
                     canvas.width, canvas.height, canvas.font, canvas.left / canvas.width,
                     1 - canvas.right / canvas.width, 1 - canvas.top / canvas.height,
                     canvas.bottom / canvas.height, plot_colours::axis,
                     plot_colours::grid);
      if(!plot.heading.empty())
        fmt::format_to(out, "set label {} at screen 0.5,{:.4f} center\n",
                       gnuplot_text(plot.heading), 1 - 13. / canvas.height);
    }

    void write_axis(Script out, char name, const Axis &axis, bool small)
    {
      fmt::format_to(out, "set {}label {} offset {}\n", name, gnuplot_text(axis.label),
                     name == 'x' ? "0,0.3" : (small ? "1.6,0" : "0.4,0"));
      fmt::format_to(out, "set {}range [{:.10g}:{:.10g}]\n", name, axis.lower,
                     axis.upper);
      if(axis.logarithmic)
        fmt::format_to(out, "set logscale {}\nset {}tics ({})\n", name, name,
                       logarithmic_tics(axis.lower, axis.upper, small));
      else
        fmt::format_to(out, "set format {0} '%g'\nset {0}tics {1:.6g}\n", name,
                       linear_step(axis.lower, axis.upper, name == 'x' ? 5 : 6));
    }

    void write_guides(Script out, const Plot &plot, const Canvas &canvas)
    {
      const std::vector<GuideLine> lines = guide_lines(plot, canvas);
      for(std::size_t g = 0; g < lines.size(); ++g)
      {
        const GuideLine &line = lines[g];
        fmt::format_to(
            out,
            "set arrow from {:.8g},{:.8g} to {:.8g},{:.8g} nohead back lw 1 lc "
            "rgb '{}'\n",
            line.x0, line.y0, line.x1, line.y1, plot_colours::guide);
        if(line.label_x > 0)
          fmt::format_to(out,
                         "set label '{}^{{{:g}}}' at screen {:.5f},{:.5f} center tc rgb "
                         "'{}'\n",
                         plot.guides[g].base, plot.guides[g].exponent,
                         line.label_x / canvas.width, 1 - line.label_y / canvas.height,
                         plot_colours::axis);
      }
    }

    void write_end_labels(Script out, const Plot &plot, const Canvas &canvas)
    {
      for(const EndLabel &label : end_labels(plot, canvas))
      {
        const Curve &curve = plot.curves[label.curve];
        const std::string colour = colour_of(curve.style);
        if(curve.line)
          fmt::format_to(
              out,
              "set arrow from {:.8g},{:.8g} to graph 1.022,{:.5f} nohead lw 0.6 "
              "lc rgb '{}'\n",
              label.x, label.y, label.height, colour);
        std::string words = gnuplot_text(shortened(curve.label, longest_label));
        if(!curve.exponent.empty())
        {
          const std::size_t hat = curve.exponent.find('^');
          words.pop_back();
          words += fmt::format("  {}^{{{}}}'", curve.exponent.substr(0, hat),
                               curve.exponent.substr(hat + 1));
        }
        fmt::format_to(out, "set label {} at graph 1.034,{:.5f} left tc rgb '{}'\n",
                       words, label.height, colour);
      }
    }

    void write_failed(Script out, const Plot &plot)
    {
      int at_right_edge = 0;
      for(const EdgeMark &mark : plot.failed)
      {
        const std::string x
            = std::isnan(mark.x)
                  ? fmt::format("graph {:.3f}", 0.985 - 0.03 * at_right_edge++)
                  : fmt::format("first {:.8g}", mark.x);
        fmt::format_to(
            out, "set label '' at {},graph 0.97 point pt 2 ps {} lw 2 lc rgb '{}'\n", x,
            plot.small ? 0.7 : 1.1, colour_of(mark.style));
      }
    }

    bool drawn(const Plot &plot, double x, double y)
    {
      return std::isfinite(x) && std::isfinite(y) && (!plot.x.logarithmic || x > 0)
             && (!plot.y.logarithmic || y > 0);
    }

    void write_data(Script out, const Plot &plot, std::size_t c)
    {
      const Curve &curve = plot.curves[c];
      fmt::format_to(out, "$data{} << end_of_data\n", c);
      for(std::size_t i = 0; i < curve.x.size(); ++i)
        if(!drawn(plot, curve.x[i], curve.y[i]))
          fmt::format_to(out, "\n");
        else
        {
          const double spread = i < curve.spread.size() ? curve.spread[i] : 0;
          const double low = curve.y[i] - spread;
          fmt::format_to(out, "{:.8g} {:.8g} {:.8g} {:.8g}\n", curve.x[i], curve.y[i],
                         plot.y.logarithmic ? std::max(low, 0.1 * curve.y[i]) : low,
                         curve.y[i] + spread);
        }
      fmt::format_to(out, "end_of_data\n");
    }

    std::string curve_command(const Plot &plot, std::size_t c)
    {
      const Curve &curve = plot.curves[c];
      const std::string colour = colour_of(curve.style);
      const int points = static_cast<int>(curve.x.size());
      constexpr int most_markers = 24;
      std::string command = fmt::format("$data{} using 1:2 with ", c);
      const std::string line
          = fmt::format(" lw {} dt {}", plot.small ? 1.6 : 2, dash_of(curve.style));
      const std::string marks
          = fmt::format(" pt {} ps {}", point_type(curve.style.marker, curve.style.open),
                        plot.small ? 0.7 : (curve.line ? 0.9 : 0.5));
      if(curve.line && curve.markers)
        command
            += "linespoints" + line + marks
               + (points > most_markers ? fmt::format(" pi {}", (points + 11) / 12) : "");
      else
        command += curve.line ? "lines" + line : "points" + marks;
      command += fmt::format(" lc rgb '{}' notitle", colour);
      if(curve.band)
        return fmt::format("$data{} using 1:3:4 with filledcurves fs transparent solid "
                           "0.2 noborder lc rgb '{}' notitle, \\\n     ",
                           c, colour)
               + command;
      if(!curve.spread.empty())
        command
            += fmt::format(", $data{} using 1:3:(0):($4-$3) with vectors nohead lw 1.4 "
                           "lc rgb '{}' notitle",
                           c, colour);
      return command;
    }
  } // namespace

  bool nothing_to_draw(const Plot &plot)
  {
    for(const Curve &curve : plot.curves)
      for(std::size_t i = 0; i < curve.x.size(); ++i)
        if(drawn(plot, curve.x[i], curve.y[i]))
          return false;
    return true;
  }

  std::string plot_script(const Plot &given)
  {
    Plot plot = given;
    choose_ranges(plot);
    const Canvas canvas = canvas_of(plot);
    std::string script;
    const Script out = std::back_inserter(script);
    write_frame(out, plot, canvas);
    write_axis(out, 'x', plot.x, plot.small);
    write_axis(out, 'y', plot.y, plot.small);
    write_guides(out, plot, canvas);
    if(!plot.small)
      write_end_labels(out, plot, canvas);
    write_failed(out, plot);
    std::string commands;
    for(std::size_t c = 0; c < plot.curves.size(); ++c)
    {
      Plot single = plot;
      single.curves = {plot.curves[c]};
      if(nothing_to_draw(single))
        continue;
      write_data(out, plot, c);
      commands += (commands.empty() ? "plot " : ", \\\n     ") + curve_command(plot, c);
    }
    return script + (commands.empty() ? "plot NaN notitle" : commands) + "\n";
  }
} // namespace meltfront::verification
