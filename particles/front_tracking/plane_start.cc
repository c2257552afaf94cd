#include <particles/front_tracking/plane_start.h>

#include <cases/error.h>
#include <cases/exact/line_sink.h>
#include <cases/undisturbed.h>

#include <particles/front_tracking/tracking_options.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace meltfront::particles::front_tracking
{
  namespace
  {
    /** Neighbours and walls must change a similarity solution by less than this part. */
    constexpr double negligible = 1e-5;

    /** A seed that is felt is tried again with this share of its radius. */
    constexpr double smaller = 0.9;

    constexpr int sample_lines = 33;

    struct Seed
    {
      std::shared_ptr<const cases::LineSink> solution;
      PlanePoint place;
    };

    /** The solution around a sink that draws a given power (W/m), by bisection for its
     * front constant. */
    std::shared_ptr<const cases::LineSink>
    solution_of_strength(const cases::Scene &scene, double far, double strength)
    {
      double lower = 1e-4, upper = 5;
      while(upper - lower > 1e-15 * upper)
      {
        const double middle = std::sqrt(lower * upper);
        if(middle <= lower || middle >= upper)
          break;
        const bool weaker
            = cases::LineSink(scene.material, middle, far).strength() < strength;
        (weaker ? lower : upper) = middle;
      }
      auto solution = std::make_shared<cases::LineSink>(scene.material,
                                                        std::sqrt(lower * upper), far);
      if(std::abs(solution->strength() - strength) > 1e-9 * strength)
        throw cases::Refusal(fmt::format(
            "rkpm-tracked: no similarity solution draws {:.6g} W/m: give the initial "
            "front (key `front` of the initial state)",
            strength));
      return solution;
    }

    double wall_distance(const cases::Scene &scene, const PlanePoint &place)
    {
      const cases::Domain &domain = scene.domain;
      if(domain.outline)
        return domain.outline->distance(position_of(place));
      if(domain.round())
        return domain.radius - place.norm();
      double least = std::numeric_limits<double>::infinity();
      for(int d = 0; d < 2; ++d)
        least = std::min({least, place[d] - domain.lower[d], domain.upper[d] - place[d]});
      return least;
    }

    /** Whether walls or other sinks feel what is around a sink. */
    bool felt(const cases::Scene &scene, const std::vector<Seed> &seeds, double clock)
    {
      const double diffusivity = scene.material.liquid.diffusivity();
      double least = std::numeric_limits<double>::infinity();
      for(std::size_t i = 0; i < seeds.size(); ++i)
      {
        least = std::min(least, wall_distance(scene, seeds[i].place));
        for(std::size_t j = 0; j < i; ++j)
          least = std::min(least, (seeds[i].place - seeds[j].place).norm() / 2);
      }
      return std::exp(-least * least / (4 * diffusivity * clock)) > negligible;
    }

    /** When the smallest seed has grown to the largest radius that none feels (s). */
    double seeding_clock(const cases::Scene &scene, const std::vector<Seed> &seeds,
                         double smallest_radius, double largest_radius)
    {
      for(double radius = largest_radius;; radius *= smaller)
      {
        double clock = 0;
        for(const Seed &seed : seeds)
        {
          const double share
              = std::max(radius, smallest_radius) / seed.solution->front(1);
          clock = std::max(clock, share * share);
        }
        if(!felt(scene, seeds, clock))
          return clock;
        if(radius <= smallest_radius)
          throw cases::Refusal(fmt::format("rkpm-tracked cannot seed the front of a "
                                           "sink: walls or other sinks feel it "
                                           "before it has grown to {:.3g} m; take more "
                                           "nodes or give the initial front",
                                           smallest_radius));
      }
    }

    PlaneStart seeded_start(const cases::Scene &scene, double smallest_radius,
                            double largest_radius)
    {
      const double far = scene.initial.temperature({}, scene.start_time);
      std::vector<Seed> seeds;
      for(const cases::PointSource &source : scene.sources)
        seeds.push_back(
            {solution_of_strength(scene, far, -source.power(scene.start_time)),
             PlanePoint(source.position[0], source.position[1])});
      const double clock = seeding_clock(scene, seeds, smallest_radius, largest_radius);
      if(!(scene.start_time + clock < scene.end_time))
        throw cases::Refusal("rkpm-tracked: the front does not grow to the size of its "
                             "seed before the end; take more nodes along the side");
      PlaneStart start;
      start.time = scene.start_time + clock;
      cases::require_undisturbed(scene, far, start.time, method_name);
      start.description
          = fmt::format("similarity solution of each sink at {:.6g} s", start.time);
      start.level_set = [seeds, clock](const PlanePoint &point)
      {
        double least = std::numeric_limits<double>::infinity();
        for(const Seed &seed : seeds)
          least = std::min(least,
                           (point - seed.place).norm() - seed.solution->front(clock));
        return least;
      };
      start.temperature = [seeds, clock, far](const PlanePoint &point)
      {
        double result = far;
        for(const Seed &seed : seeds)
        {
          const double distance = std::max((point - seed.place).norm(), 1e-150);
          const double value = seed.solution->temperature(distance, clock);
          if(distance < seed.solution->front(clock))
            return value;
          result += value - far;
        }
        return result;
      };
      return start;
    }

    struct InitialPhases
    {
      bool solid = false, liquid = false, uniform = true;
    };

    InitialPhases initial_phases(const cases::Scene &scene)
    {
      InitialPhases result;
      const cases::Domain &domain = scene.domain;
      const double melting = scene.material.melting_temperature;
      const double first = scene.initial.temperature({}, scene.start_time);
      for(int i = 0; i < sample_lines; ++i)
        for(int j = 0; j < sample_lines; ++j)
        {
          PlanePoint place;
          for(int d = 0; d < 2; ++d)
          {
            const double low = domain.round() ? -domain.radius : domain.lower[d],
                         high = domain.round() ? domain.radius : domain.upper[d];
            place[d] = low + (high - low) * (d == 0 ? i : j) / (sample_lines - 1);
          }
          const bool outside
              = domain.outline ? !domain.outline->inside(position_of(place))
                : domain.round()
                    ? place.norm() > domain.radius || place.norm() < domain.inner_radius
                    : false;
          if(outside)
            continue;
          const double value
              = scene.initial.temperature(position_of(place), scene.start_time);
          (value < melting ? result.solid : result.liquid) = true;
          result.uniform = result.uniform && value == first;
        }
      return result;
    }
  } // namespace

  PlaneStart find_plane_start(const cases::Scene &scene, double smallest_seed,
                              double largest_seed)
  {
    const double time = scene.start_time;
    PlaneStart start;
    start.time = time;
    start.temperature = [&scene, time](const PlanePoint &point)
    { return scene.initial.temperature(position_of(point), time); };
    const auto &exact = scene.initial.exact;
    if(exact && exact->has_front() && time > exact->start_time())
    {
      start.description = "exact solution";
      const double sign = exact->solid_at_origin() ? 1 : -1;
      start.level_set = [&exact = *exact, time, sign](const PlanePoint &point)
      { return sign * exact.signed_distance(position_of(point), time); };
      return start;
    }
    if(scene.initial.front)
    {
      start.description = "the scene's level set";
      start.level_set = [&front = *scene.initial.front, time](const PlanePoint &point)
      { return front(position_of(point), time); };
      return start;
    }
    const InitialPhases initial = initial_phases(scene);
    if(initial.solid && initial.liquid)
    {
      const double melting = scene.material.melting_temperature;
      start.description = "where the initial temperature is the melting temperature";
      start.level_set
          = [temperature = start.temperature, melting](const PlanePoint &point)
      { return temperature(point) - melting; };
      return start;
    }
    const bool sinks = !scene.sources.empty()
                       && std::ranges::all_of(scene.sources, [&](const auto &source)
                                              { return source.power(time) < 0; });
    if(initial.solid || !initial.uniform || !sinks)
      throw cases::Refusal(
          "rkpm-tracked needs a front at the start: one phase fills the domain, and no "
          "line sink in a uniform liquid seeds one; give the initial front or an initial "
          "temperature that crosses the melting temperature");
    return seeded_start(scene, smallest_seed, largest_seed);
  }
} // namespace meltfront::particles::front_tracking
