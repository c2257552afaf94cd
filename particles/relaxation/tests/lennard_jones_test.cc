#include <cases/error.h>
#include <particles/relaxation/lennard_jones.h>

#include <gtest/gtest.h>

#include <random>

namespace meltfront::particles
{
  namespace
  {
    constexpr CoordinateBox unit_box(int dimension)
    {
      return {dimension, {0, 0, 0}, {1, 1, 1}};
    }

    ParticleStorage random_particles(int dimension, int count, std::uint64_t seed)
    {
      std::mt19937_64 generator(seed);
      ParticleStorage result{dimension, {}};
      for(int i = 0; i < count; ++i)
      {
        std::array<double, 3> point{};
        for(int d = 0; d < dimension; ++d)
          point[d] = static_cast<double>(generator() >> 11) * 0x1p-53;
        result.add(point);
      }
      return result;
    }

    /** Particles on the walls of the unit square, corners among them. */
    ParticleStorage rim(int intervals)
    {
      ParticleStorage result{2, {}};
      for(int i = 0; i <= intervals; ++i)
        for(int j = 0; j <= intervals; ++j)
          if(i == 0 || j == 0 || i == intervals || j == intervals)
            result.add({i / double(intervals), j / double(intervals), 0});
      return result;
    }

    /** The energy pair by pair, from the potential itself. */
    double energy_by_pairs(const ParticleStorage &moving, const ParticleStorage &fixed,
                           const LennardJones &potential)
    {
      const double cutoff = potential.cutoff * potential.length;
      double sum = 0;
      const auto add = [&](const std::array<double, 3> &a, const std::array<double, 3> &b)
      {
        const double distance = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
        if(distance < cutoff)
          sum += potential.pair_energy(distance) - potential.pair_energy(cutoff);
      };
      for(std::size_t a = 0; a < moving.size(); ++a)
      {
        for(std::size_t b = 0; b < a; ++b)
          add(moving.point(a), moving.point(b));
        for(std::size_t b = 0; b < fixed.size(); ++b)
          add(moving.point(a), fixed.point(b));
      }
      return sum;
    }

    struct Relaxed
    {
      ParticleStorage particles;
      Descent descent;
    };

    /** @param least_fall 0: to a minimum */
    Relaxed relaxed(int side, std::uint64_t seed,
                    double least_fall = LennardJonesRelaxation().least_fall)
    {
      Relaxed result{random_particles(2, side * side, seed), {}};
      LennardJonesRelaxation parameters;
      parameters.least_fall = least_fall;
      parameters.potential.length = 1. / (side + 1);
      result.descent = relax_by_lennard_jones(result.particles, rim(side + 1),
                                              unit_box(2), parameters);
      return result;
    }

    TEST(LennardJones, TheWellIsAQuarterOfTheEnergyDeepAtTheSixthRootOfTwo)
    {
      const LennardJones potential{.length = 0.3, .energy = 2};
      const double bottom = 0.3 * std::pow(2., 1. / 6);
      EXPECT_NEAR(potential.pair_energy(bottom), -0.5, 1e-15);
      EXPECT_GT(potential.pair_energy(1.001 * bottom), potential.pair_energy(bottom));
      EXPECT_GT(potential.pair_energy(0.999 * bottom), potential.pair_energy(bottom));
      EXPECT_NEAR(potential.pair_energy(0.3), 0, 1e-15);
    }

    TEST(LennardJones, EnergyIsThatOfAllPairs)
    {
      for(int dimension = 1; dimension <= 3; ++dimension)
      {
        const int count = dimension == 1 ? 10 : 120;
        const ParticleStorage moving = random_particles(dimension, count, 4);
        const ParticleStorage fixed = random_particles(dimension, count / 2, 5);
        const LennardJones potential{.length = dimension == 3 ? 0.2 : 0.09};
        LennardJonesEnergy energy(dimension, fixed, potential, 1);
        Coordinates gradient = moving.position;
        const double expected = energy_by_pairs(moving, fixed, potential);
        EXPECT_NEAR(energy(moving.position, gradient), expected,
                    1e-11 * std::abs(expected))
            << dimension;
      }
    }

    TEST(LennardJones, ForcesAreDifferencesOfTheEnergy)
    {
      for(int dimension = 1; dimension <= 3; ++dimension)
      {
        const int per_side = dimension == 3 ? 4 : 8;
        ParticleStorage moving{dimension, {}};
        std::mt19937_64 generator(3);
        for(int i = 0; i < std::pow(per_side, dimension); ++i)
        {
          const std::array<int, 3> cell{i % per_side, i / per_side % per_side,
                                        i / per_side / per_side};
          std::array<double, 3> point{};
          for(int d = 0; d < 3; ++d)
            point[d]
                = (cell[d] + 0.4 * static_cast<double>(generator()) * 0x1p-64) / per_side;
          moving.add(point);
        }
        const ParticleStorage fixed = moving;
        for(int d = 0; d < dimension; ++d)
          for(double &x : moving.position[d])
            x += 0.3 / per_side;
        LennardJonesEnergy energy(dimension, fixed, {.length = 0.9 / per_side}, 1);
        Coordinates gradient = moving.position, unused = gradient;
        energy(moving.position, gradient);
        const double step = 1e-6 / per_side;
        double largest = 0;
        for(int d = 0; d < dimension; ++d)
          for(const double g : gradient[d])
            largest = std::max(largest, std::abs(g));
        for(int d = 0; d < dimension; ++d)
          for(const std::size_t a : {std::size_t(0), moving.size() / 2})
          {
            Coordinates shifted = moving.position;
            shifted[d][a] += step;
            const double above = energy(shifted, unused);
            shifted[d][a] -= 2 * step;
            EXPECT_NEAR((above - energy(shifted, unused)) / (2 * step), gradient[d][a],
                        1e-6 * largest)
                << dimension << ' ' << d << ' ' << a;
          }
        EXPECT_EQ(energy.list_builds(), 1);
      }
    }

    TEST(LennardJones, KeptNeighboursGiveTheEnergyOfNewOnes)
    {
      ParticleStorage moving = random_particles(2, 400, 6);
      const ParticleStorage fixed = rim(21);
      const LennardJones potential{.length = 1. / 21};
      LennardJonesEnergy kept(2, fixed, potential, 1);
      Coordinates gradient = moving.position, fresh_gradient = gradient;
      std::mt19937_64 generator(1);
      for(int move = 0; move < 20; ++move)
      {
        LennardJonesEnergy fresh(2, fixed, potential, 1);
        const double expected = fresh(moving.position, fresh_gradient);
        EXPECT_NEAR(kept(moving.position, gradient), expected,
                    1e-10 * std::abs(expected));
        for(int d = 0; d < 2; ++d)
          for(double &x : moving.position[d])
            x += 0.1 / 21 * (static_cast<double>(generator()) * 0x1p-64 - 0.5);
      }
      EXPECT_GT(kept.list_builds(), 1);
      EXPECT_LT(kept.list_builds(), 20);
    }

    TEST(LennardJones, TwoParticlesSettleInTheWell)
    {
      for(int dimension = 1; dimension <= 3; ++dimension)
      {
        ParticleStorage moving{dimension, {}};
        moving.add({0.5, 0.5, 0.5});
        const std::array<double, 3> fixed_point{0.55, 0.5, 0.5};
        ParticleStorage fixed{dimension, {}};
        fixed.add(fixed_point);
        LennardJonesRelaxation parameters;
        parameters.potential.length = 0.1;
        const Descent descent
            = relax_by_lennard_jones(moving, fixed, unit_box(dimension), parameters);
        EXPECT_TRUE(descent.converged);
        EXPECT_NEAR(0.55 - moving.position[0][0], 0.1 * std::pow(2., 1. / 6), 1e-6);
      }
    }

    TEST(LennardJones, TheEnergyNeverRises)
    {
      for(const long most : {0L, 5L, 20L, 80L})
      {
        ParticleStorage particles = random_particles(2, 100, 2);
        LennardJonesRelaxation parameters;
        parameters.potential.length = 1. / 11;
        double energy = std::numeric_limits<double>::infinity();
        parameters.most_iterations = most;
        for(int part = 0; part < 4; ++part)
        {
          const Descent descent
              = relax_by_lennard_jones(particles, rim(11), unit_box(2), parameters);
          EXPECT_LE(descent.energy, descent.energy_before);
          EXPECT_LE(descent.energy_before, energy + 1e-12 * std::abs(energy));
          EXPECT_LE(descent.iterations, most);
          energy = descent.energy;
        }
      }
    }

    TEST(LennardJones, NoParticleLeavesTheBoxFromAnyStart)
    {
      constexpr int side = 10;
      constexpr double margin = 1e-3 / (side + 1);
      for(std::uint64_t seed = 1; seed <= 30; ++seed)
      {
        const Relaxed result = relaxed(side, seed);
        EXPECT_TRUE(result.descent.converged) << seed;
        EXPECT_GT(result.descent.energy_before, 1e3 * std::abs(result.descent.energy));
        // Every particle near the bottom of some wells, none left high up on a wall.
        EXPECT_LT(result.descent.energy, -0.4 * 1e-2 * side * side) << seed;
        for(int d = 0; d < 2; ++d)
          for(const double x : result.particles.position[d])
          {
            ASSERT_GE(x, margin) << seed;
            ASSERT_LE(x, 1 - margin) << seed;
          }
      }
    }

    TEST(LennardJones, TheSameBitsForAnyNumberOfThreads)
    {
      const auto twenty_iterations = [](int threads)
      {
        Relaxed result{random_particles(2, 400, 7), {}};
        LennardJonesRelaxation parameters;
        parameters.potential.length = 1. / 21;
        parameters.most_iterations = 20;
        parameters.threads = threads;
        result.descent
            = relax_by_lennard_jones(result.particles, rim(21), unit_box(2), parameters);
        return result;
      };
      const Relaxed one = twenty_iterations(1), two = twenty_iterations(2);
      EXPECT_EQ(one.particles.position, two.particles.position);
      EXPECT_EQ(one.descent.energy, two.descent.energy);
      EXPECT_EQ(one.descent.evaluations, two.descent.evaluations);
      EXPECT_EQ(one.descent.iterations, 20);
    }

    TEST(LennardJones, AMinimumStays)
    {
      Relaxed first = relaxed(10, 3, 0);
      ParticleStorage again = first.particles;
      LennardJonesRelaxation parameters;
      parameters.least_fall = 0;
      parameters.potential.length = 1. / 11;
      const Descent descent
          = relax_by_lennard_jones(again, rim(11), unit_box(2), parameters);
      EXPECT_NEAR(descent.energy, first.descent.energy,
                  1e-4 * std::abs(first.descent.energy));
      for(int d = 0; d < 2; ++d)
        for(std::size_t a = 0; a < again.size(); ++a)
          EXPECT_NEAR(again.position[d][a], first.particles.position[d][a], 0.02);
    }

    /** Forces of random particles differ by fifteen orders: without the steps that
     * spread them the energy takes several hundred evaluations to fall below zero. */
    TEST(LennardJones, RandomParticlesAreSpreadWithinAHundredIterations)
    {
      for(const int side : {20, 40, 80})
      {
        ParticleStorage particles = random_particles(2, side * side, 1);
        LennardJonesRelaxation parameters;
        parameters.potential.length = 1. / (side + 1);
        parameters.most_iterations = 100;
        const Descent descent
            = relax_by_lennard_jones(particles, rim(side + 1), unit_box(2), parameters);
        EXPECT_GT(descent.energy_before, 1e6);
        EXPECT_LT(descent.energy, -0.2 * 1e-2 * side * side) << side;
        EXPECT_LE(descent.evaluations, 150) << side;
      }
    }

    TEST(LennardJones, LineSearchesTakeFewEvaluations)
    {
      for(std::uint64_t seed = 1; seed <= 5; ++seed)
      {
        const Descent descent = relaxed(20, seed, 0).descent;
        EXPECT_TRUE(descent.converged);
        EXPECT_LT(descent.evaluations, 1.7 * descent.iterations) << seed;
        EXPECT_LT(descent.largest_force, 1e-2 * 1e-2 * 21) << seed;
      }
    }

    TEST(LennardJones, TheLeastFallStopsEarlierNearTheSameEnergy)
    {
      const Descent minimum = relaxed(20, 1, 0).descent;
      for(const double least_fall : {1e-2, 1e-3, 1e-4})
      {
        const Descent descent = relaxed(20, 1, least_fall).descent;
        EXPECT_TRUE(descent.converged);
        EXPECT_LT(descent.iterations, minimum.iterations);
        EXPECT_GE(descent.energy, minimum.energy);
        EXPECT_LT(descent.energy, 0.9 * minimum.energy) << least_fall;
      }
    }

    TEST(LennardJones, FillsACube)
    {
      constexpr int side = 6;
      ParticleStorage particles = random_particles(3, side * side * side, 1);
      LennardJonesRelaxation parameters;
      parameters.potential.length = 1. / (side + 1);
      const Descent descent = relax_by_lennard_jones(particles, ParticleStorage{3, {}},
                                                     unit_box(3), parameters);
      EXPECT_TRUE(descent.converged);
      double nearest = 1;
      for(std::size_t a = 0; a < particles.size(); ++a)
        for(std::size_t b = 0; b < a; ++b)
        {
          const auto p = particles.point(a), q = particles.point(b);
          nearest = std::min(nearest, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
        }
      EXPECT_GT(nearest, 0.8 / (side + 1));
    }

    TEST(LennardJones, RefusesWhatCannotBeRelaxed)
    {
      const LennardJonesRelaxation parameters;
      ParticleStorage outside{2, {{{0.5, 1.5}, {0.5, 0.5}, {}}}};
      EXPECT_THROW(relax_by_lennard_jones(outside, {2, {}}, unit_box(2), parameters),
                   cases::InputError);
      ParticleStorage twins{2, {{{0.5, 0.5}, {0.5, 0.5}, {}}}};
      EXPECT_THROW(relax_by_lennard_jones(twins, {2, {}}, unit_box(2), parameters),
                   cases::InputError);
      LennardJonesRelaxation negative;
      negative.potential.length = -1;
      ParticleStorage one{2, {{{0.5}, {0.5}, {}}}};
      EXPECT_THROW(relax_by_lennard_jones(one, {2, {}}, unit_box(2), negative),
                   cases::InputError);
      ParticleStorage none{2, {}};
      EXPECT_TRUE(
          relax_by_lennard_jones(none, {2, {}}, unit_box(2), parameters).converged);
    }
  } // namespace
} // namespace meltfront::particles
