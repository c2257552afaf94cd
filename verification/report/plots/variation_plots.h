#ifndef meltfront_verification_report_plots_variation_plots_h
#define meltfront_verification_report_plots_variation_plots_h

#include <verification/report/chapters/variation_group.h>
#include <verification/report/plots/plot.h>

#include <string>

namespace meltfront::verification
{
  /** The error of the front of a case (root mean square over the run) over the exact
   * front at the end. */
  double relative_front_error(const StoredCase &record, const Level &level);

  /**
   * A script that draws the map of a group with two axes: for each pair of values the
   * relative error of the front on the finest level, which also gives the shade, the
   * fitted order (or what keeps the errors from having one) and, in brackets, V h/alpha
   * there.
   */
  std::string variation_map_script(const VariationGroup &group, const std::string &label);

  /** The relative error of the front against V h/alpha, every level of every case; a
   * style for each value of the first axis. */
  Plot error_against_peclet(const VariationGroup &group, const std::string &label);
} // namespace meltfront::verification

#endif
