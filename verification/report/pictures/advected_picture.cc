#include <verification/measure/formulas/exact_front.h>
#include <verification/report/page/number_text.h>
#include <verification/report/pictures/advected_picture.h>
#include <verification/report/plots/gnuplot.h>
#include <verification/report/plots/method_styles.h>

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace meltfront::verification
{
  namespace
  {
    constexpr double picture_width = 420, picture_margin = 30;

    using Script = std::back_insert_iterator<std::string>;

    /** When the exact front is drawn, in the plane: at the intermediate times and at the
     * end. */
    std::vector<double> shown_times(const StoredCase &record)
    {
      if(record.scene.domain.dimension != 2)
        return {};
      std::vector<double> times = record.measurement.intermediate_times;
      times.push_back(record.scene.end_time);
      return times;
    }

    /** Black for the last of the times, colours of the palette before it. */
    std::string colour_of(const StoredCase &record, double time)
    {
      const std::vector<double> times = shown_times(record);
      if(!(time < record.scene.end_time))
        return "black";
      std::size_t number = 0;
      while(number + 1 < times.size() && times[number] < time - 1e-9)
        ++number;
      return palette()[number % palette().size()].light;
    }

    void write_pieces(Script out, const std::vector<FrontPiece> &front, std::size_t name)
    {
      fmt::format_to(out, "$exact{} << end_of_data\n", name);
      for(const auto &[begin, end] : front)
        fmt::format_to(out, "{:.5g} {:.5g} {:.5g} {:.5g}\n", begin[0], begin[1],
                       end[0] - begin[0], end[1] - begin[1]);
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

  std::string advected_interface_script(const StoredCase &record,
                                        const std::vector<FrontFrame> &found)
  {
    const double width = record.scene.domain.upper[0] - record.scene.domain.lower[0];
    const double height = record.scene.domain.upper[1] - record.scene.domain.lower[1];
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
        picture_margin / picture_height, plot_colours::axis, record.scene.domain.lower[0],
        width / 2, record.scene.domain.lower[1], height / 2, record.scene.domain.lower[0],
        record.scene.domain.upper[0], record.scene.domain.lower[1],
        record.scene.domain.upper[1]);
    std::string commands;
    const auto add = [&commands](const std::string &command)
    { commands += (commands.empty() ? "plot " : ", \\\n     ") + command; };
    const std::vector<double> times = shown_times(record);
    const double longest = 0.006 * record.scene.domain.side();
    for(std::size_t f = 0; f < times.size(); ++f)
      if(const auto exact = exact_front_pieces(record.scene, times[f], longest);
         !exact.empty())
      {
        write_pieces(out, exact, f);
        add(fmt::format("$exact{} using 1:2:3:4 with vectors nohead lw 1.2 lc rgb '{}'",
                        f, colour_of(record, times[f])));
      }
    for(std::size_t f = 0; f < found.size(); ++f)
      if(write_points(out, found[f], f))
        add(fmt::format("$found{} with points pt 7 ps 0.3 lc rgb '{}'", f,
                        colour_of(record, found[f].time)));
    return script + (commands.empty() ? "plot NaN notitle" : commands) + "\n";
  }

  std::string advected_interface_times(const StoredCase &record)
  {
    std::string times;
    for(const double time : shown_times(record))
      times += (times.empty() ? "" : ", ") + plain_number(time, 4);
    return times;
  }
} // namespace meltfront::verification
