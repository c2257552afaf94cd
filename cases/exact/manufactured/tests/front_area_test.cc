// Areas of fronts, and what plane, disk and ball know as solutions of one coordinate.

#include <cases/exact/manufactured/front_area.h>
#include <cases/exact/manufactured/manufactured_solution.h>
#include <cases/exact/tests/materials.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meltfront::cases::manufactured
{
  namespace
  {
    constexpr double pi = std::numbers::pi;

    TEST(FrontArea, IsThatOfClosedForms)
    {
      const double time = 0.15, radius = 0.5 + 0.15 * std::sin(0.3 * pi);
      const auto area = [time](const char *name, int dimension, double scale = 1)
      {
        return front_area(
            *make_front_family(
                {.name = name, .dimension = dimension, .length_scale = scale}),
            time);
      };
      EXPECT_NEAR(area("plane", 1) - 1, 0, 1e-3);
      EXPECT_NEAR(area("disk", 2) / (2 * pi * radius) - 1, 0, 1e-3);
      EXPECT_NEAR(area("disk", 3) / (4 * pi * radius * radius) - 1, 0, 1e-2);
      EXPECT_NEAR(area("disk", 2, 0.01) / (0.02 * pi * radius) - 1, 0, 1e-3);
      EXPECT_NEAR(area("ellipse", 2) / 2.193417067695038 - 1, 0, 1e-3);
      EXPECT_NEAR(
          area("star-3", 2) / (6.6973401632382902 * (0.5 + 0.1 * std::sin(0.3 * pi))) - 1,
          0, 2e-3);
      EXPECT_NEAR(area("ellipse", 3) / 1.383149804454783 - 1, 0, 2e-2);
    }

    TEST(ManufacturedSolution, OfDiskAndPlaneDependsOnOneCoordinate)
    {
      Material material;
      material.liquid.conductivity = 0.1;
      const ManufacturedSolution disk(
          material, make_front_family({.name = "disk", .dimension = 2}), 1);
      EXPECT_TRUE(disk.depends_on_one_coordinate());
      EXPECT_EQ(disk.symmetry(), Symmetry::cylindrical);
      EXPECT_NEAR(disk.front(0.25), 0.65, 1e-15);
      EXPECT_EQ(disk.temperature(0.5, 0.1), disk.temperature(Position{0.3, 0.4, 0}, 0.1));
      EXPECT_NEAR(disk.ExactSolution::solid_volume(0, 1, 0.25), pi * 0.65 * 0.65, 1e-14);
      const ManufacturedSolution plane(
          material, make_front_family({.name = "plane", .dimension = 1}), 1);
      EXPECT_EQ(plane.symmetry(), Symmetry::planar);
      EXPECT_NEAR(plane.front(0.25), 0.7, 1e-15);
      const ManufacturedSolution star(
          material, make_front_family({.name = "star-3", .dimension = 2}), 1);
      EXPECT_FALSE(star.depends_on_one_coordinate());
      EXPECT_TRUE(std::isnan(star.front(0.25)));
    }

    /** The rate of the heat content is the flux at the end and what is released. */
    TEST(ManufacturedSolution, HeatContentFollowsFromFluxAndSource)
    {
      Material material;
      material.solid = {.conductivity = 2, .specific_heat_capacity = 1.5, .density = 1.2};
      material.liquid
          = {.conductivity = 0.5, .specific_heat_capacity = 1, .density = 0.8};
      material.latent_heat = 3;
      const ManufacturedSolution disk(
          material, make_front_family({.name = "disk", .dimension = 2}), 1);
      const double time = 0.1, step = 1e-4, outer = 0.9;
      const double rate = (disk.heat_content(0, outer, time + step)
                           - disk.heat_content(0, outer, time - step))
                          / (2 * step);
      constexpr int rings = 20000;
      double released = 0;
      for(int i = 0; i < rings; ++i)
      {
        const double r = outer * (i + 0.5) / rings;
        released += 2 * pi * r * outer / rings
                    * disk.volumetric_source(Position{r, 0, 0}, time);
      }
      const double through_wall = 2 * pi * outer * disk.heat_flux({outer, 0, 0}, time)[0];
      EXPECT_NEAR(rate / (released + through_wall), 1, 2e-4);
    }
  } // namespace
} // namespace meltfront::cases::manufactured
