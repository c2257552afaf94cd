#include <cases/error.h>
#include <reference_fem/enthalpy/initial_state.h>
#include <reference_fem/enthalpy/run.h>
#include <reference_fem/enthalpy/sum_over.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meltfront::reference_fem
{
  using cases::Effect;

  namespace
  {
    constexpr const char *method_name = "fem-enthalpy";

    /** Iterations grow with the cells that the front crosses in a step: beyond these the
     * next step is halved. */
    constexpr int comfortable_iterations = 30;

    /** Below this share of the nominal step a step that does not converge stops the run.
     */
    constexpr double smallest_step = 1e-4;

  } // namespace

  EnthalpyRun::EnthalpyRun(const cases::Scene &in_space, const cases::EffectSet &effects,
                           const cases::Resolution &resolution)
    : motion(effects.contains(Effect::liquid_motion)
                 ? std::make_unique<LiquidMotion>(in_space)
                 : nullptr)
    , scene(motion ? motion->at_rest() : in_space)
    , effects(effects)
    , resolution(resolution)
    , options(options_for(scene, resolution))
    , bounds(cases::temperature_bounds(scene))
    , time(scene.start_time)
    , time_before(scene.start_time)
    , breakpoints(cases::breakpoints_of(scene))
    , queue(scene.start_time, scene.end_time, options.steps, options.start_halvings,
            options.step_ends)
  {
    if(motion && options.dimension > 1)
      throw cases::Refusal("fem-enthalpy moves displaced liquid in one dimension only");
    std::unique_ptr<Mesh> geometry;
    if(options.refine_at_front)
      refine_start();
    else
    {
      geometry = make_mesh(scene, options.dimension, resolution.n);
      mesh = geometry->discretise();
      make_parts(*geometry);
      if(!holds_solute(scene, effects))
        enthalpy = initial_enthalpy(scene, *geometry, mesh, free);
    }
    judge_mesh();
    // The mesh itself is large: it makes room for the solver where it is not needed.
    if(sources && sources->move())
      mesh_of_moving_sources = std::move(geometry);
    geometry.reset();
    make_solver();
    if(alloy)
      enthalpy = alloy->initial_enthalpy();
    enthalpy_before = enthalpy;
    if(motion)
    {
      // Cells that the front cuts hold a little more or less solid than lies in them.
      motion->move(mesh, enthalpy, enthalpy_before, time);
      linear_solver->conductances_changed();
    }
    u = CompensatedVector(enthalpy.size());
    for(std::size_t i = 0; i < u.size(); ++i)
      u.set(i, solver->kirchhoff_at_enthalpy(i, enthalpy[i]));
    rhs.resize(u.size());
    heat.resize(u.size());
    initial_heat = total_heat();
  }

  /** What its shape means for the maximum principle. */
  void EnthalpyRun::judge_mesh()
  {
    obeys_maximum_principle = mesh.conduction.is_monotone();
    slack = obeys_maximum_principle
                ? cases::overshoot_of_round_off
                : cases::allowed_overshoot(overshoot, mesh.spacing, scene.domain);
  }

  /** The parts that work on the mesh; the nodes whose temperature a wall prescribes. */
  void EnthalpyRun::make_parts(Mesh &geometry)
  {
    free.assign(mesh.volume.size(), 1);
    if(effects.contains(Effect::heat_sources))
      sources.emplace(scene, geometry, mesh);
    if(effects.contains(Effect::volumetric_source))
      release.emplace(scene, mesh);
    if(effects.contains(Effect::wall_flux))
      flux.emplace(scene, mesh);
    if(effects.contains(Effect::wall_temperature))
      walls.emplace(scene, mesh).mark(free);
    if(effects.contains(Effect::robin_wall) || effects.contains(Effect::radiating_wall))
      exchange.emplace(scene, mesh, free);
  }

  void EnthalpyRun::make_solver()
  {
    if(mesh.lattice)
      levels = std::make_shared<const Levels>(lattice_levels(*mesh.lattice));
    else if(refinable && options.preconditioner == Preconditioner::automatic)
      levels = std::make_shared<const Levels>(refinable->levels(mesh.conduction));
    const auto make_linear_solver = [this](const ConductionMatrix &matrix)
    {
      auto result = options.dimension == 1 ? make_tridiagonal_solver(matrix)
                    : levels && options.preconditioner == Preconditioner::automatic
                        ? make_multigrid_solver(matrix, levels)
                        : make_krylov_solver(matrix, options.preconditioner);
      linear_solver_in_words = result->description();
      return result;
    };
    if(!holds_solute(scene, effects))
    {
      if(scene.inclusion && scene.material.curves)
        throw cases::Refusal("fem-enthalpy simulates an inclusion in a material of one "
                             "conductivity only");
      if(options.front_within_cells && motion)
        throw cases::Refusal("fem-enthalpy takes fronts at their places within cells "
                             "(front = within_cells) where no liquid is displaced only");
      if(options.front_within_cells && scene.material.curves)
        throw cases::Refusal("fem-enthalpy takes fronts at their places within cells "
                             "(front = within_cells) where the phases' properties are "
                             "constant only");
      if(options.front_within_cells && scene.changes_phase())
        fronts.emplace(mesh, scene.material, free);
      auto linear = make_linear_solver(problem().conduction);
      linear_solver = linear.get();
      solver
          = make_nonlinear_solver(problem(), scene.material, effects, std::move(linear));
      return;
    }
    if(scene.material.curves)
      throw cases::Refusal(
          "fem-enthalpy simulates properties that depend on temperature, "
          "and melting ranges, of pure substances only, not of alloys");
    auto for_alloy = std::make_unique<AlloySolver>(
        scene, effects, mesh, free, exchange ? &*exchange : nullptr, make_linear_solver);
    alloy = for_alloy.get();
    solver = std::move(for_alloy);
    bounds = alloy->bounds(bounds);
  }

  StepProblem EnthalpyRun::problem()
  {
    const ConductionMatrix &conduction = alloy    ? alloy->conduction_matrix()
                                         : fronts ? fronts->matrix()
                                                  : mesh.conduction;
    return {conduction,
            mesh.volume,
            free,
            exchange ? &*exchange : nullptr,
            fronts || motion ? nullptr : levels.get(),
            refinable ? least_volume_over_typical() : 1};
  }

  StepFormula EnthalpyRun::formula(double next) const
  {
    // A formula of two steps spans no breakpoint, and is stable for a limited growth.
    const bool two_steps
        = options.bdf2 && step_number > 0
          && !std::ranges::binary_search(breakpoints, time)
          && next - time <= largest_growth_of_bdf2 * (time - time_before);
    return two_steps ? bdf2_step(time_before, time, next)
                     : backward_euler_step(time, next);
  }

  /** First guess: the last change goes on. Halves the iterations of long steps. */
  void EnthalpyRun::predict(double next)
  {
    if(step_number == 0 || std::ranges::binary_search(breakpoints, time))
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
    step_released_heat = release ? release->add_load(step, rhs) : 0;
    step_flux_heat = flux ? flux->add_load(step, rhs) : 0;
    if(exchange)
      exchange->begin(step);
    predict(step.next);
    if(alloy)
      alloy->begin(step, enthalpy);
    if(walls)
      walls->prescribe(step, *solver, u);
    const StepOutcome outcome
        = fronts ? solve_with_fronts(step)
                 : solver->solve(step.c, rhs, options.iteration_limit, u, heat);
    iterations += outcome.iterations;
    capped_steps += outcome.iterations >= options.iteration_limit;
    return outcome;
  }

  /**
   * Solve with the fronts where the last two steps lead them, then with the fronts where
   * that leaves them. Further passes change nothing that could be seen.
   */
  StepOutcome EnthalpyRun::solve_with_fronts(const StepFormula &step)
  {
    const bool continues
        = step_number > 0 && !std::ranges::binary_search(breakpoints, time);
    const double ratio
        = continues ? (step.next - step.now) / (step.now - time_before) : 0;
    std::vector<double> state = enthalpy;
    for(std::size_t i = 0; i < state.size(); ++i)
      state[i] += ratio * (enthalpy[i] - enthalpy_before[i]);
    StepOutcome outcome;
    int all = 0;
    for(int pass = 0; pass < 2; ++pass)
    {
      if(pass > 0)
        for(std::size_t i = 0; i < state.size(); ++i)
          if(free[i])
            state[i] = heat[i] / mesh.volume[i];
      fronts->follow(state);
      linear_solver->conductances_changed();
      outcome = solver->solve(step.c, rhs, options.iteration_limit, u, heat);
      all += outcome.iterations;
      if(!outcome.converged)
        break;
    }
    outcome.iterations = all;
    return outcome;
  }

  void EnthalpyRun::accept(const StepFormula &step)
  {
    if(alloy)
      alloy->accept();
    enthalpy_before.swap(enthalpy);
    for(std::size_t i = 0; i < enthalpy.size(); ++i)
      enthalpy[i] = free[i] ? heat[i] / mesh.volume[i] : enthalpy_before[i];
    double entered = step_flux_heat;
    if(exchange)
      entered += step.c
                 * exchange->power([this](std::size_t i)
                                   { return solver->temperature_excess(u[i]); });
    if(walls)
      entered += walls->react(step, problem(), u, rhs, enthalpy,
                              [this](unsigned int node, double temperature, double last)
                              { return enthalpy_at_wall(node, temperature, last); });
    const double boundary_now
        = step.combine(boundary_heat.now, boundary_heat.before) + entered;
    boundary_heat = {boundary_now, boundary_heat.now};
    released_heat
        = {step.combine(released_heat.now, released_heat.before) + step_released_heat,
           released_heat.now};
    time_before = time;
    time = step.next;
    ++step_number;
    check_balance();
  }

  /** Of a node at a prescribed temperature, where its enthalpy was `last`. */
  double EnthalpyRun::enthalpy_at_wall(unsigned int node, double temperature,
                                       double last) const
  {
    const cases::Material &material = scene.material;
    const double excess = temperature - material.melting_temperature;
    const double jump = material.curves ? material.curves->jump() : material.latent_heat;
    return alloy ? alloy->enthalpy_at(node, excess, last)
                 : density()
                       * (excess == 0 ? std::clamp(last / density(), 0., jump)
                                      : material.enthalpy(temperature));
  }

  void EnthalpyRun::check_temperatures(const StepFormula &step) const
  {
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for(std::size_t i = 0; i < u.size(); ++i)
    {
      const double excess = solver->temperature_excess(u[i]);
      lowest = std::min(lowest, excess);
      highest = std::max(highest, excess);
    }
    const double melting = scene.material.melting_temperature;
    cases::check_temperature(bounds, melting + lowest, melting + highest, method_name,
                             step_number + 1, step.next, slack);
    if(alloy && !alloy->concentrations_hold())
      throw cases::NumericalError(method_name, step_number + 1, step.next,
                                  "concentration", "is negative or not finite");
  }

  bool EnthalpyRun::keeps_bounds(const StepFormula &step) const
  {
    try
    {
      check_temperatures(step);
      return true;
    }
    catch(const cases::NumericalError &)
    {
      return false;
    }
  }

  /**
   * Solve a step. BDF2 obeys no maximum principle: where it swings beyond the bounds
   * after a sudden change, the step is made with backward Euler instead.
   */
  StepOutcome EnthalpyRun::solve(StepFormula &step)
  {
    StepOutcome outcome = attempt(step);
    if(!outcome.converged)
      return outcome;
    if(step.weight_before != 0 && !keeps_bounds(step))
    {
      u = u_accepted;
      step = backward_euler_step(step.now, step.next);
      outcome = attempt(step);
      ++statistics.euler_steps;
    }
    if(outcome.converged)
      check_temperatures(step);
    return outcome;
  }

  double EnthalpyRun::nominal_step() const
  {
    return (scene.end_time - scene.start_time) / options.steps;
  }

  double EnthalpyRun::total_heat() const
  {
    return sum_over(mesh.volume, [&](std::size_t i) { return enthalpy[i]; });
  }

  double EnthalpyRun::source_heat() const
  {
    return (sources ? sources->energy(time) : 0) + released_heat.now;
  }

  void EnthalpyRun::check_balance()
  {
    const double total = total_heat();
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

  void EnthalpyRun::take_steps()
  {
    require_resumable();
    if(!is_resumed())
    {
      u_accepted = u;
      reached(0, time);
    }
    // Where walls call for short steps among long ones, these do not fall back to first
    // order.
    const bool grows_slowly = options.step_ends.size() > breakpoints.size();
    while(!queue.empty())
    {
      if(grows_slowly && step_number > 0
         && !std::ranges::binary_search(breakpoints, time))
        queue.limit_growth(time_before, time, largest_growth_of_bdf2);
      StepFormula step = formula(queue.next());
      const StepOutcome outcome = solve(step);
      if(!outcome.converged)
      {
        require_halvable(step, outcome);
        queue.halve(time);
        ++statistics.halvings;
        u = u_accepted;
        continue;
      }
      if(refinement && refine_for_step())
        continue;
      queue.pop();
      u_before = u_accepted;
      u_accepted = u;
      statistics.graph_inconsistency
          = std::max(statistics.graph_inconsistency, outcome.graph_inconsistency);
      statistics.iterations = std::max(statistics.iterations, outcome.iterations);
      accept(step);
      if(motion)
        move_liquid();
      if(refinement)
        adapt_to_state();
      if(outcome.iterations > comfortable_iterations && !queue.empty())
      {
        queue.halve(time);
        ++statistics.halvings;
      }
      reached(step_number, time);
    }
  }

  void EnthalpyRun::move_liquid()
  {
    const LiquidMotion::Entered entered
        = motion->move(mesh, enthalpy, enthalpy_before, time);
    boundary_heat.now += entered.now;
    boundary_heat.before += entered.before;
    for(std::size_t i = entered.first; i < u.size(); ++i)
    {
      u.set(i, solver->kirchhoff_at_enthalpy(i, enthalpy[i]));
      u_before.set(i, solver->kirchhoff_at_enthalpy(i, enthalpy_before[i]));
    }
    u_accepted = u;
    linear_solver->conductances_changed();
    check_balance();
  }

  void EnthalpyRun::require_halvable(const StepFormula &step,
                                     const StepOutcome &outcome) const
  {
    if(!std::isfinite(outcome.graph_inconsistency))
      throw cases::NumericalError(method_name, step_number + 1, step.next, "enthalpy",
                                  "is not finite");
    if(step.next - step.now >= smallest_step * nominal_step())
      return;
    if(outcome.coupling_defect > 0)
      throw cases::NumericalError(
          method_name, step_number + 1, step.next, "concentration",
          fmt::format(
              "and heat are not coupled better than {:.3g}, however short the step",
              outcome.coupling_defect));
    throw cases::NumericalError(
        method_name, step_number + 1, step.next, "enthalpy",
        fmt::format("is off the enthalpy graph by {:.3g} after {} iterations, however "
                    "short the step",
                    outcome.graph_inconsistency, outcome.iterations));
  }
} // namespace meltfront::reference_fem
