#include <cases/error.h>
#include <cases/overshoot.h>
#include <cases/stopwatch.h>
#include <cases/time_integral.h>
#include <particles/scattered/linear_choices.h>
#include <particles/scattered/linear_growth.h>
#include <particles/scattered/linear_problem.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace meltfront::particles
{
  namespace
  {
    constexpr double singular = 1e-13;

    /** Fewer steps are not taken by default, however short the run. */
    constexpr long fewest_steps = 10;

    /** One run: the matrices, the unknowns, and their advance in time. */
    class LinearRun
    {
    public:
      LinearRun(const cases::Scene &scene, const LinearProblem &problem,
                const LinearSites &sites, const LinearDescription &description,
                const cases::Resolution &resolution)
        : scene(scene)
        , problem(problem)
        , sites(sites)
        , description(description)
        , n(problem.operator_rows.rows())
        , scheme(choice<LinearScheme>(linear_scheme_names(),
                                      resolution.options.get_string("time_scheme")))
        , threads(resolution.threads)
        , bounds(cases::temperature_bounds(scene))
        , breakpoints(cases::breakpoints_of(scene))
        , unknowns(n)
        , load(n)
        , source(n)
        , solid_fraction(n, 0.)
      {
        const cases::Options &options = resolution.options;
        solver_parameters.method = choice<LinearMethod>(
            linear_method_names(), options.get_string("linear_solver"));
        solver_parameters.tolerance = options.get_double("solver_tolerance");
        solver_parameters.symmetric = problem.symmetric;
        solver_parameters.dimension = sites.dimension;
        steps = linear_steps(resolution);
        if(options.get_integer("steps") == 0)
          steps = std::min(
              steps, std::max(fewest_steps, most_monotone_steps(scene, problem, sites)));
        if(!problem.reconstruction.columns.empty())
          temperature.resize(n);
      }

      cases::Cost run(cases::Observer &observer)
      {
        cases::Stopwatch watch;
        if(scene.problem == cases::ProblemKind::poisson)
          return solve_steady(observer, watch);
        return step(observer, watch);
      }

    private:
      cases::Cost solve_steady(cases::Observer &observer, cases::Stopwatch &watch)
      {
        steps = 1;
        LinearSolver solver
            = make_solver(sum_of(-1, problem.operator_rows, 0, problem.operator_rows), 1);
        if(scene.inclusion)
          require_steady_rows(scene, problem, solver_parameters, description.method);
        const cases::Stopwatch::Seconds setup = watch.elapsed();
        problem.source(steady_step(scene.end_time), load);
        solve(solver, 1, scene.end_time);
        const cases::Stopwatch::Seconds total = watch.elapsed();
        observer.begin(describe(solver, 0));
        observe(observer, 1, scene.end_time);
        return cost(setup, {total.wall - setup.wall, total.cpu - setup.cpu});
      }

      cases::Cost step(cases::Observer &observer, cases::Stopwatch &watch)
      {
        const double length = (scene.end_time - scene.start_time) / double(steps);
        start();
        LinearSolver solver = make_solver(system(length), 0);
        if(scene.inclusion)
          require_stable_steps(problem, solver, rate_of(length), steps,
                               description.method);
        const cases::Stopwatch::Seconds setup = watch.elapsed();
        observer.begin(describe(solver, length));
        observe(observer, 0, scene.start_time);
        cases::Stopwatch stepping;
        for(long k = 1; k <= steps; ++k)
        {
          const double end
              = k == steps ? scene.end_time : scene.start_time + double(k) * length;
          advance(solver, k, end, length);
          check(k, end);
          if(observer.wants(k, end) || k == steps)
            stepping.without([&] { observe(observer, k, end); });
        }
        return cost(setup, stepping.elapsed());
      }

      /** The unknowns whose temperatures are the initial ones. */
      void start()
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
            throw cases::NumericalError(
                description.method, 0, scene.start_time, "initial temperature",
                "cannot be reconstructed: the matrix of the shape "
                "functions is singular");
        }
        initial_heat = stored_heat();
      }

      cases::Position position(std::size_t site) const
      {
        cases::Position p{};
        for(int d = 0; d < sites.dimension; ++d)
          p[d] = sites.positions[d][site];
        return p;
      }

      /** The matrix of a step; Crank-Nicolson's is that of backward Euler over half of
       * it, times two where time does not count (walls). */
      CompressedRows system(double length) const
      {
        return sum_of(rate_of(length), problem.mass, -1, problem.operator_rows);
      }

      double rate_of(double length) const
      {
        return scheme == LinearScheme::backward_euler   ? 1 / length
               : scheme == LinearScheme::crank_nicolson ? 2 / length
                                                        : 1.5 / length;
      }

      LinearSolver make_solver(const CompressedRows &matrix, long at_step)
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

      void solve(LinearSolver &solver, long at_step, double time)
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

      void advance(LinearSolver &solver, long k, double end, double length)
      {
        const bool anew = k == 1 || looks_back_over_breakpoint(end, length);
        if(scheme == LinearScheme::bdf2 && anew)
        {
          start_bdf2(k, end, length);
          return;
        }
        if(scheme == LinearScheme::crank_nicolson)
        {
          // Two half steps of backward Euler damp what a jump excites (Rannacher 1984);
          // their matrix is the same.
          if(anew)
            for(const double time : {end - length / 2, end})
              take_euler_step(solver, k, time, length / 2);
          else
            take_crank_nicolson_step(solver, k, end, length);
          return;
        }
        if(scheme == LinearScheme::backward_euler)
          take_euler_step(solver, k, end, length);
        else
          take_bdf2_step(solver, k, end, length);
      }

      /** Whether what the scene prescribes jumps or bends in a step or the one before: a
       * formula that continues the means of both would overshoot by half of the jump. */
      bool looks_back_over_breakpoint(double end, double length) const
      {
        const auto next = std::ranges::upper_bound(breakpoints, end - 2 * length);
        return next != breakpoints.end() && *next < end;
      }

      /** The step to a time; the schemes of second order know the one before. */
      LinearStep step_to(double end, double length, bool knows_before) const
      {
        const double begin = end - length;
        return {knows_before ? begin - length : begin, begin, end,
                knows_before && scheme == LinearScheme::bdf2 ? 0.5 : 0., end};
      }

      /** load = factor * mass * vector + source. */
      void set_load(double factor, std::span<const double> vector, const LinearStep &step)
      {
        problem.source(step, source);
        problem.mass.multiply(vector, load, threads);
        for(std::size_t i = 0; i < n; ++i)
          load[i] = factor * load[i] + source[i];
        work += static_cast<long>(problem.mass.size());
      }

      void take_euler_step(LinearSolver &solver, long k, double time, double length)
      {
        const LinearStep step = step_to(time, length, false);
        set_load(1 / length, unknowns, step);
        solve(solver, k, time);
        book(step, length, 1);
      }

      void take_crank_nicolson_step(LinearSolver &solver, long k, double end,
                                    double length)
      {
        const LinearStep step = step_to(end, length, true);
        LinearStep at_begin = step;
        at_begin.at = step.begin;
        book(at_begin, length, 0.5);
        previous.resize(n);
        problem.operator_rows.multiply(unknowns, previous, threads);
        work += static_cast<long>(problem.operator_rows.size());
        problem.source(at_begin, source);
        for(std::size_t i = 0; i < n; ++i)
          previous[i] = algebraic(i) ? 0 : previous[i] + source[i];
        set_load(2 / length, unknowns, step);
        for(std::size_t i = 0; i < n; ++i)
          load[i] += previous[i];
        solve(solver, k, end);
        book(step, length, 0.5);
      }

      /** A step of backward Euler, with a matrix of its own. */
      void start_bdf2(long k, double end, double length)
      {
        if(!starting)
          starting.emplace(make_solver(
              sum_of(1 / length, problem.mass, -1, problem.operator_rows), k));
        before = unknowns;
        booked_before = booked;
        take_euler_step(*starting, k, end, length);
        if(breakpoints.empty())
          starting.reset();
      }

      void take_bdf2_step(LinearSolver &solver, long k, double end, double length)
      {
        previous.resize(n);
        for(std::size_t i = 0; i < n; ++i)
          previous[i] = 2 * unknowns[i] - 0.5 * before[i];
        before = unknowns;
        const LinearStep step = step_to(end, length, true);
        set_load(1 / length, previous, step);
        solve(solver, k, end);
        // What has flowed in obeys the recursion of what is stored.
        const cases::HeatBudget last = booked;
        booked.boundary = (4 * last.boundary - booked_before.boundary) / 3;
        booked.sources = (4 * last.sources - booked_before.sources) / 3;
        booked_before = last;
        book(step, length, 2. / 3);
      }

      bool algebraic(std::size_t row) const
      {
        return problem.mass.offsets[row] == problem.mass.offsets[row + 1];
      }

      void book(const LinearStep &step, double length, double share)
      {
        if(!problem.inflow)
          return;
        const HeatInflow inflow = problem.inflow(step, unknowns);
        booked.boundary += share * length * inflow.through_walls;
        booked.sources += share * length * inflow.released;
      }

      std::span<const double> temperatures()
      {
        if(temperature.empty())
          return unknowns;
        problem.reconstruction.multiply(unknowns, temperature, threads);
        return temperature;
      }

      double stored_heat()
      {
        const cases::Material &material = scene.material;
        const std::span<const double> found = temperatures();
        double sum = 0;
        for(std::size_t i = 0; i < n; ++i)
          sum += sites.weights[i] * (found[i] - material.melting_temperature);
        return sum * material.solid.volumetric_heat_capacity();
      }

      /** Backward Euler alone keeps the principle whatever the step. */
      bool obeys_maximum_principle() const
      {
        return description.obeys_maximum_principle
               && (scene.problem == cases::ProblemKind::poisson
                   || scheme == LinearScheme::backward_euler);
      }

      void check(long k, double time)
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
        cases::check_temperature(bounds, lowest, highest, description.method, k, time,
                                 obeys_maximum_principle()
                                     ? cases::overshoot_of_round_off
                                     : cases::allowed_overshoot(description.overshoot,
                                                                description.run.spacing,
                                                                scene.domain));
      }

      void observe(cases::Observer &observer, long k, double time)
      {
        cases::Snapshot snapshot;
        snapshot.step = k;
        snapshot.time = time;
        snapshot.dimension = sites.dimension;
        snapshot.positions = sites.positions;
        snapshot.weights = sites.weights;
        snapshot.temperature = temperatures();
        snapshot.solid_fraction = solid_fraction;
        snapshot.obeys_maximum_principle = obeys_maximum_principle();
        snapshot.heat.booked = static_cast<bool>(problem.inflow);
        if(snapshot.heat.booked && scene.problem == cases::ProblemKind::poisson)
        {
          // Without release the walls' sum is round-off, with nothing to relate it to.
          const HeatInflow inflow = problem.inflow(steady_step(time), unknowns);
          snapshot.heat.booked = inflow.released != 0;
          snapshot.heat.boundary = inflow.through_walls;
          snapshot.heat.sources = inflow.released;
        }
        else if(snapshot.heat.booked)
        {
          snapshot.heat = booked;
          snapshot.heat.stored = stored_heat();
          snapshot.heat.initial = initial_heat;
        }
        observer.observe(snapshot);
      }

      cases::RunDescription describe(const LinearSolver &solver, double length) const
      {
        cases::RunDescription result = description.run;
        result.time_step = length;
        result.unknowns = static_cast<long>(n);
        result.parameters.push_back(
            {"linear solver", linear_method_names()[std::size_t(solver.method())], ""});
        result.parameters.push_back(
            {"entries per row",
             fmt::format("{:.4g}", double(problem.operator_rows.size()) / double(n)),
             "1"});
        result.parameters.push_back({"entries of factors or preconditioner over those "
                                     "of the matrix",
                                     fmt::format("{:.3g}", solver.fill()), "1"});
        if(std::isfinite(solver.reciprocal_condition()))
          result.parameters.push_back(
              {"reciprocal condition of the matrix (UMFPACK)",
               fmt::format("{:.2g}", solver.reciprocal_condition()), "1"});
        if(length > 0)
          result.parameters.push_back(
              {"time scheme", linear_scheme_names()[std::size_t(scheme)], ""});
        else
        {
          result.parameters.push_back(
              {"iterations of the linear solver", std::to_string(iterations), "1"});
          result.parameters.push_back(
              {"residual", fmt::format("{:.1e}", worst_residual), "1"});
        }
        return result;
      }

      cases::Cost cost(const cases::Stopwatch::Seconds &setup,
                       const cases::Stopwatch::Seconds &stepping) const
      {
        cases::Cost result;
        result.setup_wall = description.setup_wall + setup.wall;
        result.setup_cpu = description.setup_cpu + setup.cpu;
        result.stepping_wall = stepping.wall;
        result.stepping_cpu = stepping.cpu;
        result.steps = steps;
        result.unknowns = static_cast<long>(n);
        result.work = description.setup_work + work;
        result.solver_iterations = iterations;
        result.most_iterations = most_iterations;
        result.effects = description.effects;
        return result;
      }

      const cases::Scene &scene;
      const LinearProblem &problem;
      const LinearSites &sites;
      const LinearDescription &description;
      std::size_t n;
      LinearScheme scheme;
      int threads;
      cases::TemperatureBounds bounds;
      std::vector<double> breakpoints;      ///< ascending (s)
      std::optional<LinearSolver> starting; ///< of backward Euler, where BDF2 begins
      LinearSolverParameters solver_parameters;
      long steps = 0;
      std::vector<double> unknowns, before, previous, load, source;
      std::vector<double> temperature; ///< where the unknowns are not them
      std::vector<double> solid_fraction;
      double initial_heat = 0;
      cases::HeatBudget booked, booked_before; ///< boundary and sources
      long work = 0, iterations = 0, most_iterations = 0;
      long matrix_entries = 0, entries_per_solve = 0;
      double worst_residual = 0;
    };
  } // namespace

  cases::Cost run_linear_problem(const cases::Scene &scene, const LinearProblem &problem,
                                 const LinearSites &sites,
                                 const LinearDescription &description,
                                 const cases::Resolution &resolution,
                                 cases::Observer &observer)
  {
    return LinearRun(scene, problem, sites, description, resolution).run(observer);
  }
} // namespace meltfront::particles
