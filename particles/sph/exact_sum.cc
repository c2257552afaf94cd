#include <particles/sph/exact_sum.h>

#include <bit>
#include <cmath>
#include <limits>

namespace meltfront::particles
{
  namespace
  {
    constexpr int mantissa_bits = 52;
    constexpr std::uint64_t mantissa_mask = (std::uint64_t(1) << mantissa_bits) - 1;
    constexpr int exponent_mask = 0x7ff;
    constexpr std::int64_t digit_mask = 0xffffffff;

    /** Binary exponent of the lowest digit's lowest bit, the least that doubles have. */
    constexpr int lowest_exponent = -1074;

    /** Terms that a digit has room for between carries. */
    constexpr std::uint32_t terms_before_carry = 1u << 30;
  } // namespace

  ExactSum::ExactSum(const Packed &packed)
    : first(0)
    , last(digits_of_doubles - 1)
    , not_finite(packed.back())
  {
    for(std::size_t d = 0; d < digits_of_doubles; ++d)
      digits[d] = packed[d];
  }

  void ExactSum::touch(std::size_t digit)
  {
    if(first > last)
    {
      first = last = digit;
      digits[digit] = 0;
    }
    while(first > digit)
      digits[--first] = 0;
    while(last < digit)
      digits[++last] = 0;
  }

  void ExactSum::add(double term)
  {
    const auto bits = std::bit_cast<std::uint64_t>(term);
    const int exponent = static_cast<int>(bits >> mantissa_bits) & exponent_mask;
    if(exponent == exponent_mask)
    {
      ++not_finite;
      return;
    }
    // Numbers below the normal ones have the exponent of the least of these.
    const std::uint64_t mantissa
        = (bits & mantissa_mask) | std::uint64_t(exponent > 0) << mantissa_bits;
    const int place = exponent > 0 ? exponent - 1 : 0;
    const auto digit = static_cast<std::size_t>(place / digit_bits);
    touch(digit);
    touch(digit + 2);
    const unsigned __int128 shifted = static_cast<unsigned __int128>(mantissa)
                                      << place % digit_bits;
    const std::int64_t sign = std::signbit(term) ? -1 : 1;
    for(std::size_t d = 0; d < 3; ++d)
      digits[digit + d] += sign
                           * static_cast<std::int64_t>(
                               static_cast<std::uint64_t>(shifted >> d * digit_bits)
                               & std::uint64_t(digit_mask));
    if(++pending == terms_before_carry)
      carry();
  }

  /** Make every digit but the last one that of a number: not negative, below 2^32. */
  void ExactSum::carry()
  {
    pending = 0;
    if(first > last)
      return;
    for(std::size_t d = first;; ++d)
    {
      if(d == last)
      {
        const bool fits = digits[d] >= -digit_mask && digits[d] <= digit_mask;
        if(fits || last + 1 == digits_of_doubles)
          return;
        touch(last + 1);
      }
      digits[d + 1] += digits[d] >> digit_bits;
      digits[d] &= digit_mask;
    }
  }

  double ExactSum::value() const
  {
    if(not_finite > 0)
      return std::numeric_limits<double>::quiet_NaN();
    if(first > last)
      return 0;
    ExactSum sum = *this;
    sum.carry();
    std::size_t highest = sum.last;
    while(highest > sum.first && sum.digits[highest] == 0)
      --highest;
    if(sum.digits[highest] >= 0)
      return sum.rounded();
    for(std::size_t d = sum.first; d <= sum.last; ++d)
      sum.digits[d] = -sum.digits[d];
    sum.carry();
    return -sum.rounded();
  }

  /** Of a sum >= 0 after carry(). The highest three digits hold at least 65 bits, and
   * whether anything stands below them decides on ties only. */
  double ExactSum::rounded() const
  {
    std::size_t top = last;
    while(top > first && digits[top] == 0)
      --top;
    unsigned __int128 leading = 0;
    bool more = false;
    for(std::size_t d = first; d <= top; ++d)
      if(top - d > 2)
        more = more || digits[d] != 0;
      else
        leading |= static_cast<unsigned __int128>(digits[d])
                   << (d + 2 - top) * digit_bits;
    leading |= static_cast<unsigned __int128>(more);
    return std::ldexp(static_cast<double>(leading),
                      lowest_exponent + digit_bits * (static_cast<int>(top) - 2));
  }

  ExactSum::Packed ExactSum::packed() const
  {
    ExactSum sum = *this;
    sum.carry();
    Packed result{};
    for(std::size_t d = sum.first; d <= sum.last; ++d)
      result[d] = sum.digits[d];
    result.back() = not_finite;
    return result;
  }
} // namespace meltfront::particles
