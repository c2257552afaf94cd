#include <particles/alloy/phase_exchange.h>

#include <cmath>

namespace meltfront::particles
{
  Freezing freeze(double heat, double depression, double latent_heat,
                  double solid_capacity, double liquid_capacity)
  {
    const double product = heat * depression;
    const double b = latent_heat + depression * liquid_capacity - heat;
    const double root = std::sqrt(b * b + 4 * solid_capacity * product);
    const double drop
        = b > 0 ? 2 * product / (b + root) : (root - b) / (2 * solid_capacity);
    return {drop, drop / (depression + drop)};
  }
} // namespace meltfront::particles
