#include <verification/report/pictures/scene_picture.h>

#include <verification/report/chapters/scene_words.h>
#include <verification/report/pictures/mesh_walls.h>
#include <verification/report/pictures/tracked_front.h>
#include <verification/report/plots/gnuplot.h>
#include <verification/report/plots/method_styles.h>
#include <verification/report/plots/plot_layout.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <tuple>

namespace meltfront::verification
{
  namespace
  {
    using Script = std::back_insert_iterator<std::string>;

    constexpr double canvas_width = 640;
    constexpr double margin = 46;
    constexpr double scale_strip = 40; // below the domain
    constexpr double tallest = 460;
    constexpr double strip_aspect = 0.24;

    /** The rectangle that is drawn, and how large. */
    struct Frame
    {
      double x0, x1, y0, y1;
      double left, top;     // of the domain in the picture
      double width, height; // of the domain in the picture
      double canvas_height;

      double pixels_per_length() const
      {
        return width / (x1 - x0);
      }
    };

    bool has_sites(const RunRecord *run)
    {
      return run && run->profile.picture_x.size() > 1
             && run->profile.picture_y.size() == run->profile.picture_x.size();
    }

    /** A slab has no extent across: that of the strip of particles, or of a schematic. */
    void set_strip(Frame &frame, const RunRecord *run)
    {
      const double length = frame.x1 - frame.x0;
      frame.y0 = 0;
      frame.y1 = strip_aspect * length;
      if(!has_sites(run))
        return;
      const auto [lowest, highest] = std::minmax_element(run->profile.picture_y.begin(),
                                                         run->profile.picture_y.end());
      constexpr double thinnest = 0.06;
      const double height
          = std::max(*highest - *lowest + run->description.spacing, thinnest * length);
      frame.y0 = (*lowest + *highest - height) / 2;
      frame.y1 = frame.y0 + height;
    }

    Frame frame_of(const StoredCase &record, const RunRecord *run)
    {
      Frame frame{};
      if(record.scene.domain.round())
      {
        frame.x0 = frame.y0 = -record.scene.domain.radius;
        frame.x1 = frame.y1 = record.scene.domain.radius;
      }
      else
      {
        frame.x0 = record.scene.domain.lower[0];
        frame.x1 = record.scene.domain.upper[0];
        frame.y0 = record.scene.domain.lower[1];
        frame.y1 = record.scene.domain.upper[1];
      }
      if(!(frame.x1 > frame.x0))
        frame.x1 = frame.x0 + 1;
      if(record.scene.domain.shape == cases::DomainShape::slab || !(frame.y1 > frame.y0))
        set_strip(frame, run);
      const double aspect = (frame.y1 - frame.y0) / (frame.x1 - frame.x0);
      frame.width = std::min(canvas_width - 2 * margin, tallest / aspect);
      frame.height = frame.width * aspect;
      frame.left = (canvas_width - frame.width) / 2;
      frame.top = margin;
      frame.canvas_height = frame.top + frame.height + margin + scale_strip;
      return frame;
    }

    void write_canvas(Script out, const Frame &frame)
    {
      fmt::format_to(
          out,
          "set encoding utf8\n"
          "set terminal svg size {:.0f},{:.0f} dynamic enhanced font 'sans-serif,15'\n"
          "set lmargin at screen {:.6f}\nset rmargin at screen {:.6f}\n"
          "set tmargin at screen {:.6f}\nset bmargin at screen {:.6f}\n"
          "unset key\nunset border\nunset tics\nunset clip points\n"
          "set xrange [{:.10g}:{:.10g}]\nset yrange [{:.10g}:{:.10g}]\n",
          canvas_width, frame.canvas_height, frame.left / canvas_width,
          (frame.left + frame.width) / canvas_width, 1 - frame.top / frame.canvas_height,
          1 - (frame.top + frame.height) / frame.canvas_height, frame.x0, frame.x1,
          frame.y0, frame.y1);
    }

    /** The walls, and beside each the words on what it prescribes. */
    void write_walls(Script out, const StoredCase &record, const Frame &frame)
    {
      using cases::Side;
      const cases::Domain &domain = record.scene.domain;
      if(domain.mesh)
      {
        fmt::format_to(out, "set label {} at graph 0.5,1 center offset 0,0.9\n",
                       gnuplot_text(shortened(words_of_mesh_walls(record.scene),
                                              std::size_t((canvas_width - 20) / 7.5))));
        return;
      }
      for(const Side side : record.scene.sides())
      {
        const cases::Boundary &boundary = record.scene.boundary(side);
        const auto line = [&](double x0, double y0, double x1, double y1)
        {
          fmt::format_to(out,
                         "set arrow from graph {},{} to graph {},{} nohead front {}\n",
                         x0, y0, x1, y1, look_of_wall(boundary.kind));
        };
        const auto words = [&](double room)
        {
          return gnuplot_text(
              shortened(short_words(boundary), static_cast<std::size_t>(room / 7.5)));
        };
        if(side == Side::x_min || side == Side::x_max)
        {
          const int at = side == Side::x_max;
          line(at, 0, at, 1);
          // Beside a low strip there is no room: above and below it.
          if(domain.shape == cases::DomainShape::slab)
            fmt::format_to(out, "set label {} at graph {},{} {} offset {},{}\n",
                           words(frame.width), at, 1 - at, at ? "right" : "left",
                           at ? 0.5 : -0.5, at ? -0.9 : 0.9);
          else
            fmt::format_to(out,
                           "set label {} at graph {},0.5 center rotate by 90 offset "
                           "{},0\n",
                           words(frame.height), at, at ? 1.9 : -1.7);
        }
        else if(side == Side::y_min || side == Side::y_max)
        {
          const int at = side == Side::y_max;
          line(0, at, 1, at);
          fmt::format_to(out, "set label {} at graph 0.5,{} center offset 0,{}\n",
                         words(frame.width), at, at ? 0.9 : -0.9);
        }
        else if(side == Side::inner)
          fmt::format_to(out, "set label {} at graph 0.5,0.5 center front\n",
                         words(frame.width * domain.inner_radius / domain.radius));
        else if(side == Side::outer)
          fmt::format_to(out, "set label {} at graph 0.5,1 center offset 0,0.9\n",
                         words(canvas_width - 20));
      }
    }

    /** A length of 1, 2 or 5 times a power of ten, about a quarter of the width. */
    void write_scale(Script out, const StoredCase &record, const Frame &frame)
    {
      const double wanted = (frame.x1 - frame.x0) / 4;
      double length = std::pow(10, std::floor(std::log10(wanted)));
      if(5 * length <= wanted)
        length *= 5;
      else if(2 * length <= wanted)
        length *= 2;
      const double x0 = frame.left / canvas_width;
      const double x1 = x0 + length * frame.pixels_per_length() / canvas_width;
      const double y = 20 / frame.canvas_height;
      const std::string unit = unit_of(record, " m");
      fmt::format_to(
          out,
          "set arrow from screen {:.5f},{:.5f} to screen {:.5f},{:.5f} heads size "
          "screen 0.006,90 lw 1.5 lc rgb 'black'\n"
          "set label '{:g}{}' at screen {:.5f},{:.5f} left\n",
          x0, y, x1, y, length, unit, x1 + 0.012, y);
    }

    void write_circle(Script out, const char *name, double radius, const Frame &frame,
                      double from, double to)
    {
      fmt::format_to(out, "${} << end_of_data\n", name);
      constexpr int pieces = 240;
      for(int i = 0; i <= pieces; ++i)
      {
        const double angle = from + (to - from) * i / pieces;
        const double x = radius * std::cos(angle), y = radius * std::sin(angle);
        const double slack = 1e-9 * (frame.x1 - frame.x0);
        const bool inside = x >= frame.x0 - slack && x <= frame.x1 + slack
                            && y >= frame.y0 - slack && y <= frame.y1 + slack;
        if(inside)
          fmt::format_to(out, "{:.8g} {:.8g}\n", x, y);
        else
          fmt::format_to(out, "\n");
      }
      fmt::format_to(out, "end_of_data\n");
    }

    /** The corners of a polygon; evenly spread points on a curve of many vertices. */
    void write_outline(Script out, const cases::Outline &outline)
    {
      constexpr int most_points = 400;
      fmt::format_to(out, "$outline << end_of_data\n");
      const auto write = [&out](const auto &points)
      {
        for(std::size_t i = 0; i <= points.size(); ++i)
          fmt::format_to(out, "{:.8g} {:.8g}\n", points[i % points.size()][0],
                         points[i % points.size()][1]);
      };
      if(outline.vertices().size() > most_points)
        write(outline.points(most_points));
      else
        write(outline.vertices());
      fmt::format_to(out, "end_of_data\n");
    }

    /** The phases as areas on either side of the front. */
    void write_areas(Script out, const StoredCase &record, const RunRecord *run,
                     double front)
    {
      bool solid_first = true;
      if(run && !run->profile.solid_fraction.empty())
        solid_first = run->profile.solid_fraction.front() > 0.5;
      const char *inner
          = solid_first ? plot_colours::solid_area : plot_colours::liquid_area;
      const char *outer
          = solid_first ? plot_colours::liquid_area : plot_colours::solid_area;
      const auto circle = [&out](double radius, const char *colour)
      {
        fmt::format_to(out,
                       "set object circle at 0,0 size {:.8g} fs solid noborder fc rgb "
                       "'{}' behind\n",
                       radius, colour);
      };
      if(record.scene.domain.round())
        circle(record.scene.domain.radius, outer);
      else if(!record.scene.domain.irregular())
        fmt::format_to(out,
                       "set object rectangle from graph 0,0 to graph 1,1 fs solid "
                       "noborder fc rgb '{}' behind\n",
                       outer);
      if(std::isfinite(front) && radial_front(record))
        circle(front, inner);
      else if(std::isfinite(front))
        fmt::format_to(out,
                       "set object rectangle from graph 0,0 to {:.8g},graph 1 fs solid "
                       "noborder fc rgb '{}' behind\n",
                       front, inner);
      if(record.scene.domain.shape == cases::DomainShape::shell)
        circle(record.scene.domain.inner_radius, plot_colours::page);
    }

    /** The sites of one phase as data; returns how many there are. */
    int write_sites(Script out, const RunRecord &run, bool solid)
    {
      int count = 0;
      const RunProfile &profile = run.profile;
      fmt::format_to(out, "${} << end_of_data\n", solid ? "solid" : "liquid");
      for(std::size_t i = 0; i < profile.picture_x.size(); ++i)
      {
        const bool is_solid = i < profile.picture_solid_fraction.size()
                              && profile.picture_solid_fraction[i] >= 0.5;
        if(is_solid == solid && std::isfinite(profile.picture_x[i])
           && std::isfinite(profile.picture_y[i]))
        {
          fmt::format_to(out, "{:.6g} {:.6g}\n", profile.picture_x[i],
                         profile.picture_y[i]);
          ++count;
        }
      }
      fmt::format_to(out, "end_of_data\n");
      return count;
    }

    /** The markers' size, from the area that each site has. */
    double point_size(const RunRecord &run, const Frame &frame, const StoredCase &record)
    {
      const double hole = record.scene.domain.inner_radius / record.scene.domain.radius;
      const double covered
          = record.scene.domain.round() ? std::numbers::pi / 4 * (1 - hole * hole) : 1;
      const double area
          = covered * frame.width * frame.height / run.profile.picture_x.size();
      constexpr double radius_of_size_one = 4.5;
      return std::clamp(0.35 * std::sqrt(area), 0.9, 7.) / radius_of_size_one;
    }

    std::string write_front(Script out, const StoredCase &record, const Frame &frame,
                            double front)
    {
      const std::string look = " with lines lw 2.4 lc rgb 'black'";
      if(!radial_front(record))
      {
        fmt::format_to(out,
                       "$front << end_of_data\n{0:.8g} {1:.8g}\n{0:.8g} "
                       "{2:.8g}\nend_of_data\n",
                       front, frame.y0, frame.y1);
        return "$front" + look;
      }
      write_circle(out, "front", front, frame, 0, 2 * std::numbers::pi);
      return "$front" + look;
    }
  } // namespace

  const RunRecord *run_to_picture(const CaseRuns &runs)
  {
    constexpr long most_sites = 2600;
    // The most sites up to that number, else the fewest; corrected forms before
    // published.
    const auto rank = [](const RunRecord &run)
    {
      const long sites = static_cast<long>(run.profile.picture_x.size());
      return std::tuple(sites <= most_sites, sites <= most_sites ? sites : -sites,
                        base_method(run.label) == run.method);
    };
    const RunRecord *best = nullptr;
    for(const LabelRuns &label : runs.labels)
      for(const Level &level : label.levels)
        if(has_sites(level.finished) && (!best || rank(*level.finished) > rank(*best)))
          best = level.finished;
    return best;
  }

  double front_at_end(const CaseRuns &runs)
  {
    if(const double exact = exact_front_at_end(*runs.record); std::isfinite(exact))
      return exact;
    const RunRecord *run = runs.finest();
    return run ? run->series.front.back() : std::nan("");
  }

  std::string scene_picture_script(const StoredCase &record, const SceneContent &content)
  {
    const RunRecord *run = content.run;
    double front = content.front;
    if(record.scene.symmetry == cases::Symmetry::none && !record.exact)
      front = std::nan(""); // its shape is not known
    const Frame frame = frame_of(record, run);
    std::string script;
    const Script out = std::back_inserter(script);
    write_canvas(out, frame);
    write_walls(out, record, frame);
    write_scale(out, record, frame);
    std::vector<std::string> plots;
    if(has_sites(run))
    {
      const double size = point_size(*run, frame, record);
      for(const bool solid : {true, false})
      {
        if(write_sites(out, *run, solid) == 0)
          continue;
        plots.push_back(fmt::format("{} with points pt {} ps {:.3f} lw {} lc rgb '{}'",
                                    solid ? "$solid" : "$liquid", solid ? 7 : 6, size,
                                    solid ? 1. : 0.9,
                                    solid ? plot_colours::solid : plot_colours::liquid));
      }
    }
    else
      write_areas(out, record, run, front);
    if(record.scene.domain.round())
      for(const auto &[name, radius] :
          {std::pair("rim", record.scene.domain.radius),
           std::pair("hole", record.scene.domain.inner_radius)})
        if(radius > 0)
        {
          write_circle(out, name, radius, frame, 0, 2 * std::numbers::pi);
          plots.push_back(fmt::format("${} with lines lw 4 lc rgb 'black'", name));
        }
    if(record.scene.domain.outline)
    {
      write_outline(out, *record.scene.domain.outline);
      plots.emplace_back("$outline with lines lw 4 lc rgb 'black'");
    }
    if(record.scene.domain.mesh)
      for(const std::string &plot : write_mesh_walls(script, record.scene))
        plots.push_back(plot);
    if(std::isfinite(front))
      plots.push_back(write_front(out, record, frame, front));
    for(const std::string &plot : write_tracked_fronts(script, content.tracked))
      plots.push_back(plot);
    for(const cases::PointSource &source : record.scene.sources)
      fmt::format_to(out,
                     "set label '' at {:.8g},{:.8g} point pt 3 ps 1.6 lw 2.4 lc rgb "
                     "'black' front\n",
                     source.position[0], source.position[1]);
    std::string command;
    for(const std::string &plot : plots)
      command += (command.empty() ? "plot " : ", \\\n     ") + plot;
    return script + (command.empty() ? "plot NaN" : command) + "\n";
  }
} // namespace meltfront::verification
