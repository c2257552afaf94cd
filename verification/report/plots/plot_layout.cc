#include <verification/report/plots/plot_layout.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meltfront::verification
{
  Canvas canvas_of(const Plot &plot)
  {
    if(plot.small)
      return {320, 230, 58, 14, 28, 46, 12};
    return {640, 420, 84, 178, 16, 60, 15};
  }

  namespace
  {
    struct Extent
    {
      double lower = INFINITY, upper = -INFINITY;

      void include(double value, bool logarithmic)
      {
        if(!std::isfinite(value) || (logarithmic && value <= 0))
          return;
        lower = std::min(lower, value);
        upper = std::max(upper, value);
      }
    };

    /** Give an axis the range of its data, with a margin of the given share. */
    void choose_range(Axis &axis, Extent data, double margin)
    {
      if(data.lower > data.upper)
        data = axis.logarithmic ? Extent{0.1, 10} : Extent{0, 1};
      double lower = axis.logarithmic ? std::log10(data.lower) : data.lower;
      double upper = axis.logarithmic ? std::log10(data.upper) : data.upper;
      // A single level or a constant still gets a range; a logarithmic one half a decade.
      const double least
          = axis.logarithmic
                ? 0.5
                : std::max(1e-12, 0.02 * std::max(std::abs(lower), std::abs(upper)));
      if(upper - lower < least)
      {
        const double middle = (lower + upper) / 2;
        lower = middle - least / 2;
        upper = middle + least / 2;
      }
      const double pad = margin * (upper - lower);
      lower -= pad;
      upper += pad;
      if(std::isnan(axis.lower))
        axis.lower = axis.logarithmic ? std::pow(10, lower) : lower;
      if(std::isnan(axis.upper))
        axis.upper = axis.logarithmic ? std::pow(10, upper) : upper;
    }
  } // namespace

  void choose_ranges(Plot &plot)
  {
    Extent x, y;
    for(const Curve &curve : plot.curves)
      for(std::size_t i = 0; i < curve.x.size(); ++i)
      {
        const bool valid = std::isfinite(curve.x[i]) && std::isfinite(curve.y[i])
                           && (!plot.x.logarithmic || curve.x[i] > 0)
                           && (!plot.y.logarithmic || curve.y[i] > 0);
        if(!valid)
          continue;
        x.include(curve.x[i], plot.x.logarithmic);
        y.include(curve.y[i], plot.y.logarithmic);
        if(i < curve.spread.size())
          y.include(curve.y[i] + curve.spread[i], plot.y.logarithmic);
      }
    for(const EdgeMark &mark : plot.failed)
      x.include(mark.x, plot.x.logarithmic);
    choose_range(plot.x, x, plot.x.logarithmic ? 0.09 : 0);
    choose_range(plot.y, y, plot.failed.empty() ? 0.08 : 0.12);
  }

  std::vector<double> spread_apart(const std::vector<double> &wanted, double gap,
                                   double lower, double upper)
  {
    const std::size_t count = wanted.size();
    if(count == 0)
      return {};
    if(count > 1)
      gap = std::min(gap, (upper - lower) / (count - 1));
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&wanted](std::size_t a, std::size_t b)
                     { return wanted[a] < wanted[b]; });
    // Isotonic regression of wanted_k - k gap: neighbours that are too close share a
    // mean.
    struct Block
    {
      double sum;
      std::size_t size;
    };
    std::vector<Block> blocks;
    for(std::size_t k = 0; k < count; ++k)
    {
      blocks.push_back({wanted[order[k]] - k * gap, 1});
      while(blocks.size() > 1
            && blocks[blocks.size() - 2].sum * blocks.back().size
                   > blocks.back().sum * blocks[blocks.size() - 2].size)
      {
        const Block last = blocks.back();
        blocks.pop_back();
        blocks.back().sum += last.sum;
        blocks.back().size += last.size;
      }
    }
    std::vector<double> result(count);
    std::size_t k = 0;
    for(const Block &block : blocks)
      for(std::size_t i = 0; i < block.size; ++i, ++k)
        result[order[k]] = std::clamp(block.sum / block.size, lower,
                                      std::max(lower, upper - (count - 1) * gap))
                           + k * gap;
    return result;
  }

  std::vector<EndLabel> end_labels(const Plot &plot, const Canvas &canvas)
  {
    std::vector<EndLabel> labels;
    std::vector<double> heights;
    for(std::size_t c = 0; c < plot.curves.size(); ++c)
    {
      const Curve &curve = plot.curves[c];
      EndLabel label{c, -INFINITY, 0, 0};
      for(std::size_t i = 0; i < curve.x.size(); ++i)
        if(std::isfinite(curve.x[i]) && std::isfinite(curve.y[i]) && curve.x[i] > label.x
           && curve.x[i] <= plot.x.upper && (!plot.y.logarithmic || curve.y[i] > 0))
        {
          label.x = curve.x[i];
          label.y = curve.y[i];
        }
      if(!std::isfinite(label.x) || curve.label.empty())
        continue;
      const auto scaled
          = [&plot](double y) { return plot.y.logarithmic ? std::log(y) : y; };
      heights.push_back(std::clamp((scaled(label.y) - scaled(plot.y.lower))
                                       / (scaled(plot.y.upper) - scaled(plot.y.lower)),
                                   0., 1.));
      labels.push_back(label);
    }
    const double drawn = canvas.height - canvas.top - canvas.bottom;
    const auto apart = spread_apart(heights, 1.25 * canvas.font / drawn, 0.02, 0.98);
    for(std::size_t l = 0; l < labels.size(); ++l)
      labels[l].height = apart[l];
    return labels;
  }

  double linear_step(double lower, double upper, int most)
  {
    const double least = (upper - lower) / most;
    const double power = std::pow(10, std::floor(std::log10(least)));
    for(const double digit : {1., 2., 5.})
      if(digit * power >= least * (1 - 1e-9))
        return digit * power;
    return 10 * power;
  }

  std::string logarithmic_tics(double lower, double upper, bool small)
  {
    const int first = static_cast<int>(std::floor(std::log10(lower)));
    const int last = static_cast<int>(std::ceil(std::log10(upper)));
    const double decades = std::log10(upper / lower);
    const int most = small ? 5 : 8;
    const int every = std::max(1, static_cast<int>(std::ceil(decades / most)));
    std::string tics;
    const auto add = [&](const std::string &label, double at, int level)
    {
      if(at >= lower * (1 - 1e-9) && at <= upper * (1 + 1e-9))
        tics += fmt::format("{}'{}' {:.6g} {}", tics.empty() ? "" : ", ", label, at,
                            level);
    };
    for(int decade = first; decade <= last; ++decade)
    {
      const double power = std::pow(10, decade);
      const bool labelled = decade % every == 0;
      add(labelled ? fmt::format("10^{{{}}}", decade) : "", power, labelled ? 0 : 1);
      for(int digit = 2; digit <= 9 && every == 1; ++digit)
      {
        const bool named = (digit == 2 || digit == 5) && decades < (small ? 1.2 : 2);
        add(named ? fmt::format("{}·10^{{{}}}", digit, decade) : "", digit * power,
            named ? 0 : 1);
      }
    }
    return tics;
  }

  std::string shortened(const std::string &utf8, std::size_t length)
  {
    std::vector<std::size_t> begins;
    for(std::size_t i = 0; i < utf8.size(); ++i)
      if((static_cast<unsigned char>(utf8[i]) & 0xc0) != 0x80)
        begins.push_back(i);
    if(begins.size() <= length || length < 2)
      return utf8;
    if(utf8.ends_with("]"))
      return "…" + utf8.substr(begins[begins.size() - length + 1]);
    return utf8.substr(0, begins[length - 1]) + "…";
  }
} // namespace meltfront::verification
