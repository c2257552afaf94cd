#ifndef meltfront_cases_overshoot_h
#define meltfront_cases_overshoot_h

#include <cases/capabilities.h>
#include <cases/scene.h>

#include <algorithm>
#include <cmath>

namespace meltfront::cases
{
  /** Share of their span by which temperatures pass bounds by round-off alone. */
  inline constexpr double overshoot_of_round_off = 1e-9;

  /**
   * Share of the bounds' span by which temperatures may pass them at a spacing h (m):
   * at_twenty (20 h / side)^order, at least round-off.
   */
  inline double allowed_overshoot(const Overshoot &overshoot, double spacing,
                                  const Domain &domain)
  {
    return std::max(overshoot_of_round_off,
                    overshoot.at_twenty
                        * std::pow(20 * spacing / domain.side(), overshoot.order));
  }
} // namespace meltfront::cases

#endif
