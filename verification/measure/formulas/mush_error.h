#ifndef meltfront_verification_measure_formulas_mush_error_h
#define meltfront_verification_measure_formulas_mush_error_h

#include <cases/exact_solution.h>
#include <cases/snapshot.h>

#include <span>

namespace meltfront::verification
{
  /** Errors of an alloy's state at one time; NaN where there is nothing to compare. */
  struct MushError
  {
    /** sqrt(sum w (T - T_exact)^2 / sum w) with the sites' volumes w (K) */
    double temperature_rms;
    /** the same of the mass fraction of solid */
    double solid_fraction_rms;
    /** the same of the liquid's mass fraction of the first solute, over sites that hold
     * liquid in both */
    double concentration_rms;
    /** |solid - exact solid| / exact solid, of the volume whose mass is solid */
    double ice_error;
  };

  /** Mass fraction of a solute in the liquid of a site; NaN where there is none. */
  double liquid_concentration(double concentration, double solid_fraction);

  /**
   * Compare a snapshot with the exact solution at the snapshot's time, between the
   * coordinates `from` and `to` (m); solid is counted between `lower` and `upper`, the
   * ends of the domain.
   *
   * @param coordinates of the sites (x or r, m)
   */
  MushError mush_error(const cases::Snapshot &snapshot,
                       std::span<const double> coordinates,
                       const cases::ExactSolution &exact, double from, double to,
                       double lower, double upper);
} // namespace meltfront::verification

#endif
