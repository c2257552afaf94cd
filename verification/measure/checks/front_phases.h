#ifndef meltfront_verification_measure_checks_front_phases_h
#define meltfront_verification_measure_checks_front_phases_h

#include <cases/scene.h>
#include <cases/snapshot.h>

namespace meltfront::verification
{
  /** Whether sites of a snapshot that stand for a volume are solid, or liquid, at least
   * in part. */
  struct PhasesPresent
  {
    bool solid = false;
    bool liquid = false;
  };

  PhasesPresent phases_present(const cases::Snapshot &snapshot);

  /** Tracked points of a front beside which no phase changes. */
  struct StrayPoints
  {
    double share = 0; ///< of all tracked points
    cases::Position first{};
  };

  /**
   * Looks for solid and liquid in the cubes, three spacings wide, around each tracked
   * point (Snapshot::front). Within a spacing of a wall a layer may be too thin for any
   * site.
   *
   * @param spacing of the sites (m)
   */
  StrayPoints stray_points(const cases::Domain &domain, const cases::Snapshot &snapshot,
                           double spacing);

  /** Distance of a point from the nearest wall of a domain (m). */
  double distance_from_wall(const cases::Domain &domain, const cases::Position &point);
} // namespace meltfront::verification

#endif
