#include <verification/judge/error_bar.h>

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

namespace meltfront::verification
{
  namespace
  {
    using cases::nan;

    constexpr double round_off = 1e-12;      ///< of the quantity's size
    constexpr double least_order = 0.5;      ///< with which a bar is made
    constexpr double converging_order = 0.2; ///< below it nothing converges
    constexpr double highest_observed = 20;  ///< all that a ratio of differences can tell
    constexpr double steps_refined = 1.1;    ///< ratio of steps: less is not refined
    constexpr double factor_of_two_levels = 2;
    constexpr double spread_factor = 3;
    /** Two levels whose values differ by less than this share of h may agree by chance;
     * 90 per cent of errors of position are below this share of h then. */
    constexpr double chance_share = 1e-3, error_share = 0.05;

    double option(const RunRecord &run, const char *key)
    {
      const auto found = run.options.find(key);
      return found == run.options.end() ? 0 : std::strtod(found->second.c_str(), nullptr);
    }

    double scheme_order(const RunRecord &run)
    {
      static const std::map<std::string, double> orders{
          {"euler", 1}, {"backward-euler", 1}, {"crank-nicolson", 2},
          {"rkl2", 2},  {"bdf2", 2},           {"bdf3", 3},
          {"bdf4", 4},  {"radau3", 3},         {"radau5", 5}};
      const auto scheme = run.options.find("time_scheme");
      const auto found
          = scheme == run.options.end() ? orders.end() : orders.find(scheme->second);
      return found == orders.end() ? 2 : found->second;
    }

    /** The highest order that refined steps allow to believe in. */
    double order_cap(const BarLevel &finest, const BarLevel &coarser,
                     const BarRecipe &recipe, std::string &remark)
    {
      if(recipe.in_time)
        return recipe.order_in_time;
      const double steps = static_cast<double>(std::max(finest.steps, 1L))
                           / static_cast<double>(std::max(coarser.steps, 1L));
      if(steps < steps_refined)
      {
        remark = "time step not refined: its error is not measured";
        return std::min(recipe.highest_order, 1.);
      }
      const double in_time = recipe.order_in_time * std::log(steps)
                             / std::log(coarser.spacing / finest.spacing);
      return std::min(recipe.highest_order, std::max(1., in_time));
    }

    ErrorBar bar_of_two(const BarLevel &finest, const BarLevel &coarser, double d,
                        double norm, const BarRecipe &recipe)
    {
      ErrorBar result;
      result.levels = 2;
      result.converging = true;
      result.value = finest.value;
      result.order = std::min(1., order_cap(finest, coarser, recipe, result.remark));
      // Whether terms of the error cancel at a place only a third level could tell.
      const double width = std::fmax(norm, recipe.local_difference);
      const double a = std::isnan(width) ? d : std::sqrt((d * d + width * width) / 2);
      result.bar = factor_of_two_levels * a
                   / (std::pow(coarser.spacing / finest.spacing, result.order) - 1);
      if(std::isnan(norm) && !recipe.in_time && d <= chance_share * finest.spacing)
        result.bar = std::max(result.bar, error_share * finest.spacing);
      result.remark
          = result.remark.empty() ? "two levels" : "two levels; " + result.remark;
      return result;
    }
  } // namespace

  BarConstants bar_constants(const RunRecord &run)
  {
    const double in_time = scheme_order(run);
    static const std::map<std::string, BarConstants> known{
        {"fem-enthalpy", {2, 2, 1.5, 1.5, 2}},
        {"sph", {2, 2, 1.75, 1.25, 2}},
        {"sph-mixture", {2, 0, 1.5, 2, 1.5}},
        {"sph-two-population", {2, 0, 1.5, 2, 1.5}},
        {"rkpm-tracked", {2, 0, 2, 2, 1.5}},
        {"sph-2005", {0.75, 1, 2, 0.75, 2}},
        {"sph-two-population-2005", {0.75, 1, 2, 0.75, 2}},
        {"fem-cut", {2, 0, 1.5, 2, 1.5}}};
    if(run.method == "fem-fitted")
    {
      const double order = 2 * std::max(1., option(run, "degree"));
      return {order, in_time, 1.5, order, 1.5};
    }
    const auto found = known.find(run.method);
    BarConstants constants
        = found == known.end() ? BarConstants{2, 0, 2.5, 2, 1.5} : found->second;
    if(constants.order_in_time == 0)
      constants.order_in_time = in_time;
    return constants;
  }

  double observed_order(double ratio, double r21, double r32)
  {
    const auto excess = [&](double p)
    {
      return std::pow(r21, p) * std::expm1(p * std::log(r32))
                 / std::expm1(p * std::log(r21))
             - ratio;
    };
    const double least = 1e-6;
    if(excess(least) >= 0)
      return -1;
    if(excess(highest_observed) <= 0)
      return highest_observed;
    const auto [lower, upper] = boost::math::tools::bisect(
        excess, least, highest_observed, boost::math::tools::eps_tolerance<double>(40));
    return (lower + upper) / 2;
  }

  ErrorBar error_bar(std::span<const BarLevel> levels,
                     std::span<const double> differences, const BarRecipe &recipe)
  {
    const std::size_t count = levels.size();
    ErrorBar result;
    if(count == 0)
      return result;
    const BarLevel &finest = levels[count - 1];
    result.value = finest.value;
    result.levels = 1;
    if(count == 1)
    {
      result.remark = "one level: no error bar";
      return result;
    }
    const BarLevel &second = levels[count - 2];
    const double d21 = std::abs(finest.value - second.value);
    const double norm21 = differences[count - 2];
    const double r21 = second.spacing / finest.spacing;
    if(count == 2)
      return bar_of_two(finest, second, d21, norm21, recipe);

    const BarLevel &third = levels[count - 3];
    const double d32 = std::abs(second.value - third.value);
    const bool norms = std::isfinite(norm21) && std::isfinite(differences[count - 3]);
    const double finer = norms ? norm21 : d21;
    const double coarser = norms ? differences[count - 3] : d32;
    const double width
        = std::isnan(recipe.local_difference) ? finer : recipe.local_difference;
    const double a = std::sqrt((d21 * d21 + width * width) / 2);
    const double floor = round_off * recipe.scale;
    result.levels = 3;
    result.converging = true;
    if(a <= floor)
    {
      result.bar = floor;
      result.remark = "round-off";
      return result;
    }
    const double cap = order_cap(finest, second, recipe, result.remark);
    result.observed
        = finer > 0 ? observed_order(coarser / finer, r21, third.spacing / second.spacing)
                    : cap;
    if(result.observed < converging_order && coarser > floor)
    {
      result.converging = false;
      result.bar = spread_factor * std::max({d21, d32, finer, coarser});
      result.remark = "not converging";
      return result;
    }
    result.order = std::min(std::max(result.observed, std::min(least_order, cap)), cap);
    result.bar = recipe.factor * a / (std::pow(r21, result.order) - 1);
    return result;
  }
} // namespace meltfront::verification
