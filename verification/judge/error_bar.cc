#include <verification/judge/error_bar.h>

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <string_view>

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
    /** What Newton's method leaves of fem-fitted's values over some hundred steps, of
     * their size: errors of ladders that no longer fall are up to 7e-10. */
    constexpr double floor_of_fitted = 1e-9;
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
      if(std::isfinite(recipe.time_error))
      {
        remark = "time error measured at half the step";
        return recipe.highest_order;
      }
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

    double time_error(const BarRecipe &recipe)
    {
      return std::isfinite(recipe.time_error) ? recipe.time_error : 0;
    }

    /** sqrt((d^2 + D^2)/2) */
    double with_norm(double difference, double norm)
    {
      return std::isnan(norm) ? std::abs(difference)
                              : std::sqrt((difference * difference + norm * norm) / 2);
    }

    /** Of the finest of all levels, if it falls as h^p, by a level and the next finer. */
    double error_by_pair(std::span<const BarLevel> levels, std::size_t coarser,
                         double width, double p)
    {
      const double d = levels[coarser].value - levels[coarser + 1].value;
      return with_norm(d, width) * std::pow(levels.back().spacing, p)
             / (std::pow(levels[coarser].spacing, p)
                - std::pow(levels[coarser + 1].spacing, p));
    }

    ErrorBar bar_of_two(const BarLevel &finest, const BarLevel &coarser, double norm,
                        const BarRecipe &recipe)
    {
      ErrorBar result;
      result.levels = 2;
      result.converging = true;
      result.value = finest.value;
      result.order = std::min(1., order_cap(finest, coarser, recipe, result.remark));
      const double d = std::abs(finest.value - coarser.value);
      // Whether terms of the error cancel at a place only a third level could tell.
      const double width = recipe.local_differences.empty()
                               ? norm
                               : std::fmax(norm, recipe.local_differences.back());
      const double a = with_norm(d, width);
      result.bar = std::max(factor_of_two_levels, recipe.factor)
                   * (a / (std::pow(coarser.spacing / finest.spacing, result.order) - 1)
                      + time_error(recipe));
      result.bar = std::max(result.bar, recipe.floor * recipe.scale);
      if(std::isnan(norm) && !recipe.in_time && d <= chance_share * finest.spacing)
        result.bar = std::max(result.bar, error_share * finest.spacing);
      result.remark
          = result.remark.empty() ? "two levels" : "two levels; " + result.remark;
      return result;
    }

    /** Whether a run says of itself what begins like that. */
    bool says(const RunRecord &run, std::string_view name, std::string_view beginning)
    {
      return std::ranges::any_of(
          run.description.parameters, [&](const cases::Parameter &parameter)
          { return parameter.name == name && parameter.value.starts_with(beginning); });
    }

    /** Whether sph took fronts for lines or planes within particles. */
    bool has_plane_fronts(const RunRecord &run)
    {
      return says(run, "exchange at fronts", "front as a line or a plane");
    }

    /** Along a line, where random slabs and shells tell: whatever a scheme's order,
     * fronts that have just begun or turned back show less. Nothing for other methods. */
    std::optional<BarConstants> constants_along_a_line(const RunRecord &run)
    {
      constexpr BarTrust plain{1.5, 1.5, true}, closer{1.5, 1.25, true},
          closest{1.5, 1, true}, wide{1.5, 2, true};
      static const std::map<std::string, std::array<BarTrust, 3>> methods{
          {"fem-enthalpy", {plain, plain, plain}},
          {"sph", {closer, wide, closest}},
          {"sph-mixture", {plain, plain, plain}},
          {"sph-two-population", {plain, plain, plain}},
          {"rkpm-tracked", {closer, closer, wide}}};
      const auto found = methods.find(run.method);
      if(run.description.dimension > 1 || found == methods.end())
        return std::nullopt;
      const auto &[front, heat, temperature] = found->second;
      return BarConstants{front, front, heat, temperature, scheme_order(run)};
    }

    /** Of methods whose front stands in cells or particles, in the plane and in space: of
     * first order in space, and of sph where fronts are lines or planes. */
    BarConstants constants_in_cells(const RunRecord &run)
    {
      BarConstants constants;
      constants.order_in_time = 2;
      if(run.method == "fem-enthalpy")
      {
        constants.front = {1, 1.25};
        constants.volume = {1, 1};
        constants.heat = {1, 1.25};
        constants.temperature = {1, 1, true};
        return constants;
      }
      constants.front = constants.volume = {1, 1.25, true};
      constants.heat = {1, 1.25, true};
      constants.temperature = {1, 1, true};
      if(has_plane_fronts(run))
      {
        constants.front = constants.volume = {1.5, 1.5, true};
        constants.heat = {1.5, 1.25, true};
        constants.temperature = {1.5, 1.25, true};
      }
      return constants;
    }
  } // namespace

  BarConstants bar_constants(const RunRecord &run)
  {
    if(const auto known = constants_along_a_line(run))
      return *known;
    // Mixtures conduct by the rows of sph.
    if(run.method == "fem-enthalpy" || run.method == "sph" || run.method == "sph-mixture"
       || run.method == "sph-two-population")
      return constants_in_cells(run);
    struct Known
    {
      BarTrust front, temperature;
      double order_in_time = 0; ///< 0: of the scheme
    };
    static const std::map<std::string, Known> methods{
        // In the plane and in space; three coarse levels often show two by chance.
        {"rkpm-tracked", {{1.5, 1.5, true}, {1.5, 1.5, true}}},
        {"sph-2005", {{0.75, 2}, {0.75, 2, true}, 1}},
        {"sph-two-population-2005", {{0.75, 2}, {0.75, 2, true}, 1}},
        {"fem-cut", {{2, 1.5}, {2, 1.25}}},
        {"voronoi-fv", {{2, 2.5}, {2, 1.5}}}};
    const auto found = methods.find(run.method);
    Known known = found == methods.end() ? Known{{2, 2.5}, {2, 1.25}} : found->second;
    // The state that sph hands over is a fixed number of spacings deep: of first order.
    if(run.method == "rkpm-tracked" && says(run, "start", "sph"))
      known.front.order = known.temperature.order = 1;
    BarConstants constants;
    if(run.method == "fem-fitted")
    {
      // At the front it is superconvergent; elsewhere polynomials of its degree are not.
      const double degree = std::max(1., option(run, "degree"));
      known = {{2 * degree, 1.5}, {degree + 1, 1.25, true}};
      constants.floor = floor_of_fitted;
    }
    constants.front = constants.volume = constants.heat = known.front;
    constants.temperature = known.temperature;
    constants.consistent = run.method != "sph-two-population-2005";
    constants.order_in_time
        = known.order_in_time > 0 ? known.order_in_time : scheme_order(run);
    return constants;
  }

  BarRecipe bar_recipe(const BarConstants &constants, const BarTrust &trust, double scale,
                       bool in_time)
  {
    BarRecipe recipe{scale, trust.order, constants.order_in_time, trust.factor, in_time};
    recipe.all_pairs = trust.all_pairs;
    recipe.floor = constants.floor;
    recipe.consistent = constants.consistent;
    return recipe;
  }

  double error_of_step(double difference, double norm, double ratio_of_steps,
                       double order_in_time)
  {
    return with_norm(difference, norm) / (1 - std::pow(ratio_of_steps, -order_in_time));
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
    if(!recipe.consistent)
    {
      result.levels = static_cast<int>(count);
      result.remark
          = "the method does not converge to the scene's solution: no error bar";
      return result;
    }
    const BarLevel &second = levels[count - 2];
    const double d21 = std::abs(finest.value - second.value);
    const double norm21 = differences[count - 2];
    if(count == 2)
      return bar_of_two(finest, second, norm21, recipe);

    const BarLevel &third = levels[count - 3];
    const double d32 = std::abs(second.value - third.value);
    const double norm32 = differences[count - 3];
    const bool norms = std::isfinite(norm21) && std::isfinite(norm32);
    const double finer = norms ? norm21 : d21;
    const double coarser = norms ? norm32 : d32;
    const double floor = recipe.floor * recipe.scale;
    const auto width = [&](std::size_t pair)
    {
      return !recipe.local_differences.empty() ? recipe.local_differences[pair]
             : norms                           ? differences[pair]
                                               : nan;
    };
    result.levels = 3;
    result.converging = true;
    const std::size_t coarsest_pair = recipe.all_pairs ? 0 : count - 2;
    double largest = 0;
    for(std::size_t pair = coarsest_pair; pair + 1 < count; ++pair)
      largest = std::max(
          largest, with_norm(levels[pair].value - levels[pair + 1].value, width(pair)));
    if(largest <= floor)
    {
      result.bar = floor + recipe.factor * time_error(recipe);
      result.remark
          = recipe.floor > round_off ? "at the floor of its solver" : "round-off";
      return result;
    }
    const double cap = order_cap(finest, second, recipe, result.remark);
    result.observed
        = finer > 0 ? observed_order(coarser / finer, second.spacing / finest.spacing,
                                     third.spacing / second.spacing)
                    : cap;
    if(result.observed < converging_order && coarser > floor)
    {
      result.converging = false;
      result.bar = spread_factor * std::max({d21, d32, finer, coarser});
      result.remark = "not converging";
      return result;
    }
    result.order = std::min(std::max(result.observed, std::min(least_order, cap)), cap);
    double error = 0;
    for(std::size_t pair = coarsest_pair; pair + 1 < count; ++pair)
      error = std::max(error, error_by_pair(levels, pair, width(pair), result.order));
    result.bar = std::max(floor, recipe.factor * (error + time_error(recipe)));
    return result;
  }
} // namespace meltfront::verification
