// Radiation and the bath: what is done to particles by name, beside the sweeps.

#include <particles/greenspan/motion/motion.h>
#include <particles/greenspan/motion/step_noise.h>
#include <particles/greenspan/shadows.h>
#include <particles/greenspan/sphere_shadows.h>

#include <cmath>
#include <numbers>

namespace meltfront::particles::greenspan
{
  namespace
  {
    std::vector<Exposure> exposure_to(const Radiation &light, const ParticleState &now,
                                      double radius)
    {
      if(now.dimension == 3)
      {
        const Centres centres{now.position[0], now.position[1], now.position[2]};
        return light.parallel ? exposure_to_rays(centres, light.direction, radius)
                              : exposure_to_point(centres, light.position, radius);
      }
      const std::array<double, 2> source{light.position[0], light.position[1]};
      const std::array<double, 2> along{light.direction[0], light.direction[1]};
      return light.parallel
                 ? exposure_to_rays(now.position[0], now.position[1], along, radius)
                 : exposure_to_point(now.position[0], now.position[1], source, radius);
    }
  } // namespace

  void Motion::irradiate()
  {
    const Radiation &radiation = *given.radiation;
    const double radius = radiation.radius > 0 ? radiation.radius
                                               : given.force.equilibrium_distance() / 2;
    const auto exposure = exposure_to(radiation, state(), radius);
    const double all_around = (dimension == 3 ? 4 : 2) * std::numbers::pi;
    const double energy = radiation.power * given.time_step
                          * static_cast<double>(radiation.interval)
                          / (radiation.parallel ? 1 : all_around);
    for(std::size_t i = 0; i < names.size(); ++i)
    {
      const double gain = energy * exposure[names[i]].width;
      if(gain == 0)
        continue;
      double squared = 0;
      for(int d = 0; d < dimension; ++d)
        squared += velocity[d][i] * velocity[d][i];
      if(squared > 0)
      {
        const double factor = std::sqrt(1 + 2 * gain / squared);
        for(int d = 0; d < dimension; ++d)
          velocity[d][i] *= factor;
      }
      else // nothing that moves yet: along the first axis
        velocity[0][i] = std::sqrt(2 * gain);
      absorbed_energy += gain;
    }
  }

  void Motion::exchange_with_bath()
  {
    const Thermostat &bath = *given.thermostat;
    const double kept = std::exp(-bath.rate * given.time_step);
    const double noise
        = std::sqrt(bath.temperature(steps_taken) * (1 - kept) * (1 + kept));
    const StepNoise random(bath.seed, steps_taken);
    const auto n = static_cast<std::ptrdiff_t>(names.size());
#pragma omp parallel for schedule(static) num_threads(given.threads) if(given.threads > 1)
    for(std::ptrdiff_t i = 0; i < n; ++i)
    {
      const std::array<double, 3> normal = random(names[i], dimension);
      for(int d = 0; d < dimension; ++d)
        velocity[d][i] = kept * velocity[d][i] + noise * normal[d];
    }
  }
} // namespace meltfront::particles::greenspan
