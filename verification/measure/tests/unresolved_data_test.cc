#include <cases/outline.h>
#include <verification/measure/checks/unresolved_data.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <vector>

namespace
{
  using namespace meltfront::cases;
  using meltfront::verification::unresolved_data;
  using meltfront::verification::unresolved_walls;

  Field field_of(const std::string &words, std::function<double(const Position &)> value)
  {
    return {words,
            [value = std::move(value)](const Position &p, double) { return value(p); }};
  }

  /** A box of 1 by 0.8 at -1, all walls insulated. */
  Scene unit_box()
  {
    Scene scene;
    scene.domain.shape = DomainShape::box;
    scene.domain.dimension = 2;
    scene.domain.upper = {1, 0.8, 0};
    scene.initial.temperature = Field::uniform(-1);
    for(int side = 0; side < 4; ++side)
      scene.boundaries[side] = Boundary();
    return scene;
  }

  double bell(double distance, double width)
  {
    return std::exp(-distance * distance / (width * width));
  }

  Field spot_on_wall(double width)
  {
    return field_of("exp(-((y - 0.3137)/w)^2)",
                    [width](const Position &p) { return bell(p[1] - 0.3137, width); });
  }
} // namespace

TEST(UnresolvedData, SpotsOnWallsNarrowerThanTheSpacing)
{
  Scene scene = unit_box();
  for(const BoundaryKind kind : {BoundaryKind::fixed_temperature,
                                 BoundaryKind::heat_transfer, BoundaryKind::radiation})
  {
    scene.boundaries[0] = Boundary{kind, spot_on_wall(0.004)};
    const std::string found = unresolved_data(scene, 0.025);
    EXPECT_NE(found.find("x_min"), std::string::npos) << found;
    EXPECT_NE(found.find("(0, 0.313"), std::string::npos) << found;
    EXPECT_NE(found.find("m or less would"), std::string::npos) << found;
    EXPECT_EQ(unresolved_data(scene, 0.0031), "");
  }
  // What a flux brings in is booked, and the book is held against the data.
  scene.boundaries[0] = Boundary{BoundaryKind::flux, spot_on_wall(0.004)};
  EXPECT_EQ(unresolved_data(scene, 0.025), "");
}

TEST(UnresolvedData, StepsAndWideBellsPass)
{
  Scene scene = unit_box();
  scene.boundaries[0] = Boundary{BoundaryKind::fixed_temperature, spot_on_wall(0.06)};
  EXPECT_EQ(unresolved_data(scene, 0.05), "");
  scene.boundaries[0] = Boundary{BoundaryKind::fixed_temperature,
                                 field_of("if(y < 0.3137, 1, -1)", [](const Position &p)
                                          { return p[1] < 0.3137 ? 1. : -1.; })};
  EXPECT_EQ(unresolved_data(scene, 0.1), "");
  scene.initial.temperature = field_of("if(x < 0.5, 1, -1)", [](const Position &p)
                                       { return p[0] < 0.5 ? 1. : -1.; });
  EXPECT_EQ(unresolved_data(scene, 0.1), "");
}

TEST(UnresolvedData, InitialTemperatures)
{
  Scene scene = unit_box();
  scene.initial.temperature = field_of(
      "-1 + 500*exp(-((x - 0.3137)^2 + (y - 0.4043)^2)/0.000016)", [](const Position &p)
      { return -1 + 500 * bell(std::hypot(p[0] - 0.3137, p[1] - 0.4043), 0.004); });
  EXPECT_NE(unresolved_data(scene, 0.0125), "");
  EXPECT_EQ(unresolved_data(scene, 0.003), "");
  // A ridge along the diagonal, and a layer on a wall.
  scene.initial.temperature = field_of("exp(-((x - y)/0.004)^2)", [](const Position &p)
                                       { return bell(p[0] - p[1], 0.004); });
  EXPECT_NE(unresolved_data(scene, 0.0125), "");
  scene.initial.temperature = field_of("exp(-y/0.001)", [](const Position &p)
                                       { return std::exp(-p[1] / 0.001); });
  EXPECT_NE(unresolved_data(scene, 0.0125), "");
}

TEST(UnresolvedData, SpotsOnRoundWalls)
{
  Scene scene;
  scene.domain.shape = DomainShape::ball;
  scene.domain.dimension = 2;
  scene.domain.radius = 1;
  scene.initial.temperature = Field::uniform(-1);
  const auto spot = [](double width)
  {
    return Boundary{
        BoundaryKind::fixed_temperature,
        field_of("exp(-((x - 0.6)^2 + (y - 0.8)^2)/w^2)", [width](const Position &p)
                 { return bell(std::hypot(p[0] - 0.6, p[1] - 0.8), width); })};
  };
  scene.boundaries[static_cast<int>(Side::outer)] = spot(0.01);
  EXPECT_NE(unresolved_data(scene, 0.05), "");
  scene.boundaries[static_cast<int>(Side::outer)] = spot(0.2);
  EXPECT_EQ(unresolved_data(scene, 0.05), "");
}

// The tip of a wedge is narrow, and so is one side of a step where it meets a wall at an
// angle; what stays narrow along itself is a feature, also where it ends at a body.
TEST(UnresolvedData, TipsOfWhatIsWideAreNoFeatures)
{
  Scene scene;
  scene.domain.shape = DomainShape::box;
  scene.domain.dimension = 2;
  scene.domain.upper = {1, 1, 0};
  const auto start_in = [&](const std::string &words, auto inside)
  {
    scene.initial.temperature = field_of(words, [inside](const Position &p)
                                         { return inside(p[0], p[1]) ? -1. : 1.; });
    return unresolved_data(scene, 0.05);
  };
  for(const double slope : {0.2, 0.4, 1., 3.})
    EXPECT_EQ(start_in("if(x + slope*y < 0.617, -1, 1)",
                       [slope](double x, double y) { return x + slope * y < 0.617; }),
              "")
        << slope;
  EXPECT_EQ(start_in("if(abs(x - 0.5) + abs(y - 0.5) < 0.3, -1, 1)",
                     [](double x, double y)
                     { return std::abs(x - 0.5) + std::abs(y - 0.5) < 0.3; }),
            "");
  EXPECT_NE(start_in("if(abs(x + 0.4*y - 0.617) < 0.01, -1, 1)", [](double x, double y)
                     { return std::abs(x + 0.4 * y - 0.617) < 0.01; }),
            "");
  EXPECT_NE(start_in("if((y < 0.01) || (x < 0.3), -1, 1)",
                     [](double x, double y) { return y < 0.01 || x < 0.3; }),
            "");
}

// Beside a place of a wall that bends there is wall on both sides.
TEST(UnresolvedData, AStepOnAWallThatBendsIsNoFeature)
{
  const auto step = [](bool spot)
  {
    return Boundary{BoundaryKind::heat_transfer,
                    field_of("if(x < 0.2, ...)",
                             [spot](const Position &p) {
                               return (spot ? std::abs(p[0] - 0.2) < 0.01 : p[0] < 0.2)
                                          ? 1.
                                          : 0.;
                             })};
  };
  Scene disk;
  disk.domain.shape = DomainShape::ball;
  disk.domain.dimension = 2;
  disk.domain.radius = 0.7;
  disk.initial.temperature = Field::uniform(-1);
  Scene bracket = disk;
  bracket.domain.shape = DomainShape::outline;
  bracket.domain.outline = std::make_shared<const Outline>(std::vector<Outline::Point>{
      {0, 0}, {1, 0}, {1, 0.3}, {0.4, 0.42}, {0.33, 1}, {0, 1}});
  bracket.domain.upper = {1, 1, 0};
  bracket.domain.reference_length = 1;
  Scene ball = disk;
  ball.domain.dimension = 3;
  for(Scene *scene : {&disk, &bracket, &ball})
  {
    scene->boundaries[static_cast<int>(Side::outer)] = step(false);
    EXPECT_EQ(unresolved_data(*scene, 0.05), "");
  }
  for(Scene *scene : {&disk, &bracket})
  {
    scene->boundaries[static_cast<int>(Side::outer)] = step(true);
    EXPECT_NE(unresolved_data(*scene, 0.05), "");
  }
}

TEST(UnresolvedWalls, AnInnerWallFarNarrowerThanTheSpacing)
{
  for(const int dimension : {2, 3})
  {
    Scene scene;
    scene.domain.shape = DomainShape::shell;
    scene.domain.dimension = dimension;
    scene.domain.inner_radius = 1e-3;
    scene.domain.radius = 1;
    scene.initial.temperature = Field::uniform(1);
    scene.boundaries[static_cast<int>(Side::outer)] = Boundary();
    scene.boundaries[static_cast<int>(Side::inner)] = Boundary();
    EXPECT_EQ(unresolved_walls(scene, 0.05, 0.05), "");
    for(const BoundaryKind kind : {BoundaryKind::fixed_temperature, BoundaryKind::flux,
                                   BoundaryKind::heat_transfer, BoundaryKind::radiation})
    {
      scene.boundaries[static_cast<int>(Side::inner)]
          = Boundary{kind, Field::uniform(-1)};
      const std::string found = unresolved_walls(scene, 0.05, 0.05);
      EXPECT_NE(found.find("0.002 m across"), std::string::npos) << found;
      EXPECT_NE(found.find("25 times as large"), std::string::npos) << found;
      EXPECT_EQ(unresolved_walls(scene, 0.05, 0.002), "");
      EXPECT_EQ(unresolved_walls(scene, 0.002, 0.002), "");
    }
    scene.domain.inner_radius = 0.97;
    EXPECT_NE(unresolved_walls(scene, 0.05, 0.05).find("0.03 m thick"),
              std::string::npos);
    EXPECT_NE(unresolved_walls(scene, 0.03, 0.03), "");
    EXPECT_EQ(unresolved_walls(scene, 0.015, 0.015), "");
  }
}

TEST(UnresolvedWalls, AWallAboutAnAxis)
{
  Scene scene = unit_box();
  scene.domain.shape = DomainShape::axisymmetric;
  scene.boundaries[0] = Boundary{BoundaryKind::fixed_temperature, Field::uniform(1)};
  EXPECT_EQ(unresolved_walls(scene, 0.05, 0.05), "");
  scene.domain.lower[0] = 0.01;
  EXPECT_NE(unresolved_walls(scene, 0.05, 0.05).find("0.02 m across"), std::string::npos);
  EXPECT_EQ(unresolved_walls(scene, 0.02, 0.02), "");
  scene.boundaries[0] = Boundary();
  EXPECT_EQ(unresolved_walls(scene, 0.05, 0.05), "");
}

TEST(UnresolvedWalls, ABoxThinnerThanTheSpacing)
{
  Scene scene = unit_box();
  scene.domain.upper[1] = 0.01;
  EXPECT_EQ(unresolved_walls(scene, 0.05, 0.05), "");
  scene.boundaries[0] = Boundary{BoundaryKind::fixed_temperature, Field::uniform(1)};
  EXPECT_EQ(unresolved_walls(scene, 0.05, 0.05), "");
  scene.boundaries[3] = Boundary{BoundaryKind::flux, Field::uniform(1)};
  const std::string found = unresolved_walls(scene, 0.05, 0.05);
  EXPECT_NE(found.find("0.01 m wide along y"), std::string::npos) << found;
  EXPECT_NE(found.find("5 times as large"), std::string::npos) << found;
  EXPECT_EQ(unresolved_walls(scene, 0.01, 0.01), "");
  scene.boundaries[3] = Boundary();
  scene.boundaries[0] = Boundary{BoundaryKind::heat_transfer,
                                 field_of("y", [](const Position &p) { return p[1]; })};
  EXPECT_NE(unresolved_walls(scene, 0.05, 0.05), "");
  scene.boundaries[0] = Boundary();
  scene.initial.temperature = field_of("x", [](const Position &p) { return p[0]; });
  EXPECT_EQ(unresolved_walls(scene, 0.05, 0.05), "");
  scene.initial.temperature = field_of("y", [](const Position &p) { return p[1]; });
  EXPECT_NE(unresolved_walls(scene, 0.05, 0.05), "");
}
