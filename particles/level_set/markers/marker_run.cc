#include <cases/error.h>
#include <particles/level_set/markers/marker_run.h>
#include <particles/level_set/reinitialisation.h>

#include <fmt/format.h>

namespace meltfront::particles::level_set
{
  namespace
  {
    class Run
    {
    public:
      Run(const Grid &grid, const ScalarFunction &initial,
          const cases::VelocityField &velocity, const MarkerRunParameters &parameters,
          const MarkerCallback &callback)
        : parameters(parameters)
        , velocity(velocity)
        , at_nodes(velocity_function(velocity))
        , callback(callback)
        , steps(count_steps(grid, velocity, parameters.transport))
        , front(grid, displaced(grid, initial), parameters.transport.level_set)
        , scheme(grid, parameters.markers, "level set with markers")
      {
        scheme.seed(initial);
      }

      MarkerResult operator()()
      {
        tell(0, 0);
        if(at_rest())
          rest();
        else
          for(long step = 1; step <= steps.steps; ++step)
            take_step(step);
        return {std::move(front), scheme.markers(), steps, node_steps, scheme.work()};
      }

    private:
      ScalarFunction displaced(const Grid &grid, const ScalarFunction &initial) const
      {
        Position offset{};
        for(int d = 0; d < grid.dimension(); ++d)
        {
          offset[d] = parameters.grid_offset[d] * grid.spacing();
          if(!std::isfinite(offset[d]))
            throw cases::InputError(fmt::format(
                "the grid's front is to lie off by {} spacings: it must be a number",
                parameters.grid_offset[d]));
        }
        return [initial, offset](const Position &p) {
          return initial({p[0] - offset[0], p[1] - offset[1], p[2] - offset[2]});
        };
      }

      double time_of(long step) const
      {
        return parameters.transport.end_time * static_cast<double>(step)
               / static_cast<double>(steps.steps);
      }

      /** Whether nothing moves near the front, whenever one looks. */
      bool at_rest()
      {
        constexpr int times = 17;
        for(int n = 0; n < times; ++n)
          if(std::isfinite(advection.longest_step(
                 front, at_nodes, parameters.transport.end_time * n / (times - 1))))
            return false;
        return true;
      }

      void take_step(long number)
      {
        const TimeStep step{number, time_of(number - 1), steps.length};
        node_steps += static_cast<double>(front.band().size());
        advection.step(front, at_nodes, step);
        scheme.move(velocity, step);
        if(scheme.corrects_at(number))
          scheme.correct(front);
        const TransportParameters &transport = parameters.transport;
        if(transport.reinitialise_every > 0 && number % transport.reinitialise_every == 0)
        {
          reinitialise(front, transport.iterations);
          scheme.refresh(front);
        }
        if(scheme.reseeds_at(number))
          scheme.reseed(front);
        tell(number, time_of(number));
      }

      void rest()
      {
        if(parameters.steps_at_rest < 1 || parameters.iterations_at_rest < 0)
          throw cases::InputError(fmt::format(
              "{} steps at rest and {} iterations after them: at least 1 step is needed, "
              "and iterations must not be below zero",
              parameters.steps_at_rest, parameters.iterations_at_rest));
        steps = {parameters.steps_at_rest,
                 parameters.transport.end_time
                     / static_cast<double>(parameters.steps_at_rest)};
        for(long step = 1; step <= steps.steps; ++step)
        {
          node_steps += static_cast<double>(front.band().size());
          scheme.correct(front);
          front.rebuild_band();
          if(step == steps.steps)
          {
            reinitialise(front, parameters.iterations_at_rest);
            scheme.correct(front);
          }
          tell(step, time_of(step));
        }
      }

      void tell(long step, double time) const
      {
        if(callback)
          callback({front, scheme.markers(), step, time, scheme.work()});
      }

      const MarkerRunParameters &parameters;
      const cases::VelocityField &velocity;
      const VelocityFunction at_nodes;
      const MarkerCallback &callback;
      StepCount steps;
      LevelSet front;
      MarkerScheme scheme;
      Advection advection;
      Reinitialisation reinitialise;
      double node_steps = 0;
    };
  } // namespace

  MarkerResult run_markers(const Grid &grid, const ScalarFunction &initial,
                           const cases::VelocityField &velocity,
                           const MarkerRunParameters &parameters,
                           const MarkerCallback &callback)
  {
    return Run(grid, initial, velocity, parameters, callback)();
  }
} // namespace meltfront::particles::level_set
