#include <cases/error.h>
#include <verification/measure/checks/front_phases.h>
#include <verification/measure/checks/snapshot_checks.h>
#include <verification/measure/formulas/site_coordinates.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    /** Within so many spacings of a wall or a source a front begins there. */
    constexpr double spacings_to_origin = 2;
  } // namespace

  void SnapshotChecks::judge_phase(const cases::Snapshot &snapshot)
  {
    if(!entries[phase].reason.empty())
      return;
    const double tolerance
        = entries[principle].bound * span()
          + same_temperature
                * std::max({std::abs(lowest_seen), std::abs(highest_seen),
                            temperature_of_melting()})
          + capillary_shift;
    const MetastableSites found = finder.find(snapshot, tolerance);
    if(add(phase, found.share))
      return;
    refuse_unnamed_front(snapshot, found);
    end_run(
        snapshot, "phase",
        fmt::format("is {} at {}, {:.3g} K {} its melting temperature; so is {:.3g} of "
                    "the domain, away from fronts",
                    found.solid ? "solid" : "liquid",
                    place_text(site_position(snapshot, found.site), snapshot.dimension),
                    found.beyond, found.solid ? "above" : "below", found.share));
  }

  /** Whether what is released at a place warms a solid, or cools a liquid. That of an
   * exact solution melts and freezes at its fronts only. */
  bool SnapshotChecks::releases_towards(bool solid, const cases::Position &place,
                                        double time) const
  {
    if(!scene.volumetric_source || scene.volumetric_source->expression == "exact")
      return false;
    const double released = (*scene.volumetric_source)(place, time);
    return solid ? released > 0 : released < 0;
  }

  void SnapshotChecks::refuse_unnamed_front(const cases::Snapshot &snapshot,
                                            const MetastableSites &found) const
  {
    using cases::FrontOrigin;
    const cases::Position place = site_position(snapshot, found.site);
    const double reach = spacings_to_origin * spacing;
    const bool at_source = std::ranges::any_of(
        scene.sources,
        [&](const cases::PointSource &source)
        {
          const cases::Position at = source.at(snapshot.time);
          return std::hypot(at[0] - place[0], at[1] - place[1], at[2] - place[2])
                 <= reach;
        });
    const PhasesPresent present = phases_present(snapshot);
    std::string what;
    if(at_source && !capabilities.takes(FrontOrigin::source))
      what = "fronts that set out from a source";
    else if(!at_source && distance_from_wall(scene.domain, place) <= reach
            && !capabilities.takes(FrontOrigin::wall))
      what = "fronts that set out from a wall";
    else if(capabilities.most_fronts == 1 && present.solid && present.liquid)
      what = "a second front";
    else if(tracks_front && releases_towards(found.solid, place, snapshot.time))
      what = "fronts that set out where heat is released throughout";
    else
      return;
    throw cases::Refusal(fmt::format(
        "{} does not simulate {}; at t = {:.6g} the {} at {} is {:.3g} K {} its melting "
        "temperature",
        method, what, snapshot.time, found.solid ? "solid" : "liquid",
        place_text(place, snapshot.dimension), found.beyond,
        found.solid ? "above" : "below"));
  }

  void SnapshotChecks::judge_front(const cases::Snapshot &snapshot)
  {
    if(!entries[front].reason.empty() || !tracks_front)
      return;
    if(snapshot.front[0].empty())
    {
      const PhasesPresent present = phases_present(snapshot);
      if(!add(front, present.solid && present.liquid))
        end_run(snapshot, "front", "is not reported, and there are both phases");
      return;
    }
    const StrayPoints stray = stray_points(scene.domain, snapshot, spacing);
    if(!add(front, stray.share))
      end_run(snapshot, "front",
              fmt::format("is reported at {}, where no phase changes",
                          place_text(stray.first, snapshot.dimension)));
  }
} // namespace meltfront::verification
