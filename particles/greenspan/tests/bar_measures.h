#ifndef meltfront_particles_greenspan_tests_bar_measures_h
#define meltfront_particles_greenspan_tests_bar_measures_h

#include <particles/greenspan/bar/bar.h>

#include <span>

namespace meltfront::particles::greenspan
{
  /** A straight line through the squares of the molten mass over time. */
  struct FrontFit
  {
    double slope = 0;
    double intercept = 0;
    double r_squared = 0; ///< share of the variance that the line explains
    int points = 0;
  };

  /**
   * Fit of (molten + shift)^2 over time to the looks from the last one on that has molten
   * less than a mass.
   * @param shift mass that is added to the molten one: where the wall's temperature would
   *   be reached inside the bath, see BarTemperatures::slip
   * @throws cases::InputError for fewer than three looks
   */
  FrontFit fit_front(std::span<const BarLook> looks, double least, double shift = 0);

  /** Temperatures along a bar that melts, averaged over looks. */
  struct BarTemperatures
  {
    double edge = 0;           ///< at the end of the hot bath, from the melt's profile
    double gradient = 0;       ///< of the melt there, per mass
    double melt_at_front = 0;  ///< from the melt's profile
    double solid_at_front = 0; ///< from the solid's profile
    double slip = 0; ///< mass beyond the bath's end where the profile would reach its
                     ///< temperature
    int looks = 0;
  };

  /**
   * Straight lines through the temperatures of layers, look by look, at the same shares
   * of the molten mass: the melt's first half and its second, and as much of the solid
   * behind the front.
   * @param hot_temperature of the bath
   * @throws cases::InputError if no look has molten the mass
   */
  BarTemperatures bar_temperatures(std::span<const BarLook> looks, double least,
                                   double hot_temperature);

  /**
   * Looks at the same times, averaged over runs: squares of the molten mass, without edge
   * and layers.
   * @param block so many looks in turn are averaged, too; what is left over is dropped
   */
  std::vector<BarLook> mean_looks(const std::vector<std::vector<BarLook>> &runs,
                                  std::size_t block = 1);

  /** Runs with seeds first_seed, first_seed + 1, ... */
  std::vector<std::vector<BarLook>> run_bars(const BarSettings &settings,
                                             const BarSchedule &schedule, int members,
                                             std::uint64_t first_seed, int threads);
} // namespace meltfront::particles::greenspan

#endif
