#ifndef meltfront_particles_sph_careful_sum_h
#define meltfront_particles_sph_careful_sum_h

#include <cmath>

namespace meltfront::particles
{
  /** A sum that keeps the digits its additions would lose (Neumaier 1974). */
  class CarefulSum
  {
  public:
    void add(double value)
    {
      const double next = sum + value;
      lost += std::abs(sum) >= std::abs(value) ? (sum - next) + value
                                               : (value - next) + sum;
      sum = next;
    }

    double value() const
    {
      return sum + lost;
    }

  private:
    double sum = 0;
    double lost = 0;
  };
} // namespace meltfront::particles

#endif
