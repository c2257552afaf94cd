#include <cases/error.h>
#include <particles/greenspan/generation.h>
#include <particles/greenspan/motion/bonds.h>
#include <particles/greenspan/motion/motion.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meltfront::particles::greenspan
{
  namespace
  {
    std::size_t bonds(const ParticleState &state)
    {
      return BondGraph(state.dimension, state.position).count();
    }

    std::size_t triangle_bonds(int base)
    {
      return std::size_t(3) * base * (base - 1) / 2;
    }

    std::size_t rectangle_bonds(int base, int rows)
    {
      const std::size_t along
          = std::size_t(rows + 1) / 2 * (base - 1) + std::size_t(rows) / 2 * (base - 2);
      return along + std::size_t(rows - 1) * 2 * (base - 1);
    }

    TEST(GreenspanGeneration, CountsOfBondsAreExact)
    {
      const double spacing = PairForce::triangle().equilibrium_distance();
      for(const int base : {1, 2, 4, 7, 45, 140, 1000})
      {
        const ParticleState solid = HexagonalLattice::triangle(base, spacing);
        EXPECT_EQ(solid.size(), std::size_t(base) * (base + 1) / 2);
        EXPECT_EQ(bonds(solid), triangle_bonds(base)) << base;
      }
      EXPECT_EQ(triangle_bonds(7), 63u);
      EXPECT_EQ(triangle_bonds(45), 2970u);
      EXPECT_EQ(triangle_bonds(140), 29190u);
      for(const auto &[base, rows] : {std::pair{7, 7}, {2, 1}, {45, 24}, {1000, 1000}})
        EXPECT_EQ(bonds(HexagonalLattice::rectangle(base, rows, spacing)),
                  rectangle_bonds(base, rows))
            << base;
      EXPECT_EQ(rectangle_bonds(7, 7), 111u);
      EXPECT_EQ(rectangle_bonds(45, 24), 3068u);
    }

    TEST(GreenspanGeneration, OutlinesAreFilled)
    {
      const double spacing = PairForce::triangle().equilibrium_distance();
      const ParticleState seven = HexagonalLattice::disk(1.01 * spacing, spacing);
      EXPECT_EQ(seven.size(), 7u);
      EXPECT_EQ(bonds(seven), 12u);
      const double radius = 60;
      const ParticleState disk = HexagonalLattice::disk(radius, spacing);
      const double cell = std::sqrt(0.75) * spacing * spacing;
      EXPECT_NEAR(static_cast<double>(disk.size()) * cell,
                  std::numbers::pi * radius * radius, 2 * std::numbers::pi * radius);
      EXPECT_EQ(*std::min_element(disk.position[1].begin(), disk.position[1].end()), 0);
      const cases::Outline l_shape({{0, 0}, {20, 0}, {20, 8}, {8, 8}, {8, 20}, {0, 20}},
                                   {4, 4});
      const ParticleState corner = HexagonalLattice::within(l_shape, spacing);
      EXPECT_NEAR(static_cast<double>(corner.size()) * cell, l_shape.area(),
                  l_shape.perimeter() * spacing / 2);
      EXPECT_THROW(HexagonalLattice::within(l_shape, 0), cases::InputError);
      EXPECT_THROW(HexagonalLattice::triangle(0, 1), cases::InputError);
      EXPECT_THROW(HexagonalLattice::triangle(1 << 30, 1), cases::InputError);
    }

    // Figures of an independent code. Widths grow by 0.005 per unit of time, for
    // particles on the base creep.
    TEST(GreenspanGeneration, SolidsOfTheReportComeToRest)
    {
      const auto extent = [](const std::vector<double> &x) {
        return *std::max_element(x.begin(), x.end())
               - *std::min_element(x.begin(), x.end());
      };
      Relaxation relaxation;
      const PairForce triangle = PairForce::triangle();
      relaxation.force = triangle;
      RelaxedSolid solid = relax_on_base(
          HexagonalLattice::triangle(7, triangle.equilibrium_distance()), relaxation);
      EXPECT_EQ(solid.state.size(), 28u);
      EXPECT_EQ(solid.bonds, 63u);
      EXPECT_NEAR(extent(solid.state.position[0]), 6.4857, 1e-2);
      EXPECT_NEAR(extent(solid.state.position[1]), 5.5056, 2e-3);
      EXPECT_LT(solid.residual, 0.1);

      const PairForce rectangle = PairForce::rectangle();
      relaxation.force = rectangle;
      solid = relax_on_base(
          HexagonalLattice::rectangle(7, 7, rectangle.equilibrium_distance()),
          relaxation);
      EXPECT_EQ(solid.state.size(), 46u);
      EXPECT_EQ(solid.bonds, 111u);
      EXPECT_NEAR(extent(solid.state.position[0]), 6.3558, 1e-2);
      EXPECT_NEAR(extent(solid.state.position[1]), 5.3623, 2e-3);
      EXPECT_LT(solid.residual, 0.1);
    }

    TEST(GreenspanGeneration, LargerSolidsNeedLessGravity)
    {
      const PairForce force = PairForce::triangle();
      const ParticleState lattice
          = HexagonalLattice::triangle(20, force.equilibrium_distance());
      Relaxation relaxation = Relaxation::for_rows(force, 20);
      EXPECT_NEAR(relaxation.gravity, 32 * 0.35, 1e-12);
      const RelaxedSolid solid = relax_on_base(lattice, relaxation);
      EXPECT_EQ(solid.bonds, triangle_bonds(20));
      EXPECT_LT(solid.residual, 0.5);
      relaxation.gravity = 3200;
      EXPECT_THROW(relax_on_base(lattice, relaxation), cases::NumericalError);
    }

    TEST(GreenspanGeneration, TemperatureIsThatOfTheVelocities)
    {
      ParticleState state = HexagonalLattice::rectangle(100, 100, 1.07);
      set_temperature(state, 12, 3);
      MotionParameters parameters;
      parameters.gravity = 0;
      parameters.time_step = 1e-9;
      const Motion motion(parameters, state);
      EXPECT_NEAR(motion.temperature(), 12, 4 * 12 / std::sqrt(9950.));
      EXPECT_NEAR(motion.momentum()[0], 0, 1e-9);
    }
  } // namespace
} // namespace meltfront::particles::greenspan
