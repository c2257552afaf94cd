#include <cases/error.h>
#include <cases/exact/check_material.h>
#include <cases/exact/one_phase_start.h>
#include <cases/exact/onset_layer.h>
#include <cases/wall_law.h>

#include <boost/math/tools/toms748_solve.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace meltfront::cases
{
  namespace
  {
    const char *const name = "spectral oracle";

    /** One phase at one temperature, which nothing disturbs. */
    class UniformPhase : public LayeredSolution
    {
    public:
      UniformPhase(const OracleProblem &problem, double temperature)
        : problem(problem)
        , uniform(temperature)
      {
      }

      std::string description() const override
      {
        return fmt::format("one phase at {:.12g}", uniform);
      }

      Symmetry symmetry() const override
      {
        return problem.symmetry;
      }

      double start_time() const override
      {
        return problem.start_time;
      }

      bool solid_at_origin() const override
      {
        return problem.solid_at_origin;
      }

      double inner() const override
      {
        return problem.inner;
      }

      double outer() const override
      {
        return problem.outer;
      }

      std::vector<double> fronts(double) const override
      {
        return {};
      }

      using ExactSolution::temperature;
      double temperature(double, double) const override
      {
        return uniform;
      }

      double heat_content(double lower, double upper, double) const override
      {
        const Material &material = problem.material;
        const double excess = uniform - material.melting_temperature;
        return (problem.solid_at_origin
                    ? material.solid.volumetric_heat_capacity() * excess
                    : material.liquid.volumetric_heat_capacity() * excess
                          + material.liquid.density * material.latent_heat)
               * volume_between(symmetry(), lower, upper);
      }

    private:
      OracleProblem problem;
      double uniform;
    };

    /** Builds the solution one stage after the other. */
    class Stages
    {
    public:
      explicit Stages(const OracleProblem &problem)
        : problem(problem)
        , sign(problem.solid_at_origin ? -1 : 1)
        , melting(problem.material.melting_temperature)
        , reached(problem.start_time)
      {
        const bool centre = problem.symmetry != Symmetry::planar && problem.inner == 0;
        for(const bool at_inner : {true, false})
          if(!(at_inner && centre) && wall(at_inner).kind != BoundaryKind::insulated)
            waiting.push_back(at_inner);
        const PhaseProperties &phase
            = sign > 0 ? problem.material.liquid : problem.material.solid;
        const double length = problem.outer - problem.inner;
        // Longer than any layer from a wall is used.
        window = 2e-3 * length * length / phase.diffusivity();
      }

      std::shared_ptr<const LayeredSolution> solve()
      {
        if(const std::optional<double> temperature = uniform_temperature())
          set_off(*temperature);
        while(true)
        {
          const auto run = advance();
          const std::optional<Passing> first = first_passing(*run);
          if(!first)
            return run;
          add_layer(first->at_inner,
                    wall(first->at_inner).kind == BoundaryKind::fixed_temperature
                        ? Onset::at_melting
                        : Onset::by_wall_law,
                    first->time, run, window);
          waiting.erase(std::ranges::find(waiting, first->at_inner));
          if(reached >= problem.end_time)
            return current;
        }
      }

    private:
      const OracleWall &wall(bool at_inner) const
      {
        return at_inner ? problem.inner_wall : problem.outer_wall;
      }

      std::optional<double> uniform_temperature() const
      {
        const double first = problem.initial_temperature(problem.inner);
        const int samples = 64;
        for(int i = 1; i <= samples; ++i)
          if(problem.initial_temperature(std::lerp(problem.inner, problem.outer,
                                                   static_cast<double>(i) / samples))
             != first)
            return {};
        return first;
      }

      /** How far a held wall is beyond the melting temperature, or whither its law drives
       * a phase at it: positive where the other phase grows. */
      double drive(const OracleWall &w, double time) const
      {
        const double given = w.value(time);
        return sign
               * (w.kind == BoundaryKind::fixed_temperature
                      ? melting - given
                      : -heat_through(w.law(), given, melting).flux);
      }

      /** From a uniform temperature walls set off at once. */
      void set_off(double temperature)
      {
        current = std::make_shared<UniformPhase>(problem, temperature);
        const bool at_melting = temperature == melting;
        const std::vector<bool> walls = waiting;
        double end = problem.end_time;
        waiting.clear();
        for(const bool at_inner : walls)
        {
          const OracleWall &w = wall(at_inner);
          const bool held = w.kind == BoundaryKind::fixed_temperature;
          // Just after the start: a ramp begins at the melting temperature.
          const double soon = problem.start_time + 1e-6 * window;
          Onset onset = Onset::wall_layer;
          if(held && drive(w, problem.start_time) > 0)
            onset = Onset::jump;
          else if(at_melting && drive(w, soon) > 0)
            onset = Onset::at_melting;
          else
          {
            if(at_melting)
              throw InputError(fmt::format(
                  "{}: a phase at the melting temperature has to be frozen or melted by "
                  "each of its walls from the start on or be insulated",
                  name));
            waiting.push_back(at_inner);
          }
          const double longest = std::min(window, end - problem.start_time);
          add_layer(at_inner, onset, problem.start_time, current, longest);
          end = reached;
        }
      }

      void add_layer(bool at_inner, Onset onset, double time,
                     const std::shared_ptr<const LayeredSolution> &before, double longest)
      {
        const auto layer = std::make_shared<OnsetLayer>(OnsetProblem{
            onset, before, problem.material, at_inner, wall(at_inner), time, longest});
        current = layer;
        reached = layer->end_time();
      }

      /** From where the stages have come to. */
      std::shared_ptr<const SpectralOracle> advance() const
      {
        OracleProblem next = problem;
        next.start_time = reached;
        if(current)
        {
          next.start = current;
          next.solid_at_origin = current->solid_at_origin();
          const bool at_melting = problem.initial_temperature(problem.inner) == melting
                                  && uniform_temperature().has_value();
          (sign > 0 ? next.liquid_at_melting : next.solid_at_melting) = at_melting;
        }
        if(!waiting.empty())
        {
          next.longest_beyond = window;
          next.end_time += window;
        }
        return std::make_shared<SpectralOracle>(next);
      }

      struct Passing
      {
        bool at_inner;
        double time;
      };

      /** When the first of the walls that wait passes the melting temperature. */
      std::optional<Passing> first_passing(const SpectralOracle &run) const
      {
        std::optional<Passing> first;
        const double end = std::min(run.end_time(), problem.end_time);
        for(const bool at_inner : waiting)
        {
          const double coordinate = at_inner ? problem.inner : problem.outer;
          const auto excess = [&](double time)
          { return sign * (run.temperature(coordinate, time) - melting); };
          const int samples = 4096;
          double before = problem.start_time;
          for(int i = 1; i <= samples; ++i)
          {
            const double time
                = std::lerp(problem.start_time, end, static_cast<double>(i) / samples);
            if(excess(time) < 0)
            {
              std::uintmax_t iterations = 200;
              const auto bracket = boost::math::tools::toms748_solve(
                  excess, before, time, boost::math::tools::eps_tolerance<double>(),
                  iterations);
              if(!first || bracket.first < first->time)
                first = Passing{at_inner, bracket.first};
              break;
            }
            before = time;
          }
        }
        return first;
      }

      OracleProblem problem;
      double sign; ///< of freezing: 1, of melting: -1
      double melting;
      double reached; ///< what `current` is known until
      double window = 0;
      std::vector<bool> waiting; ///< walls, inner or outer, that have no front yet
      std::shared_ptr<const LayeredSolution> current;
    };
  } // namespace

  std::shared_ptr<const LayeredSolution>
  solve_from_one_phase(const OracleProblem &problem)
  {
    check_material(problem.material, name);
    require_equal_densities(problem.material, name);
    if(problem.start || !problem.initial_fronts.empty() || !problem.initial_temperature)
      throw InputError(fmt::format("{}: one phase starts from a temperature profile, "
                                   "without a front",
                                   name));
    if(!(problem.start_time < problem.end_time))
      throw InputError(fmt::format("{}: the end time ({}) must lie after the start time "
                                   "({})",
                                   name, problem.end_time, problem.start_time));
    return Stages(problem).solve();
  }
} // namespace meltfront::cases
