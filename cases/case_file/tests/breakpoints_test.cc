#include <cases/case_file/breakpoints.h>
#include <cases/case_file/case_file.h>
#include <cases/case_file/expression.h>
#include <cases/error.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meltfront::cases
{
  namespace
  {
    std::vector<double> breakpoints(const std::string &expression, double end)
    {
      Field field = parse_field(expression, "xt");
      add_breakpoints(field, {{0.3, 0, 0}, {0.7, 0, 0}}, 0, end);
      return field.breakpoints;
    }

    TEST(Breakpoints, PulsesThatStartAndEndAtLiteralsAreFound)
    {
      EXPECT_EQ(breakpoints("if(t > 5000 & t < 5000.0001, 1e4, 0)", 1e4),
                (std::vector<double>{5000, 5000.0001}));
      const std::vector<double> scaled
          = breakpoints("if(abs(t/60 - 5) < 0.1, 1, 0)", 1e4);
      ASSERT_EQ(scaled.size(), 2u);
      EXPECT_DOUBLE_EQ(scaled[0], 294);
      EXPECT_DOUBLE_EQ(scaled[1], 306);
      EXPECT_EQ(breakpoints("if(t <= 3600, 1, 2)", 1e4), std::vector<double>{3600});
    }

    // 2 - 1.9 and 1.1 - 1 differ from 0.1 by round-off: they must not take its place.
    TEST(Breakpoints, RoundNumbersAreFoundAsWritten)
    {
      for(const char *number :
          {"0.1", "0.2", "0.3", "0.4", "0.7", "0.05", "0.15", "0.11", "1.1", "0.6"})
        for(const char *form :
            {"if(t < {}, 0, 1)", "if(t<={},1,2)", "0.1 + if(t > {}, 0.5, 0.3)",
             "if(t < {}, 0.9*t, 20 + 0.1*t)"})
        {
          const std::string expression = fmt::format(fmt::runtime(form), number);
          for(const double end : {1.2, 2., 10., 3600.})
            EXPECT_EQ(breakpoints(expression, end),
                      std::vector<double>{std::stod(number)})
                << expression << " to " << end;
        }
    }

    // No candidate of those that the expression's numbers make, but close to one.
    TEST(Breakpoints, AJumpBetweenNeighbouringCandidatesIsFound)
    {
      const double jump = 0.1 + 5e-17; // 4 roundings above 0.1, and 3 below the other
      const std::vector<double> found = find_breakpoints(
          [jump](double t) { return t < jump ? 0. : 1.; }, {0.1, 0.1 + 1e-16}, 0, 0.3);
      ASSERT_EQ(found.size(), 1u);
      EXPECT_NEAR(found[0], 0.1, 1e-15);
    }

    TEST(Breakpoints, JumpsAndBendsWithoutALiteralAreLocatedToRoundOff)
    {
      const std::vector<double> jump = breakpoints("if(3*t < pi, 1, 3)", 10);
      ASSERT_EQ(jump.size(), 1u);
      EXPECT_NEAR(jump[0], std::numbers::pi / 3, 1e-13);
      const std::vector<double> bends = breakpoints("max(0, sin(t))", 20);
      for(int k = 1; k <= 6; ++k)
        EXPECT_TRUE(std::ranges::any_of(
            bends, [k](double t) { return std::abs(t - k * std::numbers::pi) < 1e-9; }))
            << k;
    }

    TEST(Breakpoints, SmoothFunctionsHaveNoneButShortFeatures)
    {
      EXPECT_TRUE(breakpoints("sin(t)", 100).empty());
      EXPECT_TRUE(breakpoints("1 - 2*t + t^3", 1).empty());
      EXPECT_TRUE(breakpoints("if(x > 0.5, 1, 0)", 1).empty());
      const std::vector<double> bump = breakpoints("exp(-((t - 5)/1e-4)^2)", 1e4);
      ASSERT_FALSE(bump.empty());
      EXPECT_LT(bump.front(), 5);
      EXPECT_GT(bump.front(), 4.99);
      EXPECT_GT(bump.back(), 5);
      EXPECT_LT(bump.back(), 5.01);
    }

    TEST(Breakpoints, WhatMovesBreaksAtEachPosition)
    {
      const std::vector<double> found = breakpoints("if(x < 0.1*t, 1, 0)", 10);
      ASSERT_EQ(found.size(), 2u);
      EXPECT_NEAR(found[0], 3, 1e-12);
      EXPECT_NEAR(found[1], 7, 1e-12);
    }

    TEST(Breakpoints, WhatVariesTooFastOrIsNotFiniteIsRefused)
    {
      EXPECT_THROW(breakpoints("sin(1e5*t)", 1e3), InputError);
      EXPECT_THROW(breakpoints("1/(t - 3.7)", 10), InputError);
    }

    TEST(Breakpoints, CasesCarryThem)
    {
      const Case c = read_case_text(R"(
set title = pulse
subsection Scene
  set symmetry = planar
  set end time = 100
  subsection Domain
    set shape = slab
    set length = 1
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
  subsection Walls
    subsection x_min
      set kind = flux
      set flux = if(t < 33.3, 1, -1)
    end
    subsection x_max
      set kind = fixed temperature
      set temperature = 1 + min(t, 50)
    end
  end
  subsection Initial state
    set temperature = 1
  end
end
)",
                                    "pulse.prm");
      EXPECT_EQ(c.scene.boundary(Side::x_min).value.breakpoints,
                std::vector<double>{33.3});
      EXPECT_EQ(c.scene.boundary(Side::x_max).value.breakpoints, std::vector<double>{50});
    }

    TEST(Breakpoints, EnergyOfASourceHoldsItsPulses)
    {
      const Case c = read_case_text(R"(
set title = pulse
subsection Scene
  set symmetry = none
  set end time = 1e4
  subsection Domain
    set shape = box
    set dimension = 2
    set lower corner = 0, 0
    set upper corner = 1, 1
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
    set temperature = -1
  end
  subsection Source 1
    set position = 0.5, 0.5
    set power = if(t > 5000.3 & t < 5000.3001, 1e4, 0)
  end
end
)",
                                    "pulse.prm");
      const PointSource &source = c.scene.sources.at(0);
      EXPECT_NEAR(source.energy(1e4), 1, 1e-7);
      EXPECT_EQ(source.energy(5000), 0);
    }
  } // namespace
} // namespace meltfront::cases
