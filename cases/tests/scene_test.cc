#include <cases/domain_measure.h>
#include <cases/error.h>
#include <cases/sampling.h>
#include <cases/scene.h>
#include <cases/snapshot.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace meltfront::cases;

namespace
{
  Boundary fixed(std::function<double(const Position &, double)> temperature)
  {
    return {BoundaryKind::fixed_temperature, {"an expression", std::move(temperature)}};
  }

  Scene box_scene(int dimension)
  {
    Scene scene;
    scene.domain.shape = DomainShape::box;
    scene.domain.dimension = dimension;
    scene.domain.lower = {-1, -2, dimension == 3 ? -3. : 0.};
    scene.domain.upper = {1, 2, dimension == 3 ? 3. : 0.};
    scene.initial.temperature = Field::uniform(5);
    for(int s = 0; s < 2 * dimension; ++s)
      scene.boundaries[s] = Boundary();
    return scene;
  }
} // namespace

TEST(Material, TemperatureInvertsEnthalpyInEachPhase)
{
  const Material water{{2.2, 2090, 1000}, {0.6, 4190, 1000}, 333500, 0};
  for(const double temperature : {-40., -1e-9, 1e-9, 30.})
    EXPECT_NEAR(water.temperature(water.enthalpy(temperature)), temperature,
                1e-15 * 333500);
  EXPECT_EQ(water.temperature(100000), 0);
  EXPECT_EQ(water.enthalpy(0, 0.25), 0.75 * 333500);
  EXPECT_EQ(water.solid_fraction(water.enthalpy(0, 0.25)), 0.25);
  EXPECT_EQ(water.solid_fraction(-1), 1);
  EXPECT_EQ(water.solid_fraction(400000), 0);
}

TEST(Material, WithoutLatentHeatThePhaseIsAStep)
{
  Material material;
  material.latent_heat = 0;
  EXPECT_EQ(material.solid_fraction(-1e-300), 1);
  EXPECT_EQ(material.solid_fraction(0), 0);
}

TEST(Position, CoordinateAndVolumeAreInverseInEverySymmetry)
{
  const Position p{0.3, 0.4, 1.2};
  EXPECT_EQ(coordinate(Symmetry::planar, p), 0.3);
  EXPECT_DOUBLE_EQ(coordinate(Symmetry::cylindrical, p), 0.5);
  EXPECT_DOUBLE_EQ(coordinate(Symmetry::spherical, p), 1.3);
  for(const Symmetry symmetry :
      {Symmetry::planar, Symmetry::cylindrical, Symmetry::spherical})
    EXPECT_DOUBLE_EQ(enclosing_coordinate(symmetry, volume_between(symmetry, 0, 0.7)),
                     0.7);
  EXPECT_DOUBLE_EQ(volume_between(Symmetry::spherical, 1, 2),
                   28. / 3. * std::numbers::pi);
}

TEST(Scene, SideIsWhatAResolutionDivides)
{
  EXPECT_EQ(box_scene(2).domain.side(), 2);
  Domain ball;
  ball.shape = DomainShape::ball;
  ball.radius = 0.5;
  EXPECT_EQ(ball.side(), 1);
}

TEST(Scene, KnowsItsSides)
{
  const Scene scene = box_scene(2);
  EXPECT_EQ(scene.sides(),
            (std::vector{Side::x_min, Side::x_max, Side::y_min, Side::y_max}));
  EXPECT_THROW(scene.boundary(Side::outer), std::logic_error);
  EXPECT_STREQ(to_string(Side::outer), "outer");
}

TEST(Field, UniformIsTheSameEverywhere)
{
  const Field field = Field::uniform(0.1);
  EXPECT_TRUE(field.constant);
  EXPECT_EQ(field({1, 2, 3}, 4), 0.1);
  EXPECT_EQ(std::stod(field.expression), 0.1);
}

TEST(TemperatureBounds, AreTheExtremesOfInitialAndWallTemperatures)
{
  Scene scene = box_scene(2);
  TemperatureBounds bounds = temperature_bounds(scene);
  EXPECT_EQ(bounds.lower, 5);
  EXPECT_EQ(bounds.upper, 5);
  scene.boundaries[0] = {BoundaryKind::fixed_temperature, Field::uniform(-2)};
  bounds = temperature_bounds(scene);
  EXPECT_EQ(bounds.lower, -2);
  EXPECT_EQ(bounds.upper, 5);
}

TEST(TemperatureBounds, SeeInnerWallsHoweverNarrowAndShellsHoweverThin)
{
  for(const int dimension : {2, 3})
    for(const double inner_radius : {1e-9, 1e-3, 0.5, 0.999, 1 - 1e-9})
    {
      Scene scene;
      scene.domain.shape = DomainShape::shell;
      scene.domain.dimension = dimension;
      scene.domain.inner_radius = inner_radius;
      scene.domain.radius = 1;
      scene.initial.temperature = Field::uniform(5);
      scene.end_time = 1;
      for(const Side side : {Side::inner, Side::outer})
        scene.boundaries[static_cast<std::size_t>(side)]
            = {BoundaryKind::fixed_temperature, Field::uniform(5)};
      // Lowest in the direction of y, beside the wall that is bent most.
      Field cold{"5 - 7*t*(y > 0)", [](const Position &p, double time)
                 { return p[1] > 0 ? 5 - 7 * time : 5; }};
      scene.boundaries[static_cast<std::size_t>(Side::inner)]->value = cold;
      EXPECT_NEAR(temperature_bounds(scene).lower, -2, 0.01) << inner_radius;
      int points = 0;
      visit_points(scene.domain,
                   [&](const Position &p) { points += contains(scene.domain, p); });
      EXPECT_GT(points, 1000) << inner_radius;
    }
}

TEST(TemperatureBounds, HoldTheFrontOfAMetastablePhase)
{
  Scene scene = box_scene(2);
  scene.initial.temperature = Field::uniform(-0.2);
  EXPECT_EQ(temperature_bounds(scene).upper, -0.2);
  scene.initial.front = Field{
      .expression = "", .value = [](const Position &p, double) { return p[0] - 0.5; }};
  const TemperatureBounds bounds = temperature_bounds(scene);
  EXPECT_EQ(bounds.lower, -0.2);
  EXPECT_EQ(bounds.upper, scene.material.melting_temperature);
}

TEST(TemperatureBounds, FollowAWallInTimeAndAlongItself)
{
  Scene scene = box_scene(3);
  scene.boundaries[5] = fixed([](const Position &p, double t) { return 10 * t + p[0]; });
  const TemperatureBounds bounds = temperature_bounds(scene);
  EXPECT_NEAR(bounds.lower, -1, 0.02);
  EXPECT_NEAR(bounds.upper, 11, 0.02);
  EXPECT_LE(bounds.lower, -1);
  EXPECT_GE(bounds.upper, 11);
}

// Samples as far apart as those of a wall in space passed over what is narrow, or took
// the lowest value for higher than it is, and methods failed by it.
TEST(TemperatureBounds, FindWhatIsNarrowAlongAWallInThePlaneAndGrowsInTime)
{
  constexpr double narrow = 0.01;
  for(const double place : {0.371, 0.6044})
  {
    Scene scene = box_scene(2);
    scene.boundaries[2]
        = fixed([=](const Position &p, double t)
                { return 5 - 8 * t * std::exp(-std::pow((p[0] - place) / narrow, 2)); });
    const TemperatureBounds of_box = temperature_bounds(scene);
    EXPECT_LE(of_box.lower, -3);
    EXPECT_NEAR(of_box.lower, -3, 0.01);

    Scene ring;
    ring.domain = Domain{DomainShape::shell, 2, {}, {}, 1, 0.2};
    ring.initial.temperature = Field::uniform(5);
    ring.end_time = 1;
    ring.boundaries[static_cast<std::size_t>(Side::inner)]
        = {BoundaryKind::fixed_temperature, Field::uniform(5)};
    ring.boundaries[static_cast<std::size_t>(Side::outer)] = fixed(
        [=](const Position &p, double t)
        {
          const double way = (std::atan2(p[1], p[0]) - place) / (3 * narrow);
          return 5 - 8 * t * std::exp(-way * way);
        });
    const TemperatureBounds of_ring = temperature_bounds(ring);
    EXPECT_LE(of_ring.lower, -3);
    EXPECT_NEAR(of_ring.lower, -3, 0.01);
  }
}

TEST(TemperatureBounds, AreTakenOnRoundWallsThemselves)
{
  Scene scene;
  scene.domain = Domain{DomainShape::shell, 2, {}, {}, 1, 0.2};
  scene.initial.temperature = Field::uniform(0);
  Field steep;
  steep.value = [](const Position &p, double)
  { return std::hypot(p[0], p[1]) < 0.6 ? -1 / std::hypot(p[0], p[1]) : p[0]; };
  for(const Side side : {Side::inner, Side::outer})
    scene.boundaries[static_cast<std::size_t>(side)]
        = Boundary{BoundaryKind::fixed_temperature, steep, false};
  const TemperatureBounds bounds = temperature_bounds(scene);
  EXPECT_NEAR(bounds.lower, -5, 0.01) << "-1/r at r = 0.2, and no less beside it";
  EXPECT_NEAR(bounds.upper, 1, 0.01);
}

TEST(TemperatureBounds, OpenWhereHeatComesInOrGoesOut)
{
  Scene scene = box_scene(2);
  scene.sources.push_back({{}, "-1", [](double) { return -1.; }, {}});
  EXPECT_EQ(temperature_bounds(scene).lower, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(temperature_bounds(scene).upper, 5);
  scene.sources.clear();
  scene.boundaries[2] = {BoundaryKind::flux, Field::uniform(3)};
  EXPECT_EQ(temperature_bounds(scene).upper, std::numeric_limits<double>::infinity());
  EXPECT_EQ(temperature_bounds(scene).lower, 5);
}

TEST(TemperatureBounds, CoverABall)
{
  Scene scene;
  scene.domain.shape = DomainShape::ball;
  scene.domain.dimension = 2;
  scene.domain.radius = 2;
  scene.initial.temperature
      = {"x", [](const Position &p, double) { return p[0]; }, false};
  scene.boundaries[6]
      = fixed([](const Position &, double time) { return 3 * std::sin(time); });
  scene.end_time = 2 * std::numbers::pi;
  const TemperatureBounds bounds = temperature_bounds(scene);
  EXPECT_NEAR(bounds.lower, -3, 0.02);
  EXPECT_NEAR(bounds.upper, 3, 0.02);
}

TEST(CheckTemperature, StopsAtABrokenBoundOrANumberThatIsNone)
{
  const TemperatureBounds bounds{-1, 2};
  EXPECT_NO_THROW(check_temperature(bounds, -1, 2, "sph", 3, 0.5));
  EXPECT_NO_THROW(check_temperature(bounds, -1 - 1e-10, 2, "sph", 3, 0.5));
  EXPECT_THROW(check_temperature(bounds, -1.001, 2, "sph", 3, 0.5), NumericalError);
  EXPECT_THROW(check_temperature(bounds, -1, 2.001, "sph", 3, 0.5), NumericalError);
  try
  {
    check_temperature(bounds, std::nan(""), 2, "sph", 3, 0.5);
    FAIL() << "a temperature that is not a number passed";
  }
  catch(const NumericalError &error)
  {
    EXPECT_STREQ(error.what(), "sph, step 3, t = 0.5: temperature is not finite");
    EXPECT_EQ(error.step, 3);
  }
}

TEST(HeatBudget, DefectIsRelativeToItsLargestTerm)
{
  EXPECT_EQ(HeatBudget().defect(), 0);
  EXPECT_EQ((HeatBudget{3, 4, -2, -1, 10}).defect(), 0);
  EXPECT_DOUBLE_EQ((HeatBudget{3, 4, -2, -1.5, 10}).defect(), 0.05);
  EXPECT_TRUE(std::isinf((HeatBudget{0, 0, std::nan(""), 0, 0}).defect()));
}

TEST(DomainMeasure, CellsOfWhichAllSidesAreWholeNumbers)
{
  Domain domain;
  domain.shape = DomainShape::box;
  domain.dimension = 3;
  domain.upper = {0.06, 0.04, 0.1};
  EXPECT_EQ(fewest_whole_cells(domain), 3);
  domain.dimension = 2;
  domain.upper = {1, 1, 0};
  EXPECT_EQ(fewest_whole_cells(domain), 1);
  domain.upper = {1, 0.7, 0};
  EXPECT_EQ(fewest_whole_cells(domain), 10);
  domain.upper = {1, std::sqrt(2.), 0};
  EXPECT_EQ(fewest_whole_cells(domain), 1) << "there is none";
  domain.shape = DomainShape::ball;
  EXPECT_EQ(fewest_whole_cells(domain), 1);
}
