#include <reference_fem/enthalpy/run.h>
#include <reference_fem/enthalpy/sum_over.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem
{
  std::string EnthalpyRun::mesh_in_words() const
  {
    const char *shape
        = mesh.measure == cases::Symmetry::cylindrical      ? "radial, weight 2 pi r"
          : mesh.measure == cases::Symmetry::spherical      ? "radial, weight 4 pi r^2"
          : scene.domain.shape == cases::DomainShape::ball  ? "unstructured"
          : scene.domain.shape == cases::DomainShape::shell ? "rings"
          : scene.domain.shape == cases::DomainShape::axisymmetric
              ? "Cartesian, weight 2 pi r"
          : scene.domain.outline ? "squares and a layer along the outline"
          : scene.domain.mesh    ? cases::to_string(scene.domain.mesh->kind())
                                 : "Cartesian";
    return fmt::format("{} cells, {} nodes, {}D, {}{}",
                       mesh.cells.size() >> mesh.dimension, mesh.volume.size(),
                       mesh.dimension, shape,
                       refinable ? " at the start, refined at the front" : "");
  }

  cases::RunDescription EnthalpyRun::describe() const
  {
    cases::RunDescription result;
    result.dimension = mesh.dimension;
    result.spacing = mesh.spacing;
    result.time_step = nominal_step();
    result.unknowns = std::count(free.begin(), free.end(), 1);
    result.parameters = {
        {"elements", "linear, lumped mass, exact enthalpy graph", ""},
        {"mesh", mesh_in_words(), ""},
        {"time scheme",
         options.bdf2
             ? "BDF2; backward Euler for the first step and where BDF2 passes the "
               "bounds of the maximum principle"
             : "backward Euler",
         ""},
        {"time step", fmt::format("{:.6g}", result.time_step), "s"},
        {"nonlinear solver", "truncated nonsmooth Newton with Gauss-Seidel sweeps", ""},
        {"iteration limit", fmt::format("{}", options.iteration_limit), "1"},
        {"linear solver", linear_solver_in_words, ""},
        {"graph consistency required",
         fmt::format("{:g}", NonlinearSolver::accepted_inconsistency), "1"},
        {"heat balance required", fmt::format("{:g}", accepted_balance_defect), "1"},
        {"tolerance of the maximum principle", fmt::format("{:g}", slack), "1"}};
    return result;
  }

  double EnthalpyRun::density() const
  {
    return scene.material.solid.density;
  }

  void EnthalpyRun::state_of_sites()
  {
    const std::size_t n_sites = mesh.node_of_site.size();
    site_temperature.resize(n_sites);
    site_solid_fraction.resize(n_sites);
    for(std::size_t site = 0; site < n_sites; ++site)
    {
      const unsigned int node = mesh.node_of_site[site];
      if(alloy)
      {
        const cases::PhaseState state = alloy->state(node, enthalpy[node]);
        site_temperature[site] = state.temperature;
        site_solid_fraction[site] = 1 - state.liquid_fraction;
        continue;
      }
      const double specific = enthalpy[node] / density();
      site_temperature[site] = scene.material.temperature(specific);
      site_solid_fraction[site] = scene.material.solid_fraction(specific);
    }
    for(const HangingSite &hangs : mesh.hanging)
    {
      double temperature = 0, solid_fraction = 0;
      for(const auto &[node, share] : hangs.nodes)
      {
        const double specific = enthalpy[node] / density();
        temperature += share * scene.material.temperature(specific);
        solid_fraction += share * scene.material.solid_fraction(specific);
      }
      site_temperature[hangs.site] = temperature;
      site_solid_fraction[hangs.site] = solid_fraction;
    }
  }

  double EnthalpyRun::latent_heat(std::size_t node) const
  {
    const double whole = density() * scene.material.latent_heat;
    if(scene.material.curves)
      return whole * (1 - scene.material.solid_fraction(enthalpy[node] / density()));
    return alloy ? whole * alloy->state(node, enthalpy[node]).liquid_fraction
                 : std::clamp(enthalpy[node], 0., whole);
  }

  cases::Snapshot EnthalpyRun::snapshot(long step, double)
  {
    state_of_sites();
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
    snapshot.obeys_maximum_principle = obeys_maximum_principle;
    snapshot.heat.latent
        = sum_over(mesh.volume, [this](std::size_t i) { return latent_heat(i); });
    snapshot.heat.stored = sum_over(mesh.volume, [this](std::size_t i)
                                    { return enthalpy[i] - latent_heat(i); });
    snapshot.heat.boundary = boundary_heat.now;
    snapshot.heat.sources = source_heat();
    snapshot.heat.initial = initial_heat;
    if(motion)
      motion->return_to_space(mesh, snapshot);
    if(scene.alloy)
    {
      const double mass
          = density() * sum_over(mesh.volume, [](std::size_t) { return 1; });
      snapshot.mass = {mass, mass};
    }
    if(alloy)
      alloy->report(snapshot);
    return snapshot;
  }

  cases::Cost EnthalpyRun::cost() const
  {
    cases::Cost cost;
    cost.steps = step_number;
    cost.unknowns = describe().unknowns;
    cost.work = solver->work() + adaptation.work;
    cost.solver_iterations = alloy ? alloy->iterations() : iterations;
    cost.most_iterations = statistics.iterations;
    cost.capped_steps = capped_steps;
    cost.effects = effect_costs();
    cost.evidence
        = {{"largest distance from the enthalpy graph", statistics.graph_inconsistency},
           {"largest defect of a step's heat balance", statistics.balance_defect},
           {"steps halved", double(statistics.halvings)},
           {"steps left to backward Euler", double(statistics.euler_steps)}};
    if(step_number > 0)
      cost.evidence["iterations_per_step"] = double(cost.solver_iterations) / step_number;
    const long linear_iterations = adaptation.linear_iterations
                                   + (linear_solver ? linear_solver->iterations() : 0);
    if(linear_iterations > 0)
      cost.evidence["linear iterations per iteration"]
          = double(linear_iterations) / iterations;
    if(refinable && step_number > 0)
    {
      cost.unknowns = std::lround(adaptation.unknowns_times_steps / step_number);
      cost.evidence["adaptations"] = double(adaptation.adaptations);
      cost.evidence["transfer_defect"] = adaptation.transfer_defect;
      cost.evidence["unknowns, mean"] = double(cost.unknowns);
      cost.evidence["unknowns, most"] = double(adaptation.most_unknowns);
    }
    return cost;
  }

  std::vector<cases::EffectCost> EnthalpyRun::effect_costs() const
  {
    const NonlinearSolver::GraphCost graph = solver->graph_cost();
    std::vector<cases::EffectCost> result;
    for(const cases::EffectDecision &decision : effects.decisions())
    {
      if(!decision.on)
        continue;
      if(const auto cost = alloy ? alloy->cost(decision.effect) : std::nullopt)
      {
        result.push_back(*cost);
        continue;
      }
      switch(decision.effect)
      {
      case cases::Effect::phase_change:
        result.push_back({decision.effect, graph.sweeps + graph.linearisations,
                          graph.bytes, graph.seconds});
        break;
      case cases::Effect::heat_sources:
        result.push_back(sources->cost());
        break;
      case cases::Effect::moving_source:
        result.push_back(sources->cost_of_moving());
        break;
      case cases::Effect::liquid_motion:
        result.push_back(motion->cost());
        break;
      case cases::Effect::volumetric_source:
        result.push_back(release->cost());
        break;
      case cases::Effect::inclusion:
        // Its conductances are those of the matrix: no memory and no time of their own.
        result.push_back({decision.effect, 1, 0, 0});
        break;
      case cases::Effect::wall_temperature:
        result.push_back(walls->cost());
        break;
      case cases::Effect::wall_flux:
        result.push_back(flux->cost());
        break;
      case cases::Effect::robin_wall:
      case cases::Effect::radiating_wall:
        result.push_back(exchange->cost(decision.effect));
        break;
      default:
        // Kirchhoff's variable makes the phases' differences a second slope of the
        // graph: two numbers, and no time that could be told apart.
        result.push_back(
            {decision.effect, graph.linearisations,
             graph.linearisations > 0 ? static_cast<long>(sizeof(double)) : 0L, 0});
      }
    }
    for(std::size_t e = 0; e < adaptation.effects.size(); ++e)
    {
      const cases::EffectCost &earlier = adaptation.effects[e];
      result[e].calls += earlier.calls;
      result[e].bytes = std::max(result[e].bytes, earlier.bytes);
      result[e].seconds += earlier.seconds;
    }
    return result;
  }
} // namespace meltfront::reference_fem
