#ifndef meltfront_particles_greenspan_motion_step_noise_h
#define meltfront_particles_greenspan_motion_step_noise_h

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace meltfront::particles::greenspan
{
  /** Normal numbers that depend on a seed, a step and a particle's name only, whoever
   * asks for them and in what order. */
  class StepNoise
  {
  public:
    StepNoise(std::uint64_t seed, long step)
      : key(mixed(mixed(seed) ^ static_cast<std::uint64_t>(step)))
    {
    }

    /** One for each direction. */
    std::array<double, 3> operator()(std::uint32_t particle, int dimension) const
    {
      const std::uint64_t own = mixed(key + 2 * std::uint64_t(particle));
      const auto plane = normal_pair(own);
      return {plane[0], plane[1], dimension == 3 ? normal_pair(own + 1)[0] : 0};
    }

  private:
    /** Mixes bits (Steele, Lea and Flood 2014). */
    static std::uint64_t mixed(std::uint64_t bits)
    {
      bits += 0x9e3779b97f4a7c15;
      bits = (bits ^ bits >> 30) * 0xbf58476d1ce4e5b9;
      bits = (bits ^ bits >> 27) * 0x94d049bb133111eb;
      return bits ^ bits >> 31;
    }

    /** In (0, 1]. */
    static double uniform(std::uint64_t bits)
    {
      return (static_cast<double>(bits >> 11) + 1) * 0x1p-53;
    }

    /** Two normal numbers (Box and Muller). */
    static std::array<double, 2> normal_pair(std::uint64_t key)
    {
      const std::uint64_t first = mixed(key), second = mixed(first);
      const double radius = std::sqrt(-2 * std::log(uniform(first)));
      const double angle = 2 * std::numbers::pi * uniform(second);
      return {radius * std::cos(angle), radius * std::sin(angle)};
    }

    std::uint64_t key;
  };
} // namespace meltfront::particles::greenspan

#endif
