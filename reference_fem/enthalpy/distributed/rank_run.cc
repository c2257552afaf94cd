#include <reference_fem/enthalpy/distributed/mpi_start.h>
#include <reference_fem/enthalpy/distributed/rank_newton.h>
#include <reference_fem/enthalpy/distributed/rank_run.h>
#include <reference_fem/enthalpy/distributed/rank_solver.h>
#include <reference_fem/enthalpy/initial_state.h>
#include <reference_fem/enthalpy/sum_over.h>

#include <cases/error.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meltfront::reference_fem
{
  namespace
  {
    constexpr const char *name = "fem-enthalpy";

    // As EnthalpyRun has them:
    constexpr int comfortable_iterations_of_ranks = 30;
    constexpr double smallest_step_of_ranks = 1e-4;
  } // namespace

  RankRun::RankRun(const cases::Scene &scene, const cases::EffectSet &effects,
                   const cases::Resolution &resolution, int ranks)
    : scene(scene)
    , effects(effects)
    , options(options_for(scene, resolution))
    , n_ranks(ranks)
    , communicator(ranks > 1 ? MPI_COMM_WORLD : MPI_COMM_SELF)
    , bounds(cases::temperature_bounds(scene))
    , time(scene.start_time)
    , time_before(scene.start_time)
    , breakpoints(cases::breakpoints_of(scene))
    , queue(scene.start_time, scene.end_time, options.steps, options.start_halvings,
            options.step_ends)
  {
    if(options.refine_at_front)
      throw cases::Refusal(
          "fem-enthalpy refines meshes at the front (refinement = front) "
          "on one rank only, by its serial engine");
    if(options.preconditioner != Preconditioner::automatic)
      throw cases::Refusal("fem-enthalpy has one preconditioner on several ranks: leave "
                           "the option preconditioner at automatic");
    start_mpi_alone();
    levels = make_rank_levels(scene, resolution.n, communicator);
    const RankLevel &finest = levels.front();
    const std::unique_ptr<Mesh> geometry = make_rank_mesh(scene, finest);
    mesh = geometry->discretise();
    site_numbers.resize(finest.n_with_ghosts());
    for(unsigned int i = 0; i < site_numbers.size(); ++i)
      site_numbers[i] = finest.number(i);
    n_nodes = finest.lattice.n_nodes();
    free = finest.free;
    n_free = static_cast<std::uint64_t>(
        sum_of_ranks(static_cast<double>(std::ranges::count(free, 1))));
    using cases::Effect;
    if(effects.contains(Effect::heat_sources))
      sources.emplace(scene, *geometry, mesh);
    if(effects.contains(Effect::volumetric_source))
      release.emplace(scene, mesh);
    if(effects.contains(Effect::wall_flux))
      flux.emplace(scene, mesh);
    if(effects.contains(Effect::wall_temperature))
      walls.emplace(scene, mesh);
    if(effects.contains(Effect::robin_wall) || effects.contains(Effect::radiating_wall))
      exchange.emplace(scene, mesh, free);
    enthalpy = enthalpy_before = initial_enthalpy(scene, *geometry, mesh, free);
    if(!release) // which alone asks for them from now on
      mesh.positions = {};
    auto linear = make_rank_solver(levels, traffic);
    linear_solver = linear.get();
    solver = make_rank_newton(problem(), levels, scene.material, effects,
                              std::move(linear), traffic);
    u = u_accepted = CompensatedVector(finest.n_with_ghosts());
    u_before.resize(u.size());
    for(std::size_t i = 0; i < enthalpy.size(); ++i)
      u.set(i, solver->kirchhoff_at_enthalpy(i, enthalpy[i]));
    for(std::vector<double> *part : u.parts())
      finest.exchange(*part, traffic);
    rhs.resize(enthalpy.size());
    heat.resize(enthalpy.size());
    initial_heat = total([this](std::size_t i) { return enthalpy[i]; });
  }

  StepProblem RankRun::problem()
  {
    return {mesh.conduction, mesh.volume, free, exchange ? &*exchange : nullptr, nullptr};
  }

  double RankRun::sum_of_ranks(double own) const
  {
    ++traffic.reductions;
    return dealii::Utilities::MPI::sum(own, communicator);
  }

  bool RankRun::continues() const
  {
    return step_number > 0 && !std::ranges::binary_search(breakpoints, time);
  }

  StepFormula RankRun::formula(double next) const
  {
    // A formula of two steps spans no breakpoint, and is stable for a limited growth.
    const bool two_steps
        = options.bdf2 && continues()
          && next - time <= largest_growth_of_bdf2 * (time - time_before);
    return two_steps ? bdf2_step(time_before, time, next)
                     : backward_euler_step(time, next);
  }

  StepOutcome RankRun::attempt(const StepFormula &step)
  {
    for(std::size_t i = 0; i < rhs.size(); ++i)
      rhs[i] = mesh.volume[i] * step.combine(enthalpy[i], enthalpy_before[i]);
    if(sources)
      sources->add_load(step, rhs);
    step_released_heat = release ? release->add_load(step, rhs) : 0;
    step_flux_heat = flux ? flux->add_load(step, rhs) : 0;
    if(exchange)
      exchange->begin(step);
    // First guess: the last change goes on.
    if(continues())
    {
      const double ratio = (step.next - time) / (time - time_before);
      for(std::size_t i = 0; i < u.size(); ++i)
        u.add(i, ratio * (u_accepted[i] - u_before[i]));
    }
    if(walls)
      walls->prescribe(step, *solver, u);
    const StepOutcome outcome
        = solver->solve(step.c, rhs, options.iteration_limit, u, heat);
    iterations += outcome.iterations;
    capped_steps += outcome.iterations >= options.iteration_limit;
    return outcome;
  }

  /** As EnthalpyRun::solve: where BDF2 passes the bounds, backward Euler. */
  StepOutcome RankRun::solve(StepFormula &step)
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

  void RankRun::accept(const StepFormula &step)
  {
    enthalpy_before.swap(enthalpy);
    for(std::size_t i = 0; i < enthalpy.size(); ++i)
      enthalpy[i] = free[i] ? heat[i] / mesh.volume[i] : enthalpy_before[i];
    double entered = step_flux_heat;
    if(exchange)
      entered += step.c
                 * exchange->power([this](std::size_t i)
                                   { return solver->temperature_excess(u[i]); });
    const cases::Material &material = scene.material;
    const double density = material.solid.density;
    if(walls)
      entered += walls->react(
          step, problem(), u, rhs, enthalpy,
          [&](unsigned int, double temperature, double last)
          {
            return density
                   * (temperature == material.melting_temperature
                          ? std::clamp(last / density, 0., material.latent_heat)
                          : material.enthalpy(temperature));
          });
    boundary_heat
        = {step.combine(boundary_heat.now, boundary_heat.before) + sum_of_ranks(entered),
           boundary_heat.now};
    released_heat = {step.combine(released_heat.now, released_heat.before)
                         + sum_of_ranks(step_released_heat),
                     released_heat.now};
    time_before = time;
    time = step.next;
    ++step_number;
    check_balance();
  }

  void RankRun::check_temperatures(const StepFormula &step) const
  {
    constexpr double far = std::numeric_limits<double>::infinity();
    // A value that is not a number is no minimum of others.
    std::vector<double> most{-far, -far, 0};
    for(std::size_t i = 0; i < mesh.volume.size(); ++i)
    {
      const double excess = solver->temperature_excess(u[i]);
      most[0] = std::max(most[0], excess);
      most[1] = std::max(most[1], -excess);
      if(!std::isfinite(excess))
        most[2] = 1;
    }
    dealii::Utilities::MPI::max(most, communicator, most);
    ++traffic.reductions;
    const double melting = scene.material.melting_temperature;
    const double not_finite = most[2] > 0 ? std::nan("") : 0;
    cases::check_temperature(bounds, melting - most[1] + not_finite,
                             melting + most[0] + not_finite, name, step_number + 1,
                             step.next, cases::overshoot_of_round_off);
  }

  bool RankRun::keeps_bounds(const StepFormula &step) const
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

  double RankRun::nominal_step() const
  {
    return (scene.end_time - scene.start_time) / static_cast<double>(options.steps);
  }

  double RankRun::source_heat() const
  {
    return (sources ? sources->energy(time) : 0) + released_heat.now;
  }

  void RankRun::check_balance()
  {
    const double all = total([this](std::size_t i) { return enthalpy[i]; });
    const double magnitude
        = total([this](std::size_t i) { return std::abs(enthalpy[i]); });
    const double defect_before = defect;
    defect = all - initial_heat - boundary_heat.now - source_heat();
    const double scale = std::max({magnitude, std::abs(boundary_heat.now),
                                   std::abs(source_heat()), std::abs(initial_heat)});
    const double relative = scale > 0 ? std::abs(defect - defect_before) / scale : 0;
    statistics.balance_defect = std::max(statistics.balance_defect, relative);
    if(!(relative <= accepted_balance_defect))
      throw cases::NumericalError(
          name, step_number, time, "heat balance",
          fmt::format("is off by {:.3g} of the heat at hand, more than {:g}", relative,
                      accepted_balance_defect));
  }

  void RankRun::take_steps()
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
      if(grows_slowly && continues())
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
      queue.pop();
      u_before = u_accepted.rounded();
      u_accepted = u;
      statistics.graph_inconsistency
          = std::max(statistics.graph_inconsistency, outcome.graph_inconsistency);
      statistics.iterations = std::max(statistics.iterations, outcome.iterations);
      accept(step);
      if(outcome.iterations > comfortable_iterations_of_ranks && !queue.empty())
      {
        queue.halve(time);
        ++statistics.halvings;
      }
      reached(step_number, time);
    }
  }

  void RankRun::require_halvable(const StepFormula &step,
                                 const StepOutcome &outcome) const
  {
    if(!std::isfinite(outcome.graph_inconsistency))
      throw cases::NumericalError(name, step_number + 1, step.next, "enthalpy",
                                  "is not finite");
    if(step.next - step.now < smallest_step_of_ranks * nominal_step())
      throw cases::NumericalError(
          name, step_number + 1, step.next, "enthalpy",
          fmt::format("is off the enthalpy graph by {:.3g} after {} iterations, however "
                      "short the step",
                      outcome.graph_inconsistency, outcome.iterations));
  }
} // namespace meltfront::reference_fem
