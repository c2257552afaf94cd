#include <cases/error.h>
#include <particles/greenspan/generation.h>
#include <particles/greenspan/motion/motion.h>
#include <particles/greenspan/motion/random_numbers.h>
#include <particles/greenspan/sphere_shadows.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meltfront::particles::greenspan
{
  namespace
  {
    constexpr double pi = std::numbers::pi;

    Centres centres_of(const ParticleState &state)
    {
      return {state.position[0], state.position[1], state.position[2]};
    }

    ParticleState spheres(const std::vector<std::array<double, 3>> &places)
    {
      ParticleState state;
      state.dimension = 3;
      for(const auto &place : places)
        state.add(place);
      return state;
    }

    /** A crystal of which a third of the particles is missing and the others are moved.
     */
    ParticleState rough_crystal(std::uint64_t seed)
    {
      RandomNumbers random(seed);
      const ParticleState crystal = HexagonalLattice::close_packed_box({3, 3, 3}, 1.2);
      ParticleState state = spheres({});
      for(std::size_t i = 0; i < crystal.size(); ++i)
        if(random.normal() > -0.43)
          state.add({crystal.position[0][i] + 0.03 * random.normal(),
                     crystal.position[1][i] + 0.03 * random.normal(),
                     crystal.position[2][i] + 0.03 * random.normal()});
      return state;
    }

    /** The sphere that a ray meets first, by what it meets alone; none: their number. */
    std::size_t first_met(const ParticleState &state, const std::array<double, 3> &from,
                          const std::array<double, 3> &along, double radius)
    {
      double nearest = 1e9;
      std::size_t met = state.size();
      for(std::size_t i = 0; i < state.size(); ++i)
      {
        double middle = 0, squared = 0;
        for(int d = 0; d < 3; ++d)
        {
          const double way = state.position[d][i] - from[d];
          middle += way * along[d];
          squared += way * way;
        }
        const double inside = radius * radius - squared + middle * middle;
        if(inside > 0 && middle - std::sqrt(inside) < nearest && middle > 0)
        {
          nearest = middle - std::sqrt(inside);
          met = i;
        }
      }
      return met;
    }

    /** Compares with rays at random: each sphere within five standard errors of its
     * number of hits, chi^2 of all within five of its own. */
    void expect_like_rays(const std::vector<Exposure> &exposure,
                          const std::vector<long> &hits, long rays, double all)
    {
      double chi_squared = 0;
      int spheres_hit = 0;
      for(std::size_t i = 0; i < exposure.size(); ++i)
      {
        const double share = exposure[i].width / all;
        const double found = static_cast<double>(hits[i]) / static_cast<double>(rays);
        const double error = std::sqrt(share * (1 - share) / static_cast<double>(rays));
        if(share < 1e-5) // too rare to be Gaussian
        {
          EXPECT_LT(found, 1e-4) << i;
          continue;
        }
        EXPECT_NEAR(found, share, 5 * error) << i;
        chi_squared += (found - share) * (found - share) / (error * error);
        ++spheres_hit;
      }
      EXPECT_GT(spheres_hit, 10);
      EXPECT_NEAR(chi_squared, spheres_hit, 5 * std::sqrt(2. * spheres_hit));
    }

    TEST(GreenspanSphereShadows, OfAPointAgreeWithRaysAtRandom)
    {
      constexpr double radius = 0.5;
      constexpr long rays = 100'000;
      for(const std::array<double, 3> source :
          {std::array{-3., 1., 2.}, {2.1, 2.2, 9.}, {2.0, 2.1, 1.9}})
      {
        ParticleState state = rough_crystal(3), kept = spheres({});
        for(std::size_t i = 0; i < state.size(); ++i) // not around the source
          if(std::hypot(state.position[0][i] - source[0],
                        state.position[1][i] - source[1],
                        state.position[2][i] - source[2])
             > 0.9)
            kept.add({state.position[0][i], state.position[1][i], state.position[2][i]});
        RandomNumbers random(17);
        std::vector<long> hits(kept.size() + 1, 0);
        for(long ray = 0; ray < rays; ++ray)
        {
          std::array<double, 3> along{random.normal(), random.normal(), random.normal()};
          const double length = std::hypot(along[0], along[1], along[2]);
          for(double &component : along)
            component /= length;
          ++hits[first_met(kept, source, along, radius)];
        }
        expect_like_rays(exposure_to_point(centres_of(kept), source, radius), hits, rays,
                         4 * pi);
      }
    }

    TEST(GreenspanSphereShadows, OfRaysAgreeWithRaysAtRandom)
    {
      constexpr double radius = 0.55, width = 8;
      constexpr long rays = 100'000;
      const ParticleState state = rough_crystal(5);
      RandomNumbers random(23);
      std::vector<long> hits(state.size() + 1, 0);
      for(long ray = 0; ray < rays; ++ray)
      {
        const double x = 2 + width * (random.uniform() - 0.5),
                     z = 2 + width * (random.uniform() - 0.5);
        ++hits[first_met(state, {x, 9, z}, {0, -1, 0}, radius)];
      }
      expect_like_rays(exposure_to_rays(centres_of(state), {0, -2, 0}, radius), hits,
                       rays, width * width);
    }

    TEST(GreenspanSphereShadows, OfTwoSpheresIsALens)
    {
      constexpr double radius = 0.5;
      for(const double aside : {0., 0.3, 0.7, 1., 1.3})
      {
        const auto exposure = exposure_to_rays(
            centres_of(spheres({{0, 0, 0}, {aside, 0, 3}})), {0, 0, 1}, radius);
        const double half = std::acos(std::min(1., aside));
        const double lens = radius * radius * (2 * half - std::sin(2 * half));
        EXPECT_NEAR(exposure[0].share, 1, 1e-15);
        EXPECT_NEAR(exposure[1].width, pi * radius * radius - lens, 1e-14) << aside;
      }
    }

    TEST(GreenspanSphereShadows, FarPointIsParallelRays)
    {
      constexpr double far = 1e6;
      const ParticleState state = rough_crystal(8);
      const auto rays = exposure_to_rays(centres_of(state), {-1, -2, -2}, 0.5);
      const auto point = exposure_to_point(centres_of(state),
                                           {far / 3, 2 * far / 3, 2 * far / 3}, 0.5);
      for(std::size_t i = 0; i < state.size(); ++i)
        EXPECT_NEAR(point[i].share, rays[i].share, 2e-5) << i;
    }

    /** A crystal along whose rows rays go: edges coincide, touch and meet in threes. */
    TEST(GreenspanSphereShadows, OfAPerfectCrystalAreItsSurface)
    {
      constexpr double spacing = 1.1;
      const ParticleState state = HexagonalLattice::close_packed_box({4, 4, 4}, spacing);
      const auto exposure = exposure_to_rays(centres_of(state), {0, 0, 1}, spacing / 2);
      const double disk = pi * spacing * spacing / 4;
      double all = 0;
      for(std::size_t i = 0; i < state.size(); ++i)
      {
        if(state.position[2][i] < 0.1) // the first layer
        {
          EXPECT_NEAR(exposure[i].width, disk, 1e-12) << i;
        }
        all += exposure[i].width;
      }
      // All together cover what the two layers' disks cover, found point by point.
      EXPECT_GT(all, 32 * disk);
      double union_area = 0;
      constexpr int points = 600;
      const double left = -1, width = 8;
      for(int i = 0; i < points; ++i)
        for(int j = 0; j < points; ++j)
        {
          const double x = left + width * (i + 0.5) / points,
                       y = left + width * (j + 0.5) / points;
          bool within = false;
          for(std::size_t k = 0; k < state.size() && !within; ++k)
            within = state.position[2][k] < 1
                     && std::hypot(x - state.position[0][k], y - state.position[1][k])
                            < spacing / 2;
          union_area += within * width * width / points / points;
        }
      EXPECT_NEAR(all, union_area, 0.01);
    }

    TEST(GreenspanSphereShadows, ASourceWithinASphereLightsItAlone)
    {
      const auto exposure = exposure_to_point(
          centres_of(spheres({{0, 0, 0}, {0.9, 0, 0}, {-2, 0, 0}})), {0.8, 0.1, 0}, 0.5);
      EXPECT_EQ(exposure[1].width, 4 * pi);
      EXPECT_EQ(exposure[0].width + exposure[2].width, 0);
      const Centres none{};
      EXPECT_TRUE(exposure_to_rays(none, {1, 0, 0}, 1).empty());
      EXPECT_THROW(exposure_to_rays(none, {0, 0, 0}, 1), cases::InputError);
      EXPECT_THROW(exposure_to_point(none, {0, 0, 0}, 0), cases::InputError);
    }
  } // namespace
} // namespace meltfront::particles::greenspan
