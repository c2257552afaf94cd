#ifndef meltfront_verification_measure_formulas_front_shape_h
#define meltfront_verification_measure_formulas_front_shape_h

#include <cases/exact_solution.h>
#include <cases/scene.h>
#include <cases/snapshot.h>

#include <optional>

namespace meltfront::verification
{
  /** The volume that is solid, sum of weight x solid fraction, in the measure of the
   * scene (m, m^2, m^3). */
  double solid_volume(const cases::Snapshot &snapshot);

  /** What a domain lacks of the volume within a coordinate: that of a shell's hole (m,
   * m^2, m^3), zero for other shapes. */
  double hole_volume(cases::Symmetry symmetry, const cases::Domain &domain);

  /**
   * Amplitude of cos(m phi) in a front that goes once around the origin of a plane (m).
   *
   * With r(phi) = R + a cos(m phi), the moment of the region that the front encloses is
   * M = integral of cos(m phi) dA = pi R a, and its area is pi (R^2 + a^2/2). The
   * amplitude returned is M/(pi R_mean), where pi R_mean^2 is the enclosed area, the hole
   * of a shell included (its own moment is zero): a (1 - a^2/(4 R^2) + ...). Where liquid
   * is inside, the solid's moment counts with the opposite sign, since that of the whole
   * domain is zero: positive a always means that the front bulges at phi = 0.
   *
   * @param solid_inside whether the front encloses solid
   * @param mode m >= 1
   * @return NaN for sites on a line, and where nothing is enclosed
   */
  double front_mode_amplitude(const cases::Snapshot &snapshot,
                              const cases::Domain &domain, bool solid_inside, int mode);

  /** Number of points on the front that a snapshot holds. */
  std::size_t front_points(const cases::Snapshot &snapshot);

  /** A point on the front (m). */
  cases::Position front_point(const cases::Snapshot &snapshot, std::size_t point);

  /** How far points on the front lie from the exact front (m). */
  struct FrontDistance
  {
    double root_mean_square = 0;
    double largest = 0; ///< magnitude
  };

  /** Signed distances of a snapshot's points on the front; nothing if it holds none, or
   * the exact solution does not exist yet. */
  std::optional<FrontDistance> front_distance(const cases::Snapshot &snapshot,
                                              const cases::ExactSolution &exact);

  /** Largest less least distance of the points on the front from the origin (m); NaN for
   * fewer than two points, and for sites on a line. */
  double roundness(const cases::Snapshot &snapshot);
} // namespace meltfront::verification

#endif
