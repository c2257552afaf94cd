#include <particles/benchmarks/crowd.h>
#include <particles/core/arrangement.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::benchmarks
{
  namespace
  {
    ParticleStorage sorted_box(const CrowdSize &size)
    {
      const double spacing = 1. / size.per_side;
      ParticleStorage particles = arrange_in_box(size.dimension, {}, spacing);
      reorder(particles, order_along_curve(particles, spacing));
      return particles;
    }
  } // namespace

  Crowd::Crowd(const CrowdSize &size)
    : radius(size.radius / size.per_side * (1 - 1e-9))
    , particles(sorted_box(size))
    , neighbours(particles, radius)
  {
    coefficients.reserve(neighbours.size());
    for(std::size_t a = 0; a < neighbours.rows(); ++a)
      for(const std::size_t b : neighbours[a])
        coefficients.push_back(1 + 1e-3 * std::cos(double(a) + double(b)));
    rows = ParticleOperator(neighbours, coefficients);
    for(auto *array : {&enthalpy, &u, &solute, &result, &result_2})
      array->assign(rows.padded_rows(), 0.);
    for(std::size_t a = 0; a < particles.size(); ++a)
    {
      const double x = particles.position[0][a];
      enthalpy[a] = 20 * (x - 0.5) * latent_heat + 0.5 * latent_heat;
      u[a] = 2 * std::min(enthalpy[a], 0.) + std::max(enthalpy[a] - latent_heat, 0.);
      solute[a] = 0.1 + 0.05 * std::sin(7 * x);
    }
  }
} // namespace meltfront::particles::benchmarks
