#include <verification/measure/formulas/front_reader.h>
#include <verification/measure/tests/fixtures.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace meltfront::verification
{
  namespace
  {
    using cases::DomainShape;
    using cases::Symmetry;
    using tests::State;

    const tests::LinearProfile freezing_slab(Symmetry::planar);

    /** n cells between 0 and 1; the cell that holds the front is partly frozen and at
     * T_m. */
    State frozen_slab(int n, double front, double melting_temperature = 0)
    {
      State state;
      for(int i = 0; i < n; ++i)
      {
        const double x = (i + 0.5) / n;
        const double fraction = std::clamp(front * n - i, 0., 1.);
        state.positions[0].push_back(x);
        state.weights.push_back(1. / n);
        state.solid_fraction.push_back(fraction);
        state.temperature.push_back(melting_temperature
                                    + (fraction > 0 && fraction < 1 ? 0 : x - front));
      }
      return state;
    }

    TEST(FrontReader, ReadsASlabFromItsLatentHeatExactly)
    {
      const auto scene = tests::scene_of(DomainShape::slab, 1, Symmetry::planar);
      FrontReader reader(scene, &freezing_slab, 0.1, 0.12);
      State state = frozen_slab(10, 0.437);
      const FrontReading reading = reader.read(state.view(1, 1));
      EXPECT_NEAR(reading.latent_heat, 0.437, 1e-15);
      EXPECT_DOUBLE_EQ(reading.isotherm, 0.45); // the site that is at T_m
      EXPECT_DOUBLE_EQ(reading.max_ice, 0.35 + 0.06);
      EXPECT_DOUBLE_EQ(reading.heat_loss, 0.45); // 37 % of its latent heat is lost
    }

    TEST(FrontReader, CountsAQuarterOfTheLatentHeatAsTheLimitOfHeatLoss)
    {
      const auto scene = tests::scene_of(DomainShape::slab, 1, Symmetry::planar);
      FrontReader reader(scene, &freezing_slab, 0.1, 0);
      State state = frozen_slab(10, 0.42);
      EXPECT_DOUBLE_EQ(reader.read(state.view(1, 1)).heat_loss, 0.35);
      State quarter = frozen_slab(10, 0.43);
      EXPECT_DOUBLE_EQ(reader.read(quarter.view(1, 1)).heat_loss, 0.45);
    }

    TEST(FrontReader, HasNoIsothermAndNoIceInALiquid)
    {
      const auto scene = tests::scene_of(DomainShape::slab, 1, Symmetry::planar);
      FrontReader reader(scene, &freezing_slab, 0.1, 0);
      State state = frozen_slab(10, 0);
      const FrontReading reading = reader.read(state.view(1, 0));
      EXPECT_EQ(reading.latent_heat, 0);
      EXPECT_TRUE(std::isnan(reading.isotherm));
      EXPECT_TRUE(std::isnan(reading.max_ice));
      EXPECT_TRUE(std::isnan(reading.heat_loss));
    }

    TEST(FrontReader, ReadsAStripInTwoDimensionsLikeTheSlab)
    {
      const auto scene = tests::scene_of(DomainShape::slab, 1, Symmetry::planar);
      FrontReader reader(scene, &freezing_slab, 0.1, 0.12);
      State line = frozen_slab(10, 0.437), strip;
      for(int row = 0; row < 4; ++row)
        for(int i = 0; i < 10; ++i)
        {
          strip.positions[0].push_back(line.positions[0][i]);
          strip.positions[1].push_back(0.1 * row);
          strip.weights.push_back(line.weights[i] / 4);
          strip.temperature.push_back(line.temperature[i]);
          strip.solid_fraction.push_back(line.solid_fraction[i]);
        }
      const FrontReading reading = reader.read(strip.view(2, 1));
      EXPECT_NEAR(reading.latent_heat, 0.437, 1e-15);
      EXPECT_NEAR(reading.isotherm, 0.45, 1e-15);
      EXPECT_DOUBLE_EQ(reading.max_ice, 0.35 + 0.06);
    }

    TEST(FrontReader, ReadsALiquidCoreFromTheLiquidsVolume)
    {
      const auto scene = tests::scene_of(DomainShape::ball, 2, Symmetry::cylindrical);
      const tests::LinearProfile exact(Symmetry::cylindrical, false);
      FrontReader reader(scene, &exact, 0.1, 0.1);
      // Rings of 0.1 with exact areas: liquid up to 0.2, solid beyond.
      State state;
      for(int i = 0; i < 5; ++i)
      {
        state.positions[0].push_back(0.1 * (i + 0.5));
        state.weights.push_back(
            cases::volume_between(Symmetry::cylindrical, 0.1 * i, 0.1 * (i + 1)));
        state.solid_fraction.push_back(i < 2 ? 0 : 1);
        state.temperature.push_back(0.2 - 0.1 * (i + 0.5));
      }
      const FrontReading reading = reader.read(state.view(1, 1));
      EXPECT_NEAR(reading.latent_heat, 0.2, 1e-15);
      EXPECT_NEAR(reading.isotherm, 0.2, 1e-15);
      EXPECT_TRUE(std::isnan(reading.max_ice));
    }

    /** Particles on a lattice in a box about the origin, solid inside a radius. */
    State frozen_lattice(int dimension, int n, double radius)
    {
      State state;
      const double spacing = 1. / n;
      const int layers = dimension == 3 ? n : 1;
      for(int k = 0; k < layers; ++k)
        for(int j = 0; j < n; ++j)
          for(int i = 0; i < n; ++i)
          {
            const cases::Position p{(i + 0.5) / n - 0.5, (j + 0.5) / n - 0.5,
                                    dimension == 3 ? (k + 0.5) / n - 0.5 : 0};
            const double r = std::hypot(p[0], p[1], p[2]);
            for(int d = 0; d < dimension; ++d)
              state.positions[d].push_back(p[d]);
            state.weights.push_back(std::pow(spacing, dimension));
            state.solid_fraction.push_back(r < radius ? 1 : 0);
            state.temperature.push_back(r - radius);
          }
      return state;
    }

    TEST(FrontReader, ReadsTheEquivalentRadiusInABoxWithARadialSolution)
    {
      for(const int dimension : {2, 3})
      {
        const Symmetry symmetry
            = dimension == 2 ? Symmetry::cylindrical : Symmetry::spherical;
        const int n = dimension == 2 ? 100 : 40;
        const tests::LinearProfile exact(symmetry);
        const auto scene = tests::scene_of(DomainShape::box, dimension, Symmetry::none);
        FrontReader reader(scene, &exact, 1. / n, 1.3 / n);
        State state = frozen_lattice(dimension, n, 0.3);
        const FrontReading reading = reader.read(state.view(dimension, 1));
        double volume = 0;
        for(std::size_t i = 0; i < state.weights.size(); ++i)
          volume += state.weights[i] * state.solid_fraction[i];
        EXPECT_NEAR(reading.latent_heat, cases::enclosing_coordinate(symmetry, volume),
                    1e-14);
        EXPECT_NEAR(reading.latent_heat, 0.3, 0.2 / n);
        EXPECT_NEAR(reading.isotherm, 0.3, 1e-3 / n) << "T is linear in the radius";
        EXPECT_NEAR(reading.max_ice, 0.3 + 0.65 / n, 0.5 / n);
      }
    }

    TEST(FrontReader, ReadsTheIsothermOfScatteredParticles)
    {
      std::mt19937 generator(7);
      std::uniform_real_distribution<double> jitter(-0.004, 0.004);
      const auto scene = tests::scene_of(DomainShape::slab, 1, Symmetry::planar);
      FrontReader reader(scene, &freezing_slab, 0.02, 0.02);
      State state;
      for(int i = 0; i < 50; ++i)
        for(int j = 0; j < 8; ++j)
        {
          const double x = (i + 0.5) / 50 + jitter(generator);
          state.positions[0].push_back(x);
          state.positions[1].push_back(0.02 * j);
          state.weights.push_back(0.02 / 8);
          state.temperature.push_back(3 * (x - 0.4321));
          state.solid_fraction.push_back(x < 0.4321 ? 1 : 0);
        }
      EXPECT_NEAR(reader.read(state.view(2, 1)).isotherm, 0.4321, 1e-12);
    }

    TEST(FrontReader, FollowsSitesThatMove)
    {
      const auto scene = tests::scene_of(DomainShape::slab, 1, Symmetry::planar);
      FrontReader reader(scene, &freezing_slab, 0.1, 0);
      State state = frozen_slab(10, 0.4);
      EXPECT_NEAR(reader.read(state.view(1, 1)).isotherm, 0.4, 1e-14);
      for(double &x : state.positions[0])
        x += 0.01;
      EXPECT_NEAR(reader.read(state.view(1, 1)).isotherm, 0.41, 1e-14);
    }

    TEST(FrontReader, MeasuresABoxWithAPlanarSolutionFromItsLowerSide)
    {
      const tests::LinearProfile exact(Symmetry::planar);
      auto scene = tests::scene_of(DomainShape::box, 2, Symmetry::none);
      scene.domain.upper[1] = 1.5; // two metres high
      FrontReader reader(scene, &exact, 0.1, 0);
      State state = frozen_slab(10, 0.43);
      for(double &x : state.positions[0])
        x -= 0.5;
      state.positions[1].assign(10, 0.3);
      for(double &weight : state.weights)
        weight *= 2;
      EXPECT_NEAR(reader.read(state.view(2, 1)).latent_heat, -0.07, 1e-15);
    }

    // Solid at the start, then melted from the inner wall, then frozen there: the scene's
    // start does not tell which phase lies inside. Two fronts leave what was known.
    TEST(FrontReader, SeesWhichPhaseAWallMadeInside)
    {
      auto scene = tests::scene_of(DomainShape::slab, 1, Symmetry::planar);
      scene.initial.temperature = cases::Field::uniform(-1);
      FrontReader reader(scene, nullptr, 0.1, 0);
      State state = frozen_slab(10, 1);
      const auto front_of = [&](std::initializer_list<double> fractions)
      {
        state.solid_fraction = fractions;
        return reader.read(state.view(1, 1)).latent_heat;
      };
      EXPECT_NEAR(front_of({1, 1, 1, 1, 1, 1, 1, 1, 1, 1}), 1, 1e-15);
      EXPECT_NEAR(front_of({0, 0, 0.4, 1, 1, 1, 1, 1, 1, 1}), 0.26, 1e-15);
      EXPECT_NEAR(front_of({0, 0, 0, 0, 0, 0, 0, 0.8, 1, 1}), 0.72, 1e-15);
      EXPECT_NEAR(front_of({1, 0, 0, 0, 0, 0, 0, 0.8, 1, 1}), 0.62, 1e-15);
      EXPECT_NEAR(front_of({1, 1, 1, 0.5, 0, 0, 0, 0, 0, 0}), 0.35, 1e-15);
    }

    TEST(Isotherm, TakesTheMiddleOfAPlateau)
    {
      const std::vector<double> x{0, 1, 2, 3, 4, 5};
      EXPECT_DOUBLE_EQ(isotherm_crossing(x, std::vector{-2., -1., 0., 0., 0., 2.}), 3);
      EXPECT_DOUBLE_EQ(isotherm_crossing(x, std::vector{-2., -1., 1e-13, -1e-13, 1., 2.}),
                       2.5);
    }

    TEST(Isotherm, TakesTheEdgeOfAPhaseAtItsMeltingPoint)
    {
      const std::vector<double> x{0, 1, 2, 3};
      EXPECT_DOUBLE_EQ(isotherm_crossing(x, std::vector{-2., -1., 0., 0.}), 2);
      EXPECT_DOUBLE_EQ(isotherm_crossing(x, std::vector{0., 0., -1., -2.}), 1);
    }

    TEST(Isotherm, IsNaNWhereThereIsNone)
    {
      const std::vector<double> x{0, 1, 2};
      EXPECT_TRUE(std::isnan(isotherm_crossing(x, std::vector{1., 2., 3.})));
      EXPECT_TRUE(std::isnan(isotherm_crossing(x, std::vector{0., 0., 0.})));
      EXPECT_TRUE(std::isnan(isotherm_crossing({}, {})));
    }

    TEST(SolidHoldsOrigin, FollowsTheSceneWithoutAnExactSolution)
    {
      auto slab = tests::scene_of(DomainShape::slab, 1, Symmetry::planar);
      auto &wall = slab.boundaries[static_cast<std::size_t>(cases::Side::x_min)];
      EXPECT_FALSE(solid_holds_origin(slab, nullptr)) << "liquid between insulated walls";
      *wall = {cases::BoundaryKind::fixed_temperature, cases::Field::uniform(-1), false};
      EXPECT_TRUE(solid_holds_origin(slab, nullptr));
      *wall = {cases::BoundaryKind::fixed_temperature, cases::Field::uniform(1), false};
      EXPECT_FALSE(solid_holds_origin(slab, nullptr));
      *wall = {cases::BoundaryKind::flux, cases::Field::uniform(-1), false};
      EXPECT_TRUE(solid_holds_origin(slab, nullptr));
      for(const auto kind :
          {cases::BoundaryKind::heat_transfer, cases::BoundaryKind::radiation})
        for(const double surroundings : {-1, 1})
        {
          *wall = {.kind = kind, .value = cases::Field::uniform(surroundings)};
          EXPECT_EQ(solid_holds_origin(slab, nullptr), surroundings < 0);
        }

      auto box = tests::scene_of(DomainShape::box, 2, Symmetry::none);
      box.sources.push_back(
          {{}, "-1", [](double) { return -1; }, [](double time) { return -time; }});
      EXPECT_TRUE(solid_holds_origin(box, nullptr));
      EXPECT_EQ(measured_symmetry(box, nullptr), Symmetry::cylindrical);
    }
  } // namespace
} // namespace meltfront::verification
