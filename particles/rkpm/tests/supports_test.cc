#include <cases/error.h>
#include <particles/rkpm/reproducing_weights.h>
#include <particles/rkpm/tests/scattered.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::rkpm
{
  namespace
  {
    double distance(const ParticleStorage &particles, std::size_t a, std::size_t b)
    {
      const auto x = particles.point(a), y = particles.point(b);
      return std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]);
    }

    TEST(Supports, NearestNeighboursAreThoseOfASortedList)
    {
      for(int dim = 1; dim <= 3; ++dim)
      {
        const ParticleStorage particles = perturbed_box(dim, dim == 3 ? 7 : 15, 3);
        const int number = 5 * dim;
        SupportSettings settings;
        settings.neighbours = number;
        const std::vector<int> never(particles.size(), 0);
        const Supports supports = find_supports(particles, particles, settings, 6, never);
        for(std::size_t a = 0; a < particles.size(); ++a)
        {
          std::vector<std::pair<double, std::uint32_t>> sorted;
          for(std::uint32_t b = 0; b < particles.size(); ++b)
            sorted.emplace_back(distance(particles, a, b), b);
          std::sort(sorted.begin(), sorted.end());
          EXPECT_NEAR(supports.dilation[a], sorted[number].first, 1e-14);
          std::vector<std::uint32_t> expected;
          for(int i = 0; i < number; ++i)
            expected.push_back(sorted[i].second);
          std::sort(expected.begin(), expected.end());
          const auto row = supports[a];
          EXPECT_EQ(std::vector<std::uint32_t>(row.begin(), row.end()), expected);
        }
      }
    }

    TEST(Supports, FixedDilationIsAlphaTimesTheSpacing)
    {
      const ParticleStorage particles = perturbed_box(2, 9, 3);
      const SupportSettings settings{SupportRule::fixed_dilation, 2.6, 0.125, 0};
      std::vector<int> enlargements(particles.size(), 0);
      enlargements[17] = 2;
      const Supports supports
          = find_supports(particles, particles, settings, 6, enlargements);
      for(std::size_t a = 0; a < particles.size(); ++a)
      {
        const double dilation = 0.325 * (a == 17 ? 1.44 : 1);
        EXPECT_NEAR(supports.dilation[a], dilation, 1e-15);
        std::size_t within = 0;
        for(std::size_t b = 0; b < particles.size(); ++b)
          within += distance(particles, a, b) < dilation;
        EXPECT_EQ(supports[a].size(), within);
      }
    }

    TEST(Supports, ReachOfNeighboursIsTheTransposedList)
    {
      const ParticleStorage particles = perturbed_box(2, 9, 5);
      std::vector<double> dilations;
      for(std::size_t i = 0; i < particles.size(); ++i)
        dilations.push_back(0.3 + 0.1 * std::sin(7. * i));
      const Supports supports = reach_of_neighbours(particles, dilations);
      for(std::size_t a = 0; a < particles.size(); ++a)
        for(std::size_t b = 0; b < particles.size(); ++b)
        {
          const auto row = supports[a];
          EXPECT_EQ(std::count(row.begin(), row.end(), b),
                    distance(particles, a, b) < dilations[b]);
        }
    }

    TEST(ReproducingWeights, ADeficientSupportIsEnlargedAndSaidSo)
    {
      // At alpha = 1.2 a particle sees its four nearest only, in a corner two.
      const ParticleStorage particles = perturbed_box(2, 9, 5, 0.05);
      const SupportSettings narrow{SupportRule::fixed_dilation, 1.2, 0.125, 0};
      for(const Variant form : {Variant::derivative_free, Variant::multiple_fixed})
      {
        const ReproducingWeights found = compute_weights(
            particles, particles, {form, KernelShape::wendland_c4, 2, 2}, narrow, 1);
        EXPECT_EQ(found.record.enlarged, particles.size()) << variant_name(form);
        EXPECT_EQ(found.record.lowered, 0u);
        EXPECT_GE(found.record.most_enlargements, 2);
        EXPECT_GE(found.record.least_rank_ratio, least_rank_ratio);
        std::vector<double> values;
        for(std::size_t a = 0; a < particles.size(); ++a)
          values.push_back(particles.position[0][a] * particles.position[0][a]);
        // A rank ratio down to 1e-8 costs eight digits of h^-2 = 64.
        const int xx = MonomialBasis(2, 2).find({2, 0, 0});
        for(std::size_t a = 0; a < particles.size(); ++a)
          EXPECT_NEAR(found.apply(xx, a, values), 2, 1e-6);
      }
    }

    TEST(ReproducingWeights, OrderIsLoweredOnlyWhereNothingElseHelps)
    {
      // On two rows nothing of second order across them is determined.
      ParticleStorage particles;
      particles.dimension = 2;
      for(int i = 0; i < 40; ++i)
        for(int j = 0; j < 2; ++j)
          particles.add({0.1 * i, 0.1 * j, 0});
      const ReproducingWeights found = compute_weights(
          particles, particles,
          {Variant::derivative_free, KernelShape::wendland_c4, 2, 2}, {}, 1);
      EXPECT_EQ(found.record.lowered, particles.size());
      EXPECT_EQ(found.record.lowest_order, 1);
      std::vector<double> values;
      for(std::size_t a = 0; a < particles.size(); ++a)
        values.push_back(particles.position[0][a] - 3 * particles.position[1][a]);
      for(std::size_t a = 0; a < particles.size(); ++a)
      {
        EXPECT_EQ(found.order[a], 1);
        EXPECT_NEAR(found.apply(0, a, values), values[a], 1e-12);
        EXPECT_NEAR(found.apply(1, a, values), 1, 1e-11);
        EXPECT_NEAR(found.apply(2, a, values), -3, 1e-11);
      }
    }

    TEST(ReproducingWeights, ValuesCanBeTakenAtOtherPoints)
    {
      const ParticleStorage particles = perturbed_box(3, 8, 5);
      ParticleStorage points;
      points.dimension = 3;
      points.add({0.2, 0.3, 0.9});
      points.add({0, 0, 0});
      const ReproducingWeights found = compute_weights(
          points, particles, {Variant::derivative_free, KernelShape::wendland_c4, 3, 2},
          {}, 1);
      std::vector<double> values;
      for(std::size_t a = 0; a < particles.size(); ++a)
        values.push_back(particles.position[0][a] * particles.position[2][a]);
      EXPECT_NEAR(found.apply(0, 0, values), 0.18, 1e-13);
      EXPECT_NEAR(found.apply(0, 1, values), 0, 1e-13);
    }

    TEST(ReproducingWeights, HaveTheSameBitsForAnyNumberOfThreads)
    {
      const ParticleStorage particles = perturbed_box(2, 21, 5);
      for(const Variant form : {Variant::derivative_free, Variant::multiple_fixed})
      {
        const MomentSettings how{form, KernelShape::wendland_c4, 2, 3};
        const auto one = compute_weights(particles, particles, how, {}, 1);
        const auto three = compute_weights(particles, particles, how, {}, 3);
        EXPECT_EQ(one.weights, three.weights);
        EXPECT_EQ(one.supports.neighbours, three.supports.neighbours);
      }
    }

    TEST(ReproducingWeights, BadInputIsRefusedInWords)
    {
      const MomentSettings how{Variant::derivative_free, KernelShape::wendland_c4, 2, 2};
      ParticleStorage line;
      line.dimension = 2;
      for(int i = 0; i < 60; ++i)
        line.add({0.1 * i, 0.05 * i, 0});
      EXPECT_THROW(compute_weights(line, line, how, {}, 1), cases::InputError);
      ParticleStorage few = perturbed_box(2, 3, 1);
      EXPECT_THROW(compute_weights(few, few, how, {}, 1), cases::InputError);
      ParticleStorage together;
      together.dimension = 2;
      for(int i = 0; i < 60; ++i)
        together.add({0.5, 0.5, 0});
      EXPECT_THROW(compute_weights(together, together, how, {}, 1), cases::InputError);
      ParticleStorage box = perturbed_box(2, 9, 1);
      EXPECT_THROW(
          compute_weights(box, box, how, {SupportRule::fixed_dilation, 0, 1, 0}, 1),
          cases::InputError);
      MomentSettings multiple = how;
      multiple.variant = Variant::multiple_fixed;
      EXPECT_THROW(compute_weights(few, box, multiple, {}, 1), cases::InputError);
      MomentSettings space = how;
      space.dimension = 3;
      EXPECT_THROW(compute_weights(box, box, space, {}, 1), cases::InputError);
      box.position[1][3] = std::nan("");
      EXPECT_THROW(compute_weights(box, box, how, {}, 1), cases::InputError);
    }
  } // namespace
} // namespace meltfront::particles::rkpm
