#include <cases/error.h>
#include <particles/greenspan/calibration/bulk.h>
#include <particles/greenspan/motion/bonds.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::greenspan
{
  namespace
  {
    ParticleState warm_crystal(double temperature, int columns = 12, int rows = 10)
    {
      PeriodicCrystal crystal;
      crystal.columns = columns;
      crystal.rows = rows;
      ParticleState state = crystal.lattice();
      set_temperature(state, temperature, 3);
      return state;
    }

    MotionParameters free_of_gravity(double time_step = 4e-4)
    {
      MotionParameters parameters;
      parameters.gravity = 0;
      parameters.time_step = time_step;
      return parameters;
    }

    TEST(GreenspanPeriodic, NeighboursAreThoseAmongAllImages)
    {
      Motion motion(free_of_gravity(), warm_crystal(80, 24, 20));
      motion.advance(2000); // no lattice any more, some have gone round
      const ParticleState state = motion.state();
      for(const bool both : {true, false})
      {
        Period period = state.period;
        if(!both)
          period[0] = 0;
        const auto cells
            = find_in_periodic_space(2, state.position, state.size(), 1.8, period, false);
        const auto all
            = find_in_periodic_space(2, state.position, state.size(), 1.8, period, true);
        for(std::size_t a = 0; a < state.size(); ++a)
        {
          std::vector<std::uint32_t> expected;
          for(std::uint32_t b = 0; b < state.size(); ++b)
          {
            double least = 1e9;
            for(int i = -3; i <= 3; ++i)
              for(int j = -3; j <= 3; ++j)
                least = std::min(
                    least,
                    std::hypot(
                        state.position[0][a] - state.position[0][b] + i * period[0],
                        state.position[1][a] - state.position[1][b] + j * period[1]));
            if(a != b && least < 1.8)
              expected.push_back(b);
          }
          for(const FoundRows *found : {&cells, &all})
          {
            std::vector<std::uint32_t> row((*found)[a].begin(), (*found)[a].end());
            std::sort(row.begin(), row.end());
            EXPECT_EQ(row, expected) << a << " " << both;
          }
        }
      }
    }

    TEST(GreenspanPeriodic, PerfectCrystalIsAtRestWithItsSixBonds)
    {
      const ParticleState state = warm_crystal(0);
      const Motion motion(free_of_gravity(), state);
      const auto acceleration = motion.accelerations();
      for(int d = 0; d < 2; ++d)
        for(const double a : acceleration[d])
          EXPECT_NEAR(a, 0, 1e-9);
      const PairForce force;
      EXPECT_NEAR(motion.energy().bonds, -3. * force.bond_work() * double(state.size()),
                  1e-8);
      const BondGraph bonds(state);
      EXPECT_EQ(bonds.coordination(), 6);
      EXPECT_NEAR(hexatic_order(state, bonds), 1, 1e-12);
      for(const double order : lattice_order(state, bonds))
        EXPECT_NEAR(order, 1, 1e-12);
    }

    TEST(GreenspanPeriodic, NothingDependsOnWhereThePeriodBegins)
    {
      const ParticleState state = warm_crystal(20);
      ParticleState moved = state;
      for(std::size_t i = 0; i < moved.size(); ++i)
      {
        moved.position[0][i] -= 0.37 * moved.period[0] + (i % 3) * moved.period[0];
        moved.position[1][i] += 5.61 * moved.period[1];
      }
      Motion one(free_of_gravity(), state), other(free_of_gravity(), moved);
      one.advance(500);
      other.advance(500);
      for(int d = 0; d < 2; ++d)
        for(std::size_t i = 0; i < state.size(); ++i)
          EXPECT_NEAR(one.state().velocity[d][i], other.state().velocity[d][i], 1e-8);
    }

    TEST(GreenspanPeriodic, SameBitsForThreadsSkinsAndSearches)
    {
      for(const bool along_y_only : {true, false})
      {
        ParticleState start = warm_crystal(60, 60, 40);
        if(along_y_only)
          start.period[0] = 0;
        MotionParameters parameters = free_of_gravity();
        Motion reference(parameters, start);
        reference.advance(150);
        parameters.threads = 3;
        parameters.skin = 0.5;
        parameters.search = NeighbourRows::Search::among_all;
        Motion other(parameters, start);
        other.advance(150);
        EXPECT_EQ(reference.state().position, other.state().position);
        EXPECT_EQ(reference.state().velocity, other.state().velocity);
      }
    }

    TEST(GreenspanPeriodic, EnergyIsOfSecondOrderAndMomentumIsKept)
    {
      double finer = 0;
      for(const double time_step : {1.25e-4, 2.5e-4, 5e-4, 1e-3})
      {
        Motion motion(free_of_gravity(time_step), warm_crystal(2));
        const double start = motion.energy().total();
        double largest = 0;
        for(int k = 0; k < 500; ++k)
        {
          motion.advance(std::lround(1e-3 / time_step));
          largest = std::max(largest, std::abs(motion.energy().total() - start));
        }
        if(finer > 0)
        {
          EXPECT_NEAR(largest / finer, 4, 0.2) << time_step;
        }
        finer = largest;
        for(const double p : motion.momentum())
          EXPECT_NEAR(p, 0, 1e-10);
      }
    }

    // p = -dU/dA of a crystal at rest, by a difference that is exact to its square.
    TEST(GreenspanPeriodic, PressureIsTheDerivativeOfTheEnergy)
    {
      PeriodicCrystal crystal;
      crystal.spacing = 1.06;
      const auto energy = [&crystal](double factor)
      {
        Motion motion(free_of_gravity(), crystal.lattice());
        motion.stretch(factor);
        return motion.energy().bonds;
      };
      const Motion motion(free_of_gravity(), crystal.lattice());
      const double area = motion.period()[0] * motion.period()[1];
      for(int d = 0; d < 2; ++d)
      {
        const double pressure = motion.virial()[d] / area;
        EXPECT_GT(pressure, 100);
        double error = 0;
        for(const double e : {4e-4, 2e-4, 1e-4, 5e-5})
        {
          const double difference = -(energy(1 + e) - energy(1 - e)) / (4 * e * area);
          const double smaller = std::abs(difference - pressure);
          if(error > 0)
          {
            EXPECT_NEAR(error / smaller, 4, 0.1);
          }
          error = smaller;
        }
        EXPECT_LT(error, 1e-5 * pressure);
      }
    }

    TEST(GreenspanPeriodic, BadInputIsRefused)
    {
      ParticleState narrow = warm_crystal(0);
      narrow.period[1] = 3.5;
      EXPECT_THROW(Motion(free_of_gravity(), narrow), cases::InputError);
      MotionParameters walled = free_of_gravity();
      walled.wall = true;
      EXPECT_THROW(Motion(walled, warm_crystal(0)), cases::InputError);
      PeriodicCrystal odd;
      odd.rows = 7;
      EXPECT_THROW(odd.lattice(), cases::InputError);
      Motion motion(free_of_gravity(), warm_crystal(0));
      EXPECT_THROW(motion.stretch(3), cases::InputError);
      motion.stretch(0.55);
      EXPECT_THROW(motion.stretch(0.55), cases::InputError);
      BathZone reversed;
      reversed.begin = 2;
      reversed.end = 1;
      EXPECT_THROW(motion.set_zones({reversed}), cases::InputError);
    }
  } // namespace
} // namespace meltfront::particles::greenspan
