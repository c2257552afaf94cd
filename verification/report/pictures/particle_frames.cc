#include <verification/report/page/number_text.h>
#include <verification/report/pictures/particle_frames.h>
#include <verification/report/plots/gnuplot.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace meltfront::verification
{
  namespace
  {
    constexpr double drawing_width = 400;
    constexpr double frame_margin = 8, strip_below = 26;
    constexpr double fast = 7.5;
    constexpr double most_aside = 1.3; // of the solid's width
    constexpr std::size_t most_numbered = 50;

    using Out = std::back_insert_iterator<std::string>;

    /** A range widened to hold a value, but no farther than a bound on either side. */
    void widen(double &lower, double &upper, double value, double least, double most)
    {
      lower = std::min(lower, std::max(value, least));
      upper = std::max(upper, std::min(value, most));
    }

    /** Pairs nearer than a distance, found by sweeping along x. */
    template <typename Visit>
    void for_near_pairs(const ParticleFrame &frame, double distance, const Visit &visit)
    {
      std::vector<std::size_t> order(frame.x.size());
      std::iota(order.begin(), order.end(), 0);
      std::ranges::sort(order, {}, [&frame](std::size_t i) { return frame.x[i]; });
      for(std::size_t a = 0; a < order.size(); ++a)
        for(std::size_t b = a + 1; b < order.size(); ++b)
        {
          const std::size_t i = order[a], j = order[b];
          if(frame.x[j] - frame.x[i] >= distance)
            break;
          if(std::hypot(frame.x[j] - frame.x[i], frame.y[j] - frame.y[i]) < distance)
            visit(i, j);
        }
    }

    std::string star(double x, double y, double radius)
    {
      std::string points;
      for(int i = 0; i < 10; ++i)
      {
        const double angle = (i * 36 - 90) * std::numbers::pi / 180;
        const double r = i % 2 == 0 ? radius : 0.42 * radius;
        points += fmt::format("{}{:.1f},{:.1f}", i == 0 ? "" : " ",
                              x + r * std::cos(angle), y + r * std::sin(angle));
      }
      return points;
    }
  } // namespace

  DrawingColours DrawingColours::of_page()
  {
    return {"currentColor", "var(--muted)", "var(--solid)", "var(--liquid)",
            "var(--page)"};
  }

  DrawingColours DrawingColours::of_file()
  {
    return {"#1b1f23", "#5c646c", plot_colours::solid, plot_colours::liquid, "#ffffff"};
  }

  FrameDrawing::FrameDrawing(const StoredCase &record,
                             const std::vector<ParticleFrame> &frames,
                             const DrawingColours &colours)
    : solid(*record.scene.particle_solid)
    , radius(std::pow(solid.law.repulsion / solid.law.attraction,
                      1 / (solid.law.repulsion_exponent - solid.law.attraction_exponent))
             / 2)
    , colours(colours)
    , x0(0)
    , x1(1)
    , y0(0)
    , y1(1)
    , scale(1)
  {
    if(!frames.empty() && !frames.front().x.empty())
    {
      const ParticleFrame &first = frames.front();
      const auto [left, right] = std::ranges::minmax(first.x);
      const auto [bottom, top] = std::ranges::minmax(first.y);
      const double width = right - left, height = top - bottom;
      x0 = left;
      x1 = right;
      y0 = bottom;
      y1 = top;
      for(const ParticleFrame &frame : frames)
      {
        for(const double x : frame.x)
          widen(x0, x1, x, left - most_aside * width, right + most_aside * width);
        for(const double y : frame.y)
          widen(y0, y1, y, bottom - 0.5 * height, top + 0.5 * height);
      }
    }
    if(solid.heating)
      y1 = std::max(y1, solid.heating->position[1]);
    if(solid.light && !solid.light->parallel)
      y1 = std::max(y1, solid.light->at[1]);
    if(solid.base)
      y0 = std::min(y0, 0.);
    const double room = 0.05 * std::max(x1 - x0, y1 - y0) + 0.3;
    x0 -= room;
    x1 += room;
    y0 -= room;
    y1 += room;
    scale = (drawing_width - 2 * frame_margin) / (x1 - x0);
  }

  double FrameDrawing::width() const
  {
    return drawing_width;
  }

  double FrameDrawing::height() const
  {
    return std::ceil(scale * (y1 - y0) + 2 * frame_margin + strip_below);
  }

  FrameDrawing::Point FrameDrawing::place(double x, double y) const
  {
    return {frame_margin + scale * (x - x0), frame_margin + scale * (y1 - y)};
  }

  bool FrameDrawing::visible(const Point &point) const
  {
    return point.x >= 0 && point.x <= width() && point.y >= 0
           && point.y <= height() - strip_below;
  }

  std::string FrameDrawing::background() const
  {
    std::string svg;
    const Out out(svg);
    if(solid.base)
    {
      const Point ground = place(0, 0);
      fmt::format_to(out,
                     "<path d=\"M0 {0:.1f}H{1:.0f}\" stroke=\"{2}\" stroke-width=\"1\"/>",
                     ground.y, width(), colours.muted);
      if(solid.base->hot)
        fmt::format_to(
            out,
            "<path d=\"M{:.1f} {:.1f}H{:.1f}\" stroke=\"{}\" "
            "stroke-width=\"4\"/>",
            std::max(place(-solid.base->hot->half_width, 0).x, 0.), ground.y + 2.5,
            std::min(place(solid.base->hot->half_width, 0).x, width()), colours.liquid);
    }
    if(solid.light && solid.dimension() == 2)
      svg += rays();
    if(solid.heating)
    {
      const Point source = place(solid.heating->position[0], solid.heating->position[1]);
      fmt::format_to(out,
                     "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"none\" "
                     "stroke=\"{}\" stroke-dasharray=\"2 4\"/>"
                     "<polygon points=\"{}\" fill=\"{}\"/>",
                     source.x, source.y, scale * solid.heating->reach, colours.muted,
                     star(source.x, source.y, 8), colours.ink);
    }
    return svg;
  }

  /** Where light comes from: a star, or rays that enter from the edge. */
  std::string FrameDrawing::rays() const
  {
    const cases::Position &at = solid.light->at;
    if(!solid.light->parallel)
    {
      const Point source = place(at[0], at[1]);
      return fmt::format("<polygon points=\"{}\" fill=\"{}\"/>",
                         star(source.x, source.y, 8), colours.ink);
    }
    constexpr int count = 9;
    const double reach = std::hypot(width(), height()) / 2, length = 0.16 * reach;
    const double size = std::hypot(at[0], at[1]);
    const double dx = at[0] / size, dy = -at[1] / size;
    std::string path;
    for(int i = 0; i < count; ++i)
    {
      const double aside = reach * (2. * i / (count - 1) - 1);
      const double x = std::clamp(width() / 2 - reach * dx - aside * dy, 0., width()),
                   y = std::clamp((height() - strip_below) / 2 - reach * dy + aside * dx,
                                  0., height() - strip_below);
      fmt::format_to(Out(path), "M{:.1f} {:.1f}l{:.1f} {:.1f}", x, y, length * dx,
                     length * dy);
    }
    return fmt::format(
        "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-dasharray=\"3 3\"/>", path,
        colours.muted);
  }

  std::string FrameDrawing::bonds(const ParticleFrame &frame) const
  {
    std::string path;
    for_near_pairs(frame, solid.law.cutoff,
                   [&](std::size_t i, std::size_t j)
                   {
                     if(frame.solid[i] < 0.5 || frame.solid[j] < 0.5)
                       return;
                     const Point a = place(frame.x[i], frame.y[i]);
                     const Point b = place(frame.x[j], frame.y[j]);
                     if(visible(a) || visible(b))
                       fmt::format_to(Out(path), "M{:.1f} {:.1f}L{:.1f} {:.1f}", a.x, a.y,
                                      b.x, b.y);
                   });
    if(path.empty())
      return {};
    return fmt::format(
        "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.3\"/>", path,
        colours.solid);
  }

  /** Points as short strokes with round ends: one path for all. */
  std::string FrameDrawing::particles(const ParticleFrame &frame, double wanted) const
  {
    std::string path;
    for(std::size_t i = 0; i < frame.x.size(); ++i)
      if((frame.solid[i] >= 0.5) == (wanted >= 0.5))
        if(const Point p = place(frame.x[i], frame.y[i]); visible(p))
          fmt::format_to(Out(path), "M{:.1f} {:.1f}h0", p.x, p.y);
    if(path.empty())
      return {};
    const double size = std::min(wanted >= 0.5 ? 4. : 6.5, 0.4 * scale);
    return fmt::format(
        "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:.1f}\" "
        "stroke-linecap=\"round\"/>",
        path, wanted >= 0.5 ? colours.solid : colours.liquid, size);
  }

  /** Layer by layer, each ball with an edge that sets it off from those behind it. */
  std::string FrameDrawing::balls(const ParticleFrame &frame) const
  {
    constexpr std::size_t balls_in_layer = 8;
    const std::size_t n = frame.x.size(), layers = 1 + n / balls_in_layer;
    std::string svg;
    for(std::size_t layer = 0; layer < layers; ++layer)
      for(const double wanted : {1., 0.})
      {
        std::string path;
        for(std::size_t i = layer * n / layers; i < (layer + 1) * n / layers; ++i)
          if((frame.solid[i] >= 0.5) == (wanted >= 0.5))
            if(const Point p = place(frame.x[i], frame.y[i]); visible(p))
              fmt::format_to(Out(path), "M{:.1f} {:.1f}h0", p.x, p.y);
        if(!path.empty())
          for(const auto &[size, colour] :
              {std::pair(2 * radius * scale, colours.page),
               {1.8 * radius * scale, wanted >= 0.5 ? colours.solid : colours.liquid}})
            fmt::format_to(Out(svg),
                           "<path d=\"{}\" fill=\"none\" stroke=\"{}\" "
                           "stroke-width=\"{:.1f}\" stroke-linecap=\"round\"/>",
                           path, colour, size);
      }
    return svg;
  }

  std::string FrameDrawing::arrows(const ParticleFrame &frame) const
  {
    constexpr double length = 0.75, head = 4.5; // in spacings, in the picture's units
    std::string path;
    for(std::size_t i = 0; i < frame.x.size(); ++i)
    {
      const double speed = std::hypot(frame.velocity_x[i], frame.velocity_y[i]);
      const Point from = place(frame.x[i], frame.y[i]);
      if(frame.solid[i] >= 0.5 || !(speed > fast) || !visible(from))
        continue;
      const double dx = frame.velocity_x[i] / speed, dy = -frame.velocity_y[i] / speed;
      const Point tip{from.x + length * scale * dx, from.y + length * scale * dy};
      fmt::format_to(Out(path), "M{:.1f} {:.1f}L{:.1f} {:.1f}", from.x, from.y, tip.x,
                     tip.y);
      fmt::format_to(Out(path), "M{:.1f} {:.1f}L{:.1f} {:.1f}L{:.1f} {:.1f}",
                     tip.x + head * (-dx - 0.6 * dy), tip.y + head * (-dy + 0.6 * dx),
                     tip.x, tip.y, tip.x + head * (-dx + 0.6 * dy),
                     tip.y + head * (-dy - 0.6 * dx));
    }
    if(path.empty())
      return {};
    return fmt::format(
        "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.2\"/>", path,
        colours.ink);
  }

  std::string FrameDrawing::numbers(const ParticleFrame &frame) const
  {
    if(frame.x.size() > most_numbered)
      return {};
    std::string svg = fmt::format("<g font-size=\"9\" fill=\"{}\">", colours.muted);
    for(std::size_t i = 0; i < frame.x.size(); ++i)
      if(const Point p = place(frame.x[i], frame.y[i]); visible(p))
        fmt::format_to(Out(svg), "<text x=\"{:.0f}\" y=\"{:.0f}\">{}</text>", p.x + 4,
                       p.y - 4, i + 1);
    return svg + "</g>";
  }

  std::string FrameDrawing::words(const ParticleFrame &frame) const
  {
    const auto solids = static_cast<long>(
        std::ranges::count_if(frame.solid, [](double value) { return value >= 0.5; }));
    long outside = 0;
    for(std::size_t i = 0; i < frame.x.size(); ++i)
      outside += !visible(place(frame.x[i], frame.y[i]));
    return fmt::format(
        "<text x=\"{:.0f}\" y=\"{:.0f}\" font-size=\"13\" text-anchor=\"middle\" "
        "fill=\"{}\">step {}: {} solid{}</text>",
        width() / 2, height() - 8, colours.ink, frame.step, solids,
        outside == 0 ? "" : fmt::format(", {} out of the picture", outside));
  }

  std::string FrameDrawing::frame(const ParticleFrame &frame) const
  {
    if(solid.dimension() == 3)
      return balls(frame) + words(frame);
    return bonds(frame) + particles(frame, 1) + particles(frame, 0) + arrows(frame)
           + numbers(frame) + words(frame);
  }
} // namespace meltfront::verification
