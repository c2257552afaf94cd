#include <reference_fem/cut/conservative/conservative_run.h>

#include <cases/error.h>
#include <cases/exact/front_start.h>
#include <cases/overshoot.h>
#include <cases/temperature_slack.h>
#include <reference_fem/cut/conservative/initial_front.h>
#include <reference_fem/cut/run.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace meltfront::reference_fem::cut::conservative
{
  namespace
  {
    /** Spacings: what there is of a phase at the start is resolved if it is 2.5 deep;
     * some node is then deeper than this. */
    constexpr double least_depth = 2.5,
                     least_depth_of_node = 2.5 - 1 / std::numbers::sqrt2;

    /** Of the time in which temperatures even out across a spacing. */
    constexpr double share_of_projection = 0.04, farthest_spread = 4;
  } // namespace

  /** From the scene's front, or from the enthalpy method where it has none. */
  void ConservativeRun::start()
  {
    std::optional<cases::FrontStart> found;
    if(options.start != StartFrom::enthalpy)
    {
      const double seed = options.seed_cells * mesh.spacing;
      cases::SeedRule rule{method_name, "cells", seed, seed};
      for(const cases::Side side : scene.sides())
        if(scene.boundary(side).exact)
          rule.exempt_walls.push_back(side);
      try
      {
        found = cases::find_front_start(scene, rule);
      }
      catch(const cases::Refusal &)
      {
        if(options.start == StartFrom::scene)
          throw;
      }
    }
    const bool layers = found && layer_appears_at_once(*found),
               jumps = found && !layers && starts_with_jumps();
    if(found
       && (options.start == StartFrom::scene
           || (options.start == StartFrom::automatic && !layers && !jumps)))
    {
      start_from(*found);
      return;
    }
    before.emplace(scene, effects, resolution, mesh,
                   EnthalpyStartOptions{options.start_depth, options.start_refinement});
    unknowns = static_cast<long>(mesh.nodes.size());
    if(jumps)
    {
      before->until_smooth();
      start_in_words
          = fmt::format("fem-enthalpy with {} cells along the side until {:.6g} s, what "
                        "jumps at the start smooth over {:g} cells",
                        before->cells, before->time, options.start_depth);
      return;
    }
    Values at_start;
    if(found)
      for(const Point &node : mesh.nodes)
        at_start.push_back(found->level_set(position(node)));
    before->until_deep(std::move(at_start));
    start_in_words = fmt::format(
        "fem-enthalpy with {} cells along the side until {:.6g} s, the new phase {:.2g} "
        "to {:.2g} cells deep",
        before->cells, before->time, before->least_depth, before->most_depth);
  }

  /** The enthalpy method's steps up to the time at which it hands over. */
  void ConservativeRun::run_enthalpy()
  {
    cost_before = before->run(
        [this](const cases::Snapshot &snapshot)
        {
          if(snapshot.time < before->time)
          {
            state_before = &snapshot;
            reached(snapshot.step, snapshot.time);
            state_before = nullptr;
          }
          else
            take_over(snapshot);
        });
    entries += cost_before.work + before->search_work;
    note(time, "fem-enthalpy handed over temperature and front");
  }

  /** Heat and front of a state of the enthalpy method. */
  void ConservativeRun::take_over(const cases::Snapshot &snapshot)
  {
    time = snapshot.time;
    step_number = snapshot.step;
    const HatContents contents
        = contents_of_hats(mesh, scene.domain, scene.material, snapshot);
    try
    {
      state = front_of_areas(mesh, contents, latent_heat_of_volume(),
                             reach_of_distance * mesh.spacing);
    }
    catch(const std::runtime_error &error)
    {
      throw cases::Refusal(fmt::format(
          "fem-cut does not take over the front of fem-enthalpy at t = {:.6g}: {}", time,
          error.what()));
    }
    settle_hats();
    let_phases_appear();
    increment.assign(mesh.nodes.size(), 0);
    powers = sources.powers(time);
    boundary_heat = snapshot.heat.boundary;
    source_heat = snapshot.heat.sources;
    initial_heat = snapshot.heat.initial;
    begin_anew();
    settle_temperatures();
    take_over_temperatures(snapshot);
    check();
  }

  /** Temperatures of the heat that was handed over. Hats of which little lies in a phase
   * may hold more than temperatures within the bounds can, and what is shown beside
   * the front's foot at a wall may leave them by more than is allowed: then heat is
   * spread as far as it takes for them to keep to the bounds, or to leave them least. */
  void ConservativeRun::settle_temperatures()
  {
    const StepFrame frame(mesh, state.level_set, 1);
    even_out(frame);
    const double spacings = mesh.spacing * mesh.spacing / fastest_diffusivity();
    const double allowed = cases::temperature_slack(
        bounds, cases::allowed_overshoot(cut::overshoot, mesh.spacing, scene.domain));
    const auto excess = [&]
    {
      double largest = 0;
      const auto include = [&](double value, double beyond)
      {
        largest = std::max(
            {largest, bounds.lower - beyond - value, value - bounds.upper - beyond});
      };
      for(const CutTriangle &cut : frame.front.cut)
        for(const unsigned int node : cut.place->nodes)
          include(temperatures[state.level_set[node] < 0 ? 0 : 1][node]
                      + scene.material.melting_temperature,
                  0);
      collect_sites();
      for(const double value : sites.temperatures)
        include(value, allowed);
      return largest;
    };
    const std::array<Values, 2> handed_over = state.heat;
    std::array<Values, 2> best = state.heat, best_temperatures = temperatures;
    double least = excess();
    for(double share = 4 * share_of_projection;
        share <= farthest_spread && !(least <= tolerated_excess()); share *= 4)
    {
      state.heat = handed_over;
      temperatures = spread_heat(assembly, frame, {time, time, powers}, share * spacings,
                                 state.heat);
      if(excess() < least)
      {
        least = excess();
        best = state.heat;
        best_temperatures = temperatures;
      }
    }
    state.heat = best;
    temperatures = best_temperatures;
  }

  /** Of the site that is nearest to a node, in the node's phase; at corners of triangles
   * that the front cuts all temperatures follow from the heat: of one side's from sites
   * and the other's from heat the line between them would pass the melting temperature.
   */
  void ConservativeRun::take_over_temperatures(const cases::Snapshot &snapshot)
  {
    const Front front(mesh, state.level_set);
    std::vector<char> at_front(mesh.nodes.size(), false);
    for(const CutTriangle &cut : front.cut)
      for(const unsigned int node : cut.place->nodes)
        at_front[node] = true;
    Values nearest(mesh.nodes.size(), 2 * mesh.spacing);
    for(std::size_t site = 0; site < snapshot.temperature.size(); ++site)
    {
      const Point place(snapshot.positions[0][site], snapshot.positions[1][site]);
      const double excess
          = snapshot.temperature[site] - scene.material.melting_temperature;
      mesh.visit_nodes_near(place, mesh.spacing,
                            [&](unsigned int node)
                            {
                              const double distance = place.distance(mesh.nodes[node]);
                              if(at_front[node] || !(distance < nearest[node]))
                                return;
                              nearest[node] = distance;
                              const bool solid = state.level_set[node] < 0;
                              double value
                                  = solid ? std::min(excess, 0.) : std::max(excess, 0.);
                              if(solid && !powers.empty())
                                value -= sources.value(mesh.nodes[node], powers);
                              temperatures[solid ? 0 : 1][node] = value;
                            });
    }
  }

  void ConservativeRun::start_from(const cases::FrontStart &found)
  {
    time = found.time;
    step_number = time > scene.start_time ? 1 : 0;
    start_in_words = found.description;
    try
    {
      state = initial_front(
          mesh, [&](const Point &point) { return found.level_set(position(point)); },
          reach_of_distance * mesh.spacing);
    }
    catch(const std::runtime_error &error)
    {
      throw cases::Refusal(fmt::format("fem-cut does not resolve the front at the start "
                                       "with cells of {:.3g} m: {}",
                                       mesh.spacing, error.what()));
    }
    increment.assign(mesh.nodes.size(), 0);
    powers = sources.powers(time);
    const StepFrame frame(mesh, state.level_set, 1);
    require_resolved(frame.front);
    for(const Phase phase : phases)
    {
      const double capacity = assembly.properties(phase).volumetric_heat_capacity();
      for(unsigned int t = 0; t < mesh.triangles.size(); ++t)
        integrate(frame.front.part(t, phase),
                  [&](const Point &point, double weight)
                  {
                    const double heat = capacity * weight
                                        * (found.temperature(position(sources.off(point)))
                                           - scene.material.melting_temperature);
                    for(int i = 0; i < 3; ++i)
                      state.heat[index(phase)]
                                [mesh.triangles[t].nodes[static_cast<std::size_t>(i)]]
                          += heat * mesh.triangles[t].hat(i, point);
                  });
    }
    initial_temperatures(frame, found.temperature);
    unknowns = most_unknowns = frame.unknowns;
    initial_heat = stored_heat() + latent_heat();
    check();
    damp_jump_at_start(found.temperature);
  }

  /** Temperatures that the heat says. */
  void ConservativeRun::even_out(const StepFrame &frame)
  {
    temperatures = temperatures_of(assembly, frame, {time, time, powers},
                                   share_of_projection * mesh.spacing * mesh.spacing
                                       / fastest_diffusivity(),
                                   state.heat);
  }

  double ConservativeRun::fastest_diffusivity() const
  {
    return std::max(scene.material.solid.diffusivity(),
                    scene.material.liquid.diffusivity());
  }

  /** Of the scene at nodes of each phase; those beyond its front, and where a source is,
   * follow from its heat. */
  void ConservativeRun::initial_temperatures(
      const StepFrame &frame,
      const std::function<double(const cases::Position &)> &temperature)
  {
    even_out(frame);
    for(unsigned int t = 0; t < mesh.triangles.size(); ++t)
      for(const unsigned int node : mesh.triangles[t].nodes)
      {
        if(!mesh.triangles[t].whole || mesh.triangles[t].part.empty())
          continue;
        const Phase phase = state.level_set[node] < 0 ? Phase::solid : Phase::liquid;
        double value = temperature(position(sources.off(mesh.nodes[node])))
                       - scene.material.melting_temperature;
        if(phase == Phase::solid && !powers.empty())
          value -= sources.value(mesh.nodes[node], powers);
        if(std::isfinite(value))
          temperatures[index(phase)][node] = value;
      }
  }

  void ConservativeRun::require_resolved(const Front &front) const
  {
    std::array<double, 2> depth{};
    for(std::size_t t = 0; t < mesh.triangles.size(); ++t)
      if(front.location[t] != Location::outside)
        for(const unsigned int node : mesh.triangles[t].nodes)
        {
          double &deepest = depth[state.level_set[node] < 0 ? 0 : 1];
          deepest = std::max(deepest, std::abs(state.level_set[node]));
        }
    if(!(std::min(depth[0], depth[1]) >= least_depth_of_node * mesh.spacing))
      throw cases::Refusal(fmt::format(
          "fem-cut does not resolve the front at the start: solid is {:.3g} m deep and "
          "liquid {:.3g} m at a node, with cells of {:.3g} m; {} cells are needed",
          depth[0], depth[1], mesh.spacing, least_depth));
  }

  /** The scene's own initial state, of a run that sets out from fronts seeded later. */
  void ConservativeRun::report_uniform_start()
  {
    const Values nothing(mesh.nodes.size());
    FrontState uniform{Values(mesh.nodes.size(), reach_of_distance * mesh.spacing),
                       {nothing, nothing},
                       nothing};
    const double above = scene.initial.temperature({}, scene.start_time)
                         - scene.material.melting_temperature;
    const double capacity = scene.material.liquid.volumetric_heat_capacity();
    const Front front(mesh, uniform.level_set);
    for(unsigned int t = 0; t < mesh.triangles.size(); ++t)
      for(const unsigned int node : mesh.triangles[t].nodes)
        uniform.heat[index(Phase::liquid)][node]
            += capacity * above * front.part(t, Phase::liquid).area() / 3;
    std::swap(state, uniform);
    Temperatures of_liquid{nothing, Values(mesh.nodes.size(), above)};
    std::swap(temperatures, of_liquid);
    initial_heat = stored_heat() + latent_heat();
    reached(0, scene.start_time);
    std::swap(state, uniform);
    std::swap(temperatures, of_liquid);
    for(const cases::PointSource &source : scene.sources)
      source_heat += source.energy(time) - source.energy(scene.start_time);
  }
} // namespace meltfront::reference_fem::cut::conservative
