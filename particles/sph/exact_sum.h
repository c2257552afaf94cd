#ifndef meltfront_particles_sph_exact_sum_h
#define meltfront_particles_sph_exact_sum_h

#include <array>
#include <cstddef>
#include <cstdint>

namespace meltfront::particles
{
  /**
   * A sum of doubles without any rounding but the last one, so that it does not depend on
   * the order of the terms, nor on how they are shared out: a fixed-point number that
   * holds the range of all doubles (Kulisch 1971), in digits of 32 bits with room for
   * carries (Neal 2015, arXiv:1505.05571). Only digits that were touched cost anything.
   */
  class ExactSum
  {
  public:
    /** Digits of any sum of up to 2^63 doubles, and how many terms were not finite. */
    static constexpr std::size_t digits_of_doubles = 68;
    using Packed = std::array<std::int64_t, digits_of_doubles + 1>;

    ExactSum() = default;

    /** A sum by its digits, which may be those of several sums added up one by one. */
    explicit ExactSum(const Packed &packed);

    void add(double term);

    /** The sum, rounded once to the nearest double; not a number if a term was none, or
     * was infinite. */
    double value() const;

    /** All digits, without carries: so many sums may be added up as there are bits left,
     * 2^31. */
    Packed packed() const;

  private:
    static constexpr int digit_bits = 32;

    void touch(std::size_t digit);
    void carry();
    double rounded() const;

    std::array<std::int64_t, digits_of_doubles> digits; ///< from first to last only
    std::size_t first = 1, last = 0; ///< of those touched; none while first > last
    std::uint32_t pending = 0;       ///< terms since the last carry()
    std::int64_t not_finite = 0;     ///< terms that are not
  };
} // namespace meltfront::particles

#endif
