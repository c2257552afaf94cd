#include <cases/error.h>
#include <particles/greenspan/generation.h>
#include <particles/greenspan/motion/motion.h>
#include <particles/greenspan/phases.h>
#include <particles/greenspan/tables.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace meltfront::particles::greenspan
{
  namespace
  {
    TEST(GreenspanPhases, TrianglesNeedThreeColdCorners)
    {
      // Two triangles with a common side, and a particle that hangs on by one bond.
      ParticleState state;
      state.add({0, 0, 0});
      state.add({1, 0, 0});
      state.add({0.5, 0.9, 0});
      state.add({1.5, 0.9, 0});
      state.add({2.9, 0.9, 0});
      const BondGraph bonds(2, state.position);
      EXPECT_EQ(bonds.count(), 6u);
      using Marks = std::vector<char>;
      EXPECT_EQ(bonds.in_triangle(), (Marks{1, 1, 1, 1, 0}));
      EXPECT_EQ(bonds.in_triangle(Marks{0, 1, 1, 1, 1}), (Marks{0, 1, 1, 1, 0}));
      EXPECT_EQ(bonds.in_triangle(Marks{1, 0, 1, 1, 1}), (Marks{0, 0, 0, 0, 0}));
    }

    TEST(GreenspanPhases, LengthOfABondIsExclusive)
    {
      ParticleState state;
      state.add({0, 0, 0});
      state.add({1.5, 0, 0});
      state.add({0, 1.4999999, 0});
      const BondGraph bonds(2, state.position);
      EXPECT_EQ(bonds.count(), 1u);
      EXPECT_TRUE(bonds.bonded(0, 2));
      EXPECT_FALSE(bonds.bonded(0, 1));
    }

    TEST(GreenspanPhases, CellsFindTheBondsOfAllPairs)
    {
      ParticleState state = HexagonalLattice::rectangle(30, 30, 1.07);
      set_temperature(state, 100, 2);
      Motion motion(MotionParameters{}, state);
      motion.advance(500);
      state = motion.state();
      const BondGraph bonds(2, state.position);
      std::size_t count = 0;
      for(std::size_t i = 0; i < state.size(); ++i)
        for(std::size_t j = 0; j < i; ++j)
          if(std::hypot(state.position[0][i] - state.position[0][j],
                        state.position[1][i] - state.position[1][j])
             < 1.5)
          {
            ++count;
            EXPECT_TRUE(bonds.bonded(i, j));
          }
      EXPECT_EQ(bonds.count(), count);
    }

    // Measured over 20000 steps with an independent code: no cold particle exceeds 1.59,
    // where differences of velocities, as printed, exceed 7.5 nine times out of ten.
    TEST(GreenspanPhases, ColdSolidIsSolidByPositionsAndFluidByVelocities)
    {
      MotionParameters parameters;
      parameters.base = Base{};
      Motion motion(parameters, read_table(1));
      AverageVelocity average(100, parameters.time_step);
      average.record(motion.state());
      EXPECT_THROW(average.speed(), cases::InputError);
      EXPECT_EQ(average.cold(), Cold(28, 1));
      std::vector<ParticleState> past{motion.state()};
      double fastest = 0;
      int above = 0, all = 0;
      while(motion.step() < 20000)
      {
        motion.advance(100);
        past.push_back(motion.state());
        average.record(past.back());
        if(motion.step() % 1000 != 0)
          continue;
        const auto speed = average.speed();
        fastest = std::max(fastest, *std::max_element(speed.begin(), speed.end()));
        const ParticleState &now = past.back(), &then = past[past.size() - 11];
        for(std::size_t i = 7; i < 28; ++i) // those above the base
        {
          ++all;
          above += std::hypot(now.velocity[0][i] - then.velocity[0][i],
                              now.velocity[1][i] - then.velocity[1][i])
                   > 0.1 * critical_speed;
        }
      }
      EXPECT_NEAR(fastest, 1.59, 0.05);
      EXPECT_NEAR(double(above) / all, 0.885, 0.02);
    }

    TEST(GreenspanPhases, TemperatureIsTheMeanOfKineticEnergy)
    {
      MotionParameters parameters;
      parameters.gravity = 0;
      parameters.temperatures = true;
      ParticleState state;
      state.add({0, 0, 0});
      state.add({10, 0, 0});
      state.velocity[0] = {8, 3};
      Motion motion(parameters, state);
      motion.advance(50);
      const auto temperature = temperatures(motion.state());
      EXPECT_NEAR(temperature[0], 32, 1e-12);
      EXPECT_NEAR(temperature[1], 4.5, 1e-12);
      EXPECT_EQ(cold_by_temperature(motion.state()), (Cold{0, 1}));
      parameters.temperatures = false;
      EXPECT_THROW(temperatures(Motion(parameters, state).state()), cases::InputError);
      EXPECT_THROW(AverageVelocity(300, 1e-4), cases::InputError);
    }
  } // namespace
} // namespace meltfront::particles::greenspan
