#include <cases/error.h>
#include <verification/measure/formulas/grid_convergence.h>

#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace meltfront::verification
{
  namespace
  {
    constexpr double safety_factor = 1.25;
    constexpr double safety_factor_without_order = 3;
    constexpr double largest_order = 20;

    /** (f_3 - f_2)/(f_2 - f_1) of a sequence of order p, for any p, also p -> 0. */
    double ratio_of_differences(double p, double log_r21, double log_r32)
    {
      if(p == 0)
        return log_r32 / log_r21;
      return std::exp(p * log_r21) * std::expm1(p * log_r32) / std::expm1(p * log_r21);
    }
  } // namespace

  GridConvergence extrapolate(std::span<const double> h, std::span<const double> values)
  {
    std::map<double, double> by_resolution;
    if(h.size() == values.size())
      for(std::size_t i = 0; i < h.size(); ++i)
        if(h[i] > 0)
          by_resolution[h[i]] = values[i];
    if(by_resolution.size() < 3)
      throw cases::InputError(
          "an extrapolation needs values at three different resolutions");
    const auto finest = by_resolution.begin();
    const auto [h1, f1] = *finest;
    const auto [h2, f2] = *std::next(finest);
    const auto [h3, f3] = *std::next(finest, 2);

    GridConvergence result;
    if(!std::isfinite(f1) || !std::isfinite(f2) || !std::isfinite(f3))
      return result;
    if(f1 == f2 && f2 == f3)
    {
      result.extrapolated = f1;
      result.uncertainty = 0;
      result.monotone = true;
      return result;
    }
    const double log_r21 = std::log(h2 / h1), log_r32 = std::log(h3 / h2);
    const double ratio = (f3 - f2) / (f2 - f1);
    if(!(ratio > ratio_of_differences(0, log_r21, log_r32))
       || ratio > ratio_of_differences(largest_order, log_r21, log_r32))
    {
      result.uncertainty = safety_factor_without_order
                           * (std::max({f1, f2, f3}) - std::min({f1, f2, f3}));
      return result;
    }
    std::uintmax_t iterations = 100;
    const auto bracket = boost::math::tools::toms748_solve(
        [&](double p) { return ratio_of_differences(p, log_r21, log_r32) - ratio; }, 0.,
        largest_order, boost::math::tools::eps_tolerance<double>(), iterations);
    result.order = (bracket.first + bracket.second) / 2;
    result.monotone = true;
    result.extrapolated = f1 + (f1 - f2) / std::expm1(result.order * log_r21);
    result.uncertainty = safety_factor * std::abs(f1 - result.extrapolated);
    return result;
  }
} // namespace meltfront::verification
