#include <reference_fem/cut/quadrature.h>
#include <reference_fem/cut/run.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem::cut
{
  cases::RunDescription CutRun::describe() const
  {
    cases::RunDescription result;
    result.dimension = dim;
    result.spacing = state.mesh->spacing;
    result.time_step
        = (scene.end_time - scene.start_time) / static_cast<double>(options.fewest_steps);
    result.unknowns = unknowns_at_start;
    result.parameters = {
        {"scheme", fmt::format("extension ({})", chosen_scheme(options).why), ""},
        {"elements",
         fmt::format("degree {}, each phase on the cells that it cuts", options.degree),
         ""},
        {"mesh", fmt::format("{} Cartesian cells", state.mesh->cells.size()), ""},
        {"refinement about the front",
         options.refinement > 0 ? fmt::format(
             "{} divisions, {:g} finest cells to each side, the mesh follows",
             options.refinement, options.widths.finest)
                                : "none",
         ""},
        {"front",
         fmt::format("level set of degree {}, Nitsche's condition, ghost penalty",
                     options.level_set_degree),
         ""},
        {"start", start_in_words, ""},
        {"time scheme",
         "BDF2 for the temperature, after a jump at a wall a few steps of backward "
         "Euler; "
         "predictor and trapezoid for the front",
         ""},
        {"cells crossed in a step, at most", fmt::format("{:g}", options.cfl), "1"},
        {"longest time step", fmt::format("{:.6g}", result.time_step), "s"},
        {"solves per step", fmt::format("{}", options.solves), "1"},
        {"linear solver", "sparse Cholesky (Eigen, LDL')", ""}};
    return result;
  }

  cases::Cost CutRun::cost() const
  {
    cases::Cost cost;
    cost.steps = step_number;
    cost.unknowns = heat.most_unknowns;
    cost.work = heat.entries;
    cost.solver_iterations = heat.solves;
    cost.most_iterations = options.solves;
    cost.capped_steps = capped_steps;
    cost.evidence = evidence();
    cost.effects = effect_costs();
    return cost;
  }

  /** The scene's own initial state, also where the run starts from a front that was
   * seeded later. */
  void CutRun::report_initial()
  {
    std::optional<State> seeded;
    if(state.time > scene.start_time)
    {
      seeded = std::move(state);
      state = State{scene.start_time, seeded->mesh, {}, {}, {}, {}, 0};
      heat.set_front(state,
                     Values(state.mesh->level_set_positions.size(), state.mesh->spacing));
      heat.project(state,
                   [this](const Point &point) {
                     return scene.initial.temperature(position(point), scene.start_time);
                   });
    }
    initial_heat = heat.sensible_heat(state) + heat.latent_heat(state);
    reached(0, scene.start_time);
    if(seeded)
      state = *std::move(seeded);
  }

  /** Vertices as sites without weight. */
  void CutRun::add_vertices()
  {
    const BackgroundMesh &mesh = *state.mesh;
    constexpr unsigned int none = static_cast<unsigned int>(-1);
    std::vector<unsigned int> site_of_dof(mesh.positions.size(), none);
    for(unsigned int number = 0; number < mesh.cells.size(); ++number)
    {
      if(mesh.place[number] == Place::outside)
        continue;
      const Cell &cell = mesh.cells[number];
      for(unsigned int vertex = 0; vertex < 1u << dim; ++vertex)
      {
        unsigned int &site = site_of_dof[cell.dofs[vertex]];
        if(site == none)
        {
          const VertexValue value = at_vertex(state, number, vertex);
          site = sites.add(value.point, 0, value.temperature, value.solid);
        }
        sites.cells.push_back(site);
      }
    }
  }

  void CutRun::collect_sites()
  {
    const BackgroundMesh &mesh = *state.mesh;
    sites.clear();
    for(const Phase phase : phases)
    {
      const auto add = [&](unsigned int cell, const std::vector<VolumePoint> &points)
      {
        for(const VolumePoint &point : points)
          sites.add(mesh.cells[cell].real(point.unit), point.weight,
                    heat.temperature(state, phase, cell, point.unit),
                    phase == Phase::solid);
      };
      for(unsigned int cell = 0; cell < mesh.cells.size(); ++cell)
        if(CutGeometry::is(state.geometry->location[cell], phase)
           && mesh.place[cell] == Place::inside)
          add(cell, whole_cell(mesh.cells[cell], 2));
      state.geometry->visit_parts(mesh, phase, add);
    }
    add_vertices();
    for(const CutCell &cut : state.geometry->cut_cells)
      for(const SurfacePoint &point : cut.front)
        sites.add_on_front(mesh.cells[cut.cell].real(point.unit));
  }

  cases::Snapshot CutRun::snapshot(long step, double time)
  {
    collect_sites();
    return sites.snapshot(step, time,
                          {heat.sensible_heat(state), heat.latent_heat(state),
                           boundary_heat, heat.sinks.energy(state.time) + released_heat,
                           initial_heat});
  }

  std::vector<cases::EffectCost> CutRun::effect_costs() const
  {
    std::vector<cases::EffectCost> result;
    for(const cases::EffectDecision &decision : effects.decisions())
      if(decision.on)
        result.push_back(heat.cost(decision.effect, state));
    return result;
  }

  std::map<std::string, double> CutRun::evidence() const
  {
    return {{"steps halved", double(halved_steps)},
            {"steps whose front's move was cut to 0.9 cells", double(capped_steps)},
            {"steps of backward Euler", double(euler_steps)},
            {"meshes", double(meshes)}};
  }
} // namespace meltfront::reference_fem::cut
