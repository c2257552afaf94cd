#include <reference_fem/cut/start.h>

#include <cases/error.h>
#include <cases/exact/line_sink.h>
#include <cases/undisturbed.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace meltfront::reference_fem::cut
{
  namespace
  {
    /** Neighbours and walls must change a similarity solution by less than this part. */
    constexpr double negligible = 1e-6;

    constexpr int samples_across = 33;

    struct Seed
    {
      std::shared_ptr<const cases::LineSink> solution;
      Point place;
    };

    /** The solution around a sink that draws a given power (W/m), by bisection for its
     * front constant. */
    std::shared_ptr<const cases::LineSink> solution_of_strength(const cases::Scene &scene,
                                                                double far_temperature,
                                                                double strength)
    {
      double lower = 1e-4, upper = 5;
      for(int step = 0; step < 200 && upper - lower > 1e-16 * upper; ++step)
      {
        const double middle = std::sqrt(lower * upper);
        (cases::LineSink(scene.material, middle, far_temperature).strength() < strength
             ? lower
             : upper)
            = middle;
      }
      auto solution = std::make_shared<cases::LineSink>(
          scene.material, std::sqrt(lower * upper), far_temperature);
      if(std::abs(solution->strength() - strength) > 1e-9 * strength)
        throw cases::Refusal(fmt::format(
            "fem-cut: no similarity solution draws {:.6g} W/m: give the initial front "
            "(key `front` of the initial state)",
            strength));
      return solution;
    }

    /** The phases of the initial temperature. */
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
      for(int i = 0; i < samples_across; ++i)
        for(int j = 0; j < samples_across; ++j)
        {
          cases::Position p{};
          const std::array<int, 2> index{i, j};
          for(int d = 0; d < dim; ++d)
          {
            const double lower = domain.round() ? -domain.radius : domain.lower[d];
            const double upper = domain.round() ? domain.radius : domain.upper[d];
            p[d] = lower + (upper - lower) * index[d] / (samples_across - 1);
          }
          const double radius = std::hypot(p[0], p[1]);
          if(domain.round() && (radius > domain.radius || radius < domain.inner_radius))
            continue;
          const double temperature = scene.initial.temperature(p, scene.start_time);
          (temperature < melting ? result.solid : result.liquid) = true;
          result.uniform = result.uniform && temperature == first;
        }
      return result;
    }

    double distance_to_walls(const cases::Scene &scene, const Point &point)
    {
      const cases::Domain &domain = scene.domain;
      double least = std::numeric_limits<double>::infinity();
      for(const cases::Side side : scene.sides())
        if(!scene.boundary(side).exact)
        {
          const int number = static_cast<int>(side), d = number / 2;
          least = std::min(
              least, side == cases::Side::outer   ? domain.radius - point.norm()
                     : side == cases::Side::inner ? point.norm() - domain.inner_radius
                     : number % 2 == 1            ? domain.upper[d] - point[d]
                                                  : point[d] - domain.lower[d]);
        }
      return least;
    }

    /** Time after which the last of the fronts has grown to a radius. */
    double time_to_grow(const std::vector<Seed> &seeds, double radius)
    {
      double time = 0;
      for(const Seed &seed : seeds)
        time = std::max(time, std::pow(radius / seed.solution->front(1), 2));
      return time;
    }

    void require_independence(const cases::Scene &scene, const std::vector<Seed> &seeds,
                              double time)
    {
      const double diffusivity = scene.material.liquid.diffusivity();
      const auto felt = [&](double distance)
      { return std::exp(-distance * distance / (4 * diffusivity * time)) > negligible; };
      for(std::size_t i = 0; i < seeds.size(); ++i)
      {
        if(felt(distance_to_walls(scene, seeds[i].place)))
          throw cases::Refusal(
              "fem-cut cannot seed the front of a sink: the walls feel it "
              "before it has grown to the cells' size; take more cells "
              "or give the initial front");
        for(std::size_t j = 0; j < i; ++j)
          if(felt(seeds[i].place.distance(seeds[j].place) / 2))
            throw cases::Refusal("fem-cut cannot seed the fronts of the sinks: they feel "
                                 "each other before they have grown to the cells' size; "
                                 "take more cells or give the initial front");
      }
    }

    Start seeded_start(const cases::Scene &scene, double spacing, double seed_cells)
    {
      const double far = scene.initial.temperature({}, scene.start_time);
      std::vector<Seed> seeds;
      for(const cases::PointSource &source : scene.sources)
        seeds.push_back(
            {solution_of_strength(scene, far, -source.power(scene.start_time)),
             Point(source.position[0], source.position[1])});
      const double radius = seed_cells * spacing;
      const double clock = time_to_grow(seeds, radius);
      const double time = scene.start_time + clock;
      if(!(time < scene.end_time))
        throw cases::Refusal(fmt::format(
            "fem-cut: the front does not grow to a radius of {} cells before the end; "
            "take more cells along the side",
            seed_cells));
      require_independence(scene, seeds, clock);
      cases::require_undisturbed(scene, far, time, "fem-cut");
      const auto level_set = [seeds, clock](const Point &point)
      {
        double least = std::numeric_limits<double>::infinity();
        for(const Seed &seed : seeds)
          least
              = std::min(least, point.distance(seed.place) - seed.solution->front(clock));
        return least;
      };
      const auto temperature = [seeds, clock, far](const Point &point)
      {
        double result = far;
        for(const Seed &seed : seeds)
        {
          const double distance = std::max(point.distance(seed.place), 1e-150);
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
  } // namespace

  Start find_start(const cases::Scene &scene, double spacing, double seed_cells)
  {
    const double time = scene.start_time;
    const auto &exact = scene.initial.exact;
    Start start{time,
                {},
                [&scene, time](const Point &point)
                { return scene.initial.temperature(position(point), time); },
                ""};
    const bool solid_inside = exact && exact->solid_at_origin();
    if(exact && time > exact->start_time())
    {
      start.description = "exact solution";
      start.level_set = [&exact = *exact, time, solid_inside](const Point &point)
      {
        const double distance = exact.signed_distance(position(point), time);
        return solid_inside ? distance : -distance;
      };
      return start;
    }
    if(scene.initial.front)
    {
      start.description = "the scene's level set";
      start.level_set = [&front = *scene.initial.front, time](const Point &point)
      { return front(position(point), time); };
      return start;
    }
    const InitialPhases initial = initial_phases(scene);
    if(initial.solid && initial.liquid)
    {
      const double melting = scene.material.melting_temperature;
      start.description = "where the initial temperature is the melting temperature";
      start.level_set = [temperature = start.temperature, melting](const Point &point)
      { return temperature(point) - melting; };
      return start;
    }
    const bool sinks = !scene.sources.empty()
                       && std::ranges::all_of(scene.sources, [&](const auto &source)
                                              { return source.power(time) < 0; });
    if(initial.solid || !initial.uniform || !sinks)
      throw cases::Refusal("fem-cut needs a front at the start: one phase fills the "
                           "domain, and no line sink in a uniform liquid seeds one; give "
                           "the initial front or an initial temperature that crosses the "
                           "melting temperature");
    return seeded_start(scene, spacing, seed_cells);
  }
} // namespace meltfront::reference_fem::cut
