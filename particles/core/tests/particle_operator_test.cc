#include <particles/core/arrangement.h>
#include <particles/core/particle_operator.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

namespace meltfront::particles
{
  namespace
  {
    /** An operator with symmetric coefficients, and what it was made of. */
    struct Example
    {
      NeighbourList neighbours;
      std::vector<double> coefficients;
      ParticleOperator rows;
      std::vector<double> value, result;

      explicit Example(const ParticleStorage &particles, double radius)
        : neighbours(particles, radius)
      {
        for(std::size_t a = 0; a < neighbours.rows(); ++a)
          for(const std::size_t b : neighbours[a])
            coefficients.push_back(1 / (1. + a + b) + 0.1);
        rows = ParticleOperator(neighbours, coefficients);
        value.assign(rows.padded_rows(), 0);
        std::mt19937_64 generator(7);
        for(std::size_t a = 0; a < rows.rows(); ++a)
          value[a] = std::normal_distribution<double>()(generator);
        result.assign(rows.padded_rows(), -1);
      }

      double by_hand(std::size_t a) const
      {
        double sum = 0;
        for(std::size_t i = 0; i < neighbours[a].size(); ++i)
          sum += coefficients[neighbours.offset(a) + i]
                 * (value[neighbours[a][i]] - value[a]);
        return sum;
      }
    };

    Example square(double radius = 0.25, double spacing = 1. / 13)
    {
      return Example(arrange_in_box(2, {}, spacing), radius);
    }

    TEST(ParticleOperator, SumsTheRows)
    {
      for(const double radius : {0.01, 0.1, 0.25})
      {
        Example example = square(radius);
        example.rows.apply(example.value, example.result, 1);
        for(std::size_t a = 0; a < example.rows.rows(); ++a)
          ASSERT_EQ(example.result[a], example.by_hand(a)) << a;
        EXPECT_EQ(example.rows.interactions(), example.neighbours.size());
      }
    }

    TEST(ParticleOperator, CountsTheEntriesOfSlices)
    {
      const Example example = square();
      std::size_t sum = 0;
      for(std::size_t slice = 0; slice < example.rows.slices(); ++slice)
        sum += example.rows.interactions(slice);
      EXPECT_EQ(sum, example.rows.interactions());
    }

    TEST(ParticleOperator, LeavesAConstantExactlyAlone)
    {
      Example example = square();
      std::fill(example.value.begin(), example.value.end(), 0.1 + 0.2);
      example.rows.apply(example.value, example.result, 1);
      for(const double r : example.result)
        EXPECT_EQ(r, 0);
    }

    TEST(ParticleOperator, GivesTheSameBitsForAnyNumberOfThreads)
    {
      Example example = square(0.2, 1. / 40);
      example.rows.apply(example.value, example.result, 1);
      for(const int threads : {2, 3})
      {
        std::vector<double> other(example.result.size());
        example.rows.apply(example.value, other, threads);
        EXPECT_EQ(std::memcmp(other.data(), example.result.data(),
                              other.size() * sizeof(double)),
                  0);
      }
    }

    TEST(ParticleOperator, TakesNewCoefficients)
    {
      Example example = square();
      for(double &c : example.coefficients)
        c *= -3;
      example.rows.refresh(example.neighbours, example.coefficients);
      example.rows.apply(example.value, example.result, 1);
      for(std::size_t a = 0; a < example.rows.rows(); ++a)
        ASSERT_EQ(example.result[a], example.by_hand(a));
    }

    TEST(ParticleOperator, OverwritesChosenSlicesOnly)
    {
      Example example = square();
      example.rows.apply(example.value, example.result, 1);
      const std::vector<double> before = example.result;
      const std::vector<std::uint32_t> chosen{1, 4};
      const auto twice = [&](std::size_t a, std::size_t b)
      { return 2 * (example.value[b] - example.value[a]); };
      example.rows.apply_to_slices(chosen, twice, example.result);
      for(std::size_t a = 0; a < example.rows.rows(); ++a)
      {
        const std::size_t slice = a / ParticleOperator::lanes;
        const double factor = slice == 1 || slice == 4 ? 2 : 1;
        EXPECT_DOUBLE_EQ(example.result[a], factor * before[a]);
      }
    }

    // One sweep over two fields gives the bits of two sweeps, whatever the threads.
    TEST(ParticleOperator, AdvancesTwoFieldsTogether)
    {
      Example example = square(0.2, 1. / 40);
      std::vector<double> second(example.value.size());
      for(std::size_t a = 0; a < example.rows.rows(); ++a)
        second[a] = std::sin(double(a));
      const auto heat = [&](std::size_t a, std::size_t b)
      { return example.value[b] - example.value[a]; };
      const auto solute = [&](std::size_t a, std::size_t b)
      { return (second[b] - second[a]) * (example.value[a] + example.value[b]); };
      std::vector<double> heat_alone(second.size()), solute_alone(second.size());
      example.rows.apply(example.value, heat_alone, 1);
      example.rows.apply_pairs(solute, solute_alone, 1);
      for(const int threads : {1, 2, 3})
      {
        std::vector<double> first_result(second.size()), second_result(second.size());
        example.rows.apply_pairs(heat, solute, first_result, second_result, threads);
        EXPECT_EQ(first_result, heat_alone) << threads;
        EXPECT_EQ(second_result, solute_alone) << threads;
      }
      double sum = 0, size = 0;
      for(std::size_t a = 0; a < example.rows.rows(); ++a)
      {
        sum += solute_alone[a];
        size += std::abs(solute_alone[a]);
      }
      EXPECT_LE(std::abs(sum), 1e-13 * size);
    }

    TEST(ParticleOperator, KnowsWhichSlicesTouch)
    {
      const Example example = square();
      std::vector<std::size_t> offsets;
      std::vector<std::uint32_t> adjacent;
      example.rows.slice_adjacency(offsets, adjacent);
      ASSERT_EQ(offsets.size(), example.rows.slices() + 1);
      for(std::size_t a = 0; a < example.rows.rows(); ++a)
        for(const std::uint32_t b : example.neighbours[a])
        {
          const std::size_t slice = a / ParticleOperator::lanes;
          const auto first = adjacent.begin() + offsets[slice];
          const auto last = adjacent.begin() + offsets[slice + 1];
          EXPECT_TRUE(std::binary_search(first, last, b / ParticleOperator::lanes));
        }
      // A chain's slices touch their neighbours in the chain and no others.
      Example chain(arrange_in_box(1, {}, 1. / 64), 1.5 / 64);
      chain.rows.slice_adjacency(offsets, adjacent);
      EXPECT_EQ(adjacent.size(), 8u * 3 - 2);
    }

    TEST(ParticleOperator, OfNothingHasNoRows)
    {
      const ParticleOperator nothing;
      EXPECT_EQ(nothing.rows(), 0u);
      EXPECT_EQ(nothing.slices(), 0u);
    }
  } // namespace
} // namespace meltfront::particles
