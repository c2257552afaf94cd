// Walls that exchange heat with their surroundings, beside a phase that conducts badly.

#include <particles/sph/tests/scenes.h>

#include <gtest/gtest.h>

#include <cmath>

namespace meltfront::particles::testing
{
  namespace
  {
    constexpr double warmth = 0.5, cold = 0.05, coefficient = 5, end = 14;

    /** What is warmer (colder: @p sign = -1) than the melting temperature freezes (melts)
     * from a wall on and all but insulates. */
    Problem bad_conductor(double sign)
    {
      cases::Material material = unit_material(0);
      (sign > 0 ? material.liquid : material.solid).conductivity = 1e-5;
      cases::Boundary surroundings = fixed_wall(-sign * cold);
      surroundings.kind = cases::BoundaryKind::heat_transfer;
      surroundings.heat_transfer_coefficient = coefficient;
      Problem problem;
      problem.scene
          = slab(material, 1, sign * warmth, end, surroundings, cases::Boundary());
      return problem;
    }

    // Each length that the front passes gives the latent heat and that of what is ahead:
    // (L + c T) s' = (T_m - T_a)/(1/h + s/k) but for the sensible heat behind the front,
    // which is up to 1.7 % of it.
    TEST(WallExchange, ABadConductorDoesNotShutTheWallOff)
    {
      const double depth
          = std::sqrt(1 / (coefficient * coefficient) + 2 * cold * end / (1 + warmth))
            - 1 / coefficient;
      const auto method = make_sph();
      for(const int n : {20, 40})
      {
        const Outcome freezing = run(*method, bad_conductor(1), n);
        EXPECT_NEAR(freezing.front_end, depth, 0.02 * depth) << n;
        EXPECT_LE(freezing.largest_defect, 1e-12);
        const Outcome melting = run(*method, bad_conductor(-1), n);
        EXPECT_NEAR(1 - melting.front_end, freezing.front_end, 1e-9) << n;
      }
    }

    // The heat of a step of implicit schemes follows from the same law.
    TEST(WallExchange, TimeSchemesAgree)
    {
      const auto method = make_sph();
      const double steps = run(*method, bad_conductor(1), 40).front_end;
      const Outcome implicit
          = run(*method, bad_conductor(1), 40, {{"time_scheme", "backward-euler"}});
      EXPECT_NEAR(implicit.front_end, steps, 0.01);
      EXPECT_LE(implicit.largest_defect, 1e-10);
    }
  } // namespace
} // namespace meltfront::particles::testing
