#include <cases/error.h>
#include <cases/method.h>
#include <particles/level_set/advection.h>
#include <particles/level_set/level_set_run.h>
#include <particles/level_set/reinitialisation.h>

#include <fmt/format.h>

namespace meltfront::particles::level_set
{
  namespace
  {
    constexpr int sampled_times = 17;

    void require_parameters(const TransportParameters &parameters)
    {
      if(!(parameters.end_time > 0) || !std::isfinite(parameters.end_time))
        throw cases::InputError(
            fmt::format("a front carried along until {} s: the time must be above zero",
                        parameters.end_time));
      if(!(parameters.courant_number > 0 && parameters.courant_number <= 1))
        throw cases::InputError(
            fmt::format("a front carried along with a Courant number of {}: it must be "
                        "above 0 and at most 1",
                        parameters.courant_number));
      if(parameters.reinitialise_every < 0 || parameters.iterations < 0)
        throw cases::InputError(fmt::format(
            "{} iterations of reinitialisation every {} steps: neither may be "
            "below zero",
            parameters.iterations, parameters.reinitialise_every));
      if(parameters.equal_parts < 1)
        throw cases::InputError(fmt::format(
            "a run in {} equal parts: at least 1 is needed", parameters.equal_parts));
    }

    /** Largest component of the velocity at the nodes of the grid at a time (m/s). */
    double largest_component(const Grid &grid, const cases::VelocityField &velocity,
                             const double time)
    {
      std::array<std::vector<double>, 3> points, components;
      cases::PointArrays places;
      std::array<std::span<double>, 3> results;
      for(int d = 0; d < grid.dimension(); ++d)
      {
        points[d].resize(grid.nodes(0));
        components[d].resize(grid.nodes(0));
        places[d] = points[d];
        results[d] = components[d];
      }
      double largest = 0;
      for(const Interval &row : whole_grid(grid))
      {
        for(int i = row.begin; i < row.end; ++i)
        {
          const Position point = grid.position({i, row.j, row.k});
          for(int d = 0; d < grid.dimension(); ++d)
            points[d][i] = point[d];
        }
        velocity.velocities(places, time, results);
        for(int d = 0; d < grid.dimension(); ++d)
          for(const double component : components[d])
          {
            if(!std::isfinite(component))
              throw cases::InputError(fmt::format(
                  "the velocity ({}) is {} somewhere at {} s: it must be a number",
                  velocity.description(), component, time));
            largest = std::max(largest, std::abs(component));
          }
      }
      return largest;
    }
  } // namespace

  StepCount count_steps(const Grid &grid, const cases::VelocityField &velocity,
                        const TransportParameters &parameters)
  {
    require_parameters(parameters);
    double largest = 0;
    for(int n = 0; n < sampled_times; ++n)
      largest = std::max(
          largest, largest_component(grid, velocity,
                                     parameters.end_time * n / (sampled_times - 1)));
    const double parts = double(parameters.equal_parts);
    // a step more for round-off alone would be a step of nothing
    const double per_part
        = std::ceil(parameters.end_time * largest
                        / (parameters.courant_number * grid.spacing()) / parts
                    - 1e-9);
    const double steps = parts * std::max(per_part, 1.);
    if(!(steps <= cases::most_steps))
      throw cases::InputError(
          fmt::format("the velocity ({}) would need {:.3g} steps: at most {:.0e} are "
                      "taken",
                      velocity.description(), steps, cases::most_steps));
    return {static_cast<long>(steps), parameters.end_time / steps};
  }

  TransportResult run_level_set(const Grid &grid, const ScalarFunction &initial,
                                const cases::VelocityField &velocity,
                                const TransportParameters &parameters,
                                const TransportCallback &callback)
  {
    const StepCount steps = count_steps(grid, velocity, parameters);
    TransportResult result{LevelSet(grid, initial, parameters.level_set), steps};
    const VelocityFunction at_nodes = velocity_function(velocity);
    Advection advection;
    Reinitialisation reinitialise;
    if(callback)
      callback({result.front, 0, 0});
    for(long step = 1; step <= steps.steps; ++step)
    {
      result.node_steps += double(result.front.band().size());
      advection.step(
          result.front, at_nodes,
          {step, parameters.end_time * (step - 1) / steps.steps, steps.length});
      if(parameters.reinitialise_every > 0 && step % parameters.reinitialise_every == 0)
        reinitialise(result.front, parameters.iterations);
      if(callback)
        callback({result.front, step, parameters.end_time * step / steps.steps});
    }
    return result;
  }
} // namespace meltfront::particles::level_set
