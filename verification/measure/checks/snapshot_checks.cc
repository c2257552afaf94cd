#include <cases/error.h>
#include <cases/numbers.h>
#include <cases/overshoot.h>
#include <verification/measure/checks/scene_quadrature.h>
#include <verification/measure/checks/snapshot_checks.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    using cases::infinity;

    /** A front that is to be resolved bends no more than a body this many spacings
     * across. */
    constexpr double smallest_body = 4;

    /** Relative to the heat at hand: what is summed in another order. */
    constexpr double sum_of_round_off = 1e-9;

    /** The same of an alloy: crystals and liquid of a site differ a little in
     * temperature, and the site has the mean of both. */
    constexpr double site_of_two_temperatures = 1e-3;

    /** Spacings: sites in disorder sample a release at places that far from the middles
     * of what they stand for, on either side. */
    constexpr double spacings_of_sampling = 2;

    /** Share of the domain in a layer one spacing thick along its walls: as much may lie
     * between a curved wall and the volumes of the sites at it. */
    double layer_of_walls(const cases::Scene &scene, double spacing)
    {
      double area = 0;
      for(const cases::Side side : scene.sides())
        area += area_of(scene.domain, side);
      return spacing * area / volume_of(scene.domain);
    }

    /** A mesh has straight cells along a wall that bends. */
    bool meshes_curve(const cases::Scene &scene)
    {
      return scene.symmetry == cases::Symmetry::none
             && (scene.domain.round() || scene.domain.outline);
    }
  } // namespace

  SnapshotChecks::SnapshotChecks(const cases::Scene &scene,
                                 const cases::Capabilities &capabilities,
                                 const std::string &method, double spacing)
    : scene(scene)
    , capabilities(capabilities)
    , method(method)
    , spacing(spacing)
    , finder(scene, spacing)
    , given(scene)
    , lowest_seen(infinity)
    , highest_seen(-infinity)
    , capillary_shift(scene.material.gibbs_thomson_coefficient
                      * (std::max(scene.domain.dimension, 2) - 1) * 2
                      / (smallest_body * spacing))
    , entries{{.name = "phase against temperature"},
              {.name = "maximum principle"},
              {.name = "heat of sites"},
              {.name = "heat balance"},
              {.name = "heat of walls",
               .bound = given.walls_vary || meshes_curve(scene)
                            ? spacing / scene.domain.side()
                            : integral_of_round_off},
              {.name = "heat of sources",
               .bound = sites_are_cut() ? layer_of_walls(scene, spacing)
                        : given.sources_vary
                            ? spacings_of_sampling * spacing / scene.domain.side()
                            : integral_of_round_off},
              {.name = "front against phases"}}
  {
    principle_bounds = bounds_of_scene();
    if(!scene.changes_phase())
      entries[phase].reason = entries[front].reason = "no phase changes";
    else if(const cases::MetastableStart start = cases::metastable_start(scene);
            start.undercooling > 0 && start.superheat > 0)
      entries[phase].reason = "both phases are metastable at the start";
    entries[heat_of_walls].reason = given.unknown_walls;
    entries[heat_of_sources].reason = given.unknown_sources;
    if(scene.problem == cases::ProblemKind::poisson)
      entries[heat_of_sites_].reason = entries[balance].reason
          = "a steady state stores nothing";
  }

  void SnapshotChecks::judge(const cases::Snapshot &snapshot)
  {
    require_finite(snapshot);
    if(snapshot.step == 0 && scene.problem != cases::ProblemKind::poisson)
      include_initial(snapshot);
    const auto [lowest, highest] = std::ranges::minmax(snapshot.temperature);
    lowest_seen = std::min(lowest_seen, lowest);
    highest_seen = std::max(highest_seen, highest);
    tracks_front |= !snapshot.front[0].empty();
    entries[principle].bound
        = snapshot.obeys_maximum_principle
              ? cases::overshoot_of_round_off
              : cases::allowed_overshoot(capabilities.overshoot, spacing, scene.domain);
    entries[heat_of_sites_].bound = sites_are_cut() ? layer_of_walls(scene, spacing)
                                    : scene.alloy   ? site_of_two_temperatures
                                                    : sum_of_round_off;
    // The temperature of a layer of some dozen particles fluctuates: nothing bounds it,
    // nor does its phase follow it.
    if(scene.particle_solid && !snapshot.heat.conservative)
      entries[principle].reason = entries[phase].reason
          = "the temperature of few particles fluctuates";
    judge_known_properties(snapshot);
    judge_principle(snapshot);
    judge_phase(snapshot);
    judge_heat(snapshot);
    judge_front(snapshot);
  }

  void SnapshotChecks::require_finite(const cases::Snapshot &snapshot) const
  {
    const auto finite = [](double value) { return std::isfinite(value); };
    if(!std::ranges::all_of(snapshot.temperature, finite))
      end_run(snapshot, "temperature", "is not finite");
    if(!std::ranges::all_of(snapshot.solid_fraction, finite))
      end_run(snapshot, "solid fraction", "is not finite");
    if(snapshot.heat.conservative && !std::isfinite(snapshot.heat.defect()))
      end_run(snapshot, "heat budget", "is not finite");
  }

  bool SnapshotChecks::add(Kind kind, double value)
  {
    entries[kind].value = std::max(entries[kind].value.value_or(0), value);
    return value <= entries[kind].bound;
  }

  void SnapshotChecks::end_run(const cases::Snapshot &snapshot,
                               const std::string &quantity,
                               const std::string &problem) const
  {
    throw cases::NumericalError(method, snapshot.step, snapshot.time, quantity, problem);
  }

  std::vector<Check> SnapshotChecks::checks() const
  {
    std::vector<Check> result;
    for(const Entry &entry : entries)
      if(entry.value)
        result.push_back(
            {entry.name, *entry.value, entry.bound, *entry.value <= entry.bound});
    return result;
  }

  std::map<std::string, std::string> SnapshotChecks::unchecked() const
  {
    std::map<std::string, std::string> result;
    for(const Entry &entry : entries)
      if(!entry.value)
        result[entry.name] = entry.reason.empty()
                                 ? "the method reports no points of a front"
                                 : entry.reason;
    return result;
  }
} // namespace meltfront::verification
