#include <cases/error.h>
#include <cases/exact/front_start.h>
#include <cases/exact/line_sink.h>
#include <cases/initial_level.h>
#include <cases/numbers.h>
#include <cases/sampling.h>
#include <cases/undisturbed.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace meltfront::cases
{
  namespace
  {
    /** A seed that is felt is tried again with this share of its radius. */
    constexpr double smaller = 0.9;

    /** Front constants of sinks. */
    constexpr double least_constant = 1e-4, greatest_constant = 5;

    double apart(const Position &a, const Position &b)
    {
      return std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]));
    }

    struct Seed
    {
      std::shared_ptr<const LineSink> solution;
      Position place;
    };

    /** The solution around a sink that draws a given power (W/m), by bisection for its
     * front constant. */
    std::shared_ptr<const LineSink> solution_of_strength(const Scene &scene,
                                                         const SeedRule &rule, double far,
                                                         double strength)
    {
      double lower = least_constant, upper = greatest_constant;
      while(upper - lower > rule.closed_bracket * upper)
      {
        const double middle = std::sqrt(lower * upper);
        if(middle <= lower || middle >= upper)
          break;
        const bool weaker = LineSink(scene.material, middle, far).strength() < strength;
        (weaker ? lower : upper) = middle;
      }
      auto solution
          = std::make_shared<LineSink>(scene.material, std::sqrt(lower * upper), far);
      if(std::abs(solution->strength() - strength) > 1e-9 * strength)
        throw Refusal(fmt::format("{}: no similarity solution draws {:.6g} W/m: give the "
                                  "initial front (key `front` of the initial state)",
                                  rule.method, strength));
      return solution;
    }

    double wall_distance(const Scene &scene, const SeedRule &rule, const Position &place)
    {
      const Domain &domain = scene.domain;
      double least = infinity;
      for(const Side side : scene.sides())
      {
        if(std::ranges::find(rule.exempt_walls, side) != rule.exempt_walls.end())
          continue;
        const std::size_t number = static_cast<std::size_t>(side), d = number / 2;
        const double distance
            = side == Side::inner   ? apart(place, {}) - domain.inner_radius
              : side != Side::outer ? (number % 2 == 1 ? domain.upper[d] - place[d]
                                                       : place[d] - domain.lower[d])
              : domain.outline      ? domain.outline->distance(place)
                                    : domain.radius - apart(place, {});
        least = std::min(least, distance);
      }
      return least;
    }

    /** Whether walls or other sinks feel what is around a sink. */
    bool felt(const Scene &scene, const SeedRule &rule, const std::vector<Seed> &seeds,
              double clock)
    {
      const double diffusivity = scene.material.liquid.diffusivity();
      double least = infinity;
      for(std::size_t i = 0; i < seeds.size(); ++i)
      {
        least = std::min(least, wall_distance(scene, rule, seeds[i].place));
        for(std::size_t j = 0; j < i; ++j)
          least = std::min(least, apart(seeds[i].place, seeds[j].place) / 2);
      }
      return std::exp(-least * least / (4 * diffusivity * clock)) > rule.negligible;
    }

    /** When the smallest seed has grown to the largest radius that none feels (s). */
    double seeding_clock(const Scene &scene, const SeedRule &rule,
                         const std::vector<Seed> &seeds)
    {
      for(double radius = rule.largest;; radius *= smaller)
      {
        double clock = 0;
        for(const Seed &seed : seeds)
        {
          const double share = std::max(radius, rule.smallest) / seed.solution->front(1);
          clock = std::max(clock, share * share);
        }
        if(!felt(scene, rule, seeds, clock))
          return clock;
        if(radius <= rule.smallest)
          throw Refusal(fmt::format(
              "{} cannot seed the front of a sink: walls or other sinks feel it before "
              "it has grown to {:.3g} m; take more {} or give the initial front",
              rule.method, rule.smallest, rule.pieces));
      }
    }

    FrontStart seeded_start(const Scene &scene, const SeedRule &rule)
    {
      const double far = scene.initial.temperature({}, scene.start_time);
      std::vector<Seed> seeds;
      for(const PointSource &source : scene.sources)
        seeds.push_back(
            {solution_of_strength(scene, rule, far, -source.power(scene.start_time)),
             source.position});
      const double clock = seeding_clock(scene, rule, seeds);
      const double time = scene.start_time + clock;
      if(!(time < scene.end_time))
        throw Refusal(fmt::format("{}: the front does not grow to the size of its seed "
                                  "before the end; take more {} along the side",
                                  rule.method, rule.pieces));
      require_undisturbed(scene, far, time, rule.method);
      const auto level_set = [seeds, clock](const Position &point)
      {
        double least = infinity;
        for(const Seed &seed : seeds)
          least = std::min(least, apart(point, seed.place) - seed.solution->front(clock));
        return least;
      };
      const auto temperature = [seeds, clock, far](const Position &point)
      {
        double result = far;
        for(const Seed &seed : seeds)
        {
          const double distance = std::max(apart(point, seed.place), 1e-150);
          const double value = seed.solution->temperature(distance, clock);
          if(distance < seed.solution->front(clock))
            return value;
          result += value - far;
        }
        return result;
      };
      return {time, level_set, temperature,
              fmt::format("similarity solution of each sink at {:.6g} s", time)};
    }

    struct InitialPhases
    {
      bool solid = false, liquid = false, uniform = true;
    };

    InitialPhases initial_phases(const Scene &scene)
    {
      InitialPhases result;
      const Field &temperature = scene.initial.temperature;
      const double first = temperature({}, scene.start_time);
      visit_points(scene.domain,
                   [&](const Position &p)
                   {
                     const double value = temperature(p, scene.start_time);
                     const bool solid = value < scene.material.melting_temperature;
                     (solid ? result.solid : result.liquid) = true;
                     result.uniform = result.uniform && value == first;
                   });
      return result;
    }
  } // namespace

  FrontStart find_front_start(const Scene &scene, const SeedRule &rule)
  {
    const double time = scene.start_time;
    const auto at_start = [time](const Field &field) -> FrontStart::Function
    { return [&field, time](const Position &p) { return field(p, time); }; };
    FrontStart start{time, {}, at_start(scene.initial.temperature), ""};
    const auto &exact = scene.initial.exact;
    if(exact && exact->has_front() && time > exact->start_time())
    {
      start.description = "exact solution";
      start.level_set = [level = exact_level(exact), time](const Position &p)
      { return level(p, time); };
      return start;
    }
    if(scene.initial.front)
    {
      start.description = "the scene's level set";
      start.level_set = at_start(*scene.initial.front);
      return start;
    }
    const InitialPhases initial = initial_phases(scene);
    if(initial.solid && initial.liquid)
    {
      start.description = "where the initial temperature is the melting temperature";
      start.level_set = [temperature = start.temperature,
                         melting = scene.material.melting_temperature](const Position &p)
      { return temperature(p) - melting; };
      return start;
    }
    const bool sinks = !scene.sources.empty()
                       && std::ranges::all_of(scene.sources, [&](const auto &source)
                                              { return source.power(time) < 0; });
    if(initial.solid || !initial.uniform || !sinks)
      throw Refusal(fmt::format(
          "{} needs a front at the start: one phase fills the domain, and no line sink "
          "in "
          "a uniform liquid seeds one; give the initial front or an initial temperature "
          "that crosses the melting temperature",
          rule.method));
    return seeded_start(scene, rule);
  }
} // namespace meltfront::cases
