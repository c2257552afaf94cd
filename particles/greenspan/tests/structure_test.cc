#include <cases/error.h>
#include <particles/greenspan/generation.h>
#include <particles/greenspan/motion/random_numbers.h>
#include <particles/greenspan/structure.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meltfront::particles::greenspan
{
  namespace
  {
    ParticleState shaken(ParticleState state, double deviation, std::uint64_t seed)
    {
      RandomNumbers random(seed);
      for(int d = 0; d < state.dimension; ++d)
        for(double &x : state.position[d])
          x += deviation * random.normal();
      return state;
    }

    std::vector<double> peaks_of(const ParticleState &crystal, double spacing)
    {
      PairCorrelation correlation(spacing);
      for(std::uint64_t seed = 1; seed <= 20; ++seed)
        correlation.add(shaken(crystal, 0.04 * spacing, seed));
      return correlation.peaks();
    }

    TEST(GreenspanStructure, PairCorrelationOfCrystalsPeaksAtTheirShells)
    {
      constexpr double spacing = 1.1;
      const auto plane = peaks_of(HexagonalLattice::disk(9, spacing), spacing);
      ASSERT_GE(plane.size(), 3u);
      const auto space
          = peaks_of(HexagonalLattice::close_packed_ball(4, spacing), spacing);
      ASSERT_GE(space.size(), 4u);
      for(const auto &[peak, shell] : {std::pair(plane[0], 1.),
                                       {plane[1], std::numbers::sqrt3},
                                       {plane[2], 2.},
                                       {space[0], 1.},
                                       {space[1], std::numbers::sqrt2},
                                       {space[2], std::numbers::sqrt3},
                                       {space[3], 2.}})
        EXPECT_NEAR(peak, shell, 0.012 * shell);
    }

    TEST(GreenspanStructure, PairCorrelationOfAGasHasNoPeaks)
    {
      ParticleState gas;
      RandomNumbers random(4);
      for(int i = 0; i < 20000; ++i)
        gas.add({100 * random.uniform(), 100 * random.uniform(), 0});
      PairCorrelation correlation(1);
      correlation.add(gas);
      EXPECT_TRUE(correlation.peaks().empty());
    }

    Experiment crystal_in_a_bath(const ParticleState &state)
    {
      Experiment experiment;
      experiment.start = state;
      experiment.parameters.gravity = 0;
      experiment.stages = {{0, 1000}, {1000, 2000}};
      return experiment;
    }

    TEST(GreenspanStructure, TellsPartnersAndShakingOfAStage)
    {
      const Experiment experiment = crystal_in_a_bath(HexagonalLattice::close_packed_ball(
          4, PairForce::triangle().equilibrium_distance()));
      Structure structure(experiment);
      constexpr double deviation = 0.02;
      for(long step = 100; step <= 2000; step += 20)
      {
        ParticleState state
            = shaken(experiment.start, deviation, static_cast<std::uint64_t>(step));
        state.step = step;
        structure.look(state, -5. * static_cast<double>(state.size()),
                       std::vector<char>(state.size(), 1));
      }
      const auto report = structure.report();
      EXPECT_EQ(report.at("partners_of_most_end"), 12);
      EXPECT_NEAR(report.at("energy_stage_2"), -5, 1e-12);
      EXPECT_EQ(report.at("temperature_stage_1"), 0);
      // Two ends move by the deviation along the bond; 26 looks take 2 % off.
      EXPECT_NEAR(report.at("lindemann_stage_1"),
                  std::numbers::sqrt2 * deviation
                      / experiment.parameters.force.equilibrium_distance(),
                  0.05 * deviation);
      EXPECT_FALSE(report.contains("hexatic_order_stage_1"));
    }

    /** Energies on a line per phase with a jump between the second and the third of four
     * stages; temperatures by velocities of that size. */
    TEST(GreenspanStructure, FindsHeatCapacitiesAndTheLatentHeatBetweenThem)
    {
      constexpr double of_solid = 2, of_fluid = 4, latent_heat = 27, melting = 38;
      Experiment experiment = crystal_in_a_bath(HexagonalLattice::disk(3, 1.1));
      experiment.stages = {{0, 100}, {100, 200}, {200, 300}, {300, 400}};
      const double temperature[] = {20, 30, 46, 54};
      Structure structure(experiment);
      std::vector<char> solid; // the lower half
      for(const double y : experiment.start.position[1])
        solid.push_back(y < 1.3);
      for(long step = 10; step <= 400; step += 10)
      {
        ParticleState state = experiment.start;
        state.step = step;
        const double t = temperature[(step - 1) / 100];
        for(double &v : state.velocity[0])
          v = std::sqrt(2 * t);
        const double energy = t < melting ? of_solid * (t - melting)
                                          : of_fluid * (t - melting) + latent_heat;
        structure.look(state, energy * static_cast<double>(state.size()), solid);
      }
      const auto report = structure.report();
      EXPECT_NEAR(report.at("heat_capacity_stage_2"), of_solid, 1e-9);
      EXPECT_NEAR(report.at("heat_capacity_stage_4"), of_fluid, 1e-9);
      EXPECT_NEAR(report.at("latent_heat_stage_3"), latent_heat, 1e-9);
      EXPECT_GT(report.at("fluid_above_solid_stage_1"), 1.1);
      EXPECT_FALSE(report.contains("latent_heat_stage_2"));
      EXPECT_FALSE(report.contains("latent_heat_stage_4"));
    }

    TEST(GreenspanStructure, ShiftedForceEndsAtZero)
    {
      PairForce force;
      force.shifted = true;
      force.validate();
      EXPECT_NEAR(force.magnitude(force.cutoff), 0, 1e-12);
      const double r = force.equilibrium_distance();
      EXPECT_NEAR(force.magnitude(r), 0, 1e-9);
      EXPECT_GT(r, PairForce().equilibrium_distance());
      constexpr double step = 1e-5;
      for(const double distance : {1.0, 1.2, 1.45})
        EXPECT_NEAR((force.potential(distance - step) - force.potential(distance + step))
                        / (2 * step),
                    force.magnitude(distance), 1e-4);
      force.cutoff = 1.15; // it repels up to there
      EXPECT_THROW(force.validate(), cases::InputError);
    }

    /** A pair that parts through the cutoff keeps its energy to second order only where
     * the force ends there without a jump. */
    TEST(GreenspanStructure, ShiftedForceKeepsTheEnergyOfPairsThatPart)
    {
      double worst[2]{};
      for(const bool shifted : {false, true})
      {
        MotionParameters parameters;
        parameters.force.shifted = shifted;
        parameters.gravity = 0;
        parameters.time_step = 4e-4;
        RandomNumbers random(9);
        for(int pair = 0; pair < 50; ++pair)
        {
          ParticleState state;
          state.add({0, 0, 0});
          state.add({1.2, 0, 0});
          state.velocity[0][1] = 22 + random.uniform();
          Motion motion(parameters, state);
          const double before = motion.energy().total();
          motion.advance(200);
          EXPECT_GT(distance(motion.state(), 0, 1), 1.5);
          worst[shifted]
              = std::max(worst[shifted], std::abs(motion.energy().total() - before));
        }
      }
      EXPECT_LT(worst[1], worst[0] / 5);
    }
  } // namespace
} // namespace meltfront::particles::greenspan
