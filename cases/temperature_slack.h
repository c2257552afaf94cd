#ifndef meltfront_cases_temperature_slack_h
#define meltfront_cases_temperature_slack_h

#include <cases/scene.h>

#include <algorithm>
#include <cmath>

namespace meltfront::cases
{
  /** By how much temperatures may pass bounds because numbers are rounded, in thousands
   * of steps and in systems that are solved for them: 1e-9 of the larger of those that
   * are finite. Their span, to which other slacks are related, says nothing of it: a body
   * at rest has none. */
  inline double temperature_round_off(const TemperatureBounds &bounds)
  {
    double largest = 0;
    for(const double bound : {bounds.lower, bounds.upper})
      if(std::isfinite(bound))
        largest = std::max(largest, std::abs(bound));
    return 1e-9 * largest;
  }

  /** By how much temperatures may pass bounds: a share of their span, of `open_span`
   * where one of them is infinite, and round-off (K). */
  inline double temperature_slack(const TemperatureBounds &bounds, double share,
                                  double open_span = 0)
  {
    const double span = bounds.upper - bounds.lower;
    return share * (std::isfinite(span) ? span : open_span)
           + temperature_round_off(bounds);
  }
} // namespace meltfront::cases

#endif
