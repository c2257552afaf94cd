#include <particles/rkpm_tracked/plane/measure.h>
#include <particles/rkpm_tracked/plane/run.h>
#include <particles/rkpm_tracked/plane/topology.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    /** After fronts met, so many steps pass before any meet again: the new neck is to
     * open first. Bodies that overlap meanwhile count as one anyway. */
    constexpr long steps_between_meetings = 4;

    /** Changes of a node's solid fraction that count as a place where something
     * happened. */
    constexpr double noticeable = 0.02;

    /** Of the heat that flows to the front, the part from which on ripples are spoken
     * of. */
    constexpr double noticeable_drive = 0.1;

    /** Particles of curves that are farther from all new curves, in spacings, are of none
     * of these. */
    constexpr double gone = 0.25;

    /** Rate at which bodies shrank whose curves are no more (m^2/s). */
    double shrinking_rate(const PlaneFront &before, const FrontIndex &now, double spacing)
    {
      double rate = 0;
      for(std::size_t c = 0; c < before.curves(); ++c)
        for(std::size_t p = before.offsets[c]; p < before.offsets[c + 1]; ++p)
        {
          const PlanePoint &place = before.position[p];
          if(before.active[p]
             && std::abs(now.signed_distance(place, spacing)) > gone * spacing)
            rate += std::abs(before.speed[p])
                    * ((before.position[before.next(c, p)] - place).norm()
                       + (before.position[before.previous(c, p)] - place).norm())
                    / 2;
        }
      return rate;
    }
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
    const double due = before.sensible + before.latent + lost_heat(state);
    const double rate = shrinking_rate(
        state.front, FrontIndex(front, solid_beyond, nodes.spacing), nodes.spacing);
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
    const double missing = book_heat(state, scene, nodes, heat, places, due);
    unbooked_heat += missing;
    const double energy = scene.material.solid.density * scene.material.latent_heat
                          * (after.solid_area - before.solid_area);
    decreed_heat += std::abs(energy);
    for(const TopologyEvent &change : changes)
    {
      if(!change.vanished)
        next_meeting = step_number + steps_between_meetings;
      events.emplace_back(state.time, change.what);
    }
    const double area = after.solid_area - before.solid_area;
    if(std::ranges::any_of(changes, &TopologyEvent::vanished))
      vanished.push_back({state.time, std::abs(area), rate});
    events.back().second
        += fmt::format("; {:.3g} m^2 {} by that, of {:.3g} J/m latent heat {:.3g} J/m "
                       "are missing in the nodes about it",
                       std::abs(area), area > 0 ? "froze" : "melted", energy, missing);
    older.reset();
    restarted = true;
  }

  /** Of the bodies that went at once, what may still be there (m^2). */
  double PlaneRun::vanished_area() const
  {
    double area = 0;
    for(const VanishedBodies &bodies : vanished)
      area += std::max(0., bodies.area - bodies.rate * (state.time - bodies.time));
    return area;
  }

  /** Once: whether ripples of the front grow. One of wave number k does where, n into the
   * solid, k_l dT_l/dn + k_s dT_s/dn > (k_s + k_l) T_m Gamma k^2 (Mullins and Sekerka
   * 1963, quasi-steady, plane). */
  void PlaneRun::warn_of_ripples()
  {
    if(warned_of_ripples)
      return;
    const cases::Material &material = scene.material;
    const double k_solid = material.solid.conductivity,
                 k_liquid = material.liquid.conductivity;
    const PlaneFront &front = state.front;
    double drive = 0, flow = 0;
    std::size_t worst = 0;
    for(std::size_t p = 0; p < front.size(); ++p)
    {
      if(!front.active[p])
        continue;
      const PlanePoint solid = state.expansion[1].gradient[p]
                               + heat.sinks.gradient(front.position[p], state.time);
      const double from_solid = k_solid * solid.dot(front.normal[p]),
                   from_liquid
                   = k_liquid * state.expansion[0].gradient[p].dot(front.normal[p]);
      flow = std::max({flow, std::abs(from_solid), std::abs(from_liquid)});
      if(from_solid + from_liquid > drive)
      {
        drive = from_solid + from_liquid;
        worst = p;
      }
    }
    if(drive <= noticeable_drive * flow)
      return;
    warned_of_ripples = true;
    const double shortest
        = 2 * std::numbers::pi
          * std::sqrt((k_solid + k_liquid) * heat.settings.capillarity / drive);
    events.emplace_back(
        state.time,
        fmt::format(
            "the front grows into undercooled liquid or superheated solid at "
            "({:.6g}, {:.6g}): ripples longer than {:.3g} m grow there, {}",
            front.position[worst].x(), front.position[worst].y(), shortest,
            shortest > 0
                ? fmt::format("{:.3g} spacings", shortest / nodes.spacing)
                : "for want of a Gibbs-Thomson coefficient the faster the shorter "
                  "they are; only short times mean anything, and finer nodes make "
                  "it worse"));
  }

  /** Phases of the nodes by the new curves. One that changed its own without a front that
   * passed over it is at the front's temperature: beyond where the front was, its new
   * phase has no past. */
  void PlaneRun::settle_nodes()
  {
    const std::vector<NodePhase> before = state.phase;
    heat.set_front(state);
    for(std::size_t i = 0; i < nodes.size(); ++i)
      if(state.phase[i] != before[i])
        state.unknown[i] = heat.front_temperature_near(i)
                           - (state.phase[i] == NodePhase::solid
                                  ? heat.sinks.value(nodes.position[i], state.time)
                                  : 0);
  }
} // namespace meltfront::particles::rkpm_tracked
