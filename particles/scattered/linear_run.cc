#include <cases/error.h>
#include <cases/overshoot.h>
#include <cases/step_ends.h>
#include <cases/time_integral.h>
#include <particles/scattered/linear_choices.h>
#include <particles/scattered/linear_growth.h>
#include <particles/scattered/linear_run.h>
#include <particles/scattered/node_set.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meltfront::particles
{
  namespace
  {
    constexpr double singular = 1e-13;

    /** Fewer steps are not taken by default, however short the run. */
    constexpr long fewest_steps = 10;
  } // namespace

  LinearRun::LinearRun(const cases::Scene &scene, const cases::EffectSet &effects,
                       std::unique_ptr<PosedProblem> posed_problem,
                       const cases::Resolution &resolution)
    : scene(scene)
    , effects(effects)
    , posed(std::move(posed_problem))
    , problem(posed->linear())
    , sites(posed->sites())
    , description(posed->description())
    , n(problem.operator_rows.rows())
    , options(cases::read_options(LinearOptions(), resolution.options))
    , threads(resolution.threads)
    , bounds(cases::temperature_bounds(scene))
    , breakpoints(cases::breakpoints_of(scene))
    , unknowns(n)
    , load(n)
    , source(n)
    , solid_fraction(n, 0.)
  {
    solver_parameters.method = options.linear_solver;
    solver_parameters.tolerance = options.solver_tolerance;
    solver_parameters.symmetric = problem.symmetric;
    solver_parameters.dimension = sites.dimension;
    steps = linear_steps(options, resolution.n);
    if(options.steps == 0)
      steps = std::min(
          steps, std::max(fewest_steps, most_monotone_steps(scene, problem, sites)));
    if(!problem.reconstruction.columns.empty())
      temperature.resize(n);
    if(steady())
    {
      steps = 1;
      solver.emplace(
          make_solver(sum_of(-1, problem.operator_rows, 0, problem.operator_rows), 1));
      if(scene.inclusion)
        require_steady_rows(scene, problem, solver_parameters, description.method);
      return;
    }
    if(options.steps == 0)
      follow_walls(resolution.n);
    length = (scene.end_time - scene.start_time) / double(steps);
    start();
    solver.emplace(make_solver(system(length), 0));
    if(scene.inclusion)
      require_stable_steps(problem, *solver, rate_of(length), steps, description.method);
  }

  /** Steps that walls call for, but that rows with a mass of neighbours do not take, are
   * refused. */
  void LinearRun::follow_walls(int cells)
  {
    const double wanted = std::ceil((scene.end_time - scene.start_time)
                                    / cases::longest_step_of_walls(scene, cells));
    if(wanted <= double(steps))
      return;
    if(wanted > double(most_monotone_steps(scene, problem, sites)))
      throw cases::Refusal(fmt::format(
          "{} would need {:.0f} steps to follow the temperatures of the walls, and steps "
          "so short break the maximum principle with nodes so far apart; take more of "
          "them",
          description.method, wanted));
    steps = static_cast<long>(wanted);
  }

  bool LinearRun::steady() const
  {
    return scene.problem == cases::ProblemKind::poisson;
  }

  void LinearRun::take_steps()
  {
    if(steady())
    {
      problem.source(steady_step(scene.end_time), load);
      solve(*solver, 1, scene.end_time);
      reached(1, scene.end_time);
      return;
    }
    reached(0, scene.start_time);
    for(long k = 1; k <= steps; ++k)
    {
      const double end
          = k == steps ? scene.end_time : scene.start_time + double(k) * length;
      advance(*solver, k, end, length);
      check(k, end);
      reached(k, end);
    }
  }

  void LinearRun::start()
  {
    for(std::size_t i = 0; i < n; ++i)
      load[i] = scene.initial.temperature(position(i), scene.start_time);
    if(problem.reconstruction.columns.empty())
      unknowns = load;
    else
    {
      LinearSolverParameters parameters = solver_parameters;
      parameters.symmetric = false;
      LinearSolver solver(problem.reconstruction, parameters);
      if(!solver.solve(load, unknowns).converged)
        throw cases::NumericalError(description.method, 0, scene.start_time,
                                    "initial temperature",
                                    "cannot be reconstructed: the matrix of the shape "
                                    "functions is singular");
    }
    initial_heat = stored_heat();
  }

  cases::Position LinearRun::position(std::size_t site) const
  {
    cases::Position p{};
    for(int d = 0; d < sites.dimension; ++d)
      p[d] = sites.positions[d][site];
    return p;
  }

  CompressedRows LinearRun::system(double length) const
  {
    return sum_of(rate_of(length), problem.mass, -1, problem.operator_rows);
  }

  LinearSolver LinearRun::make_solver(const CompressedRows &matrix, long at_step)
  {
    LinearSolver solver(matrix, solver_parameters);
    matrix_entries = static_cast<long>(matrix.size());
    entries_per_solve = static_cast<long>(solver.fill() * double(matrix.size()));
    work += entries_per_solve;
    if(solver.reciprocal_condition() < singular)
      throw cases::NumericalError(
          description.method, at_step, scene.start_time, "matrix",
          fmt::format("is singular to round-off: UMFPACK estimates its reciprocal "
                      "condition number as {:.2g}",
                      solver.reciprocal_condition()));
    return solver;
  }

  void LinearRun::solve(LinearSolver &solver, long at_step, double time)
  {
    const LinearSolver::Outcome outcome = solver.solve(load, unknowns);
    iterations += outcome.iterations;
    most_iterations = std::max<long>(most_iterations, outcome.iterations);
    worst_residual = std::max(worst_residual, outcome.residual);
    work += std::max(1, outcome.iterations) * (entries_per_solve + matrix_entries);
    if(!outcome.converged)
      throw cases::NumericalError(
          description.method, at_step, time, "linear system",
          fmt::format("was not solved by {}: after {} iterations the residual is "
                      "{:.2g} of the right-hand side",
                      linear_method_names()[std::size_t(solver.method())],
                      outcome.iterations, outcome.residual));
  }

  std::span<const double> LinearRun::temperatures()
  {
    if(temperature.empty())
      return unknowns;
    problem.reconstruction.multiply(unknowns, temperature, threads);
    return temperature;
  }

  double LinearRun::stored_heat()
  {
    const cases::Material &material = scene.material;
    const std::span<const double> found = temperatures();
    double sum = 0;
    for(std::size_t i = 0; i < n; ++i)
      sum += sites.weights[i] * (found[i] - material.melting_temperature);
    return sum * material.solid.volumetric_heat_capacity();
  }

  bool LinearRun::obeys_maximum_principle() const
  {
    return description.obeys_maximum_principle
           && (steady() || options.time_scheme == LinearScheme::backward_euler);
  }

  void LinearRun::check(long k, double time)
  {
    const std::span<const double> found = temperatures();
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    bool finite = true;
    for(const double value : found)
    {
      finite = finite && std::isfinite(value);
      lowest = std::min(lowest, value);
      highest = std::max(highest, value);
    }
    if(!finite)
      lowest = std::numeric_limits<double>::quiet_NaN();
    try
    {
      cases::check_temperature(bounds, lowest, highest, description.method, k, time,
                               obeys_maximum_principle()
                                   ? cases::overshoot_of_round_off
                                   : cases::allowed_overshoot(description.overshoot,
                                                              description.run.spacing,
                                                              scene.domain));
    }
    catch(const cases::NumericalError &)
    {
      // Rows of random nodes may hold what grows by itself, as those about an inclusion.
      if(!steady())
        require_stable_steps(problem, *solver, rate_of(length), steps,
                             description.method);
      throw;
    }
  }

  LinearSites sites_of(const NodeSet &nodes, int dimension,
                       std::span<const double> weights)
  {
    LinearSites sites{dimension, {}, weights};
    for(int d = 0; d < dimension; ++d)
      sites.positions[d] = nodes.positions.position[d];
    return sites;
  }

  std::unique_ptr<cases::Run> make_linear_run(const cases::Scene &scene,
                                              const cases::EffectSet &effects,
                                              std::unique_ptr<PosedProblem> posed,
                                              const cases::Resolution &resolution)
  {
    return std::make_unique<LinearRun>(scene, effects, std::move(posed), resolution);
  }
} // namespace meltfront::particles
