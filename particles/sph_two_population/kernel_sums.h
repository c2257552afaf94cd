#ifndef meltfront_particles_sph_two_population_kernel_sums_h
#define meltfront_particles_sph_two_population_kernel_sums_h

#include <particles/core/particle_operator.h>
#include <particles/sph/discretisation.h>

#include <span>
#include <vector>

namespace meltfront::particles
{
  /** Sums over neighbours and the particle itself, sum_b W_ab value_b (Monaghan, Huppert
   * and Worster 2005, equations 4.11 to 4.14). */
  class KernelSums
  {
  public:
    explicit KernelSums(const Discretisation &discretisation);

    /** result_a = sum_b W_ab value_b; arrays of padded rows. */
    void sum(std::span<const double> value, std::span<double> result) const;

    /** Entries that one sum touches. */
    std::size_t interactions() const
    {
      return rows.interactions();
    }

  private:
    ParticleOperator rows;
    double own; ///< W(0)
  };
} // namespace meltfront::particles

#endif
