#ifndef meltfront_particles_greenspan_motion_random_numbers_h
#define meltfront_particles_greenspan_motion_random_numbers_h

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace meltfront::particles::greenspan
{
  /** Random numbers that are the same on every machine. */
  class RandomNumbers
  {
  public:
    explicit RandomNumbers(std::uint64_t seed)
      : generator(seed)
    {
    }

    /** In (0, 1]. */
    double uniform()
    {
      return (static_cast<double>(generator() >> 11) + 1) * 0x1p-53;
    }

    /** Normal with mean 0 and variance 1, by Box and Muller. */
    double normal()
    {
      const double radius = std::sqrt(-2 * std::log(uniform()));
      return radius * std::cos(2 * std::numbers::pi * uniform());
    }

  private:
    std::mt19937_64 generator;
  };
} // namespace meltfront::particles::greenspan

#endif
