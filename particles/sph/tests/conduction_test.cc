#include <cases/error.h>
#include <cases/exact/formula_solution.h>
#include <particles/sph/sph.h>
#include <particles/sph/tests/scenes.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meltfront::particles::testing
{
  namespace
  {
    constexpr double pi = std::numbers::pi;
    const std::unique_ptr<cases::Method> method = make_sph();

    using Formula = std::function<double(const cases::Position &, double)>;

    /** A unit slab between cold walls, of which the temperature is known. */
    Problem slab_with(const Formula &formula, double end_time)
    {
      Problem problem;
      cases::Material material = unit_material();
      material.latent_heat = 0;
      problem.scene = slab(material, 1, 0, end_time, fixed_wall(0), fixed_wall(0));
      problem.scene.initial.temperature = {"", formula};
      problem.exact = std::make_shared<cases::FormulaSolution>(cases::Symmetry::planar,
                                                               "", formula);
      return problem;
    }

    double error(const Problem &problem, int n, const OptionTexts &options = {})
    {
      const Outcome outcome = run(*method, problem, n, options);
      EXPECT_LE(outcome.largest_defect, 1e-12);
      double sum = 0;
      for(std::size_t i = 0; i < outcome.temperature.size(); ++i)
      {
        const double difference
            = outcome.temperature[i]
              - problem.exact->temperature(cases::Position{outcome.position_x[i], 0, 0},
                                           problem.scene.end_time);
        sum += difference * difference;
      }
      return std::sqrt(sum / double(outcome.temperature.size()));
    }

    double order(const Problem &problem, const OptionTexts &options = {})
    {
      std::vector<double> spacing, errors;
      for(const int n : {10, 20, 40, 80})
      {
        spacing.push_back(1. / n);
        errors.push_back(error(problem, n, options));
      }
      EXPECT_LT(errors.back(), 1e-3);
      return fitted_order(spacing, errors);
    }

    TEST(Conduction, VolumetricSourceThroughoutTheDomain)
    {
      Problem problem
          = slab_with([](const cases::Position &p, double t)
                      { return std::sin(pi * p[0]) * (1 - std::exp(-4 * t)); },
                      0.5);
      problem.scene.volumetric_source = cases::Field{
          "", [](const cases::Position &p, double t)
          {
            return std::sin(pi * p[0])
                   * (4 * std::exp(-4 * t) + pi * pi * (1 - std::exp(-4 * t)));
          }};
      EXPECT_GT(order(problem), 1.8);
      // Implicit steps are tried whole and in halves, which are booked once.
      EXPECT_LT(error(problem, 40, {{"time_scheme", "crank-nicolson"}}), 2e-3);
    }

    TEST(Conduction, AJumpOfConductivity)
    {
      const double a = 1.75658027885690253, b = 5.55479457412152502;
      Problem problem = slab_with(
          [=](const cases::Position &p, double t)
          {
            const double decay = std::exp(-30.8557427606899345 * t);
            return decay
                   * (p[0] < 0.5 ? std::sin(a * p[0])
                                 : 2.16073442764011616 * std::sin(b * (1 - p[0])));
          },
          0.05);
      problem.scene.inclusion = cases::Inclusion{
          {"", [](const cases::Position &p, double) { return p[0] - 0.5; }}, 10};
      EXPECT_GT(order(problem), 1.7);
      problem.scene.inclusion->conductivity = 1;
      EXPECT_GT(error(problem, 40), 0.05);
    }

    TEST(Conduction, AnInclusionThatConductsAsTheRestChangesNothing)
    {
      Problem problem
          = slab_with([](const cases::Position &p, double t)
                      { return std::sin(pi * p[0]) * std::exp(-pi * pi * t); },
                      0.02);
      const Outcome plain = run(*method, problem, 20);
      problem.scene.inclusion = cases::Inclusion{
          {"", [](const cases::Position &p, double) { return p[0] - 0.3; }}, 1};
      problem.scene.effect_choices[cases::Effect::inclusion] = cases::EffectChoice::on;
      const Outcome same = run(*method, problem, 20);
      EXPECT_EQ(plain.temperature, same.temperature);
    }

    TEST(Conduction, ParticlesMovedApartAreAsGoodAsJitteredOnes)
    {
      const Formula wave = [](const cases::Position &p, double t) {
        return 1 + std::cos(pi * p[0]) * std::cos(pi * p[1]) * std::exp(-2 * pi * pi * t);
      };
      Problem problem;
      cases::Material material = unit_material();
      material.latent_heat = 0;
      problem.scene = unit_box(2, material, 0, 0.02);
      problem.scene.domain.lower = {0, 0, 0};
      problem.scene.domain.upper = {1, 1, 0};
      problem.scene.initial.temperature = {"", wave};
      problem.exact
          = std::make_shared<cases::FormulaSolution>(cases::Symmetry::none, "", wave);
      const auto spread = [&](const OptionTexts &options)
      {
        const Outcome outcome = run(*method, problem, 24, options, 3);
        EXPECT_LE(outcome.largest_defect, 1e-12);
        return std::max(outcome.highest - 2, -outcome.lowest);
      };
      EXPECT_LE(spread({{"arrangement", "lennard-jones"}, {"smoothing_length", "1.3"}}),
                1e-9);
      EXPECT_LE(spread({{"arrangement", "random"}, {"smoothing_length", "3"}}), 1e-9);
      EXPECT_THROW(spread({{"arrangement", "random"}, {"smoothing_length", "1.3"}}),
                   cases::Refusal);
      EXPECT_THROW(run(*method, line_sink_in_disk(), 20, {{"arrangement", "random"}}),
                   cases::Refusal);
      EXPECT_THROW(
          run(*method, problem, 20, {{"arrangement", "random"}, {"jitter", "0.1"}}),
          cases::Refusal);
    }
  } // namespace
} // namespace meltfront::particles::testing
