// Point sources that move.

#include <particles/sph/tests/scenes.h>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace meltfront::particles::testing
{
  namespace
  {
    const auto method = make_sph();
    constexpr double pi = std::numbers::pi;

    /** Gives off 10 until `off`. */
    cases::PointSource source_until(double off)
    {
      cases::PointSource source;
      source.expression = "10 until it is switched off";
      source.power = [off](double time) { return time < off ? 10. : 0.; };
      source.energy = [off](double time) { return 10 * std::min(time, off); };
      return source;
    }

    cases::Scene without_latent_heat(cases::Scene scene)
    {
      scene.material.latent_heat = 0;
      scene.material.melting_temperature = -100;
      return scene;
    }

    double error_of(const Outcome &outcome, const std::function<double(double)> &exact)
    {
      double sum = 0;
      for(std::size_t i = 0; i < outcome.temperature.size(); ++i)
        sum += outcome.weights[i]
               * std::pow(outcome.temperature[i] - exact(outcome.position_x[i]), 2);
      return std::sqrt(sum);
    }

    // Cosines between insulated walls, each driven by the source as it passes.
    TEST(MovingSource, APlaneInASlab)
    {
      constexpr double off = 0.035, end = 0.05, from = 0.2, speed = 15;
      Problem problem;
      problem.scene = without_latent_heat(
          slab(unit_material(-100), 1, 0, end, cases::Boundary(), cases::Boundary()));
      cases::PointSource source = source_until(off);
      source.position = {from, 0, 0};
      source.path = cases::Path{"0.2 + 15 t", [](double time) {
                                  return cases::Position{from + speed * time, 0, 0};
                                }};
      problem.scene.sources = {source};
      const auto exact = [=](double x)
      {
        double sum = 10 * off;
        for(int n = 1; n < 200; ++n)
        {
          const double k = n * pi;
          const std::complex<double> rate(k * k, k * speed);
          const double decay = k * k * end;
          const std::complex<double> driven
              = std::polar(1., k * from)
                * (std::exp(rate * off - decay) - std::exp(-decay)) / rate;
          sum += 20 * std::cos(k * x) * driven.real();
        }
        return sum;
      };
      std::vector<double> spacing, errors;
      for(const int n : {20, 40, 80, 160})
      {
        const Outcome outcome = run(*method, problem, n);
        EXPECT_NEAR(outcome.heat.sources, 0.35, 1e-14);
        EXPECT_LE(outcome.largest_defect, 1e-13);
        spacing.push_back(1. / n);
        errors.push_back(error_of(outcome, exact));
      }
      EXPECT_GE(fitted_order(spacing, errors), 1.8);
      // Long implicit steps leave the heat along the path.
      const Outcome few = run(*method, problem, 80,
                              {{"time_scheme", "crank-nicolson"}, {"step_factor", "60"}});
      EXPECT_LE(error_of(few, exact), 0.02);
      EXPECT_LE(few.largest_defect, 1e-12);
    }

    TEST(MovingSource, APathThatStaysIsTheSourceThatStays)
    {
      Problem problem;
      problem.scene = without_latent_heat(unit_box(2, unit_material(-100), 0, 0.02));
      cases::PointSource source = source_until(0.01);
      source.position = {0.1, -0.2, 0};
      problem.scene.sources = {source};
      const Outcome stays = run(*method, problem, 24);
      problem.scene.sources[0].path = cases::Path{"0.1, -0.2", [](double) {
                                                    return cases::Position{0.1, -0.2, 0};
                                                  }};
      const Outcome path = run(*method, problem, 24);
      for(std::size_t i = 0; i < stays.temperature.size(); ++i)
        EXPECT_NEAR(stays.temperature[i], path.temperature[i], 1e-13);
    }

    // Once around the middle of a square, with latent heat: the heat is the source's.
    TEST(MovingSource, ASpotThatMeltsItsWay)
    {
      Problem problem;
      problem.scene = unit_box(2, unit_material(0), -0.1, 0.1);
      cases::PointSource source = source_until(0.1);
      const auto path = [](double time)
      {
        const double angle = 20 * pi * time;
        return cases::Position{0.3 * std::cos(angle), 0.3 * std::sin(angle), 0};
      };
      source.position = path(0);
      source.path = cases::Path{"circle", path};
      problem.scene.sources = {source};
      const Outcome outcome = run(*method, problem, 30);
      EXPECT_NEAR(outcome.heat.sources, 1, 1e-13);
      EXPECT_LE(outcome.largest_defect, 1e-12);
      EXPECT_GT(outcome.heat.latent, 0.3);
      EXPECT_GE(outcome.lowest, -0.1 - 1e-12);
      const auto &effects = outcome.cost.effects;
      const auto found
          = std::find_if(effects.begin(), effects.end(),
                         [](const cases::EffectCost &cost)
                         { return cost.effect == cases::Effect::moving_source; });
      ASSERT_NE(found, effects.end());
      EXPECT_GT(found->calls, 0);
    }
  } // namespace
} // namespace meltfront::particles::testing
