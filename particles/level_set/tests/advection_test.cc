#include <cases/error.h>
#include <particles/level_set/advection.h>
#include <particles/level_set/reinitialisation.h>
#include <particles/level_set/tests/shapes.h>

#include <gtest/gtest.h>

#include <numbers>

namespace meltfront::particles::level_set
{
  namespace
  {
    constexpr double pi = std::numbers::pi;

    cases::RigidMotion translation(double u, double v, double w = 0)
    {
      return {{u, v, w}, 0, {}};
    }

    cases::RigidMotion revolution()
    {
      return {{}, 2 * pi, {0.5, 0.5, 0}};
    }

    /** Smooth and without a level place. */
    double wave(const Position &p)
    {
      return p[0] + 0.7 * p[1] + 0.4 * p[2] + 0.1 * std::sin(2 * pi * p[0])
             + 0.05 * std::sin(2 * pi * (p[1] - p[2] + 0.1));
    }

    /** Largest error in the middle of a wave carried along, time steps so short that only
     * the grid counts. */
    double wave_error(int cells, int dimension)
    {
      const Grid grid = unit_grid(cells, dimension);
      LevelSet front(grid, wave, {0, 1});
      const double end = 0.05;
      const double width = grid.spacing() * std::cbrt(grid.spacing() * grid.spacing());
      const long steps = std::lround(std::ceil(end / width));
      const Position speed{0.9, -0.8, dimension == 3 ? 0.7 : 0.};
      const cases::RigidMotion motion(speed, 0, {});
      Advection advection;
      for(long step = 0; step < steps; ++step)
        advection.step(front, velocity_function(motion),
                       {step, end * step / steps, end / steps});
      double error = 0;
      for_each_node(grid, front.band(),
                    [&](std::size_t node, Position p)
                    {
                      bool middle = true;
                      for(int d = 0; d < dimension; ++d)
                      {
                        middle &= std::abs(p[d] - 0.5) < 0.11;
                        p[d] -= speed[d] * end;
                      }
                      if(middle)
                        error = std::max(error, std::abs(front.values()[node] - wave(p)));
                    });
      return error;
    }

    TEST(Advection, IsOfFifthOrderWhereSmooth)
    {
      const std::vector<std::vector<int>> levels{{20, 40, 80, 160}, {20, 28, 36, 44}};
      for(const int dimension : {2, 3})
      {
        const std::vector<int> &cells = levels[dimension - 2];
        std::vector<double> errors;
        for(const int n : cells)
          errors.push_back(wave_error(n, dimension));
        const double order = std::log(errors.front() / errors.back())
                             / std::log(double(cells.back()) / cells.front());
        EXPECT_GE(order, 4.5) << dimension << "D " << errors[0] << " " << errors[1] << " "
                              << errors[2] << " " << errors[3];
      }
    }

    TEST(Advection, LinearFunctionsAreCarriedExactly)
    {
      for(const int dimension : {2, 3})
      {
        const auto plane = [](const Position &p) { return p[0] - 2 * p[1] + p[2] + 0.4; };
        LevelSet front(unit_grid(12, dimension), plane, {0, 1});
        const cases::RigidMotion motion = translation(0.3, 0.5, dimension == 3 ? -1 : 0);
        Advection advection;
        for(long step = 0; step < 10; ++step)
          advection.step(front, velocity_function(motion), {step, 0.01 * step, 0.01});
        for_each_node(front.grid(), front.band(),
                      [&](std::size_t node, const Position &p)
                      {
                        const double z = dimension == 3 ? p[2] + 0.1 : 0;
                        EXPECT_NEAR(front.values()[node],
                                    plane({p[0] - 0.03, p[1] - 0.05, z}), 1e-13);
                      });
      }
    }

    /** phi after a step, in a band of so many layers. */
    LevelSet after_a_step(const Grid &grid, const ScalarFunction &shape, int layers)
    {
      LevelSet front(grid, shape, {layers, 1});
      const cases::RigidMotion motion = revolution();
      Advection().step(front, velocity_function(motion),
                       {1, 0, 0.5 * grid.spacing() / pi});
      return front;
    }

    TEST(Advection, BandAndWholeGridAgreeToTheBitWhereTheBandsEndCannotReach)
    {
      for(const int dimension : {2, 3})
      {
        const Grid grid = unit_grid(dimension == 2 ? 80 : 50, dimension);
        const ScalarFunction shape
            = dimension == 2 ? distance_from(slotted_disk) : distance_from(ball);
        // three stages reach three nodes each
        const LevelSet whole = after_a_step(grid, shape, 0);
        const LevelSet band = after_a_step(grid, shape, 12);
        long compared = 0;
        for_each_node(grid, band.band(),
                      [&](std::size_t node, const Position &p)
                      {
                        if(std::abs(shape(p)) > 2 * grid.spacing())
                          return;
                        EXPECT_EQ(band.values()[node], whole.values()[node]);
                        ++compared;
                      });
        EXPECT_GT(compared, 200);
      }
    }

    TEST(Advection, NothingMovesWithoutVelocity)
    {
      LevelSet front(unit_grid(40), distance_from(slotted_disk));
      const std::vector<double> before(front.values().begin(), front.values().end());
      const cases::RigidMotion rest = translation(0, 0);
      Advection advection;
      advection.step(front, velocity_function(rest), {1, 0, 100});
      EXPECT_TRUE(std::ranges::equal(before, front.values()));
      EXPECT_TRUE(std::isinf(advection.longest_step(front, velocity_function(rest), 0)));
    }

    TEST(Advection, LongestStepLetsTheFastestComponentCrossItsPart)
    {
      const LevelSet front(unit_grid(40), distance_from(disk));
      const cases::RigidMotion motion = translation(0.3, -2);
      EXPECT_DOUBLE_EQ(Advection().longest_step(front, velocity_function(motion), 0, 0.4),
                       0.4 * 0.025 / 2);
    }

    /** phi after some steps and a reinitialisation between them. */
    std::vector<double> moved(int dimension, int threads)
    {
      LevelSet front(unit_grid(dimension == 2 ? 80 : 30, dimension),
                     dimension == 2 ? distance_from(disk) : distance_from(ball),
                     {6, threads});
      const cases::SingleVortex vortex(8);
      const cases::CubeDeformation deformation(3);
      const VelocityFunction velocity
          = dimension == 2 ? velocity_function(vortex) : velocity_function(deformation);
      Advection advection;
      Reinitialisation reinitialise;
      for(long step = 0; step < 12; ++step)
      {
        advection.step(front, velocity, {step, 0.005 * step, 0.005});
        if(step % 5 == 4)
          reinitialise(front, 4);
      }
      return {front.values().begin(), front.values().end()};
    }

    TEST(Advection, ThreadsDoNotChangeABit)
    {
      for(const int dimension : {2, 3})
        EXPECT_EQ(moved(dimension, 1), moved(dimension, 2));
    }

    TEST(Advection, AFrontThatLeavesTheGridIsGone)
    {
      LevelSet front(unit_grid(40), distance_from(disk));
      const cases::RigidMotion motion = translation(1, 0.2);
      Advection advection;
      Reinitialisation reinitialise;
      for(long step = 0; step < 80; ++step)
      {
        advection.step(front, velocity_function(motion), {step, 0.01 * step, 0.01});
        if(step % 10 == 9)
          reinitialise(front);
      }
      EXPECT_EQ(front.band().size(), 0u);
      for_each_node(front.grid(), Band(front.grid(), whole_grid(front.grid())),
                    [&](std::size_t node, const Position &)
                    { EXPECT_LT(front.values()[node], 0); });
    }

    TEST(Advection, AFrontAtTheBorderSlidesAlongIt)
    {
      const cases::Ball half(2, {0, 0.4, 0}, 0.2);
      LevelSet front(unit_grid(80), distance_from(half));
      const cases::RigidMotion motion = translation(0, 1);
      Advection advection;
      Reinitialisation reinitialise;
      for(long step = 0; step < 40; ++step)
      {
        advection.step(front, velocity_function(motion), {step, 0.005 * step, 0.005});
        if(step % 10 == 9)
          reinitialise(front);
      }
      for(const double angle : {-0.5, -0.4, -0.2, 0., 0.25, 0.45, 0.5})
        EXPECT_NEAR(front.value({0.2 * std::cos(pi * angle),
                                 0.6 + 0.2 * std::sin(pi * angle), 0}),
                    0, 0.02 * front.grid().spacing());
    }

    TEST(Advection, StopsAtStepsThatAreTooLongAndAtWhatIsNoNumber)
    {
      LevelSet front(unit_grid(40), distance_from(disk));
      const cases::RigidMotion motion = translation(1, 0);
      EXPECT_THROW(Advection().step(front, velocity_function(motion), {7, 0, 0.03}),
                   cases::NumericalError);
      const VelocityFunction broken = [](const cases::PointArrays &, double,
                                         const std::array<std::span<double>, 3> &result)
      {
        for(double &u : result[0])
          u = NAN;
        for(double &u : result[1])
          u = 0;
      };
      try
      {
        Advection().step(front, broken, {7, 0, 0.001});
        FAIL();
      }
      catch(const cases::NumericalError &error)
      {
        EXPECT_EQ(error.step, 7);
        EXPECT_EQ(error.quantity, "phi");
      }
    }

    TEST(Reinitialisation, KeepsADistanceAsItIs)
    {
      const Grid grid = unit_grid(80);
      const ScalarFunction plane
          = [](const Position &p) { return 0.6 * (p[0] - 0.5) + 0.8 * (p[1] - 0.45); };
      LevelSet front(grid, plane);
      Reinitialisation()(front, 20);
      for_each_node(grid, front.band(),
                    [&](std::size_t node, const Position &p)
                    {
                      const bool middle
                          = std::abs(p[0] - 0.5) < 0.35 && std::abs(p[1] - 0.5) < 0.35;
                      if(middle)
                      {
                        EXPECT_NEAR(front.values()[node], plane(p), 1e-9);
                      }
                    });
    }

    TEST(Reinitialisation, MakesADistanceOfWhatIsNone)
    {
      for(const int dimension : {2, 3})
      {
        const Grid grid = unit_grid(dimension == 2 ? 80 : 50, dimension);
        const cases::Ball &round = round_shape(dimension);
        LevelSet front(grid,
                       [&](const Position &p)
                       {
                         const double distance = round.signed_distance(p);
                         return distance * (1 + 0.3 * std::sin(5 * p[0] + 3 * p[1]));
                       });
        for(int pass = 0; pass < 4; ++pass)
          Reinitialisation()(front);
        double worst = 0;
        for_each_node(grid, front.band(),
                      [&](std::size_t node, const Position &p)
                      {
                        const double distance = round.signed_distance(p);
                        if(std::abs(distance) < 3 * grid.spacing())
                          worst = std::max(worst,
                                           std::abs(front.values()[node] - distance));
                      });
        EXPECT_LT(worst, 0.05 * grid.spacing()) << dimension << "D";
      }
    }
    TEST(Reinitialisation, NoFrontComesInOverTheBorder)
    {
      // so steep far from the front that straight lines over the border lead to zero
      LevelSet front(
          unit_grid(50), [](const Position &p)
          { return disk.signed_distance(p) * (1.2 + std::sin(5 * p[0] + 3 * p[1])); });
      for(int pass = 0; pass < 10; ++pass)
        Reinitialisation()(front);
      for_each_node(front.grid(), front.band(),
                    [&](std::size_t node, const Position &p) {
                      EXPECT_NEAR(front.values()[node], disk.signed_distance(p), 0.02);
                    });
    }
  } // namespace
} // namespace meltfront::particles::level_set
