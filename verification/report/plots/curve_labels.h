#ifndef meltfront_verification_report_plots_curve_labels_h
#define meltfront_verification_report_plots_curve_labels_h

#include <verification/report/plots/plot.h>

namespace meltfront::verification
{
  /**
   * Shorten the labels of a plot's curves to what tells them apart: where several are
   * forms of one method, the options in which they differ stand for the label, as `bdf2`
   * or `degree=2` (the key of a word says nothing more than the word).
   */
  void shorten_labels(Plot &plot);
} // namespace meltfront::verification

#endif
