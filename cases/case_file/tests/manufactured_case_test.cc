#include <cases/case_file/case_file.h>
#include <cases/case_file/tests/sample_case.h>
#include <cases/effects.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace meltfront::cases;
using namespace meltfront::cases::test;

namespace
{
  const std::string star = R"(set title = A star
subsection Scene
  set symmetry = none
  set end time = 0.6
  subsection Domain
    set shape = ball
    set dimension = 2
    set radius = 1
  end
  subsection Material
    set latent heat = 2
    set melting temperature = 5
    subsection Solid
      set conductivity = 3
      set specific heat capacity = 1
      set density = 1
    end
    subsection Liquid
      set conductivity = 0.5
    end
  end
  subsection Initial state
    set kind = exact
  end
  subsection Volumetric source
    set power density = exact
  end
  subsection Walls
    subsection outer
      set kind = exact
    end
  end
end
subsection Exact solution
  set kind = manufactured
  set family = star-3
  set base flux = 1.5
end
)";

  const std::string two_disks = R"(set title = Two disks
subsection Scene
  set symmetry = none
  set end time = 6
  subsection Domain
    set shape = box
    set dimension = 2
    set lower corner = -1, -0.6
    set upper corner = 1, 0.6
  end
  subsection Material
    set latent heat = 1
    set melting temperature = 0
    subsection Solid
      set conductivity = 1
      set specific heat capacity = 1
      set density = 1
    end
  end
  subsection Initial state
    set kind = exact
  end
  subsection Volumetric source
    set power density = exact
  end
  subsection Walls
    subsection x_min
      set kind = exact
    end
    subsection x_max
      set kind = flux
      set flux = exact
    end
    subsection y_min
      set kind = heat transfer
      set ambient temperature = exact
      set heat transfer coefficient = 4
    end
    subsection y_max
      set kind = exact
    end
  end
end
subsection Exact solution
  set kind = manufactured
  set family = two-disks
  set period = 8
end
)";

  std::string about(const std::string &text, const std::string &old_piece,
                    const std::string &new_piece)
  {
    return complaint(replaced(text, old_piece, new_piece));
  }
} // namespace

TEST(ManufacturedCase, TakesStateWallsAndSourceFromTheSolution)
{
  const Case c = read(star);
  const ExactSolution &exact = *c.exact;
  EXPECT_FALSE(exact.depends_on_one_coordinate());
  const EffectSet effects = effects_called_for(c.scene);
  EXPECT_TRUE(effects.contains(Effect::volumetric_source));
  EXPECT_TRUE(effects.contains(Effect::phase_change));
  EXPECT_LT((*c.scene.initial.front)({0, 0, 0}, 0), 0);
  EXPECT_GT((*c.scene.initial.front)({0.9, 0, 0}, 0), 0);
  const Position p{0.3, -0.6, 0};
  EXPECT_EQ(c.scene.initial.temperature(p, 0), exact.temperature(p, 0));
  EXPECT_EQ((*c.scene.volumetric_source)(p, 0.4), exact.volumetric_source(p, 0.4));
  EXPECT_NE(exact.volumetric_source(p, 0.4), exact.volumetric_source(p, 0.5));
  EXPECT_TRUE(c.scene.volumetric_source->breakpoints.empty());
  const Position rim{0.6, 0.8, 0};
  EXPECT_EQ(c.scene.boundary(Side::outer).value(rim, 0.2), exact.temperature(rim, 0.2));
}

TEST(ManufacturedCase, WallsCanLetTheExactFluxThrough)
{
  const Case c = read(two_disks);
  const double time = 1.3, step = 1e-6;
  const Position right{1, 0.2, 0}, bottom{0.3, -0.6, 0};
  const auto temperature = [&](double x, double y) {
    return c.exact->temperature(Position{x, y, 0}, time);
  };
  // Inward, with conductivity one: the derivative along the outward normal.
  const double through_right
      = (temperature(1 + step, 0.2) - temperature(1 - step, 0.2)) / (2 * step);
  const double through_bottom
      = (temperature(0.3, -0.6 - step) - temperature(0.3, -0.6 + step)) / (2 * step);
  EXPECT_NEAR(c.scene.boundary(Side::x_max).value(right, time), through_right, 1e-7);
  EXPECT_GT(through_right, 1);
  const Boundary &wall = c.scene.boundary(Side::y_min);
  EXPECT_NEAR(wall.heat_transfer_coefficient
                  * (wall.value(bottom, time) - temperature(0.3, -0.6)),
              through_bottom, 1e-7);
}

TEST(ManufacturedCase, TimesOfContactAreBreakpoints)
{
  EXPECT_EQ(read(two_disks).scene.volumetric_source->breakpoints,
            (std::vector<double>{2, 6}));
}

TEST(ManufacturedCase, FluxThroughARoundWall)
{
  const std::string disk
      = replaced(replaced(star, "family = star-3", "family = disk"),
                 "subsection outer\n      set kind = exact",
                 "subsection outer\n      set kind = flux\n      set flux = exact");
  const Case c = read(replaced(disk, "symmetry = none", "symmetry = cylindrical"));
  EXPECT_TRUE(c.exact->depends_on_one_coordinate());
  EXPECT_EQ(c.exact->symmetry(), Symmetry::cylindrical);
  EXPECT_NEAR(c.exact->front(0.25), 0.65, 1e-14);
  const double time = 0.4, step = 1e-6;
  const double slope
      = (c.exact->temperature(1 + step, time) - c.exact->temperature(1 - step, time))
        / (2 * step);
  EXPECT_NEAR(c.scene.boundary(Side::outer).value({0.6, 0.8, 0}, time), 0.5 * slope,
              1e-7);
}

TEST(ManufacturedCase, RefusesWhatCannotBeExact)
{
  const std::string source
      = "  subsection Volumetric source\n    set power density = exact\n  end\n";
  EXPECT_TRUE(about(star, source, "").find("power density = exact") != std::string::npos);
  EXPECT_NE(about(star, "power density = exact", "power density = 3").find("needs the"),
            std::string::npos);
  EXPECT_NE(about(star, "family = star-3", "family = star-4").find("star-3"),
            std::string::npos);
  EXPECT_NE(about(star, "set base flux = 1.5", "set lambda = 1").find("lambda"),
            std::string::npos);
  EXPECT_NE(about(star, "set base flux = 1.5", "set base flux = 0").find("base flux"),
            std::string::npos);
  EXPECT_NE(about(star, "set kind = manufactured", "set kind = none").find("family"),
            std::string::npos);
  EXPECT_NE(about(star, "latent heat = 2", "latent heat = 0").find("latent heat"),
            std::string::npos);
  EXPECT_NE(about(star, "dimension = 2", "dimension = 3").find("dimension"),
            std::string::npos);
  const std::string neumann = replaced(
      replaced(slab, "set kind = fixed temperature\n      set temperature = -10",
               "set kind = flux\n      set flux = exact"),
      "end time = 100", "end time = 90");
  EXPECT_NE(complaint(neumann).find("exact"), std::string::npos);
}

TEST(ManufacturedCase, EndsWithinSoManyPeriods)
{
  EXPECT_NE(about(two_disks, "set end time = 6", "set end time = 2147483648")
                .find("key 'period' in subsection 'Exact solution' must be at least "
                      "214748 s: the run lasts no more than 10000 of them"),
            std::string::npos);
}
