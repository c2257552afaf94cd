#include <cases/error.h>
#include <particles/greenspan/generation.h>
#include <particles/greenspan/motion/bonds.h>
#include <particles/greenspan/motion/motion.h>
#include <particles/greenspan/shadows.h>
#include <particles/greenspan/tables.h>
#include <particles/greenspan/tests/report_runs.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

namespace meltfront::particles::greenspan
{
  namespace
  {
    std::set<int> exposed(const std::vector<Exposure> &exposure)
    {
      std::set<int> numbers;
      for(std::size_t i = 0; i < exposure.size(); ++i)
        if(exposure[i].share > 0)
          numbers.insert(static_cast<int>(i) + 1);
      return numbers;
    }

    // What is exposed was found with an independent code.
    TEST(GreenspanShadows, OutsideOfTheTriangleIsLit)
    {
      const ParticleState solid = read_table(1);
      const double radius = PairForce::triangle().equilibrium_distance() / 2;
      const auto &x = solid.position[0], &y = solid.position[1];
      EXPECT_EQ(exposed(exposure_to_point(x, y, {0.2, 7.7}, radius)),
                (std::set<int>{1, 7, 8, 13, 14, 18, 19, 22, 23, 25, 26, 27, 28}));
      // The source of the report lies inside the uppermost particle.
      const auto inside = exposure_to_point(x, y, {0.2, 5.7}, radius);
      EXPECT_EQ(exposed(inside), std::set<int>{28});
      EXPECT_EQ(inside[27].share, 1);
    }

    TEST(GreenspanShadows, TopRowOfTheRectangleIsLit)
    {
      const ParticleState solid = read_table(2);
      const double radius = PairForce::rectangle().equilibrium_distance() / 2;
      const auto exposure
          = exposure_to_point(solid.position[0], solid.position[1], {0, 7}, radius);
      EXPECT_EQ(exposed(exposure), (std::set<int>{40, 41, 42, 43, 44, 45, 46}));
      const double share[] = {0.320, 0.787, 0.923, 1, 0.923, 0.787, 0.320};
      for(int i = 0; i < 7; ++i)
        EXPECT_NEAR(exposure[39 + i].share, share[i], 6e-4) << i;
    }

    /** For each of many rays the disk that it meets first. */
    std::vector<double> widths_by_rays(const ParticleState &solid, double sx, double sy,
                                       double radius, int rays)
    {
      std::vector<double> width(solid.size(), 0);
      for(int ray = 0; ray < rays; ++ray)
      {
        const double angle = 2 * std::numbers::pi * (ray + 0.5) / rays;
        const double c = std::cos(angle), s = std::sin(angle);
        double nearest = 1e9;
        std::size_t hit = solid.size();
        for(std::size_t i = 0; i < solid.size(); ++i)
        {
          const double dx = solid.position[0][i] - sx, dy = solid.position[1][i] - sy;
          const double across = c * dy - s * dx;
          const double along
              = c * dx + s * dy
                - std::sqrt(std::max(0., radius * radius - across * across));
          if(std::abs(across) < radius && along > 0 && along < nearest)
          {
            nearest = along;
            hit = i;
          }
        }
        if(hit < solid.size())
          width[hit] += 2 * std::numbers::pi / rays;
      }
      return width;
    }

    TEST(GreenspanShadows, AgreeWithRays)
    {
      const double spacing = 1.08, radius = spacing / 2 * (1 - 1e-9);
      const ParticleState solid = HexagonalLattice::disk(7, spacing);
      // Beside the disk, across the cut of the angles, and in a gap of the lattice.
      for(const auto &[sx, sy] : {std::pair{-9.3, 4.1}, {12., 7.03}, {0.5, 15.}})
      {
        const auto exposure
            = exposure_to_point(solid.position[0], solid.position[1], {sx, sy}, radius);
        const int rays = 100000;
        const auto width = widths_by_rays(solid, sx, sy, radius, rays);
        for(std::size_t i = 0; i < solid.size(); ++i)
          EXPECT_NEAR(exposure[i].width, width[i], 6 * 2 * std::numbers::pi / rays) << i;
      }
    }

    TEST(GreenspanShadows, FarPointIsParallelRays)
    {
      const ParticleState solid = HexagonalLattice::disk(7, 1.08);
      const double far = 1e7, radius = 0.5;
      const double c = std::cos(1.), s = std::sin(1.);
      const auto &x = solid.position[0], &y = solid.position[1];
      const auto rays = exposure_to_rays(x, y, {-3 * c, -3 * s}, radius);
      const auto point = exposure_to_point(x, y, {far * c, far * s}, radius);
      double all = 0;
      for(std::size_t i = 0; i < solid.size(); ++i)
      {
        EXPECT_NEAR(rays[i].share, point[i].share, 1e-5) << i;
        all += rays[i].width;
      }
      EXPECT_LT(all, 15);
      EXPECT_GT(all, 13);
      EXPECT_THROW(exposure_to_rays(x, y, {0, 0}, radius), cases::InputError);
      EXPECT_THROW(exposure_to_point(x, y, {0, 0}, 0), cases::InputError);
    }

    TEST(GreenspanRadiation, GivesWhatItSends)
    {
      MotionParameters parameters;
      parameters.gravity = 0;
      Radiation light;
      light.position = {0, 6.5, 0}; // in the middle of a disk without a way out
      light.power = 50;
      parameters.radiation = light;
      ParticleState disk
          = HexagonalLattice::disk(7, parameters.force.equilibrium_distance());
      // A hole for the source.
      ParticleState ring;
      for(std::size_t i = 0; i < disk.size(); ++i)
        if(std::hypot(disk.position[0][i], disk.position[1][i] - 6.5) > 2)
          ring.add({disk.position[0][i], disk.position[1][i], 0});
      set_temperature(ring, 1, 4);
      parameters.force.cutoff = 1.5;
      Motion motion(parameters, ring);
      const double before = motion.energy().total();
      motion.advance(2000);
      EXPECT_NEAR(motion.absorbed(), 50 * 2000 * parameters.time_step, 1e-9);
      EXPECT_NEAR(motion.energy().total() - before, motion.absorbed(),
                  0.02 * motion.absorbed());
      Motion half(parameters, ring);
      half.advance(1010);
      Motion resumed(parameters, half.state());
      resumed.advance(990);
      EXPECT_EQ(resumed.state().position, motion.state().position);
      parameters.radiation->interval = 0;
      EXPECT_THROW(Motion(parameters, ring), cases::InputError);
    }

    TEST(GreenspanThermostat, HoldsATemperature)
    {
      MotionParameters parameters;
      parameters.gravity = 0;
      parameters.thermostat = Thermostat{10, 10, 1, 20, 7};
      for(const int dimension : {2, 3})
      {
        const double spacing = parameters.force.equilibrium_distance();
        ParticleState state
            = dimension == 2 ? HexagonalLattice::rectangle(20, 20, spacing)
                             : HexagonalLattice::close_packed_box({4, 4, 4}, spacing);
        Motion motion(parameters, state);
        motion.advance(8000);
        double mean = 0;
        for(int look = 0; look < 100; ++look)
        {
          motion.advance(100);
          mean += motion.temperature() / 100;
        }
        EXPECT_NEAR(mean, 10, 0.3) << dimension;
      }
      parameters.thermostat->rate = 0;
      EXPECT_THROW(Motion(parameters, read_table(1)), cases::InputError);
    }

    TEST(GreenspanFreezing, DropCrystallises)
    {
      MotionParameters parameters;
      parameters.gravity = 0;
      parameters.time_step = 4e-4;
      parameters.thermostat = Thermostat{75, 75, 1, 20, 3};
      const ParticleState disk
          = HexagonalLattice::disk(9, parameters.force.equilibrium_distance());
      Motion motion(parameters, disk);
      motion.advance(2500);
      const auto order = [&motion]
      {
        const ParticleState state = motion.state();
        const BondGraph bonds(2, state.position);
        return std::pair{hexatic_order(state, bonds), bonds.coordination()};
      };
      const auto [liquid, liquid_coordination] = order();
      motion.set_thermostat(Thermostat{50, 3, motion.step() + 60000, 2, 3});
      motion.advance(60000);
      const auto [solid, solid_coordination] = order();
      EXPECT_LT(liquid, 0.75);
      EXPECT_GT(solid, 0.85);
      EXPECT_GT(solid_coordination, liquid_coordination + 0.4);
    }

    TEST(GreenspanFreezing, BaseThatTakesAllCools)
    {
      MotionParameters parameters;
      parameters.base = Base{.restitution = 0};
      ParticleState state = read_table(1);
      Motion motion(parameters, state);
      const double before = motion.temperature();
      motion.advance(50000);
      EXPECT_LT(motion.temperature(), before / 2);
    }

    TEST(GreenspanSpace, SecondShellTellsTheParametersApart)
    {
      for(const auto &[force, neighbours] :
          {std::pair{PairForce::triangle(), 12u}, {PairForce::rectangle(), 18u}})
      {
        const ParticleState box
            = HexagonalLattice::close_packed_box({5, 5, 5}, force.equilibrium_distance());
        EXPECT_EQ(box.size(), 500u);
        const BondGraph bonds(3, box.position, force.cutoff);
        std::size_t most = 0;
        for(std::size_t i = 0; i < box.size(); ++i)
          most = std::max(most, bonds[i].size());
        EXPECT_EQ(most, neighbours);
      }
    }

    TEST(GreenspanSpace, EnergyIsOfSecondOrderAndMomentumStays)
    {
      PairForce force = PairForce::triangle();
      force.cutoff = 1.3; // between the shells, so that no bond breaks
      ParticleState start
          = HexagonalLattice::close_packed_box({2, 2, 2}, force.equilibrium_distance());
      set_temperature(start, 2, 11);
      double coarser = 0;
      for(const double time_step : {8e-4, 4e-4, 2e-4, 1e-4})
      {
        MotionParameters parameters;
        parameters.force = force;
        parameters.time_step = time_step;
        parameters.gravity = 0;
        Motion motion(parameters, start);
        const double energy = motion.energy().total();
        double error = 0;
        const long steps = std::lround(0.4 / time_step);
        for(long step = 0; step < steps; ++step)
        {
          motion.advance(1);
          error = std::max(error, std::abs(motion.energy().total() - energy));
        }
        for(const double p : motion.momentum())
          EXPECT_NEAR(p, 0, 1e-10);
        if(coarser > 0)
        {
          EXPECT_NEAR(coarser / error, 4, 0.3) << time_step;
        }
        coarser = error;
      }
    }

    TEST(GreenspanSpace, CellsAndAllPairsGiveTheSameBits)
    {
      ParticleState start = HexagonalLattice::close_packed_box({5, 5, 5}, 1.1);
      set_temperature(start, 120, 1);
      MotionParameters parameters;
      parameters.base = heated_base();
      parameters.search = NeighbourRows::Search::among_all;
      Motion all(parameters, start);
      parameters.search = NeighbourRows::Search::by_cells;
      Motion cells(parameters, start);
      all.advance(600);
      cells.advance(600);
      EXPECT_EQ(all.state().position, cells.state().position);
      EXPECT_GT(cells.list_builds(), 2);
    }

    TEST(GreenspanSpace, LightGivesTheEnergyThatItsShadowsLeave)
    {
      const PairForce force;
      ParticleState ball
          = HexagonalLattice::close_packed_ball(4, force.equilibrium_distance());
      set_temperature(ball, 4, 2);
      MotionParameters parameters;
      parameters.force.cutoff = 1.3;
      parameters.gravity = 0;
      parameters.radiation = Radiation{.parallel = true, .power = 40};
      Motion motion(parameters, ball);
      const double before = motion.energy().total();
      motion.advance(1000);
      EXPECT_NEAR(motion.energy().total() - before, motion.absorbed(),
                  0.02 * motion.absorbed());
      // The ball's shadow: its disk, less what passes through gaps at the rim.
      const double radius = 4 + force.equilibrium_distance() / 2;
      const double caught = motion.absorbed() / (40 * motion.time());
      EXPECT_LT(caught, std::numbers::pi * radius * radius);
      EXPECT_GT(caught, 0.8 * std::numbers::pi * radius * radius);
    }

    TEST(GreenspanThermostat, FollowsACourse)
    {
      Thermostat bath;
      bath.course = {{0, 50}, {100, 50}, {200, 10}};
      EXPECT_EQ(bath.temperature(0), 50);
      EXPECT_EQ(bath.temperature(60), 50);
      EXPECT_EQ(bath.temperature(150), 30);
      EXPECT_EQ(bath.temperature(1000), 10);
      MotionParameters parameters;
      bath.course = {{100, 50}, {100, 10}};
      parameters.thermostat = bath;
      EXPECT_THROW(parameters.validate(2), cases::InputError);
    }
  } // namespace
} // namespace meltfront::particles::greenspan
