#include <cases/case_file/case_file.h>
#include <cases/case_file/tests/sample_case.h>
#include <cases/effects.h>
#include <cases/wall_law.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace meltfront::cases;
using namespace meltfront::cases::test;

namespace
{
  const std::string held = "set kind = fixed temperature\n      set temperature = -10";
  const std::string radiating = "set kind = radiation\n      set emissivity = 0.9\n"
                                "      set absolute zero = -273.15\n"
                                "      set ambient temperature = -100";

  std::string about(const std::string &old_piece, const std::string &new_piece)
  {
    return complaint(replaced(replaced(slab, held, radiating), old_piece, new_piece));
  }
} // namespace

TEST(RadiatingWall, IsReadWithTheConstantOfStefanAndBoltzmann)
{
  const Case c = read(replaced(slab, held, radiating));
  const Boundary &wall = c.scene.boundary(Side::x_min);
  EXPECT_EQ(wall.kind, BoundaryKind::radiation);
  EXPECT_DOUBLE_EQ(wall.emission_coefficient, 0.9 * 5.670374419e-8);
  EXPECT_EQ(wall.absolute_zero, -273.15);
  const EffectSet effects = effects_called_for(c.scene);
  EXPECT_TRUE(effects.contains(Effect::radiating_wall));
  EXPECT_FALSE(effects.contains(Effect::robin_wall));
  // Surroundings colder than all else are a bound of the temperature.
  EXPECT_LE(temperature_bounds(c.scene).lower, -100);
}

TEST(RadiatingWall, IsRefusedBelowAbsoluteZeroAndWithKeysOfOthers)
{
  EXPECT_NE(about("ambient temperature = -100", "ambient temperature = -300")
                .find("absolute zero"),
            std::string::npos);
  EXPECT_NE(about("absolute zero = -273.15", "absolute zero = 20").find("absolute zero"),
            std::string::npos);
  EXPECT_NE(about("      set emissivity = 0.9\n", "").find("emissivity"),
            std::string::npos);
  EXPECT_NE(about("set emissivity = 0.9",
                  "set emissivity = 0.9\n      set heat transfer coefficient = 1")
                .find("heat transfer coefficient"),
            std::string::npos);
  EXPECT_NE(complaint(replaced(slab, held, held + "\n      set emissivity = 0.5"))
                .find("emissivity"),
            std::string::npos);
}

TEST(WallLaw, RadiatesByTheFourthPower)
{
  Boundary wall;
  wall.kind = BoundaryKind::radiation;
  wall.emission_coefficient = 2e-8;
  wall.absolute_zero = -273.15;
  const double own = 20, around = 500;
  const auto flux = [&](double temperature)
  { return 2e-8 * (std::pow(773.15, 4) - std::pow(temperature + 273.15, 4)); };
  const HeatThroughWall through = heat_through(wall, around, own);
  EXPECT_NEAR(through.flux, flux(own), 1e-11 * flux(own));
  EXPECT_NEAR(through.slope, (flux(own + 1e-3) - flux(own - 1e-3)) / 2e-3, 1e-6);
  EXPECT_EQ(heat_through(wall, 20, 20).flux, 0);
}

TEST(WallLaw, OfALayerBehindTheWallHasTheHeatThatFlowsThroughBoth)
{
  for(const BoundaryKind kind : {BoundaryKind::heat_transfer, BoundaryKind::radiation})
  {
    Boundary wall;
    wall.kind = kind;
    wall.heat_transfer_coefficient = 40;
    wall.emission_coefficient = 5e-8;
    const double given = 900, resistance = 0.02;
    const auto at = [&](double temperature, double layer)
    { return heat_through_layer(wall, given, temperature, layer); };
    const HeatThroughLayer found = at(300, resistance);
    // The wall's own temperature follows from the layer.
    EXPECT_NEAR(heat_through(wall, given, 300 + resistance * found.flux).flux, found.flux,
                1e-11 * found.flux);
    EXPECT_NEAR(found.slope,
                (at(300 + 1e-3, resistance).flux - at(300 - 1e-3, resistance).flux)
                    / 2e-3,
                1e-6 * std::abs(found.slope));
    EXPECT_NEAR(found.by_resistance,
                (at(300, resistance + 1e-7).flux - at(300, resistance - 1e-7).flux)
                    / 2e-7,
                1e-5 * std::abs(found.by_resistance));
    EXPECT_EQ(at(300, 0).flux, heat_through(wall, given, 300).flux);
  }
}
