#include <particles/scattered/given_values.h>

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using namespace meltfront;
  using namespace meltfront::particles;

  /** 1e4 W/m^2 between 0.3171 and 0.3172 s. */
  cases::Field pulse()
  {
    return {"",
            [](const cases::Position &, double t)
            { return t >= 0.3171 && t < 0.3172 ? 1e4 : 0.; },
            false,
            {0.3171, 0.3172}};
  }

  cases::Scene scene()
  {
    cases::Scene result;
    result.domain.upper = {1, 0, 0};
    result.boundaries[0] = cases::Boundary{cases::BoundaryKind::flux, pulse()};
    result.boundaries[1] = cases::Boundary();
    result.volumetric_source = pulse();
    return result;
  }

  constexpr int steps = 100;

  LinearStep step(int k, double share)
  {
    const double length = 1. / steps, begin = (k - 1) * length;
    return {k > 1 ? begin - length : begin, begin, begin + length, k > 1 ? share : 0,
            begin + length};
  }

  TEST(GivenValues, MeansAddUpToTheIntegral)
  {
    const cases::Scene s = scene();
    const GivenValues given(s);
    double sum = 0;
    for(int k = 1; k <= steps; ++k)
      sum += given.wall(*s.boundaries[0], {}, step(k, 0)) / steps;
    EXPECT_NEAR(sum, 1, 1e-9);
  }

  TEST(GivenValues, TheRecursionOfTwoStepsAddsUpToTheIntegral)
  {
    const cases::Scene s = scene();
    const GivenValues given(s);
    double before = 0, now = given.release({}, step(1, 0)) / steps;
    for(int k = 2; k <= steps; ++k)
    {
      const double next
          = (4 * now - before + 2 * given.release({}, step(k, 0.5)) / steps) / 3;
      before = now;
      now = next;
    }
    EXPECT_NEAR(now, 1, 1e-9);
  }

  TEST(GivenValues, ConstraintsSeePulsesAndElseHoldAtTheirTime)
  {
    cases::Scene s = scene();
    double sum = 0;
    {
      const GivenValues given(s);
      for(int k = 1; k <= steps; ++k)
        sum += given.constraint(*s.boundaries[0], {}, step(k, 0.5)) / steps;
    }
    EXPECT_NEAR(sum, 1, 1e-9);
    s.boundaries[0]->value
        = {"", [](const cases::Position &, double t) { return std::sin(t); }, false};
    const GivenValues smooth(s);
    const LinearStep some = step(7, 0.5);
    EXPECT_EQ(smooth.constraint(*s.boundaries[0], {}, some), std::sin(some.end));
  }

  TEST(GivenValues, ConstantsAreThemselves)
  {
    cases::Scene s = scene();
    s.boundaries[0]->value = cases::Field::uniform(0.1);
    const GivenValues given(s);
    EXPECT_EQ(given.wall(*s.boundaries[0], {}, step(5, 0.5)), 0.1);
    EXPECT_EQ(given.constraint(*s.boundaries[0], {}, step(5, 0.5)), 0.1);
  }
} // namespace
