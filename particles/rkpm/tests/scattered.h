#ifndef meltfront_particles_rkpm_tests_scattered_h
#define meltfront_particles_rkpm_tests_scattered_h

#include <particles/core/arrangement.h>
#include <particles/rkpm/monomial_basis.h>

#include <numeric>

namespace meltfront::particles::rkpm
{
  /** Particles of a unit box, on its edge too, each moved by at most a quarter of the
   * spacing (a share of it), those on the edge if wanted. */
  inline ParticleStorage perturbed_box(int dimension, int per_side, std::uint64_t seed,
                                       double share = 0.25, bool move_edge = true)
  {
    std::array<LatticeDirection, 3> sides;
    sides.fill({0, 1, LatticeLayout::on_edge});
    const double h = 1. / (per_side - 1);
    ParticleStorage particles = arrange_in_box(dimension, sides, h);
    jitter(particles, share * h, seed,
           [&](const std::array<double, 3> &x)
           {
             bool inside = true;
             for(int d = 0; d < dimension; ++d)
               inside = inside && x[d] > 0.5 * h && x[d] < 1 - 0.5 * h;
             return inside || move_edge;
           });
    return particles;
  }

  inline std::vector<std::uint32_t> everyone(const ParticleStorage &particles)
  {
    std::vector<std::uint32_t> all(particles.size());
    std::iota(all.begin(), all.end(), 0);
    return all;
  }

  inline int degree(const MultiIndex &a)
  {
    return a[0] + a[1] + a[2];
  }

  inline double power(double base, int exponent)
  {
    double product = 1;
    for(int i = 0; i < exponent; ++i)
      product *= base;
    return product;
  }
} // namespace meltfront::particles::rkpm

#endif
