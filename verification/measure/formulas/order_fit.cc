#include <cases/error.h>
#include <verification/measure/formulas/order_fit.h>

#include <boost/math/distributions/students_t.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace meltfront::verification
{
  namespace
  {
    constexpr int fewest_levels = 4;
    constexpr double least_order = 0.2;
    constexpr double rising_rate = -0.25;
    constexpr double largest_scatter = 0.25;
    constexpr double slowing_ratio = 0.7;

    struct Line
    {
      double slope;
      double intercept;
      double squares; ///< sum of squared residuals
      double spread;  ///< sum of (x - mean x)^2
    };

    Line least_squares(std::span<const double> x, std::span<const double> y)
    {
      const double m = static_cast<double>(x.size());
      const double mean_x = std::accumulate(x.begin(), x.end(), 0.) / m;
      const double mean_y = std::accumulate(y.begin(), y.end(), 0.) / m;
      double xx = 0, xy = 0;
      for(std::size_t i = 0; i < x.size(); ++i)
      {
        xx += (x[i] - mean_x) * (x[i] - mean_x);
        xy += (x[i] - mean_x) * (y[i] - mean_y);
      }
      const double slope = xy / xx;
      double squares = 0;
      for(std::size_t i = 0; i < x.size(); ++i)
      {
        const double residual = y[i] - mean_y - slope * (x[i] - mean_x);
        squares += residual * residual;
      }
      return {slope, mean_y - slope * mean_x, squares, xx};
    }

    /** That Student's t exceeds in absolute value with a probability of 5 %. */
    double student_quantile(int degrees_of_freedom)
    {
      return boost::math::quantile(boost::math::students_t(degrees_of_freedom), 0.975);
    }

    /** Errors by resolution, coarse to fine, as logarithms. */
    struct Levels
    {
      std::vector<double> log_h, log_error;
    };

    Levels sorted_levels(std::span<const double> h, std::span<const double> errors)
    {
      std::map<double, std::pair<double, int>, std::greater<>> sums;
      for(std::size_t i = 0; i < h.size(); ++i)
      {
        sums[h[i]].first += std::log(errors[i]);
        ++sums[h[i]].second;
      }
      Levels levels;
      for(const auto &[resolution, sum] : sums)
      {
        levels.log_h.push_back(std::log(resolution));
        levels.log_error.push_back(sum.first / sum.second);
      }
      return levels;
    }

    /** The finest resolution whose error is above the floor; infinite for none. */
    double finest_above(double floor, std::span<const double> h,
                        std::span<const double> errors)
    {
      double finest = std::numeric_limits<double>::infinity();
      for(std::size_t i = 0; i < h.size(); ++i)
        if(errors[i] > floor)
          finest = std::min(finest, h[i]);
      return finest;
    }

    /** Take the levels out whose mean error is at or below the floor. */
    int leave_out(Levels &levels, double floor)
    {
      Levels kept;
      for(std::size_t i = 0; i < levels.log_h.size(); ++i)
        if(levels.log_error[i] > std::log(floor))
        {
          kept.log_h.push_back(levels.log_h[i]);
          kept.log_error.push_back(levels.log_error[i]);
        }
      const auto count = static_cast<int>(levels.log_h.size() - kept.log_h.size());
      levels = std::move(kept);
      return count;
    }

    OrderVerdict judge(const OrderFit &fit, const Levels &levels, const Line &line,
                       double plausible_order)
    {
      if(fit.levels < fewest_levels)
        return OrderVerdict::too_few_levels;
      if(fit.order < -least_order)
        return OrderVerdict::diverging;
      const double scatter = std::sqrt(line.squares / fit.levels);
      // Rates that rise from pair to pair are those of spectral convergence.
      if(*std::min_element(fit.pairwise.begin(), fit.pairwise.end()) < rising_rate
         || (scatter > largest_scatter && !std::ranges::is_sorted(fit.pairwise)))
        return OrderVerdict::oscillating;
      const std::span x(levels.log_h), y(levels.log_error);
      const double coarse = least_squares(x.first(3), y.first(3)).slope;
      const double fine = least_squares(x.last(3), y.last(3)).slope;
      if(fit.order < least_order || fine < slowing_ratio * coarse)
        return OrderVerdict::stagnating;
      if(fit.order - fit.confidence > plausible_order)
        return OrderVerdict::suspiciously_fast;
      return OrderVerdict::clean;
    }
  } // namespace

  const char *to_string(OrderVerdict verdict)
  {
    switch(verdict)
    {
    case OrderVerdict::clean:
      return "clean";
    case OrderVerdict::stagnating:
      return "stagnating";
    case OrderVerdict::oscillating:
      return "oscillating";
    case OrderVerdict::diverging:
      return "diverging";
    case OrderVerdict::suspiciously_fast:
      return "suspiciously fast";
    case OrderVerdict::too_few_levels:
      return "too few levels";
    case OrderVerdict::not_finite:
      return "contains NaN";
    default:
      return "zero error";
    }
  }

  std::string OrderFit::remarks() const
  {
    std::string words = verdict == OrderVerdict::clean ? "" : to_string(verdict);
    if(left_out > 0)
      words += fmt::format("{}{} level{} at round-off left out",
                           words.empty() ? "" : "; ", left_out, left_out == 1 ? "" : "s");
    return words;
  }

  std::string OrderFit::text(const std::string &base) const
  {
    if(std::isnan(order))
      return fmt::format("none ({})", remarks());
    std::string result = fmt::format("{}^{:.2f}", base, order);
    if(!std::isnan(confidence))
      result += fmt::format(" +- {:.2f}", confidence);
    const std::string words = remarks();
    return words.empty() ? result : fmt::format("{} ({})", result, words);
  }

  OrderFit fit_order(std::span<const double> h, std::span<const double> errors,
                     double plausible_order, double round_off_floor)
  {
    if(h.size() != errors.size())
      throw cases::InputError("an order needs one error for each resolution");
    OrderFit fit;
    for(std::size_t i = 0; i < h.size(); ++i)
      if(!std::isfinite(h[i]) || h[i] <= 0 || !std::isfinite(errors[i]) || errors[i] < 0)
      {
        fit.verdict = OrderVerdict::not_finite;
        return fit;
      }
    const double finest = finest_above(round_off_floor, h, errors);
    for(std::size_t i = 0; i < h.size(); ++i)
      if(errors[i] == 0 && (round_off_floor <= 0 || finest < h[i] || std::isinf(finest)))
      {
        fit.verdict = OrderVerdict::zero_error;
        return fit;
      }
    Levels levels = sorted_levels(h, errors);
    if(round_off_floor > 0)
      fit.left_out = leave_out(levels, round_off_floor);
    fit.levels = static_cast<int>(levels.log_h.size());
    if(fit.levels < 2)
      return fit;
    for(int i = 0; i + 1 < fit.levels; ++i)
      fit.pairwise.push_back((levels.log_error[i] - levels.log_error[i + 1])
                             / (levels.log_h[i] - levels.log_h[i + 1]));
    const Line line = least_squares(levels.log_h, levels.log_error);
    fit.order = line.slope;
    fit.factor = std::exp(line.intercept);
    if(fit.levels > 2)
    {
      const int freedom = fit.levels - 2;
      fit.standard_error = std::sqrt(line.squares / (freedom * line.spread));
      fit.confidence = student_quantile(freedom) * fit.standard_error;
    }
    fit.verdict = judge(fit, levels, line, plausible_order);
    return fit;
  }
} // namespace meltfront::verification
