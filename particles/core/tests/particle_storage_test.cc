#include <particles/core/arrangement.h>
#include <particles/core/particle_storage.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles
{
  namespace
  {
    TEST(ParticleStorage, FollowsMortonsCurve)
    {
      const auto lattice = arrange_in_box(2, {}, 0.25);
      // The curve visits the quarters of the square, and each quarter's quarters, in the
      // order (0, 0), (1, 0), (0, 1), (1, 1).
      const std::vector<std::uint32_t> expected{0, 1, 4,  5,  2,  3,  6,  7,
                                                8, 9, 12, 13, 10, 11, 14, 15};
      EXPECT_EQ(order_along_curve(lattice, 0.25), expected);
    }

    TEST(ParticleStorage, ReordersAllCoordinates)
    {
      auto particles = arrange_in_box(3, {}, 0.125);
      jitter(particles, 0.03, 4, [](const auto &) { return true; });
      const auto before = particles;
      const auto order = order_along_curve(particles, 0.125);
      reorder(particles, order);
      ASSERT_EQ(particles.size(), before.size());
      auto sorted = order;
      std::sort(sorted.begin(), sorted.end());
      for(std::size_t i = 0; i < order.size(); ++i)
      {
        EXPECT_EQ(sorted[i], i);
        EXPECT_EQ(particles.point(i), before.point(order[i]));
      }
    }

    double mean_step(const ParticleStorage &particles)
    {
      double sum = 0;
      for(std::size_t i = 1; i < particles.size(); ++i)
      {
        const auto a = particles.point(i - 1), b = particles.point(i);
        sum += std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
      }
      return sum / (particles.size() - 1);
    }

    TEST(ParticleStorage, KeepsNearParticlesTogether)
    {
      for(int dimension = 2; dimension <= 3; ++dimension)
      {
        auto particles = arrange_in_box(dimension, {}, 1. / 16);
        // Scatter them in memory first.
        std::vector<std::uint32_t> scattered;
        for(std::size_t i = 0; i < particles.size(); ++i)
          scattered.push_back(i * 1231 % particles.size());
        reorder(particles, scattered);
        const double before = mean_step(particles);
        reorder(particles, order_along_curve(particles, 1. / 16));
        EXPECT_LT(mean_step(particles), 2. / 16);
        EXPECT_GT(before, 4. / 16);
      }
    }
  } // namespace
} // namespace meltfront::particles
