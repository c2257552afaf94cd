#include <reference_fem/cut/conservative/conservative_run.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem::cut::conservative
{
  cases::RunDescription ConservativeRun::describe() const
  {
    cases::RunDescription result;
    result.dimension = dim;
    result.spacing = mesh.spacing;
    result.time_step
        = (scene.end_time - scene.start_time) / static_cast<double>(options.fewest_steps);
    result.unknowns = unknowns;
    result.parameters = {
        {"scheme",
         fmt::format("conservative, the state is the heat of each hat function ({})",
                     chosen_scheme(options).why),
         ""},
        {"elements",
         "squares, a compact scheme of fourth order; linear triangles with the parabola "
         "that these miss where front, rims or walls are; each phase on those that it "
         "cuts",
         ""},
        {"mesh", fmt::format("{} squares cut in two", mesh.squares.size()), ""},
        {"front",
         "linear level set, area law in the same hats, Nitsche's condition, ghost "
         "penalty",
         ""},
        {"start", start_in_words, ""},
        {"time scheme", "SDIRK of two stages, order 2, L-stable, for heat and front", ""},
        {"cells crossed in a step, at most", fmt::format("{:g}", options.cfl), "1"},
        {"longest time step", fmt::format("{:.6g}", result.time_step), "s"},
        {"passes per stage, at most", fmt::format("{}", options.passes), "1"},
        {"linear solver", "sparse LU (UMFPACK)", ""}};
    return result;
  }

  cases::Cost ConservativeRun::cost() const
  {
    cases::Cost cost;
    cost.steps = step_number;
    cost.unknowns = most_unknowns;
    cost.work = entries;
    cost.solver_iterations = solves;
    cost.most_iterations = most_solves;
    cost.evidence
        = {{"steps halved", double(halved_steps)},
           {"stages whose passes did not settle", double(unsettled_stages)},
           {"small bodies booked as the other phase", double(turned_bodies)},
           {"bodies that appeared", double(appeared_bodies)},
           {"steps of backward Euler after jumps at walls", double(euler_steps)},
           {"steps after which slopes of the level set were restored",
            double(restored_slopes)},
           {"largest area by which the front was behind its heat, of the domain",
            largest_debt / domain_area()}};
    cost.effects = effect_costs();
    return cost;
  }

  double ConservativeRun::domain_area() const
  {
    const Front front(mesh, state.level_set);
    return front.area(Phase::solid) + front.area(Phase::liquid);
  }

  double ConservativeRun::stored_heat() const
  {
    return sum(state.heat[0]) + sum(state.heat[1]);
  }

  /** Of the liquid, less what the front has taken up but not yet made solid of: what the
   * last pass leaves over is freezing that is due. */
  double ConservativeRun::latent_heat() const
  {
    return latent_heat_of_volume()
           * (Front(mesh, state.level_set).area(Phase::liquid) - sum(state.debt));
  }

  /** A point of the domain's own outline for one of the polygon's that lies beyond it. */
  Point ConservativeRun::in_domain(const Point &point) const
  {
    const double radius = point.norm();
    if(!scene.domain.round())
      return point;
    if(!(radius > 0))
      return {scene.domain.inner_radius, 0};
    return Point(std::clamp(radius, scene.domain.inner_radius, scene.domain.radius)
                 / radius * point);
  }

  Phase ConservativeRun::phase_at(unsigned int triangle, const Point &point) const
  {
    return mesh.triangles[triangle].value(state.level_set, point) < 0 ? Phase::solid
                                                                      : Phase::liquid;
  }

  /** @param missed what the linear function of the triangle misses there, made as much
   * less as keeps the temperature on its phase's side of the melting temperature and
   * within the bounds that the scene gives (K) */
  double ConservativeRun::shown_temperature(unsigned int triangle, const Point &place,
                                            Phase phase, double missed) const
  {
    const double melting = scene.material.melting_temperature;
    const double linear
        = melting + assembly.temperature(phase, triangle, place, temperatures, powers);
    const double lower = phase == Phase::solid ? bounds.lower : melting,
                 upper = phase == Phase::solid ? melting : bounds.upper;
    return std::clamp(linear + missed, std::min(linear, lower), std::max(linear, upper));
  }

  unsigned int ConservativeRun::add_site(unsigned int triangle, const Point &point,
                                         double weight, Phase phase, double missed)
  {
    const Point place = in_domain(point);
    return sites.add(place, weight, shown_temperature(triangle, place, phase, missed),
                     phase == Phase::solid);
  }

  void ConservativeRun::collect_sites()
  {
    const Front front(mesh, state.level_set);
    const Guess now{temperatures, state.level_set, segments_of(front), powers};
    std::array<CurvatureFit, 2> fits{
        assembly.curvature_fit(Phase::solid, now),
        assembly.curvature_fit(Phase::liquid, now),
    };
    const auto bend = [&](unsigned int t, Phase phase)
    {
      return Remainder(fits[index(phase)](mesh.triangles[t]), mesh.triangles[t],
                       mesh.nodes);
    };
    sites.clear();
    for(unsigned int t = 0; t < mesh.triangles.size(); ++t)
      for(const Phase phase : phases)
      {
        const Polygon &part = front.part(t, phase);
        if(part.empty())
          continue;
        const Remainder missed = bend(t, phase);
        integrate(part, [&](const Point &point, double weight)
                  { add_site(t, point, weight, phase, missed.value(point)); });
      }
    constexpr unsigned int none = static_cast<unsigned int>(-1);
    std::vector<unsigned int> site_of_node(mesh.nodes.size(), none);
    for(unsigned int s = 0; s < mesh.squares.size(); ++s)
    {
      if(mesh.triangles[2 * s].part.empty() && mesh.triangles[2 * s + 1].part.empty())
        continue;
      for(const unsigned int node : mesh.squares[s])
      {
        if(site_of_node[node] == none)
        {
          // One beyond the rim is shown on it, within a triangle; at its corners the
          // linear function misses nothing.
          const Point place = in_domain(mesh.nodes[node]);
          const unsigned int t = mesh.triangle_at(place);
          const Phase phase = phase_at(t, place);
          site_of_node[node]
              = add_site(t, place, 0, phase,
                         place == mesh.nodes[node] ? 0 : bend(t, phase).value(place));
        }
        sites.cells.push_back(site_of_node[node]);
      }
    }
    for(const CutTriangle &cut : front.cut)
      if(cut.crossed)
        integrate(cut.segment,
                  [&](const Point &point, double) { sites.add_on_front(point); });
  }

  cases::Snapshot ConservativeRun::snapshot(long step, double at)
  {
    if(state_before)
      return *state_before;
    collect_sites();
    return sites.snapshot(
        step, at,
        {stored_heat(), latent_heat(), boundary_heat, source_heat, initial_heat});
  }

  std::vector<cases::EffectCost> ConservativeRun::effect_costs() const
  {
    using cases::BoundaryKind, cases::Effect;
    const auto of_wall = [&](Effect effect, BoundaryKind kind)
    {
      const auto pieces
          = std::ranges::count_if(mesh.walls, [&](const WallPiece &wall)
                                  { return scene.boundary(wall.side).kind == kind; });
      return assembly.meters.walls[static_cast<std::size_t>(kind)].cost(
          effect, static_cast<std::size_t>(pieces) * sizeof(WallPiece));
    };
    std::vector<cases::EffectCost> result;
    for(const cases::EffectDecision &decision : effects.decisions())
    {
      if(!decision.on)
        continue;
      switch(decision.effect)
      {
      case Effect::phase_change:
        result.push_back(assembly.meters.front.cost(
            decision.effect,
            (state.level_set.size() + state.debt.size()) * sizeof(double)));
        break;
      case Effect::heat_sources:
        result.push_back(assembly.meters.sources.cost(
            decision.effect, sources.places.size() * sizeof(Point)));
        break;
      case Effect::volumetric_source:
        result.push_back(
            assembly.meters.released.cost(decision.effect, assembly.released_bytes()));
        break;
      case Effect::wall_temperature:
        result.push_back(of_wall(decision.effect, BoundaryKind::fixed_temperature));
        break;
      case Effect::wall_flux:
        result.push_back(of_wall(decision.effect, BoundaryKind::flux));
        break;
      case Effect::robin_wall:
        result.push_back(of_wall(decision.effect, BoundaryKind::heat_transfer));
        break;
      case Effect::radiating_wall:
        result.push_back(of_wall(decision.effect, BoundaryKind::radiation));
        break;
      default:
        // Two conductivities or capacities in place of one are other numbers in the same
        // matrices, with no time of their own.
        result.push_back({decision.effect, solves, 0, 0});
      }
    }
    return result;
  }
} // namespace meltfront::reference_fem::cut::conservative
