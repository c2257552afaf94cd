#include <particles/front_tracking/plane_measure.h>
#include <particles/front_tracking/plane_run.h>
#include <particles/front_tracking/plane_topology.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::front_tracking
{
  namespace
  {
    /** After fronts met, so many steps pass before any meet again: the new neck is to
     * open first. Bodies that overlap meanwhile count as one anyway. */
    constexpr long steps_between_meetings = 4;

    /** Changes of a node's solid fraction that count as a place where something
     * happened. */
    constexpr double noticeable = 0.02;
  } // namespace

  TopologySettings PlaneRun::topology_settings() const
  {
    TopologySettings settings;
    settings.spacing = nodes.spacing;
    settings.front_spacing = front_spacing * nodes.spacing;
    settings.join = step_number >= next_meeting;
    return settings;
  }

  /** Fronts that met or vanished: their latent heat goes into the nodes, and the next
   * step begins anew. */
  void PlaneRun::follow_topology()
  {
    PlaneFront front = state.front;
    bool solid_beyond = heat.settings.solid_beyond;
    const std::vector<TopologyEvent> changes
        = update_topology(front, nodes, marked, solid_beyond, topology_settings());
    if(changes.empty())
      return;
    const PlaneMeasure before = measure(scene, nodes, heat, state);
    state.front = std::move(front);
    heat.settings.solid_beyond = solid_beyond;
    heat.mark_active(state.front);
    PlaneMeasure after = measure(scene, nodes, heat, state);
    std::vector<PlanePoint> places;
    for(std::size_t i = 0; i < nodes.size(); ++i)
      if(std::abs(after.solid_fraction[i] - before.solid_fraction[i]) > noticeable)
        places.push_back(nodes.position[i]);
    // The new curves are to enclose what the old ones did; what they cannot is booked.
    add_solid(state.front, places, before.solid_area - after.solid_area, nodes.spacing);
    heat.mark_active(state.front);
    after = measure(scene, nodes, heat, state);
    marked.seed(state.front, solid_beyond);
    settle_nodes();
    const double energy = scene.material.solid.density * scene.material.latent_heat
                          * (after.solid_area - before.solid_area);
    const double booked = book_latent_heat(state, scene, nodes, heat, places, energy);
    decreed_heat += std::abs(energy);
    for(const TopologyEvent &change : changes)
    {
      if(!change.vanished)
        next_meeting = step_number + steps_between_meetings;
      events.emplace_back(state.time, change.what);
    }
    const double area = after.solid_area - before.solid_area;
    events.back().second
        += fmt::format("; {:.3g} m^2 {} by that, of {:.3g} J/m latent heat {:.3g} J/m "
                       "went into the nodes about it",
                       std::abs(area), area > 0 ? "froze" : "melted", energy, booked);
    older.reset();
    fresh = true;
  }

  /** Nodes that changed their phase without a front that passed over them are at the
   * melting temperature: beyond where the front was, their new phase has no past. */
  void PlaneRun::settle_nodes()
  {
    const double absorbed = parameters.absorption * nodes.spacing;
    const FrontIndex index(state.front, heat.settings.solid_beyond, nodes.spacing);
    for(std::size_t i = 0; i < nodes.size(); ++i)
    {
      const PlanePoint &place = nodes.position[i];
      const double distance = index.signed_distance(place, nodes.spacing);
      const NodePhase phase = distance < 0 ? NodePhase::solid : NodePhase::liquid;
      const double kept = state.phase[i] == NodePhase::front ? 1.5 * absorbed : absorbed;
      if(state.phase[i] == phase || std::abs(distance) < kept)
        continue;
      state.phase[i] = phase;
      state.unknown[i]
          = scene.material.melting_temperature
            - (phase == NodePhase::solid ? heat.sinks.value(place, state.time) : 0);
    }
  }
} // namespace meltfront::particles::front_tracking
