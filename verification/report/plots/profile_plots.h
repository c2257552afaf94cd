#ifndef meltfront_verification_report_plots_profile_plots_h
#define meltfront_verification_report_plots_profile_plots_h

#include <verification/report/page/case_runs.h>
#include <verification/report/plots/plot.h>

namespace meltfront::verification
{
  /** What a profile shows over the coordinate. */
  enum class ProfileQuantity
  {
    temperature,
    solid_fraction, ///< by mass: the share of the latent heat that is lost
    concentration   ///< of the first solute in the liquid, by mass
  };

  /** Number of the profile at the end, where profiles at intermediate times count from 0.
   */
  inline constexpr int profile_at_end = -1;

  /**
   * A quantity over the coordinate at an intermediate time or at the end: the finest run
   * of every label, and the exact one where it is known.
   */
  Plot profile_plot(const CaseRuns &runs, const MethodStyles &styles,
                    ProfileQuantity quantity, int intermediate = profile_at_end);

  /** Temperature of one run at the end over its coordinate, with the exact one. */
  Plot run_profile(const RunRecord &run, const StoredCase &record);
} // namespace meltfront::verification

#endif
