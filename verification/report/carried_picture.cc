#include <verification/report/carried_picture.h>
#include <verification/report/gnuplot.h>
#include <verification/report/method_styles.h>
#include <verification/report/number_text.h>

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace meltfront::verification
{
  namespace
  {
    constexpr double picture_width = 420, picture_margin = 30;

    using Script = std::back_insert_iterator<std::string>;

    /** Black for the last of the times, colours of the palette before it. */
    std::string colour_of(const CaseRecord &record, double time)
    {
      const std::vector<FrontFrame> &exact = record.moving->exact_fronts;
      if(!(time < record.end_time))
        return "black";
      std::size_t number = 0;
      while(number + 1 < exact.size() && exact[number].time < time - 1e-9)
        ++number;
      return palette()[number % palette().size()].light;
    }

    /** Pairs of points, each a piece of its own. */
    void write_pieces(Script out, const FrontFrame &front, std::size_t name)
    {
      fmt::format_to(out, "$exact{} << end_of_data\n", name);
      for(std::size_t i = 0; i + 1 < front.x.size(); i += 2)
        fmt::format_to(out, "{:.5g} {:.5g} {:.5g} {:.5g}\n", front.x[i], front.y[i],
                       front.x[i + 1] - front.x[i], front.y[i + 1] - front.y[i]);
      fmt::format_to(out, "end_of_data\n");
    }

    /** Whether a point was found at all. */
    bool write_points(Script out, const FrontFrame &front, std::size_t name)
    {
      std::string data;
      for(std::size_t i = 0; i < front.x.size(); ++i)
        if(std::isfinite(front.x[i]) && std::isfinite(front.y[i]))
          fmt::format_to(Script(data), "{:.5g} {:.5g}\n", front.x[i], front.y[i]);
      fmt::format_to(out, "$found{} << end_of_data\n{}end_of_data\n", name, data);
      return !data.empty();
    }
  } // namespace

  std::string carried_front_script(const CaseRecord &record,
                                   const std::vector<FrontFrame> &found)
  {
    const double width = record.upper[0] - record.lower[0];
    const double height = record.upper[1] - record.lower[1];
    const double drawn = picture_width - 2 * picture_margin;
    const double picture_height = drawn * height / width + 2 * picture_margin;
    std::string script;
    const Script out(script);
    fmt::format_to(
        out,
        "set encoding utf8\n"
        "set terminal svg size {:.0f},{:.0f} dynamic enhanced font 'sans-serif,13'\n"
        "set lmargin at screen {:.6f}\nset rmargin at screen {:.6f}\n"
        "set tmargin at screen {:.6f}\nset bmargin at screen {:.6f}\n"
        "unset key\nset border 15 lw 1 lc rgb '{}'\n"
        "set tics nomirror scale 0.5 tc rgb 'black'\nset format '%g'\n"
        "set xtics {:.6g},{:.6g}\nset ytics {:.6g},{:.6g}\n"
        "set xrange [{:.10g}:{:.10g}]\nset yrange [{:.10g}:{:.10g}]\n",
        picture_width, picture_height, picture_margin / picture_width,
        1 - picture_margin / picture_width, 1 - picture_margin / picture_height,
        picture_margin / picture_height, plot_colours::axis, record.lower[0], width / 2,
        record.lower[1], height / 2, record.lower[0], record.upper[0], record.lower[1],
        record.upper[1]);
    std::string commands;
    const auto add = [&commands](const std::string &command)
    { commands += (commands.empty() ? "plot " : ", \\\n     ") + command; };
    const std::vector<FrontFrame> &exact = record.moving->exact_fronts;
    for(std::size_t f = 0; f < exact.size(); ++f)
      if(!exact[f].x.empty())
      {
        write_pieces(out, exact[f], f);
        add(fmt::format("$exact{} using 1:2:3:4 with vectors nohead lw 1.2 lc rgb '{}'",
                        f, colour_of(record, exact[f].time)));
      }
    for(std::size_t f = 0; f < found.size(); ++f)
      if(write_points(out, found[f], f))
        add(fmt::format("$found{} with points pt 7 ps 0.3 lc rgb '{}'", f,
                        colour_of(record, found[f].time)));
    return script + (commands.empty() ? "plot NaN notitle" : commands) + "\n";
  }

  std::string carried_front_times(const CaseRecord &record)
  {
    std::string times;
    for(const FrontFrame &front : record.moving->exact_fronts)
      times += (times.empty() ? "" : ", ") + plain_number(front.time, 4);
    return times;
  }
} // namespace meltfront::verification
