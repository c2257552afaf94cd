#include <cases/error.h>
#include <cases/overshoot.h>
#include <particles/rkpm_tracked/plane/measure.h>
#include <particles/rkpm_tracked/plane/run.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    /** A step of BDF2 that is long beside the time in which a phase evens out overshoots,
     * whatever the spacing. Beyond what is allowed it is halved as long as this leaves
     * less than a share of it; no earlier, as a new step beside bodies that meet costs
     * more heat than an overshoot does (cavity-two-sinks, n = 40: 2.6 % for 0.08 %). */
    constexpr double worth_halving_in_plane = 0.75;

    /** Three nodes across a phase: with fewer no parabola follows its temperature, and
     * bounds may break. */
    constexpr double resolved_thickness = 2;
  } // namespace

  double PlaneRun::shorten_to_bounds(double step, PlaneState &next)
  {
    const double tolerated = std::max(overshoot(state), tolerated_overshoot());
    double beyond = overshoot(next);
    while(beyond > tolerated)
    {
      PlaneState shorter;
      if(attempt(step / 2, shorter) > done)
        break;
      const double left = overshoot(shorter);
      if(left > worth_halving_in_plane * beyond)
        break;
      ++halved_steps;
      step /= 2;
      beyond = left;
      next = std::move(shorter);
    }
    return step;
  }

  double PlaneRun::tolerated_overshoot() const
  {
    const double melting = scene.material.melting_temperature;
    double lowest = melting, highest = melting;
    for(std::size_t i = 0; i < nodes.size(); ++i)
    {
      const double value = heat.temperature(state, i);
      lowest = std::min(lowest, value);
      highest = std::max(highest, value);
    }
    const double span = (std::isfinite(bounds.upper) ? bounds.upper : highest)
                        - (std::isfinite(bounds.lower) ? bounds.lower : lowest);
    return span
           * cases::allowed_overshoot(overshoot_in_plane, nodes.spacing, scene.domain);
  }

  /** By how much temperatures are beyond what bounds them, and phases beyond the melting
   * temperature (K). */
  double PlaneRun::overshoot(const PlaneState &of) const
  {
    const double melting = scene.material.melting_temperature;
    // Undercooled, capillary, or heated throughout, a phase may pass it.
    const bool stable = !cases::metastable_initial_phase(scene)
                        && heat.settings.capillarity == 0 && !scene.volumetric_source;
    double most = 0;
    for(std::size_t i = 0; i < nodes.size(); ++i)
    {
      if(of.phase[i] == NodePhase::front)
        continue;
      const double value = heat.temperature(of, i);
      most = std::max({most, bounds.lower - value, value - bounds.upper});
      if(stable)
        most = std::max(most, of.phase[i] == NodePhase::solid ? value - melting
                                                              : melting - value);
    }
    return most;
  }

  /** Says which phase nodes do not resolve, or nothing: its area over the length of the
   * fronts that bound it is its thickness beside a wall, and half of its radius where it
   * is a disk. */
  std::string PlaneRun::unresolved_phase() const
  {
    double length = 0;
    for(std::size_t c = 0; c < state.front.curves(); ++c)
      length += curve_length(state.front, c);
    if(length == 0)
      return {};
    const double solid = measure(scene, nodes, heat, state).solid_area;
    const double thinnest = std::min(solid, nodes.area - solid) / length;
    if(thinnest >= resolved_thickness * nodes.spacing)
      return {};
    return fmt::format("at t = {:.6g} the {} is {:.3g} m thick on the average, {:.2g} "
                       "spacings of nodes, and is not resolved: take n at least {:.2g} "
                       "times as large",
                       state.time, solid < nodes.area - solid ? "solid" : "liquid",
                       thinnest, thinnest / nodes.spacing,
                       resolved_thickness * nodes.spacing / thinnest);
  }

  void PlaneRun::check_resolved() const
  {
    try
    {
      check(state);
    }
    catch(const cases::NumericalError &error)
    {
      const std::string unresolved = unresolved_phase();
      if(unresolved.empty())
        throw;
      throw cases::Refusal(fmt::format("{}; {}", error.what(), unresolved));
    }
  }

  /** @throws cases::Refusal where the heat released melts or freezes away from fronts. */
  void PlaneRun::check_release(const PlaneState &checked, double scale) const
  {
    if(cases::metastable_initial_phase(scene))
      return;
    const double reach = spacings_from_fronts * nodes.spacing;
    for(std::size_t i = 0; i < nodes.size(); ++i)
    {
      if(checked.phase[i] == NodePhase::front)
        continue;
      const bool solid = checked.phase[i] == NodePhase::solid;
      const double excess
          = heat.temperature(checked, i) - scene.material.melting_temperature;
      if((solid ? excess : -excess) > beyond_by_release * scale
         && std::abs(heat.front_index().signed_distance(nodes.position[i], reach))
                >= reach)
        throw cases::Refusal(fmt::format(
            "{} follows fronts from where they start; at t = {:.6g} the heat released "
            "throughout {} at ({:.6g}, {:.6g}) away from them",
            method_name, checked.time, solid ? "melts solid" : "freezes liquid",
            nodes.position[i].x(), nodes.position[i].y()));
    }
  }

  /** By how much a node's temperature is beyond the melting temperature for its phase
   * (K). */
  double PlaneRun::beyond_melting(const PlaneState &of, std::size_t node) const
  {
    if(of.phase[node] == NodePhase::front)
      return 0;
    const double excess = heat.temperature(of, node) - scene.material.melting_temperature;
    return of.phase[node] == NodePhase::solid ? excess : -excess;
  }

  /** @throws cases::Refusal where a wall melts or freezes what no front is near;
   * metastable phases withstand what they do at the start, and as much as fronts that are
   * bent. */
  void PlaneRun::check_walls(const PlaneState &checked, double scale) const
  {
    const double reach = spacings_from_fronts * nodes.spacing;
    double most_bent = 0;
    for(const double curvature : checked.front.curvature)
      most_bent = std::max(most_bent, std::abs(curvature));
    for(const WallNode &wall : nodes.walls)
    {
      const double tolerated
          = (wall.dirichlet() ? beyond_at_held_walls : beyond_at_walls) * scale
            + withstood + heat.settings.capillarity * most_bent;
      const PlanePoint &place = nodes.position[wall.node];
      if(beyond_melting(checked, wall.node) > tolerated
         && std::abs(heat.front_index().signed_distance(place, reach)) >= reach)
        throw cases::Refusal(fmt::format(
            "{} follows fronts from where they start, in the plane; at t = {:.6g} the "
            "wall {} at ({:.6g}, {:.6g}) away from them",
            method_name, checked.time,
            checked.phase[wall.node] == NodePhase::solid ? "melts solid"
                                                         : "freezes liquid",
            place.x(), place.y()));
    }
  }

  void PlaneRun::check(const PlaneState &checked) const
  {
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for(std::size_t i = 0; i < nodes.size(); ++i)
    {
      if(checked.phase[i] == NodePhase::front)
        continue;
      const double value = heat.temperature(checked, i);
      if(!std::isfinite(value)) // comparisons pass over what is not a number
      {
        lowest = highest = value;
        break;
      }
      lowest = std::min(lowest, value);
      highest = std::max(highest, value);
    }
    cases::require_sinks(scene, checked.time, method_name);
    const double melting = scene.material.melting_temperature,
                 scale = std::max(highest - melting, melting - lowest);
    check_walls(checked, scale);
    if(scene.volumetric_source)
      check_release(checked, scale);
    cases::check_temperature(
        bounds, lowest, highest, method_name, step_number, checked.time,
        cases::allowed_overshoot(overshoot_in_plane, nodes.spacing, scene.domain));
    for(const PlanePoint &place : heat.sinks.places)
      if(!(heat.front_index().signed_distance(place, nodes.spacing) < 0))
        throw cases::Refusal(fmt::format(
            "rkpm-tracked: the source at ({:.6g}, {:.6g}) does not lie in the "
            "solid at time {:.6g}",
            place.x(), place.y(), checked.time));
  }
} // namespace meltfront::particles::rkpm_tracked
