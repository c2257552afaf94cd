#include <verification/measure/formulas/front_reader.h>
#include <verification/measure/formulas/front_shape.h>
#include <verification/measure/tests/fixtures.h>

#include <gtest/gtest.h>

#include <functional>
#include <numbers>

namespace meltfront::verification
{
  namespace
  {
    using cases::DomainShape;
    using cases::Symmetry;
    using tests::State;

    constexpr double pi = std::numbers::pi;

    /** A front in the plane: its distance from the origin over the angle. */
    using Radius = std::function<double(double angle)>;

    /**
     * Sites whose sum over the region within the front is exact to round-off for smooth
     * fronts: equal angles, Gauss points with two nodes along each ray, between the hole
     * and the front (phase one) and the front and the rim (phase two).
     */
    State polar_sites(const Radius &front, double hole, double rim, bool solid_inside)
    {
      State state;
      constexpr int rays = 64;
      const double gauss = 0.5 / std::sqrt(3.);
      for(int ray = 0; ray < rays; ++ray)
      {
        const double angle = 2 * pi * ray / rays;
        const double ends[] = {hole, front(angle), rim};
        for(const bool inner : {true, false})
          for(const double node : {0.5 - gauss, 0.5 + gauss})
          {
            const double from = ends[inner ? 0 : 1], to = ends[inner ? 1 : 2];
            const double r = from + node * (to - from);
            state.positions[0].push_back(r * std::cos(angle));
            state.positions[1].push_back(r * std::sin(angle));
            state.weights.push_back(r * (to - from) / 2 * 2 * pi / rays);
            state.temperature.push_back(r - front(angle));
            state.solid_fraction.push_back(inner == solid_inside ? 1 : 0);
          }
      }
      return state;
    }

    cases::Scene shell_scene(int dimension, Symmetry symmetry, double hole)
    {
      cases::Scene scene = tests::scene_of(DomainShape::shell, dimension, symmetry);
      scene.domain.radius = 1;
      scene.domain.inner_radius = hole;
      return scene;
    }

    TEST(FrontMode, IsTheAmplitudeOfAPerturbedFront)
    {
      constexpr double mean = 0.45;
      for(const double amplitude : {0.05, -0.05, 1e-3, 0.})
        for(const bool solid_inside : {true, false})
          for(const double hole : {0., 0.2})
          {
            const cases::Scene scene = shell_scene(2, Symmetry::none, hole);
            State state = polar_sites([&](double angle)
                                      { return mean + amplitude * std::cos(4 * angle); },
                                      hole, 1, solid_inside);
            const double enclosed = pi * (mean * mean + amplitude * amplitude / 2);
            EXPECT_NEAR(
                front_mode_amplitude(state.view(2, 1), scene.domain, solid_inside, 4),
                pi * mean * amplitude / std::sqrt(pi * enclosed), 1e-15);
            EXPECT_NEAR(
                front_mode_amplitude(state.view(2, 1), scene.domain, solid_inside, 3), 0,
                1e-15);
          }
    }

    TEST(FrontMode, IsNotDefinedOnALineOrForNothing)
    {
      State line;
      line.positions[0] = {0.5};
      line.weights = line.solid_fraction = line.temperature = {1};
      const cases::Scene scene = tests::scene_of(DomainShape::ball, 2, Symmetry::none);
      EXPECT_TRUE(
          std::isnan(front_mode_amplitude(line.view(1, 1), scene.domain, true, 4)));
      line.positions[1] = {0.5};
      line.solid_fraction = {0};
      EXPECT_TRUE(
          std::isnan(front_mode_amplitude(line.view(2, 1), scene.domain, true, 4)));
    }

    TEST(FrontReader, CountsTheHoleOfAShell)
    {
      for(const bool solid_inside : {true, false})
      {
        const cases::Scene plane = shell_scene(2, Symmetry::cylindrical, 0.2);
        const tests::LinearProfile exact(Symmetry::cylindrical, solid_inside);
        State state = polar_sites([](double) { return 0.4; }, 0.2, 1, solid_inside);
        FrontReader reader(plane, &exact, 0.1, 0);
        EXPECT_NEAR(reader.read(state.view(2, 1)).latent_heat, 0.4, 1e-14);
      }
      // Along the radius of a ball with a hole: exact cell volumes.
      const cases::Scene space = shell_scene(3, Symmetry::spherical, 0.25);
      const tests::LinearProfile exact(Symmetry::spherical);
      State state;
      constexpr int cells = 12;
      for(int i = 0; i < cells; ++i)
      {
        const double lower = 0.25 + 0.75 * i / cells, upper = lower + 0.75 / cells;
        state.positions[0].push_back((lower + upper) / 2);
        state.weights.push_back(cases::volume_between(Symmetry::spherical, lower, upper));
        state.temperature.push_back((lower + upper) / 2 - 0.5);
        state.solid_fraction.push_back(upper < 0.5 + 1e-12 ? 1 : 0);
      }
      FrontReader reader(space, &exact, 0.75 / cells, 0);
      EXPECT_NEAR(reader.read(state.view(1, 1)).latent_heat, 0.5, 1e-14);
    }

    cases::Field level_set(double sign)
    {
      cases::Field field;
      field.value = [sign](const cases::Position &p, double)
      { return sign * (std::hypot(p[0], p[1]) - 0.4); };
      return field;
    }

    TEST(SolidHoldsOrigin, FollowsTheInitialFrontAndTheInnerWall)
    {
      cases::Scene scene = shell_scene(2, Symmetry::none, 0.2);
      scene.initial.temperature = cases::Field::uniform(1);
      EXPECT_FALSE(solid_holds_origin(scene, nullptr)) << "warm everywhere";
      scene.boundaries[static_cast<std::size_t>(cases::Side::inner)] = cases::Boundary{
          cases::BoundaryKind::fixed_temperature, cases::Field::uniform(-1), false};
      EXPECT_TRUE(solid_holds_origin(scene, nullptr));
      scene.initial.front = level_set(1);
      EXPECT_TRUE(solid_holds_origin(scene, nullptr));
      scene.initial.front = level_set(-1);
      EXPECT_FALSE(solid_holds_origin(scene, nullptr)) << "the front goes before walls";
      // Sinks between which liquid lies at first will freeze the origin all the same.
      scene.sources.push_back(
          {{}, "-1", [](double) { return -1; }, [](double time) { return -time; }});
      EXPECT_TRUE(solid_holds_origin(scene, nullptr));
      scene.symmetry = Symmetry::cylindrical;
      EXPECT_FALSE(solid_holds_origin(scene, nullptr));
    }

    TEST(FrontPoints, AreComparedWithTheExactFront)
    {
      const tests::LinearProfile exact(Symmetry::cylindrical); // front 0.5 at t = 1
      State state;
      state.temperature = {0};
      cases::Snapshot snapshot = state.view(2, 1);
      EXPECT_FALSE(front_distance(snapshot, exact)) << "not tracked";
      EXPECT_TRUE(std::isnan(roundness(snapshot)));
      const std::vector<double> x{0.53, 0, -0.46}, y{0, 0.5, 0};
      snapshot.front[0] = x;
      snapshot.front[1] = y;
      const auto distance = front_distance(snapshot, exact);
      ASSERT_TRUE(distance);
      EXPECT_NEAR(distance->root_mean_square, std::sqrt((9e-4 + 16e-4) / 3), 1e-15);
      EXPECT_NEAR(distance->largest, 0.04, 1e-15);
      EXPECT_NEAR(roundness(snapshot), 0.07, 1e-15);
      EXPECT_EQ(front_points(snapshot), 3u);
      snapshot.dimension = 1;
      EXPECT_TRUE(std::isnan(roundness(snapshot)));
    }

    TEST(SolidVolume, SumsWeightsAndFractions)
    {
      State state;
      state.weights = {1, 2, 4};
      state.solid_fraction = {1, 0.5, 0.25};
      EXPECT_EQ(solid_volume(state.view(1, 0)), 3);
    }
  } // namespace
} // namespace meltfront::verification
