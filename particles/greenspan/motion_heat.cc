// Radiation and the bath: what is done to particles by name, beside the sweeps.

#include <particles/greenspan/motion.h>
#include <particles/greenspan/shadows.h>

#include <cmath>
#include <numbers>

namespace meltfront::particles::greenspan
{
  namespace
  {
    /** Mixes bits (Steele, Lea and Flood 2014). */
    std::uint64_t mixed(std::uint64_t bits)
    {
      bits += 0x9e3779b97f4a7c15;
      bits = (bits ^ bits >> 30) * 0xbf58476d1ce4e5b9;
      bits = (bits ^ bits >> 27) * 0x94d049bb133111eb;
      return bits ^ bits >> 31;
    }

    /** In (0, 1]. */
    double uniform(std::uint64_t bits)
    {
      return (static_cast<double>(bits >> 11) + 1) * 0x1p-53;
    }

    /** Two normal numbers (Box and Muller) that depend on the key only. */
    std::array<double, 2> normal_pair(std::uint64_t key)
    {
      const std::uint64_t first = mixed(key), second = mixed(first);
      const double radius = std::sqrt(-2 * std::log(uniform(first)));
      const double angle = 2 * std::numbers::pi * uniform(second);
      return {radius * std::cos(angle), radius * std::sin(angle)};
    }
  } // namespace

  void Motion::irradiate()
  {
    const Radiation &radiation = *given.radiation;
    const double radius = radiation.radius > 0 ? radiation.radius
                                               : given.force.equilibrium_distance() / 2;
    const ParticleState now = state();
    const std::array<double, 2> source{radiation.position[0], radiation.position[1]};
    const std::array<double, 2> along{radiation.direction[0], radiation.direction[1]};
    const auto exposure
        = radiation.parallel
              ? exposure_to_rays(now.position[0], now.position[1], along, radius)
              : exposure_to_point(now.position[0], now.position[1], source, radius);
    const double energy = radiation.power * given.time_step
                          * static_cast<double>(radiation.interval)
                          / (radiation.parallel ? 1 : 2 * std::numbers::pi);
    for(std::size_t i = 0; i < names.size(); ++i)
    {
      const double gain = energy * exposure[names[i]].width;
      double &u = velocity[0][i], &v = velocity[1][i];
      const double squared = u * u + v * v;
      if(gain == 0)
        continue;
      if(squared > 0)
      {
        const double factor = std::sqrt(1 + 2 * gain / squared);
        u *= factor;
        v *= factor;
      }
      else // nothing that moves yet: along the first axis
        u = std::sqrt(2 * gain);
      absorbed_energy += gain;
    }
  }

  void Motion::exchange_with_bath()
  {
    const Thermostat &bath = *given.thermostat;
    const double kept = std::exp(-bath.rate * given.time_step);
    const double noise
        = std::sqrt(bath.temperature(steps_taken) * (1 - kept) * (1 + kept));
    const std::uint64_t step_key = mixed(mixed(bath.seed) ^ std::uint64_t(steps_taken));
    const auto n = static_cast<std::ptrdiff_t>(names.size());
#pragma omp parallel for schedule(static) num_threads(given.threads) if(given.threads > 1)
    for(std::ptrdiff_t i = 0; i < n; ++i)
    {
      const std::uint64_t key = mixed(step_key + 2 * std::uint64_t(names[i]));
      const auto plane = normal_pair(key);
      for(int d = 0; d < 2; ++d)
        velocity[d][i] = kept * velocity[d][i] + noise * plane[d];
      if(dimension == 3)
        velocity[2][i] = kept * velocity[2][i] + noise * normal_pair(key + 1)[0];
    }
  }
} // namespace meltfront::particles::greenspan
