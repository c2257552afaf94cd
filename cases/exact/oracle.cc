#include <cases/error.h>
#include <cases/exact/check_material.h>
#include <cases/exact/front_fixing.h>
#include <cases/exact/oracle.h>
#include <cases/exact/radau.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::cases
{
  namespace
  {
    using spectral::FrontFixing;

    [[noreturn]] void
    reject(const std::string &reason)
    {
      throw InputError("spectral oracle: " + reason);
    }

    void
    check_wall(const OracleWall &wall, const std::string &which)
    {
      if(wall.kind == BoundaryKind::periodic)
        reject("the " + which + " wall cannot be periodic");
      if(wall.kind != BoundaryKind::insulated && !wall.value)
        reject("the " + which + " wall needs a value");
    }

    void
    check_start(const OracleProblem &problem)
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

    void
    check_problem(const OracleProblem &problem)
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

    /** The run with a fixed number of Chebyshev intervals. */
    struct Integration
    {
      Integration(const OracleProblem &problem, int intervals)
          : system(problem, intervals), intervals(intervals)
      {
        spectral::StiffProblem stiff;
        stiff.name = "spectral oracle";
        stiff.rate = [this](double time, const Eigen::VectorXd &state,
                            Eigen::VectorXd &rate) { system.rate(time, state, rate); };
        stiff.scale
            = [this](const Eigen::VectorXd &state) { return system.scale(state); };
        stiff.admissible
            = [this](const Eigen::VectorXd &state) { return system.admissible(state); };
        stiff.observe = [this](long step, double time, const Eigen::VectorXd &state)
        {
          system.check(step, time, state);
          defect = std::max(defect, system.resolution_defect(time, state));
        };
        trajectory = spectral::RadauIntegrator(7).integrate(
            stiff, system.initial_state(), problem.start_time, problem.end_time,
            problem.tolerance);
      }

      FrontFixing system;
      int intervals;
      double defect = 0;
      spectral::Trajectory trajectory;
    };

    std::unique_ptr<const Integration>
    integrate(const OracleProblem &problem)
    {
      if(problem.nodes > 0)
        return std::make_unique<Integration>(problem, problem.nodes);
      const int most_intervals = 140;
      const double wanted = std::max(1e-13, 0.1 * problem.tolerance);
      double defect = 0;
      for(int intervals = 12; intervals <= most_intervals; intervals += intervals / 2)
      {
        auto result = std::make_unique<Integration>(problem, intervals);
        if(result->defect <= wanted)
          return result;
        defect = result->defect;
      }
      throw NumericalError(
          "spectral oracle", 0, problem.start_time, "the profile",
          fmt::format(
              "is not resolved by {} Chebyshev intervals (last coefficients {:.1e}): "
              "initial and wall values must be smooth and agree",
              most_intervals, defect));
    }
  } // namespace

  class SpectralOracle::Run
  {
  public:
    explicit Run(const OracleProblem &problem)
        : problem(problem), integration(integrate(problem))
    {
    }

    /** The solution to start from where it answers for this time, else null. */
    const ExactSolution *
    before(double time) const
    {
      return problem.start && time < problem.start_time ? problem.start.get() : nullptr;
    }

    FrontFixing::Profile
    profile(double time) const
    {
      const double slack = 1e-9 * (problem.end_time - problem.start_time);
      if(!(time >= problem.start_time - slack && time <= problem.end_time + slack))
        throw InputError(fmt::format("spectral oracle: time {} is outside {} ... {}",
                                     time, problem.start_time, problem.end_time));
      return integration->system.profile(time, integration->trajectory.state(time));
    }

    OracleProblem problem;
    std::unique_ptr<const Integration> integration;
  };

  SpectralOracle::SpectralOracle(const OracleProblem &problem)
  {
    check_problem(problem);
    run = std::make_unique<Run>(problem);
  }

  SpectralOracle::~SpectralOracle() = default;

  std::string
  SpectralOracle::description() const
  {
    return fmt::format(
        "spectral front-fixing solution on {:.6g} ... {:.6g} m, {} Chebyshev "
        "intervals per phase, {} steps{}",
        run->problem.inner, run->problem.outer, nodes(), steps(),
        run->problem.start ? ", started from: " + run->problem.start->description() : "");
  }

  Symmetry
  SpectralOracle::symmetry() const
  {
    return run->problem.symmetry;
  }

  double
  SpectralOracle::start_time() const
  {
    return run->problem.start ? run->problem.start->start_time()
                              : run->problem.start_time;
  }

  double
  SpectralOracle::end_time() const
  {
    return run->problem.end_time;
  }

  bool
  SpectralOracle::solid_at_origin() const
  {
    return run->problem.solid_at_origin;
  }

  double
  SpectralOracle::front(double time) const
  {
    const ExactSolution *earlier = run->before(time);
    return earlier ? earlier->front(time) : run->profile(time).front;
  }

  double
  SpectralOracle::temperature(double coordinate, double time) const
  {
    if(const ExactSolution *earlier = run->before(time))
      return earlier->temperature(coordinate, time);
    return run->integration->system.temperature(run->profile(time), coordinate);
  }

  double
  SpectralOracle::heat_content(double lower, double upper, double time) const
  {
    if(const ExactSolution *earlier = run->before(time))
      return earlier->heat_content(lower, upper, time);
    return run->integration->system.heat_content(run->profile(time), lower, upper);
  }

  int
  SpectralOracle::nodes() const
  {
    return run->integration->intervals;
  }

  long
  SpectralOracle::steps() const
  {
    return run->integration->trajectory.steps();
  }

  double
  SpectralOracle::resolution_defect() const
  {
    return run->integration->defect;
  }
} // namespace meltfront::cases
