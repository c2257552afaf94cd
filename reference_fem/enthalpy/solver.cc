#include <cases/error.h>
#include <reference_fem/enthalpy/heat_sources.h>
#include <reference_fem/enthalpy/initial_state.h>
#include <reference_fem/enthalpy/linear_solver.h>
#include <reference_fem/enthalpy/mesh.h>
#include <reference_fem/enthalpy/solver.h>
#include <reference_fem/enthalpy/stopwatch.h>
#include <reference_fem/enthalpy/time_scheme.h>
#include <reference_fem/enthalpy/truncated_newton.h>
#include <reference_fem/enthalpy/wall_flux.h>
#include <reference_fem/enthalpy/wall_temperature.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace meltfront::reference_fem
{
  namespace
  {
    using cases::Effect;

    constexpr const char *method_name = "fem-enthalpy";

    /** Iterations grow with the cells that the front crosses in a step: beyond these the
     * next step is halved. */
    constexpr int comfortable_iterations = 30;

    /** Coarse runs take more steps than the cells call for, so that their fronts can be
     * compared at 50 times at least. */
    constexpr long fewest_steps = 50;

    /** Below this share of the nominal step a step that does not converge stops the run.
     */
    constexpr double smallest_step = 1e-4;

    /** Without an M-matrix the scheme itself passes the bounds of the maximum principle
     * by a few per cent of their span at most; with one, by round-off. */
    constexpr double slack_without_maximum_principle = 0.05;

    int choose_dimension(const cases::Scene &scene, const cases::Options &options)
    {
      const std::vector<int> possible = mesh_dimensions(scene);
      const int wanted = static_cast<int>(options.get_integer("dimension"));
      if(wanted == 0)
        return possible.front();
      if(std::find(possible.begin(), possible.end(), wanted) == possible.end())
        throw cases::Refusal(
            fmt::format("fem-enthalpy simulates this scene in {} dimensions, not in {}",
                        fmt::join(possible, " or "), wanted));
      return wanted;
    }

    long choose_steps(const cases::Options &options, int n)
    {
      const long steps = options.get_integer("steps");
      if(steps > 0)
        return steps;
      return std::max(fewest_steps,
                      std::lround(options.get_double("steps_per_cell") * n));
    }

    Preconditioner choose_preconditioner(const cases::Options &options)
    {
      const std::string &word = options.get_string("preconditioner");
      return word == "ssor"  ? Preconditioner::ssor
             : word == "amg" ? Preconditioner::amg
                             : Preconditioner::automatic;
    }

    /** Sum of volume times enthalpy, in extended precision: a balance to 1e-13 over many
     * nodes must not end in the sum's own round-off. */
    template <typename Value>
    double sum_over(const std::vector<double> &volume, const Value &value)
    {
      long double sum = 0;
      for(std::size_t i = 0; i < volume.size(); ++i)
        sum += static_cast<long double>(volume[i]) * value(i);
      return static_cast<double>(sum);
    }

    /** A run: the state and the parts that the scene's effects call for. */
    class EnthalpyRun
    {
    public:
      EnthalpyRun(const cases::Scene &scene, const cases::EffectSet &effects,
                  const cases::Resolution &resolution);

      cases::Cost run(cases::Observer &observer, StepStatistics &statistics);

    private:
      /** What a quantity that is summed over time was at the last two times. */
      struct History
      {
        double now = 0, before = 0;
      };

      cases::RunDescription description() const;
      std::string mesh_in_words() const;
      StepFormula formula(double next) const;
      void predict(double next);
      StepOutcome attempt(const StepFormula &step);
      void accept(const StepFormula &step, StepStatistics &statistics);
      void require_halvable(const StepFormula &step, const StepOutcome &outcome) const;
      void check_temperatures() const;
      void check_balance(StepStatistics &statistics);
      double source_heat() const;
      void report(cases::Observer &observer, bool always);
      void observe(cases::Observer &observer);
      std::vector<cases::EffectCost> effect_costs() const;

      const cases::Scene &scene;
      const cases::EffectSet &effects;
      const cases::Resolution &resolution;
      Stopwatch watch;
      bool bdf2;
      long nominal_steps;
      int iteration_limit;

      Discretization mesh;
      std::vector<char> free;
      std::unique_ptr<NonlinearSolver> solver;
      std::string linear_solver_in_words;
      std::optional<HeatSources> sources;
      std::optional<WallTemperature> walls;
      std::optional<WallFlux> flux;
      cases::TemperatureBounds bounds;
      double slack = 1e-9;

      CompensatedVector u, u_accepted, u_before;     ///< by node, W/m
      std::vector<double> enthalpy, enthalpy_before; ///< by node, J/m^3
      std::vector<double> rhs, heat;                 ///< by node, J
      History boundary_heat;
      double step_flux_heat = 0; ///< what the flux walls bring in the step under way
      double initial_heat = 0;
      double defect = 0; ///< heat at hand less heat received (J)
      double time, time_before;
      long step_number = 0;
      std::vector<double> site_temperature, site_solid_fraction;
    };

    EnthalpyRun::EnthalpyRun(const cases::Scene &scene, const cases::EffectSet &effects,
                             const cases::Resolution &resolution)
      : scene(scene)
      , effects(effects)
      , resolution(resolution)
      , bdf2(resolution.options.get_string("time_scheme") == "bdf2")
      , nominal_steps(choose_steps(resolution.options, resolution.n))
      , iteration_limit(
            static_cast<int>(resolution.options.get_integer("iteration_limit")))
      , bounds(cases::temperature_bounds(scene))
      , time(scene.start_time)
      , time_before(scene.start_time)
    {
      const int dimension = choose_dimension(scene, resolution.options);
      const std::unique_ptr<Mesh> geometry = make_mesh(scene, dimension, resolution.n);
      mesh = geometry->discretize();
      if(!mesh.conduction.is_monotone())
        slack = slack_without_maximum_principle;
      const std::size_t n = mesh.volume.size();
      free.assign(n, 1);
      if(effects.contains(Effect::heat_sources))
        sources.emplace(scene, *geometry, mesh);
      if(effects.contains(Effect::wall_flux))
        flux.emplace(scene, mesh);
      if(effects.contains(Effect::wall_temperature))
        walls.emplace(scene, mesh).mark(free);

      auto linear_solver
          = dimension == 1 ? make_tridiagonal_solver(mesh.conduction)
                           : make_krylov_solver(mesh.conduction,
                                                choose_preconditioner(resolution.options),
                                                resolution.threads);
      linear_solver_in_words = linear_solver->description();
      solver = make_nonlinear_solver({mesh.conduction, mesh.volume, free}, scene.material,
                                     effects, std::move(linear_solver));
      enthalpy = initial_enthalpy(scene, *geometry, mesh, free);
      enthalpy_before = enthalpy;
      u = CompensatedVector(n);
      for(std::size_t i = 0; i < n; ++i)
        u.set(i, solver->kirchhoff(solver->temperature_excess_at_enthalpy(enthalpy[i])));
      rhs.resize(n);
      heat.resize(n);
      initial_heat = sum_over(mesh.volume, [&](std::size_t i) { return enthalpy[i]; });
    }

    std::string EnthalpyRun::mesh_in_words() const
    {
      const char *shape
          = mesh.measure == cases::Symmetry::cylindrical     ? "radial, weight 2 pi r"
            : mesh.measure == cases::Symmetry::spherical     ? "radial, weight 4 pi r^2"
            : scene.domain.shape == cases::DomainShape::ball ? "unstructured"
                                                             : "Cartesian";
      return fmt::format("{} cells, {} nodes, {}D, {}",
                         mesh.cells.size() >> mesh.dimension, mesh.volume.size(),
                         mesh.dimension, shape);
    }

    cases::RunDescription EnthalpyRun::description() const
    {
      cases::RunDescription result;
      result.dimension = mesh.dimension;
      result.spacing = mesh.spacing;
      result.time_step = (scene.end_time - scene.start_time) / nominal_steps;
      result.unknowns = std::count(free.begin(), free.end(), 1);
      result.parameters = {
          {"elements", "linear, lumped mass, exact enthalpy graph", ""},
          {"mesh", mesh_in_words(), ""},
          {"time scheme", bdf2 ? "BDF2, first step backward Euler" : "backward Euler",
           ""},
          {"time step", fmt::format("{:.6g}", result.time_step), "s"},
          {"nonlinear solver", "truncated nonsmooth Newton with Gauss-Seidel sweeps", ""},
          {"iteration limit", fmt::format("{}", iteration_limit), "1"},
          {"linear solver", linear_solver_in_words, ""},
          {"graph consistency required",
           fmt::format("{:g}", NonlinearSolver::accepted_inconsistency), "1"},
          {"heat balance required", fmt::format("{:g}", accepted_balance_defect), "1"},
          {"tolerance of the maximum principle", fmt::format("{:g}", slack), "1"}};
      return result;
    }

    StepFormula EnthalpyRun::formula(double next) const
    {
      return bdf2 && step_number > 0 ? bdf2_step(time_before, time, next)
                                     : backward_euler_step(time, next);
    }

    /** First guess: the last change goes on. Halves the iterations of long steps. */
    void EnthalpyRun::predict(double next)
    {
      if(step_number == 0)
        return;
      const double ratio = (next - time) / (time - time_before);
      for(std::size_t i = 0; i < u.size(); ++i)
        u.add(i, ratio * (u_accepted[i] - u_before[i]));
    }

    StepOutcome EnthalpyRun::attempt(const StepFormula &step)
    {
      for(std::size_t i = 0; i < rhs.size(); ++i)
        rhs[i] = mesh.volume[i] * step.combine(enthalpy[i], enthalpy_before[i]);
      if(sources)
        sources->add_load(step, rhs);
      step_flux_heat = flux ? flux->add_load(step, rhs) : 0;
      predict(step.next);
      if(walls)
        walls->prescribe(step.next, *solver, u);
      return solver->solve(step.c, rhs, iteration_limit, u, heat);
    }

    void EnthalpyRun::accept(const StepFormula &step, StepStatistics &statistics)
    {
      enthalpy_before.swap(enthalpy);
      for(std::size_t i = 0; i < enthalpy.size(); ++i)
        enthalpy[i] = free[i] ? heat[i] / mesh.volume[i] : enthalpy_before[i];
      double entered = step_flux_heat;
      if(walls)
        entered += walls->react(step, {mesh.conduction, mesh.volume, free},
                                scene.material, u, rhs, enthalpy);
      const double boundary_now
          = step.combine(boundary_heat.now, boundary_heat.before) + entered;
      boundary_heat = {boundary_now, boundary_heat.now};
      time_before = time;
      time = step.next;
      ++step_number;
      check_temperatures();
      check_balance(statistics);
    }

    void EnthalpyRun::check_temperatures() const
    {
      double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
      for(std::size_t i = 0; i < enthalpy.size(); ++i)
      {
        const double excess = solver->temperature_excess_at_enthalpy(enthalpy[i]);
        if(!std::isfinite(excess))
          throw cases::NumericalError(method_name, step_number, time, "temperature",
                                      "is not finite");
        lowest = std::min(lowest, excess);
        highest = std::max(highest, excess);
      }
      const double melting = scene.material.melting_temperature;
      cases::check_temperature(bounds, melting + lowest, melting + highest, method_name,
                               step_number, time, slack);
    }

    double EnthalpyRun::source_heat() const
    {
      return sources ? sources->energy(time) : 0;
    }

    void EnthalpyRun::check_balance(StepStatistics &statistics)
    {
      const double total
          = sum_over(mesh.volume, [&](std::size_t i) { return enthalpy[i]; });
      const double magnitude
          = sum_over(mesh.volume, [&](std::size_t i) { return std::abs(enthalpy[i]); });
      const double received = boundary_heat.now + source_heat();
      const double defect_before = defect;
      defect = total - initial_heat - received;
      const double scale = std::max({magnitude, std::abs(boundary_heat.now),
                                     std::abs(source_heat()), std::abs(initial_heat)});
      const double relative = scale > 0 ? std::abs(defect - defect_before) / scale : 0;
      statistics.balance_defect = std::max(statistics.balance_defect, relative);
      if(!(relative <= accepted_balance_defect))
        throw cases::NumericalError(
            method_name, step_number, time, "heat balance",
            fmt::format("is off by {:.3g} of the heat at hand, more than {:g}", relative,
                        accepted_balance_defect));
    }

    void EnthalpyRun::observe(cases::Observer &observer)
    {
      const cases::Material &material = scene.material;
      const double density = material.solid.density;
      const std::size_t n_sites = mesh.node_of_site.size();
      site_temperature.resize(n_sites);
      site_solid_fraction.resize(n_sites);
      for(std::size_t site = 0; site < n_sites; ++site)
      {
        const double specific = enthalpy[mesh.node_of_site[site]] / density;
        site_temperature[site] = material.temperature(specific);
        site_solid_fraction[site] = material.solid_fraction(specific);
      }
      cases::Snapshot snapshot;
      snapshot.step = step_number;
      snapshot.time = time;
      snapshot.dimension = mesh.dimension;
      for(int d = 0; d < mesh.dimension; ++d)
        snapshot.positions[d] = mesh.site_positions[d];
      snapshot.weights = mesh.site_weights;
      snapshot.temperature = site_temperature;
      snapshot.solid_fraction = site_solid_fraction;
      snapshot.cells = mesh.cells;
      snapshot.heat.latent = sum_over(
          mesh.volume, [&](std::size_t i)
          { return std::clamp(enthalpy[i], 0., density * material.latent_heat); });
      snapshot.heat.stored = sum_over(
          mesh.volume,
          [&](std::size_t i) {
            return enthalpy[i]
                   - std::clamp(enthalpy[i], 0., density * material.latent_heat);
          });
      snapshot.heat.boundary = boundary_heat.now;
      snapshot.heat.sources = source_heat();
      snapshot.heat.initial = initial_heat;
      observer.observe(snapshot);
    }

    void EnthalpyRun::report(cases::Observer &observer, bool always)
    {
      watch.without(
          [&]
          {
            if(observer.wants(step_number, time) || always)
              observe(observer);
          });
    }

    std::vector<cases::EffectCost> EnthalpyRun::effect_costs() const
    {
      const NonlinearSolver::GraphCost graph = solver->graph_cost();
      std::vector<cases::EffectCost> result;
      for(const cases::EffectDecision &decision : effects.decisions())
      {
        if(!decision.on)
          continue;
        switch(decision.effect)
        {
        case Effect::phase_change:
          result.push_back({decision.effect, graph.sweeps, graph.bytes, graph.seconds});
          break;
        case Effect::heat_sources:
          result.push_back(sources->cost());
          break;
        case Effect::wall_temperature:
          result.push_back(walls->cost());
          break;
        case Effect::wall_flux:
          result.push_back(flux->cost());
          break;
        default:
          // Kirchhoff's variable makes the phases' differences a second slope of the
          // graph: two numbers, and no time that could be told apart.
          result.push_back(
              {decision.effect, graph.linearisations,
               graph.linearisations > 0 ? static_cast<long>(sizeof(double)) : 0L, 0});
        }
      }
      return result;
    }

    cases::Cost EnthalpyRun::run(cases::Observer &observer, StepStatistics &statistics)
    {
      cases::Cost cost;
      const Stopwatch::Seconds setup = watch.elapsed();
      const cases::RunDescription run_description = description();
      observer.begin(run_description);
      watch.restart();
      report(observer, true);

      StepQueue queue(scene.start_time, scene.end_time, nominal_steps,
                      static_cast<int>(resolution.options.get_integer("start_halvings")));
      u_accepted = u;
      while(!queue.empty())
      {
        const StepFormula step = formula(queue.next());
        const StepOutcome outcome = attempt(step);
        cost.solver_iterations += outcome.iterations;
        cost.capped_steps += outcome.iterations >= iteration_limit;
        if(!outcome.converged)
        {
          require_halvable(step, outcome);
          queue.halve(time);
          ++statistics.halvings;
          u = u_accepted;
          continue;
        }
        queue.pop();
        u_before = u_accepted;
        u_accepted = u;
        statistics.graph_inconsistency
            = std::max(statistics.graph_inconsistency, outcome.graph_inconsistency);
        statistics.iterations = std::max(statistics.iterations, outcome.iterations);
        accept(step, statistics);
        report(observer, queue.empty());
        if(outcome.iterations > comfortable_iterations && !queue.empty())
        {
          queue.halve(time);
          ++statistics.halvings;
        }
      }
      const Stopwatch::Seconds stepping = watch.elapsed();
      cost.setup_wall = setup.wall;
      cost.setup_cpu = setup.cpu;
      cost.stepping_wall = stepping.wall;
      cost.stepping_cpu = stepping.cpu;
      cost.steps = step_number;
      cost.unknowns = run_description.unknowns;
      cost.work = solver->work();
      cost.effects = effect_costs();
      return cost;
    }

    void EnthalpyRun::require_halvable(const StepFormula &step,
                                       const StepOutcome &outcome) const
    {
      const double nominal = (scene.end_time - scene.start_time) / nominal_steps;
      if(!std::isfinite(outcome.graph_inconsistency))
        throw cases::NumericalError(method_name, step_number + 1, step.next, "enthalpy",
                                    "is not finite");
      if(step.next - step.now < smallest_step * nominal)
        throw cases::NumericalError(
            method_name, step_number + 1, step.next, "enthalpy",
            fmt::format(
                "is off the enthalpy graph by {:.3g} after {} iterations, however "
                "short the step",
                outcome.graph_inconsistency, outcome.iterations));
    }
  } // namespace

  cases::Cost run_enthalpy(const cases::Scene &scene, const cases::EffectSet &effects,
                           const cases::Resolution &resolution, cases::Observer &observer,
                           StepStatistics &statistics)
  {
    EnthalpyRun run(scene, effects, resolution);
    return run.run(observer, statistics);
  }

  std::vector<cases::OptionDeclaration> enthalpy_options()
  {
    return {
        {"time_scheme",
         "",
         std::string("bdf2"),
         "Time scheme: bdf2 (second order) or backward_euler (first order).",
         0,
         0,
         {"bdf2", "backward_euler"}},
        {"steps_per_cell", "1", 0.78125,
         "Time steps over the run per cell along the domain's side; at least 50 in all.",
         1e-6, 1e6},
        {"steps", "1", 0L, "Time steps over the run; 0: from steps_per_cell.", 0, 1e9},
        {"start_halvings", "1", 3L,
         "The first step is replaced by steps that double from 2^-start_halvings of it.",
         0, 40},
        {"dimension", "1", 0L,
         "Dimension in which a symmetric scene is simulated; 0: the lowest.", 0, 3},
        {"iteration_limit", "1", 100L,
         "Nonlinear iterations after which a step is halved and tried again.", 1, 1e6},
        {"preconditioner",
         "",
         std::string("automatic"),
         "Of conjugate gradients in 2D and 3D: ssor, amg (Trilinos ML) or automatic.",
         0,
         0,
         {"automatic", "ssor", "amg"}}};
  }
} // namespace meltfront::reference_fem
