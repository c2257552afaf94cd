#include <cases/error.h>
#include <cases/exact/check_material.h>
#include <cases/exact/front_fixing.h>
#include <cases/exact/oracle.h>
#include <cases/exact/radau.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace meltfront::cases
{
  Boundary OracleWall::law() const
  {
    Boundary boundary;
    boundary.kind = kind;
    boundary.heat_transfer_coefficient = heat_transfer_coefficient;
    boundary.emission_coefficient = emission_coefficient;
    boundary.absolute_zero = absolute_zero;
    return boundary;
  }

  namespace
  {
    using spectral::FrontFixing;

    [[noreturn]] void reject(const std::string &reason)
    {
      throw InputError("spectral oracle: " + reason);
    }

    void check_wall(const OracleWall &wall, const std::string &which)
    {
      if(wall.kind == BoundaryKind::periodic)
        reject("the " + which + " wall cannot be periodic");
      if(wall.kind != BoundaryKind::insulated && !wall.value)
        reject("the " + which + " wall needs a value");
    }

    std::vector<double> starting_fronts(const OracleProblem &problem)
    {
      return problem.start ? fronts_of(*problem.start, problem.start_time)
                           : problem.initial_fronts;
    }

    void check_start(const OracleProblem &problem)
    {
      if(!problem.start && !problem.initial_temperature)
        reject("needs an exact solution or a temperature profile to start from");
      if(problem.start
         && (problem.start->symmetry() != problem.symmetry
             || problem.start->solid_at_origin() != problem.solid_at_origin))
        reject("the solution to start from has another symmetry or holds the other phase "
               "at the origin");
      double last = problem.inner;
      for(const double front : starting_fronts(problem))
      {
        if(!(front > last && front < problem.outer))
          reject(
              fmt::format("the fronts must start inside {} ... {} one after the other, "
                          "not at {}",
                          problem.inner, problem.outer, front));
        last = front;
      }
    }

    void check_problem(const OracleProblem &problem)
    {
      check_material(problem.material, "spectral oracle");
      if(problem.symmetry == Symmetry::none)
        reject("needs a planar, cylindrical or spherical symmetry");
      if(!(problem.inner < problem.outer)
         || (problem.symmetry != Symmetry::planar && problem.inner < 0))
        reject(fmt::format("the domain {} ... {} is empty or reaches across the axis",
                           problem.inner, problem.outer));
      if(!(problem.start_time < problem.end_time))
        reject(fmt::format("the end time ({}) must lie after the start time ({})",
                           problem.end_time, problem.start_time));
      const bool centre = problem.symmetry != Symmetry::planar && problem.inner == 0;
      if(!centre)
        check_wall(problem.inner_wall, "inner");
      check_wall(problem.outer_wall, "outer");
      if(problem.line_sink != 0
         && !(centre && problem.symmetry == Symmetry::cylindrical
              && problem.solid_at_origin))
        reject("a line sink needs a cylindrical problem with solid on its axis");
      if(problem.nodes < 0 || (problem.nodes > 0 && problem.nodes < 4))
        reject("needs at least 4 Chebyshev intervals");
      if(!(problem.tolerance >= 1e-14 && problem.tolerance <= 1e-2))
        reject("the tolerance must lie between 1e-14 and 1e-2");
      check_start(problem);
    }

    const double any_defect = std::numeric_limits<double>::infinity();

    double largest(const std::vector<double> &values)
    {
      return *std::ranges::max_element(values);
    }

    /** Thrown out of a run that turns out to need more nodes: the defect by phase. */
    struct Unresolved
    {
      std::vector<double> defects;
    };

    /** The run with fixed numbers of Chebyshev intervals. */
    struct Integration
    {
      /** @throws Unresolved as soon as a defect exceeds what is allowed. */
      Integration(const OracleProblem &problem, const std::vector<int> &intervals,
                  double allowed_defect)
        : system(problem, intervals)
        , intervals(intervals)
      {
        spectral::StiffProblem stiff;
        stiff.name = "spectral oracle";
        stiff.rate = [this](double time, const Eigen::VectorXd &state,
                            Eigen::VectorXd &rate) { system.rate(time, state, rate); };
        stiff.scale
            = [this](const Eigen::VectorXd &state) { return system.scale(state); };
        stiff.admissible
            = [this](const Eigen::VectorXd &state) { return system.admissible(state); };
        stiff.observe = [&](long step, double time, const Eigen::VectorXd &state)
        {
          const std::vector<double> now = system.resolution_defects(time, state);
          defect = std::max(defect, largest(now));
          if(defect > allowed_defect)
            throw Unresolved{now};
          system.check(step, time, state);
        };
        if(std::isfinite(problem.longest_beyond))
          stiff.finished = [&, beyond_since = any_defect](
                               double time, const Eigen::VectorXd &state) mutable
          {
            if(system.beyond_at_walls(time, state) > 0)
              beyond_since = std::min(beyond_since, time);
            return time >= beyond_since + problem.longest_beyond;
          };
        trajectory = spectral::RadauIntegrator(7).integrate(
            stiff, system.initial_state(), problem.start_time, problem.end_time,
            problem.tolerance);
      }

      FrontFixing system;
      std::vector<int> intervals; ///< by phase
      double defect = 0;          ///< the largest over the run
      spectral::Trajectory trajectory;
    };

    using Result = std::unique_ptr<Integration>;

    /**
     * More nodes in each phase until the last coefficients are at round-off; null where
     * they fall too slowly for that, because the data are not smooth or do not agree.
     */
    Result integrate_resolved(const OracleProblem &problem, double allowed)
    {
      const int most_intervals = 160, enough_to_judge = 60;
      std::vector<int> intervals(starting_fronts(problem).size() + 1, 12);
      double last_defect = any_defect;
      while(*std::ranges::max_element(intervals) <= most_intervals)
        try
        {
          return std::make_unique<Integration>(problem, intervals, allowed);
        }
        catch(const Unresolved &unresolved)
        {
          const double defect = largest(unresolved.defects);
          if(*std::ranges::max_element(intervals) > enough_to_judge
             && defect > 0.3 * last_defect)
            return nullptr;
          last_defect = defect;
          for(std::size_t p = 0; p < intervals.size(); ++p)
            if(unresolved.defects[p] > allowed)
              intervals[p] += intervals[p] / 3;
        }
      return nullptr;
    }

    /** Largest difference of two runs' fronts, relative to the domain. */
    double front_difference(const OracleProblem &problem, const Integration &a,
                            const Integration &b)
    {
      const int samples = 64;
      double difference = 0;
      for(int i = 1; i <= samples; ++i)
      {
        const double time = std::lerp(problem.start_time, problem.end_time,
                                      static_cast<double>(i) / samples);
        const auto edges = [&](const Integration &run)
        { return run.system.profile(time, run.trajectory.state(time)).edges; };
        const std::vector<double> of_a = edges(a), of_b = edges(b);
        for(std::size_t i = 0; i < of_a.size(); ++i)
          difference = std::max(difference, std::abs(of_a[i] - of_b[i]));
      }
      return difference / (problem.outer - problem.inner);
    }

    /**
     * More nodes until the front no longer moves: for data that do not quite agree at the
     * start, which leave a layer that no polynomial resolves for a moment.
     */
    Result integrate_by_comparison(const OracleProblem &problem)
    {
      const int most_intervals = 125;
      const double hopeless = 1e-3;
      Result last;
      double difference = any_defect;
      for(int intervals = 24; intervals <= most_intervals; intervals += intervals / 2)
        try
        {
          auto next = std::make_unique<Integration>(
              problem, std::vector<int>(starting_fronts(problem).size() + 1, intervals),
              hopeless);
          if(last)
            difference = front_difference(problem, *last, *next);
          last = std::move(next);
          last->defect = difference;
          if(difference <= 10 * problem.tolerance)
            return last;
        }
        catch(const Unresolved &)
        {
          last = nullptr;
        }
      throw NumericalError(
          "spectral oracle", 0, problem.start_time, "the front",
          std::isfinite(difference)
              ? fmt::format("still moves by {:.1e} of the domain from one set of "
                            "Chebyshev nodes to the next: the data are too steep or not "
                            "smooth enough",
                            difference)
              : fmt::format("cannot be computed: {} Chebyshev intervals do not resolve "
                            "the profile",
                            most_intervals));
    }

    Result integrate(const OracleProblem &problem)
    {
      if(problem.nodes > 0)
        return std::make_unique<Integration>(
            problem, std::vector<int>(starting_fronts(problem).size() + 1, problem.nodes),
            any_defect);
      Result result
          = integrate_resolved(problem, std::max(1e-13, 0.1 * problem.tolerance));
      if(!result && starting_fronts(problem).empty())
        throw NumericalError("spectral oracle", 0, problem.start_time, "the temperature",
                             "of the one phase is too steep or not smooth enough");
      return result ? std::move(result) : integrate_by_comparison(problem);
    }
  } // namespace

  class SpectralOracle::Run
  {
  public:
    explicit Run(const OracleProblem &problem)
      : problem(problem)
      , integration(integrate(problem))
      , end_time(std::isfinite(problem.longest_beyond) ? integration->trajectory.end()
                                                       : problem.end_time)
    {
    }

    /** The solution to start from where it answers for this time, else null. */
    const ExactSolution *before(double time) const
    {
      return problem.start && time < problem.start_time ? problem.start.get() : nullptr;
    }

    /** The profile at a time; the last one asked for is kept, for the many points of a
     * snapshot. Safe from several threads. */
    std::shared_ptr<const FrontFixing::Profile> profile(double time) const
    {
      std::shared_ptr<const FrontFixing::Profile> last = latest.load();
      if(last && last->time == time)
        return last;
      const double slack = 1e-9 * (end_time - problem.start_time);
      if(!(time >= problem.start_time - slack && time <= end_time + slack))
        throw InputError(fmt::format("spectral oracle: time {} is outside {} ... {}",
                                     time, problem.start_time, end_time));
      last = std::make_shared<const FrontFixing::Profile>(
          integration->system.profile(time, integration->trajectory.state(time)));
      latest.store(last);
      return last;
    }

    OracleProblem problem;
    std::unique_ptr<const Integration> integration;
    double end_time;

  private:
    mutable std::atomic<std::shared_ptr<const FrontFixing::Profile>> latest;
  };

  SpectralOracle::SpectralOracle(const OracleProblem &problem)
  {
    check_problem(problem);
    run = std::make_unique<Run>(problem);
  }

  SpectralOracle::~SpectralOracle() = default;

  std::string SpectralOracle::description() const
  {
    return fmt::format(
        "spectral front-fixing solution on {:.6g} ... {:.6g} m, {} Chebyshev intervals, "
        "{} steps{}",
        run->problem.inner, run->problem.outer, fmt::join(nodes(), " + "), steps(),
        run->problem.start ? ", started from: " + run->problem.start->description() : "");
  }

  Symmetry SpectralOracle::symmetry() const
  {
    return run->problem.symmetry;
  }

  double SpectralOracle::start_time() const
  {
    return run->problem.start ? run->problem.start->start_time()
                              : run->problem.start_time;
  }

  double SpectralOracle::end_time() const
  {
    return run->end_time;
  }

  bool SpectralOracle::solid_at_origin() const
  {
    return run->problem.solid_at_origin;
  }

  double SpectralOracle::inner() const
  {
    return run->problem.inner;
  }

  double SpectralOracle::outer() const
  {
    return run->problem.outer;
  }

  std::vector<double> SpectralOracle::fronts(double time) const
  {
    if(const ExactSolution *earlier = run->before(time))
      return fronts_of(*earlier, time);
    const auto profile = run->profile(time);
    return {profile->edges.begin() + 1, profile->edges.end() - 1};
  }

  double SpectralOracle::temperature(double coordinate, double time) const
  {
    if(const ExactSolution *earlier = run->before(time))
      return earlier->temperature(coordinate, time);
    return run->integration->system.temperature(*run->profile(time), coordinate);
  }

  double SpectralOracle::heat_content(double lower, double upper, double time) const
  {
    if(const ExactSolution *earlier = run->before(time))
      return earlier->heat_content(lower, upper, time);
    return run->integration->system.heat_content(*run->profile(time), lower, upper);
  }

  const std::vector<int> &SpectralOracle::nodes() const
  {
    return run->integration->intervals;
  }

  long SpectralOracle::steps() const
  {
    return run->integration->trajectory.steps();
  }

  double SpectralOracle::resolution_defect() const
  {
    return run->integration->defect;
  }
} // namespace meltfront::cases
