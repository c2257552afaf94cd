#include <particles/rkpm_tracked/plane/measure.h>
#include <particles/rkpm_tracked/plane/run.h>

#include <fmt/format.h>

#include <algorithm>

namespace meltfront::particles::rkpm_tracked
{
  cases::RunDescription PlaneRun::describe() const
  {
    cases::RunDescription result;
    result.dimension = 2;
    result.spacing = nodes.spacing;
    result.time_step = (scene.end_time - scene.start_time) / parameters.steps;
    result.unknowns = static_cast<long>(nodes.size() + front_at_start);
    result.parameters
        = {{"start", start_in_words, ""},
           {"nodes", fmt::format("{}", nodes.size()), "1"},
           {"basis order", fmt::format("{}", parameters.basis_order), "1"},
           {"time scheme",
            parameters.time_scheme == TimeScheme::bdf2 ? "bdf2" : "backward-euler", ""}};
    if(!before)
      result.parameters.insert(
          result.parameters.end(),
          {{"front particles at the start", fmt::format("{}", front_at_start), "1"},
           {"largest condition number of moment matrices at the front's start",
            fmt::format("{:.3g}", condition), "1"}});
    return result;
  }

  cases::Cost PlaneRun::cost() const
  {
    cases::Cost cost;
    cost.steps = step_number;
    cost.unknowns = static_cast<long>(heat.most_unknowns);
    cost.work = heat.entries + cost_before.work + (before ? before->search_work : 0);
    cost.solver_iterations = heat.solves;
    cost.most_iterations = most_passes;
    cost.capped_steps = capped_steps;
    cost.effects = effect_costs();
    cost.evidence = evidence();
    return cost;
  }

  void PlaneRun::report()
  {
    for(const auto &[time, event] : events)
      note(time, event);
    events.clear();
    reached(step_number, state.time);
  }

  /** The scene's own initial state, also where the run starts from a front that was
   * seeded later: all of it is liquid then. */
  void PlaneRun::report_initial()
  {
    std::optional<PlaneState> seeded;
    if(state.time > scene.start_time)
    {
      seeded = std::exchange(state, {});
      state.time = scene.start_time;
      state.phase.assign(nodes.size(), NodePhase::liquid);
      for(const PlanePoint &place : nodes.position)
        state.unknown.push_back(
            scene.initial.temperature(position_of(place), scene.start_time));
    }
    measured = measure(scene, nodes, heat, state);
    initial_heat = measured.sensible + measured.latent;
    reached(0, scene.start_time);
    if(seeded)
    {
      state = *std::move(seeded);
      balance_seed();
    }
  }

  cases::Snapshot PlaneRun::snapshot(long step, double time)
  {
    if(state_before)
      return *state_before;
    measured = measure(scene, nodes, heat, state);
    for(int d = 0; d < 2; ++d)
    {
      site_positions[d].clear();
      front_positions[d].clear();
      for(const PlanePoint &place : nodes.position)
        site_positions[d].push_back(place[d]);
      for(std::size_t p = 0; p < state.front.size(); ++p)
        if(state.front.active[p])
          front_positions[d].push_back(state.front.position[p][d]);
    }
    cases::Snapshot snapshot;
    snapshot.step = step;
    snapshot.time = time;
    snapshot.dimension = 2;
    for(int d = 0; d < 2; ++d)
    {
      snapshot.positions[d] = site_positions[d];
      snapshot.front[d] = front_positions[d];
    }
    snapshot.weights = nodes.weight;
    snapshot.temperature = measured.temperature;
    snapshot.solid_fraction = measured.solid_fraction;
    snapshot.obeys_maximum_principle = false;
    snapshot.vanished_volume = vanished_area();
    snapshot.heat
        = {measured.sensible, measured.latent, state.wall_heat + state.flux_heat,
           heat.sinks.energy(state.time) + state.released_heat, initial_heat};
    return snapshot;
  }

  std::vector<cases::EffectCost> PlaneRun::effect_costs() const
  {
    std::vector<cases::EffectCost> result;
    for(const cases::EffectDecision &decision : effects.decisions())
      if(decision.on)
      {
        result.push_back(heat.cost(decision.effect));
        for(const cases::EffectCost &first : cost_before.effects)
          if(first.effect == decision.effect)
          {
            result.back().calls += first.calls;
            result.back().bytes = std::max(result.back().bytes, first.bytes);
            result.back().seconds += first.seconds;
          }
      }
    return result;
  }

  std::map<std::string, double> PlaneRun::evidence() const
  {
    std::map<std::string, double> result{
        {"steps halved", double(halved_steps)},
        {"singular matrices, met by halving the step", double(heat.singular)},
        {"steps taken with 1e-4 to 1e-2 spacings left to move", double(capped_steps)},
        {"largest heat that the balance adds, of what flows to the front",
         largest_multiplier},
        {"heat that start and events leave out of the balance (J/m)", unbooked_heat},
        {"latent heat of areas that changed phase by decree (J/m)", decreed_heat},
        {"largest distance of level set and front particles, in spacings", mismatch}};
    if(before)
    {
      result["time at which sph handed over (s)"] = before->time;
      result["heat by which what it handed over was off (J/m)"] = handed_over_heat;
    }
    return result;
  }
} // namespace meltfront::particles::rkpm_tracked
