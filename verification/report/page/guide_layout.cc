#include <verification/report/plots/plot_layout.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    struct Point
    {
      double x, y;
    };

    /** A point of a plot with two logarithmic axes in units of the SVG. */
    Point to_canvas(const Plot &plot, const Canvas &canvas, double x, double y)
    {
      const auto share = [](const Axis &axis, double value)
      { return std::log(value / axis.lower) / std::log(axis.upper / axis.lower); };
      return {canvas.left
                  + share(plot.x, x) * (canvas.width - canvas.left - canvas.right),
              canvas.height - canvas.bottom
                  - share(plot.y, y) * (canvas.height - canvas.top - canvas.bottom)};
    }

    constexpr int pieces = 16;

    void add_segment(std::vector<Point> &points, Point from, Point to)
    {
      for(int i = 0; i <= pieces; ++i)
      {
        const double t = static_cast<double>(i) / pieces;
        points.push_back({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)});
      }
    }

    /** The curves as dense points: what a label must keep away from. */
    std::vector<Point> curve_points(const Plot &plot, const Canvas &canvas)
    {
      std::vector<Point> points;
      for(const Curve &curve : plot.curves)
      {
        bool begun = false;
        Point last{};
        for(std::size_t i = 0; i < curve.x.size(); ++i)
        {
          if(!(curve.x[i] > 0) || !(curve.y[i] > 0))
            continue;
          const Point next = to_canvas(plot, canvas, curve.x[i], curve.y[i]);
          add_segment(points, begun ? last : next, next);
          last = next;
          begun = true;
        }
        // The line that leads to the curve's label.
        if(begun)
          add_segment(points, last, {canvas.width - canvas.right, last.y});
      }
      return points;
    }

    double distance(Point a, const std::vector<Point> &points)
    {
      double least = INFINITY;
      for(const Point &b : points)
        least = std::min(least, std::hypot(a.x - b.x, a.y - b.y));
      return least;
    }

    GuideLine line_of(const Plot &plot, const Guide &guide)
    {
      double x_least = INFINITY, x_most = 0, y_most = 0;
      for(const Curve &curve : plot.curves)
        for(std::size_t i = 0; i < curve.x.size(); ++i)
          if(curve.x[i] > 0 && curve.y[i] > 0)
          {
            x_least = std::min(x_least, curve.x[i]);
            x_most = std::max(x_most, curve.x[i]);
            y_most = std::max(y_most, curve.y[i]);
          }
      const bool rising = guide.exponent > 0;
      GuideLine line{};
      line.x0 = std::clamp(rising ? x_most : x_least, plot.x.lower, plot.x.upper);
      line.y0 = std::clamp(y_most, plot.y.lower, plot.y.upper);
      line.x1 = rising ? plot.x.lower : plot.x.upper;
      line.y1 = line.y0 * std::pow(line.x1 / line.x0, guide.exponent);
      if(line.y1 < plot.y.lower)
      {
        line.y1 = plot.y.lower;
        line.x1 = line.x0 * std::pow(line.y1 / line.y0, 1 / guide.exponent);
      }
      return line;
    }
  } // namespace

  std::vector<GuideLine> guide_lines(const Plot &plot, const Canvas &canvas)
  {
    std::vector<GuideLine> lines;
    std::vector<Point> taken = curve_points(plot, canvas);
    std::vector<std::vector<Point>> guides;
    for(const Guide &guide : plot.guides)
    {
      lines.push_back(line_of(plot, guide));
      const GuideLine &line = lines.back();
      add_segment(guides.emplace_back(), to_canvas(plot, canvas, line.x0, line.y0),
                  to_canvas(plot, canvas, line.x1, line.y1));
    }
    for(std::size_t g = 0; g < lines.size(); ++g)
    {
      const double side = plot.guides[g].exponent > 0 ? 1 : -1;
      std::vector<Point> others = taken;
      for(std::size_t o = 0; o < lines.size(); ++o)
        if(o != g)
          others.insert(others.end(), guides[o].begin(), guides[o].end());
      double best = -1;
      for(const Point &on_line : guides[g])
        for(const double above : {-1., 1.})
        {
          const Point label{on_line.x - above * side * 13, on_line.y - above * 9};
          const bool inside = label.x > canvas.left + 16
                              && label.x < canvas.width - canvas.right - 16
                              && label.y > canvas.top + 8
                              && label.y < canvas.height - canvas.bottom - 12;
          constexpr double far_enough = 40;
          const double score = std::min(far_enough, distance(label, others));
          if(inside && score > best)
          {
            best = score;
            lines[g].label_x = label.x;
            lines[g].label_y = label.y;
          }
        }
      taken.push_back({lines[g].label_x, lines[g].label_y});
    }
    return lines;
  }
} // namespace meltfront::verification
