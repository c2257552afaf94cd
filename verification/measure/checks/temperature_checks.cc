#include <verification/measure/checks/snapshot_checks.h>
#include <verification/measure/formulas/site_coordinates.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  /** A scene's bounds, and with capillarity those that follow from the temperature of
   * its fronts. */
  cases::TemperatureBounds SnapshotChecks::bounds_of_scene() const
  {
    if(capillary_shift == 0)
      return cases::temperature_bounds(scene);
    cases::Scene straight = scene;
    straight.material.gibbs_thomson_coefficient = 0;
    cases::TemperatureBounds bounds = cases::temperature_bounds(straight);
    const double melting = scene.material.melting_temperature;
    bounds.lower = std::min(bounds.lower, melting - capillary_shift);
    bounds.upper = std::max(bounds.upper, melting + capillary_shift);
    return bounds;
  }

  const cases::TemperatureBounds &SnapshotChecks::bounds() const
  {
    return principle_bounds;
  }

  /** The scene's bounds are sampled: the extremes of its initial temperature may lie at
   * sites between the samples. */
  void SnapshotChecks::include_initial(const cases::Snapshot &snapshot)
  {
    for(std::size_t i = 0; i < snapshot.temperature.size(); ++i)
    {
      const double value
          = scene.initial.temperature(site_position(snapshot, i), scene.start_time);
      if(!std::isfinite(value))
        continue;
      principle_bounds.lower = std::min(principle_bounds.lower, value);
      principle_bounds.upper = std::max(principle_bounds.upper, value);
    }
    if(scene.alloy)
      include_liquidus(snapshot);
  }

  /** Mush from which solute spreads may become colder than anything was, but not colder
   * than the liquidus of the largest concentration at hand. */
  void SnapshotChecks::include_liquidus(const cases::Snapshot &snapshot)
  {
    if(std::ranges::none_of(scene.alloy->solutes, [](const cases::Solute &solute)
                            { return solute.diffusivity > 0; }))
      return;
    const cases::PhaseDiagram diagram(scene.material, *scene.alloy);
    const auto &[first, second] = snapshot.concentration;
    for(std::size_t i = 0; i < snapshot.temperature.size(); ++i)
      principle_bounds.lower = std::min(
          principle_bounds.lower,
          diagram.liquidus(first.empty() ? 0 : first[i], second.empty() ? 0 : second[i]));
  }

  double SnapshotChecks::span() const
  {
    if(std::isfinite(principle_bounds.upper - principle_bounds.lower))
      return principle_bounds.upper - principle_bounds.lower;
    double lowest = lowest_seen, highest = highest_seen;
    if(scene.changes_phase())
    {
      lowest = std::min(lowest, scene.material.melting_temperature);
      highest = std::max(highest, scene.material.melting_temperature);
    }
    return highest - lowest;
  }

  /** What latent heat is worth (K): a state at rest may be 0 throughout. */
  double SnapshotChecks::temperature_of_melting() const
  {
    const cases::Material &material = scene.material;
    return scene.changes_phase() ? material.latent_heat
                                       / std::max(material.solid.specific_heat_capacity,
                                                  material.liquid.specific_heat_capacity)
                                 : 0;
  }

  void SnapshotChecks::judge_known_properties(const cases::Snapshot &snapshot) const
  {
    if(!scene.material.curves)
      return;
    const auto [first, last] = scene.material.known_temperatures();
    const double slack = entries[principle].bound * span();
    const auto [lowest, highest] = std::ranges::minmax(snapshot.temperature);
    if(lowest < first - slack || highest > last + slack)
      end_run(
          snapshot, "temperature",
          fmt::format("ranges from {:.6g} to {:.6g}, and the material's properties are "
                      "known from {:.6g} to {:.6g} only",
                      lowest, highest, first, last));
  }

  void SnapshotChecks::judge_principle(const cases::Snapshot &snapshot)
  {
    if(!entries[principle].reason.empty())
      return;
    if(!std::isfinite(principle_bounds.lower) && !std::isfinite(principle_bounds.upper))
    {
      entries[principle].reason = "the scene bounds no temperature";
      return;
    }
    const auto [lowest, highest] = std::ranges::minmax_element(snapshot.temperature);
    const double below = principle_bounds.lower - *lowest;
    const double above = *highest - principle_bounds.upper;
    const double same
        = same_temperature
          * std::max({std::abs(*lowest), std::abs(*highest), temperature_of_melting()});
    const double beyond = std::max(below, above);
    const double value = beyond <= same ? 0 : beyond / span();
    if(add(principle, value))
      return;
    const bool cold = below > above;
    const auto worst = cold ? lowest : highest;
    end_run(
        snapshot, "temperature",
        fmt::format(
            "is {:.9g} at {}, {} value {:.9g} by {:.3g} of the span of the "
            "bounds, more than {:.3g} (maximum principle)",
            *worst,
            place_text(site_position(snapshot, static_cast<std::size_t>(
                                                   worst - snapshot.temperature.begin())),
                       snapshot.dimension),
            cold ? "below the lowest initial and wall"
                 : "above the highest initial and wall",
            cold ? principle_bounds.lower : principle_bounds.upper, value,
            entries[principle].bound));
  }
} // namespace meltfront::verification
