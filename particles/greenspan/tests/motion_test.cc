#include <cases/error.h>
#include <particles/greenspan/generation.h>
#include <particles/greenspan/motion/bonds.h>
#include <particles/greenspan/motion/motion.h>
#include <particles/greenspan/tables.h>
#include <particles/greenspan/tests/report_runs.h>

#include <gtest/gtest.h>

#include <cmath>

namespace meltfront::particles::greenspan
{
  namespace
  {
    /** Without base and gravity. */
    MotionParameters isolated(const PairForce &force, double time_step = 1e-4)
    {
      MotionParameters parameters;
      parameters.force = force;
      parameters.time_step = time_step;
      parameters.gravity = 0;
      return parameters;
    }

    double largest_energy_error(const PairForce &force, int table, double time_step)
    {
      Motion motion(isolated(force, time_step), read_table(table));
      const double start = motion.energy().total();
      double largest = 0;
      const long steps = std::lround(2 / time_step);
      const long interval = 4; // a hundredth of a vibration
      for(long step = 0; step < steps; step += interval)
      {
        motion.advance(interval);
        largest = std::max(largest, std::abs(motion.energy().total() - start));
      }
      return largest;
    }

    // Targets: the same formulas in independent codes.
    TEST(GreenspanMotion, EnergyOfIsolatedSolidsIsOfSecondOrder)
    {
      struct Solid
      {
        PairForce force;
        int table;
        double energy, error;
      };
      for(const Solid &solid : {Solid{PairForce::triangle(), 1, -5887.554933, 1.43e-3},
                                Solid{PairForce::rectangle(), 2, -7831.174353, 1.07e-2}})
      {
        const Motion motion(isolated(solid.force), read_table(solid.table));
        EXPECT_NEAR(motion.energy().total(), solid.energy, 1e-6);
        double finer = largest_energy_error(solid.force, solid.table, 5e-5);
        for(const double time_step : {1e-4, 2e-4, 4e-4})
        {
          const double error = largest_energy_error(solid.force, solid.table, time_step);
          EXPECT_NEAR(error / finer, 4.0, 0.1) << solid.table << " " << time_step;
          if(time_step == 1e-4)
          {
            EXPECT_NEAR(error, solid.error, 0.05 * solid.error);
          }
          finer = error;
        }
      }
    }

    TEST(GreenspanMotion, MomentumOfIsolatedSolidsStays)
    {
      for(const int table : {1, 2})
      {
        ParticleState start = read_table(table);
        start.velocity[0][3] += 0.7;
        const PairForce force
            = table == 1 ? PairForce::triangle() : PairForce::rectangle();
        Motion motion(isolated(force), start);
        const auto before = motion.momentum();
        motion.advance(20000);
        for(int d = 0; d < 2; ++d)
          EXPECT_NEAR(motion.momentum()[d], before[d], 1e-10);
      }
    }

    /** Differences of two states, the largest. */
    double largest_difference(const ParticleState &a, const ParticleState &b)
    {
      double largest = 0;
      for(int d = 0; d < a.dimension; ++d)
        for(std::size_t i = 0; i < a.size(); ++i)
          largest = std::max({largest, std::abs(a.position[d][i] - b.position[d][i]),
                              std::abs(a.velocity[d][i] - b.velocity[d][i])});
      return largest;
    }

    bool same_bits(const ParticleState &a, const ParticleState &b)
    {
      return a.position == b.position && a.velocity == b.velocity
             && a.kinetic_sum == b.kinetic_sum && a.step == b.step;
    }

    MotionParameters hot_rectangle()
    {
      MotionParameters parameters;
      parameters.force = PairForce::rectangle();
      parameters.base = heated_base();
      parameters.temperatures = true;
      return parameters;
    }

    /** A melting crystal of some thousand particles, which collapses on a hot base. */
    ParticleState hot_crystal(int base, int rows)
    {
      ParticleState state = HexagonalLattice::rectangle(
          base, rows, 1.02 * PairForce::rectangle().equilibrium_distance());
      set_temperature(state, 60, 5);
      return state;
    }

    TEST(GreenspanMotion, HeatStagesChangeAfterTheirLastStep)
    {
      const HeatSource source = slow_source(2);
      EXPECT_EQ(source.strength(1), 0.008);
      EXPECT_EQ(source.strength(50000), 0.008);
      EXPECT_EQ(source.strength(50001), 0.0095);
      EXPECT_EQ(source.strength(80000), 0.0095);
      EXPECT_EQ(source.strength(80001), 0.015);
      EXPECT_EQ(source.strength(200000), 0.015);
    }

    TEST(GreenspanMotion, UnheatedSolidsKeepAllBonds)
    {
      MotionParameters parameters;
      parameters.base = Base{};
      for(const int table : {1, 2})
      {
        const ParticleState start = read_table(table);
        if(table == 2)
          parameters.force = PairForce::rectangle();
        const BondGraph before(2, start.position);
        EXPECT_EQ(before.count(), table == 1 ? 63u : 111u);
        Motion motion(parameters, start);
        for(int look = 0; look < 100; ++look)
        {
          motion.advance(1000);
          const BondGraph after(2, motion.state().position);
          ASSERT_EQ(before.shared_with(after), before.count()) << motion.step();
          ASSERT_EQ(after.count(), before.count()) << motion.step();
        }
      }
    }

    TEST(GreenspanMotion, MirrorSymmetryStays)
    {
      MotionParameters parameters;
      parameters.base = Base{};
      Motion motion(parameters, read_table(1));
      motion.advance(10000);
      const ParticleState state = motion.state();
      for(std::size_t i = 0; i < state.size(); ++i)
      {
        double nearest = 1;
        for(std::size_t j = 0; j < state.size(); ++j)
          nearest = std::min(nearest,
                             std::hypot(state.position[0][i] + state.position[0][j],
                                        state.position[1][i] - state.position[1][j]));
        EXPECT_LT(nearest, 1e-11) << i;
      }
    }

    TEST(GreenspanMotion, CellsAndAllPairsGiveTheSameBits)
    {
      const ParticleState start = hot_crystal(24, 20);
      MotionParameters parameters = hot_rectangle();
      parameters.search = NeighbourRows::Search::among_all;
      Motion all(parameters, start);
      parameters.search = NeighbourRows::Search::by_cells;
      parameters.skin = 0.17;
      Motion cells(parameters, start);
      parameters.skin = 0.6;
      Motion wide(parameters, start);
      for(Motion *motion : {&all, &cells, &wide})
        motion->advance(3000);
      EXPECT_TRUE(same_bits(all.state(), cells.state()));
      EXPECT_TRUE(same_bits(all.state(), wide.state()));
      EXPECT_GT(cells.list_builds(), 10);
      EXPECT_GT(cells.list_builds(), wide.list_builds());
    }

    TEST(GreenspanMotion, FarAwayParticlesAreNeighboursToo)
    {
      ParticleState start = hot_crystal(24, 20);
      const double far = 9e5; // a grid over all of it would have huge cells
      for(const double x : {-far, far})
        for(const double y : {1., 2.05, far})
          start.add({x, y, 0});
      MotionParameters parameters = hot_rectangle();
      parameters.search = NeighbourRows::Search::among_all;
      Motion all(parameters, start);
      parameters.search = NeighbourRows::Search::by_cells;
      Motion cells(parameters, start);
      all.advance(300);
      cells.advance(300);
      EXPECT_TRUE(same_bits(all.state(), cells.state()));
      const ParticleState end = all.state();
      EXPECT_NE(end.velocity[1][end.size() - 6], start.velocity[1][end.size() - 6]);
    }

    TEST(GreenspanMotion, ThreadsAndResumingGiveTheSameBits)
    {
      // Sorted along a curve, two blocks; little skin, so that lists are made often.
      const ParticleState start = hot_crystal(90, 60);
      MotionParameters parameters = hot_rectangle();
      parameters.source = fast_source(-2);
      parameters.skin = 0.04;
      Motion one(parameters, start);
      one.advance(40);
      const ParticleState early = one.state();
      one.advance(20);
      Motion again(parameters, one.state());
      one.advance(100);
      again.advance(100);
      EXPECT_TRUE(same_bits(one.state(), again.state()));
      EXPECT_GT(one.list_builds(), 10); // among them new orders in memory
      for(const int threads : {2, 3})
      {
        parameters.threads = threads;
        Motion several(parameters, start);
        several.advance(40);
        EXPECT_TRUE(same_bits(early, several.state())) << threads;
      }
    }

    TEST(GreenspanMotion, GeneralExponentsAgreeWithCompiledOnes)
    {
      for(MotionParameters parameters :
          {isolated(PairForce::triangle()), hot_rectangle()})
      {
        const ParticleState start = hot_crystal(24, 20);
        Motion compiled(parameters, start);
        parameters.force.compiled_exponents = false;
        Motion general(parameters, start);
        const auto a = compiled.accelerations(), b = general.accelerations();
        for(int d = 0; d < 2; ++d)
          for(std::size_t i = 0; i < start.size(); ++i)
            // Terms of the sums are of the order of 100 to 1000.
            EXPECT_NEAR(a[d][i], b[d][i], 1e-13 * 1000);
        compiled.advance(300);
        general.advance(300);
        EXPECT_LT(largest_difference(compiled.state(), general.state()), 1e-9);
      }
    }

    TEST(GreenspanMotion, BadStartsAreRefused)
    {
      const ParticleState good = read_table(1);
      const auto refused = [&good](const auto &spoil, const MotionParameters &parameters)
      {
        ParticleState state = good;
        spoil(state);
        EXPECT_THROW(Motion(parameters, state), cases::InputError);
      };
      MotionParameters parameters;
      parameters.base = Base{};
      refused([](ParticleState &s) { s.position[0][4] = NAN; }, parameters);
      refused([](ParticleState &s) { s.velocity[1][4] = INFINITY; }, parameters);
      refused([](ParticleState &s) { s.position[0][4] = 1e300; }, parameters);
      refused([](ParticleState &s) { s.position[1][4] = -0.1; }, parameters);
      refused([](ParticleState &s) { s.dimension = 1; }, parameters);
      refused([](ParticleState &s) { s = ParticleState{}; }, parameters);
      refused([](ParticleState &s) { s.velocity[1].pop_back(); }, parameters);
      refused(
          [](ParticleState &s)
          {
            s.position[0][5] = s.position[0][4];
            s.position[1][5] = s.position[1][4];
          },
          parameters);
      const auto keep = [](ParticleState &) {};
      MotionParameters bad = parameters;
      bad.time_step = 0.015;
      refused(keep, bad);
      bad = parameters;
      bad.source = slow_source(2);
      bad.source->position = {good.position[0][27], good.position[1][27], 0};
      refused(keep, bad);
      bad = parameters;
      bad.force.cutoff = 1;
      refused(keep, bad);
    }

    /** The step in which a run fails, and what it says. */
    std::pair<long, std::string> failure(const MotionParameters &parameters,
                                         const ParticleState &start, long steps)
    {
      Motion motion(parameters, start);
      try
      {
        motion.advance(steps);
      }
      catch(const cases::NumericalError &error)
      {
        EXPECT_EQ(error.step, motion.step());
        return {error.step, error.what()};
      }
      return {-1, ""};
    }

    TEST(GreenspanMotion, BrokenRunsStopAtTheirStep)
    {
      // Compressed bonds are stiffer than those for which the step would do.
      MotionParameters parameters = isolated(PairForce::triangle(), 0.012);
      const auto [step, what]
          = failure(parameters, HexagonalLattice::triangle(9, 0.9), 1000);
      EXPECT_GE(step, 1);
      EXPECT_LE(step, 3);
      EXPECT_NE(what.find("time step"), std::string::npos) << what;

      // A particle that falls through the source.
      parameters = MotionParameters{};
      parameters.source = slow_source(2);
      parameters.source->position = {0, 1, 0};
      ParticleState falling;
      falling.add({0, 1.05, 0});
      falling.velocity[1][0] = -100; // against the source
      const auto [source_step, source_what] = failure(parameters, falling, 1000);
      EXPECT_GE(source_step, 1);
      EXPECT_NE(source_what.find("source"), std::string::npos) << source_what;
    }
  } // namespace
} // namespace meltfront::particles::greenspan
