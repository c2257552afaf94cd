#include <cases/error.h>
#include <cases/exact/check_material.h>
#include <cases/exact/front_fixing.h>
#include <cases/exact/oracle.h>
#include <cases/exact/radau.h>

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace meltfront::cases
{
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

    void check_start(const OracleProblem &problem)
    {
      if(!problem.start && !problem.initial_temperature)
        reject("needs an exact solution or a temperature profile to start from");
      if(problem.start
         && (problem.start->symmetry() != problem.symmetry
             || problem.start->solid_at_origin() != problem.solid_at_origin))
        reject("the solution to start from has another symmetry or holds the other phase "
               "at the origin");
      const double front = problem.start ? problem.start->front(problem.start_time)
                                         : problem.initial_front;
      if(!(front > problem.inner && front < problem.outer))
        reject(fmt::format("the front must start inside {} ... {}, not at {}",
                           problem.inner, problem.outer, front));
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
      if(!problem.one_phase)
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

    using Defect = FrontFixing::Defect;

    /** Thrown out of a run that turns out to need more nodes. */
    struct Unresolved
    {
      Defect defect;
    };

    /** The run with fixed numbers of Chebyshev intervals. */
    struct Integration
    {
      /** @throws Unresolved as soon as a defect exceeds what is allowed. */
      Integration(const OracleProblem &problem, int near_intervals, int far_intervals,
                  double allowed_defect)
        : system(problem, near_intervals, far_intervals)
        , near_intervals(near_intervals)
        , far_intervals(far_intervals)
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
          const Defect now = system.resolution_defect(time, state);
          defect = std::max({defect, now.near, now.far});
          if(defect > allowed_defect)
            throw Unresolved{now};
          system.check(step, time, state);
        };
        trajectory = spectral::RadauIntegrator(7).integrate(
            stiff, system.initial_state(), problem.start_time, problem.end_time,
            problem.tolerance);
      }

      FrontFixing system;
      int near_intervals, far_intervals;
      double defect = 0; ///< the largest over the run
      spectral::Trajectory trajectory;
    };

    using Result = std::unique_ptr<Integration>;

    const double any_defect = std::numeric_limits<double>::infinity();

    /**
     * More nodes in each phase until the last coefficients are at round-off; null where
     * they fall too slowly for that, because the data are not smooth or do not agree.
     */
    Result integrate_resolved(const OracleProblem &problem, double allowed)
    {
      const int most_intervals = 160, enough_to_judge = 60;
      int near = 12, far = 12;
      double last_defect = any_defect;
      while(std::max(near, far) <= most_intervals)
        try
        {
          return std::make_unique<Integration>(problem, near, far, allowed);
        }
        catch(const Unresolved &unresolved)
        {
          const double defect = std::max(unresolved.defect.near, unresolved.defect.far);
          if(std::max(near, far) > enough_to_judge && defect > 0.3 * last_defect)
            return nullptr;
          last_defect = defect;
          if(unresolved.defect.near > allowed)
            near += near / 3;
          if(unresolved.defect.far > allowed)
            far += far / 3;
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
        const auto front = [&](const Integration &run)
        { return run.system.profile(time, run.trajectory.state(time)).front; };
        difference = std::max(difference, std::abs(front(a) - front(b)));
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
          auto next
              = std::make_unique<Integration>(problem, intervals, intervals, hopeless);
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
        return std::make_unique<Integration>(problem, problem.nodes, problem.nodes,
                                             any_defect);
      Result result
          = integrate_resolved(problem, std::max(1e-13, 0.1 * problem.tolerance));
      return result ? std::move(result) : integrate_by_comparison(problem);
    }
  } // namespace

  class SpectralOracle::Run
  {
  public:
    explicit Run(const OracleProblem &problem)
      : problem(problem)
      , integration(integrate(problem))
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
      const double slack = 1e-9 * (problem.end_time - problem.start_time);
      if(!(time >= problem.start_time - slack && time <= problem.end_time + slack))
        throw InputError(fmt::format("spectral oracle: time {} is outside {} ... {}",
                                     time, problem.start_time, problem.end_time));
      last = std::make_shared<const FrontFixing::Profile>(
          integration->system.profile(time, integration->trajectory.state(time)));
      latest.store(last);
      return last;
    }

    OracleProblem problem;
    std::unique_ptr<const Integration> integration;

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
        "spectral front-fixing solution on {:.6g} ... {:.6g} m, {} + {} "
        "Chebyshev intervals, {} steps{}",
        run->problem.inner, run->problem.outer, near_nodes(), far_nodes(), steps(),
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
    return run->problem.end_time;
  }

  bool SpectralOracle::solid_at_origin() const
  {
    return run->problem.solid_at_origin;
  }

  double SpectralOracle::front(double time) const
  {
    const ExactSolution *earlier = run->before(time);
    return earlier ? earlier->front(time) : run->profile(time)->front;
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

  int SpectralOracle::near_nodes() const
  {
    return run->integration->near_intervals;
  }

  int SpectralOracle::far_nodes() const
  {
    return run->integration->far_intervals;
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
