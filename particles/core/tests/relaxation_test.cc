#include <particles/core/arrangement.h>
#include <particles/core/relaxation.h>

#include <gtest/gtest.h>

#include <cmath>

namespace meltfront::particles
{
  namespace
  {
    constexpr int per_side = 20;
    constexpr double spacing = 1. / per_side;

    ParticleStorage jittered(int dimension, double amount)
    {
      ParticleStorage particles = arrange_in_box(dimension, {}, spacing);
      jitter(particles, amount * spacing, 3, [](const auto &) { return true; });
      return particles;
    }

    RelaxationBounds unit_box(int dimension)
    {
      RelaxationBounds bounds;
      bounds.fixed.dimension = dimension;
      for(int d = 0; d < dimension; ++d)
      {
        bounds.mirrors.push_back({d, 0., false});
        bounds.mirrors.push_back({d, 1., true});
      }
      return bounds;
    }

    SmoothingKernel kernel(int dimension)
    {
      return SmoothingKernel(KernelShape::cubic_spline, dimension, 1.3 * spacing);
    }

    TEST(Relaxation, LeavesALatticeAlone)
    {
      for(int dimension = 1; dimension <= 2; ++dimension)
      {
        ParticleStorage particles = arrange_in_box(dimension, {}, spacing);
        const ParticleStorage before = particles;
        relax(particles, kernel(dimension), spacing, unit_box(dimension));
        for(int d = 0; d < dimension; ++d)
          for(std::size_t a = 0; a < particles.size(); ++a)
            ASSERT_NEAR(particles.position[d][a], before.position[d][a], 1e-12);
      }
    }

    TEST(Relaxation, LowersTheSpreadAndKeepsParticlesApartAndInside)
    {
      for(const double amount : {0.1, 0.2, 0.3, 0.4})
      {
        ParticleStorage particles = jittered(2, amount);
        const Relaxation done = relax(particles, kernel(2), spacing, unit_box(2));
        EXPECT_GT(done.sweeps, 5);
        EXPECT_LT(done.spread_after, 0.5 * done.spread_before) << amount;
        double nearest = 1;
        for(std::size_t a = 0; a < particles.size(); ++a)
        {
          for(int d = 0; d < 2; ++d)
          {
            ASSERT_GE(particles.position[d][a], 0);
            ASSERT_LE(particles.position[d][a], 1);
          }
          for(std::size_t b = 0; b < a; ++b)
            nearest = std::min(
                nearest, std::hypot(particles.position[0][a] - particles.position[0][b],
                                    particles.position[1][a] - particles.position[1][b]));
        }
        EXPECT_GT(nearest, 0.6 * spacing) << amount;
      }
    }

    TEST(Relaxation, IsReproducible)
    {
      ParticleStorage first = jittered(2, 0.3), second = jittered(2, 0.3);
      relax(first, kernel(2), spacing, unit_box(2));
      relax(second, kernel(2), spacing, unit_box(2));
      EXPECT_EQ(first.position, second.position);
    }

    TEST(Relaxation, MovesOnlyWhatMay)
    {
      ParticleStorage particles = jittered(2, 0.3);
      const ParticleStorage before = particles;
      RelaxationBounds bounds = unit_box(2);
      bounds.movable = [](const std::array<double, 3> &place) { return place[0] < 0.5; };
      relax(particles, kernel(2), spacing, bounds);
      int moved = 0;
      for(std::size_t a = 0; a < particles.size(); ++a)
        if(before.position[0][a] < 0.5)
          moved += particles.position[0][a] != before.position[0][a];
        else
          ASSERT_EQ(particles.position[0][a], before.position[0][a]);
      EXPECT_GT(moved, per_side * per_side / 3);
    }

    TEST(Relaxation, CrossesPeriodicSides)
    {
      RelaxationBounds bounds;
      bounds.fixed.dimension = 2;
      bounds.periodicity.period = {1, 1, 0};
      ParticleStorage particles = jittered(2, 0.3);
      const Relaxation done = relax(particles, kernel(2), spacing, bounds);
      EXPECT_LT(done.spread_after, 0.5 * done.spread_before);
    }
  } // namespace
} // namespace meltfront::particles
