#include <reference_fem/enthalpy/distributed/rank_run.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem
{
  namespace
  {
    using cases::BoundaryKind, cases::Effect;
  }

  cases::Capabilities rank_capabilities()
  {
    using cases::DomainShape, cases::FrontOrigin;
    const std::vector<BoundaryKind> walls{
        BoundaryKind::insulated, BoundaryKind::fixed_temperature, BoundaryKind::flux,
        BoundaryKind::heat_transfer, BoundaryKind::radiation};
    return {
        .form = "on several ranks",
        .problems = {cases::ProblemKind::stefan},
        .effects
        = {Effect::phase_change, Effect::phase_conductivity, Effect::phase_heat_capacity,
           Effect::heat_sources, Effect::wall_temperature, Effect::wall_flux,
           Effect::volumetric_source, Effect::robin_wall, Effect::radiating_wall},
        .shapes
        = {{DomainShape::box, {2, 3}, walls}, {DomainShape::axisymmetric, {2}, walls}},
        .front_origins
        = {FrontOrigin::none, FrontOrigin::initial_front, FrontOrigin::partly_melted,
           FrontOrigin::wall, FrontOrigin::source},
        .overshoot = overshoot};
  }

  double rank_bytes(int dimension, double nodes, int ranks)
  {
    // As measured on one and two ranks, setting up, whole snapshots and frames of fields
    // included.
    constexpr double program_of_rank = 1.7e8, in_plane = 650, in_space = 700;
    return ranks * program_of_rank + nodes * (dimension > 2 ? in_space : in_plane);
  }

  cases::RunDescription RankRun::describe() const
  {
    cases::RunDescription result;
    result.dimension = mesh.dimension;
    result.spacing = mesh.spacing;
    result.time_step = nominal_step();
    result.unknowns = static_cast<long>(n_free);
    result.parameters
        = {{"elements", "linear, lumped mass, exact enthalpy graph", ""},
           {"mesh",
            fmt::format("{} nodes, {}D, Cartesian{}, shared by {} rank{} (p4est)",
                        n_nodes, mesh.dimension,
                        levels.front().lattice.about_axis ? ", about an axis" : "",
                        n_ranks, n_ranks == 1 ? "" : "s"),
            ""},
           {"time scheme",
            options.bdf2
                ? "BDF2; backward Euler for the first step and where BDF2 passes the "
                  "bounds of the maximum principle"
                : "backward Euler",
            ""},
           {"time step", fmt::format("{:.6g}", result.time_step), "s"},
           {"nonlinear solver",
            "truncated nonsmooth Newton with sweeps of Gauss-Seidel on each rank", ""},
           {"iteration limit", fmt::format("{}", options.iteration_limit), "1"},
           {"linear solver", linear_solver->description(), ""},
           {"graph consistency required",
            fmt::format("{:g}", NonlinearSolver::accepted_inconsistency), "1"},
           {"heat balance required", fmt::format("{:g}", accepted_balance_defect), "1"},
           {"tolerance of the maximum principle",
            fmt::format("{:g}", cases::overshoot_of_round_off), "1"}};
    return result;
  }

  double RankRun::latent_heat(std::size_t node) const
  {
    return std::clamp(enthalpy[node], 0.,
                      scene.material.solid.density * scene.material.latent_heat);
  }

  cases::Snapshot RankRun::snapshot(long step, double)
  {
    const Traffic of_steps = traffic;
    site_temperature.resize(levels.front().n_with_ghosts());
    site_solid_fraction.resize(site_temperature.size());
    for(std::size_t i = 0; i < enthalpy.size(); ++i)
    {
      const double specific = enthalpy[i] / scene.material.solid.density;
      site_temperature[i] = scene.material.temperature(specific);
      site_solid_fraction[i] = scene.material.solid_fraction(specific);
    }
    levels.front().exchange(site_temperature, traffic);
    levels.front().exchange(site_solid_fraction, traffic);
    cases::Snapshot snapshot;
    snapshot.step = step;
    snapshot.time = time;
    snapshot.dimension = mesh.dimension;
    for(int d = 0; d < mesh.dimension; ++d)
      snapshot.positions[d] = mesh.site_positions[d];
    snapshot.weights = mesh.site_weights;
    snapshot.temperature = site_temperature;
    snapshot.solid_fraction = site_solid_fraction;
    snapshot.cells = mesh.cells;
    snapshot.obeys_maximum_principle = true;
    snapshot.heat.latent = total([this](std::size_t i) { return latent_heat(i); });
    snapshot.heat.stored
        = total([this](std::size_t i) { return enthalpy[i] - latent_heat(i); });
    snapshot.heat.boundary = boundary_heat.now;
    snapshot.heat.sources = source_heat();
    snapshot.heat.initial = initial_heat;
    traffic = of_steps;
    return snapshot;
  }

  cases::Cost RankRun::cost() const
  {
    cases::Cost cost;
    cost.steps = step_number;
    cost.unknowns = static_cast<long>(n_free);
    const Traffic of_steps = traffic;
    cost.work = std::lround(sum_of_ranks(static_cast<double>(costs_so_far().work)));
    cost.solver_iterations = iterations;
    cost.most_iterations = statistics.iterations;
    cost.capped_steps = capped_steps;
    cost.effects = effect_costs();
    cost.evidence
        = {{"largest distance from the enthalpy graph", statistics.graph_inconsistency},
           {"largest defect of a step's heat balance", statistics.balance_defect},
           {"steps halved", double(statistics.halvings)},
           {"steps left to backward Euler", double(statistics.euler_steps)},
           {"ranks", double(n_ranks)}};
    if(step_number > 0)
    {
      const auto steps = static_cast<double>(step_number);
      cost.evidence["iterations_per_step"] = double(iterations) / steps;
      cost.evidence["exchanges per step"] = double(of_steps.exchanges) / steps;
      cost.evidence["reductions per step"] = double(of_steps.reductions) / steps;
      cost.evidence["bytes sent per step"]
          = sum_of_ranks(of_steps.sent * sizeof(double)) / steps;
    }
    if(const long linear_iterations = costs_so_far().linear_iterations)
      cost.evidence["linear iterations per iteration"]
          = double(linear_iterations) / double(iterations);
    return cost;
  }

  RankRun::Earlier RankRun::costs_so_far() const
  {
    return {earlier.work + solver->work(),
            earlier.linear_iterations + linear_solver->iterations(),
            effect_costs_of_rank()};
  }

  std::vector<cases::EffectCost> RankRun::effect_costs_of_rank() const
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
        result.push_back({decision.effect, graph.sweeps + graph.linearisations,
                          graph.bytes, graph.seconds});
        break;
      case Effect::heat_sources:
        result.push_back(sources->cost());
        break;
      case Effect::volumetric_source:
        result.push_back(release->cost());
        break;
      case Effect::wall_temperature:
        result.push_back(walls->cost());
        break;
      case Effect::wall_flux:
        result.push_back(flux->cost());
        break;
      case Effect::robin_wall:
      case Effect::radiating_wall:
        result.push_back(exchange->cost(decision.effect));
        break;
      default:
        // The second slope of the graph: two numbers, and no time to be told apart.
        result.push_back(
            {decision.effect, graph.linearisations,
             graph.linearisations > 0 ? static_cast<long>(sizeof(double)) : 0L, 0});
      }
    }
    for(std::size_t e = 0; e < earlier.effects.size(); ++e)
    {
      result[e].calls += earlier.effects[e].calls;
      result[e].seconds += earlier.effects[e].seconds;
    }
    return result;
  }

  /** Calls of one rank, bytes and seconds of all. */
  std::vector<cases::EffectCost> RankRun::effect_costs() const
  {
    std::vector<cases::EffectCost> result = effect_costs_of_rank();
    for(cases::EffectCost &cost : result)
    {
      cost.bytes = std::lround(sum_of_ranks(static_cast<double>(cost.bytes)));
      cost.seconds = sum_of_ranks(cost.seconds);
    }
    return result;
  }
} // namespace meltfront::reference_fem
