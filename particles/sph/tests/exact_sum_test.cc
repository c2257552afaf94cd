#include <particles/sph/exact_sum.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace meltfront::particles
{
  namespace
  {
    double sum_of(const std::vector<double> &terms)
    {
      ExactSum sum;
      for(const double term : terms)
        sum.add(term);
      return sum.value();
    }

    /** Of all signs and 200 decimal orders. */
    std::vector<double> scattered_terms(std::size_t count)
    {
      std::mt19937_64 generator(11);
      std::uniform_real_distribution<double> mantissa(-1, 1), order(-330, 330);
      std::vector<double> terms;
      for(std::size_t i = 0; i < count; ++i)
        terms.push_back(std::ldexp(mantissa(generator), int(order(generator))));
      return terms;
    }

    TEST(ExactSum, OfNothingAndOfOneTerm)
    {
      EXPECT_EQ(sum_of({}), 0);
      using Limits = std::numeric_limits<double>;
      for(const double term :
          {1., -1., 0.1, -1e300, 3e-310, Limits::denorm_min(), -Limits::denorm_min(),
           Limits::max(), -Limits::max(), Limits::min(), 0.})
        EXPECT_EQ(sum_of({term}), term);
    }

    TEST(ExactSum, LosesNothing)
    {
      EXPECT_EQ(sum_of({1e300, 1, 1e-300, -1e300, -1}), 1e-300);
      EXPECT_EQ(sum_of({-1e300, 1, 1e-300, 1e300, -1}), 1e-300);
      EXPECT_EQ(sum_of({1e16, 1, 1, -1e16}), 2);
      // More than the largest double on the way.
      const double largest = std::numeric_limits<double>::max();
      EXPECT_EQ(sum_of({largest, largest, -largest, 0.5, -largest}), 0.5);
      EXPECT_TRUE(std::isinf(sum_of({largest, largest})));
    }

    TEST(ExactSum, RoundsOnceToTheNearest)
    {
      const double unit = std::ldexp(1., -53); // half of the last place of 1
      EXPECT_EQ(sum_of({1, unit}), 1);         // a tie, to the even one
      EXPECT_EQ(sum_of({1, unit, 1e-300}), 1 + 2 * unit);
      EXPECT_EQ(sum_of({1, unit, -1e-300}), 1);
      EXPECT_EQ(sum_of({-1, -unit, -1e-300}), -1 - 2 * unit);
      EXPECT_EQ(sum_of({1, 3 * unit}), 1 + 4 * unit);
      // Two doubles' own sum is rounded once too.
      const std::vector<double> terms = scattered_terms(1000);
      for(std::size_t i = 0; i + 1 < terms.size(); ++i)
        EXPECT_EQ(sum_of({terms[i], terms[i + 1]}), terms[i] + terms[i + 1]);
    }

    TEST(ExactSum, DependsNeitherOnOrderNorOnShares)
    {
      std::vector<double> terms = scattered_terms(3000);
      const double sum = sum_of(terms);
      std::mt19937_64 generator(5);
      for(int repeat = 0; repeat < 5; ++repeat)
      {
        std::ranges::shuffle(terms, generator);
        EXPECT_EQ(sum_of(terms), sum);
        ExactSum parts[7];
        for(const double term : terms)
          parts[generator() % 7].add(term);
        ExactSum::Packed all{};
        for(const ExactSum &part : parts)
        {
          const ExactSum::Packed packed = part.packed();
          for(std::size_t d = 0; d < all.size(); ++d)
            all[d] += packed[d];
        }
        EXPECT_EQ(ExactSum(all).value(), sum);
      }
    }

    TEST(ExactSum, OfNumbersInIntegersIsTheIntegers)
    {
      std::mt19937_64 generator(3);
      std::uniform_int_distribution<long> numbers(-(1L << 40), 1L << 40);
      ExactSum sum;
      long exact = 0;
      for(int i = 0; i < 4000; ++i)
      {
        const long number = numbers(generator);
        exact += number;
        sum.add(std::ldexp(double(number), -30));
      }
      EXPECT_EQ(sum.value(), std::ldexp(double(exact), -30));
    }

    TEST(ExactSum, TellsWhatIsNotFinite)
    {
      EXPECT_TRUE(std::isnan(sum_of({1, std::nan(""), 2})));
      EXPECT_TRUE(std::isnan(sum_of({1, std::numeric_limits<double>::infinity()})));
    }
  } // namespace
} // namespace meltfront::particles
