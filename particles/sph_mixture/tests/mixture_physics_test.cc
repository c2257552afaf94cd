#include <cases/error.h>
#include <cases/exact/mushy_layer.h>
#include <particles/alloy/tests/alloy_scenes.h>
#include <particles/sph/sph.h>
#include <particles/sph/tests/scenes.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace meltfront::particles::testing
{
  namespace
  {
    using cases::Field;
    using cases::Position;
    using cases::Scene;

    double largest_difference(const std::vector<double> &a, const std::vector<double> &b)
    {
      EXPECT_EQ(a.size(), b.size());
      double largest = 0;
      for(std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        largest = std::max(largest, std::abs(a[i] - b[i]));
      return largest;
    }

    // Without solute a particle that melts conducts as its partner, as with `sph` and its
    // front = partner: the fronts are as good, not those of a mean conductivity.
    TEST(Mixture, OfAPureSubstanceIsTheEnthalpyMethod)
    {
      for(const Problem &problem : {plane_freezing_water(), plane_contrast()})
      {
        const double front = problem.exact->front(problem.scene.end_time);
        for(const int n : {40, 80, 160})
        {
          const auto error = [&](const char *conductivity)
          {
            return std::abs(run(*make_sph_mixture(), problem.scene, n,
                                {{"conductivity", conductivity}})
                                .solid
                            - front);
          };
          const Outcome sph = run(*make_sph(), problem, n, {{"front", "partner"}});
          EXPECT_LT(error("integral"), std::abs(sph.front_end - front)) << n;
          EXPECT_LT(error("integral"), 0.5 * error("arithmetic")) << n;
        }
      }
    }

    // The dilute limit is not singular.
    TEST(Mixture, WithATraceOfSoluteIsNearlyThePureSubstance)
    {
      const Problem pure = plane_freezing_water();
      Scene trace = pure.scene;
      trace.alloy = cases::Alloy{};
      trace.alloy->solutes.push_back({"trace", 50.});
      trace.initial.concentration = {Field::uniform(1e-9)};
      const auto without = run(*make_sph_mixture(), pure.scene, 40);
      const auto with = run(*make_sph_mixture(), trace, 40);
      EXPECT_LT(largest_difference(without.temperature, with.temperature), 1e-3);
      EXPECT_NEAR(with.solid / without.solid, 1, 1e-4);
    }

    Scene with_two_salts(double first, double second)
    {
      Scene scene = nitrate_slab(13200);
      cases::Solute other;
      other.name = "second";
      other.liquidus_slope = 60;
      scene.alloy->solutes.push_back(other);
      scene.initial.concentration = {Field::uniform(first), Field::uniform(second)};
      return scene;
    }

    // As in `sph`: the heat, and what solute there is, belong to the volume of the ball.
    TEST(Mixture, InABallHoldsWhatItsVolumeHolds)
    {
      for(const char *scheme : {"rkl2", "crank-nicolson"})
        for(const int n : {12, 17})
        {
          Scene scene;
          scene.symmetry = cases::Symmetry::cylindrical;
          scene.domain = {cases::DomainShape::ball, 2, {}, {}, 0.05, 0};
          scene.material = nitrate_solvent();
          scene.alloy = nitrate();
          scene.alloy->solutes[0].diffusivity = 1e-6;
          scene.initial.temperature = Field::uniform(10);
          scene.initial.concentration = {
              {"", [](const Position &p, double) { return p[0] > 0.01 ? 0.1 : 0.02; }}};
          scene.boundaries[static_cast<int>(cases::Side::outer)]
              = cases::Boundary{cases::BoundaryKind::flux, Field::uniform(-500)};
          scene.end_time = 300;
          const auto outcome
              = run(*make_sph_mixture(), scene, n, {{"time_scheme", scheme}});
          double volume = 0, heat = 0;
          for(std::size_t i = 0; i < outcome.weights.size(); ++i)
          {
            volume += outcome.weights[i];
            heat += outcome.weights[i] * nitrate_density * 4180
                    * (outcome.temperature[i] - 10);
          }
          const double area = std::numbers::pi * 0.05 * 0.05;
          EXPECT_NEAR(volume, area, 1e-13 * area);
          const double taken = -500 * 2 * std::numbers::pi * 0.05 * 300;
          EXPECT_NEAR(heat, taken, 1e-9 * std::abs(taken));
          EXPECT_LE(outcome.heat_defect, 1e-12);
          EXPECT_LE(outcome.solute_defect, 1e-12);
        }
    }

    // Only the sum of what solutes lower the liquidus by counts.
    TEST(Mixture, OfTwoSolutesIsThatOfOne)
    {
      const double second = nitrate_slope * 0.07 / 60;
      for(const auto &method : {make_sph_mixture(), make_sph_two_population()})
      {
        const auto one = run(*method, nitrate_slab(13200), 40);
        const auto two = run(*method, with_two_salts(0.07, second), 40);
        EXPECT_LT(largest_difference(one.temperature, two.temperature), 1e-10);
        EXPECT_LT(largest_difference(one.solid_fraction, two.solid_fraction), 1e-11);
        EXPECT_LT(two.solute_defect, 1e-12);
        ASSERT_EQ(two.concentration[1].size(), two.x.size());
        EXPECT_NEAR(two.concentration[1][7], second, 1e-15);
      }
    }

    TEST(Mixture, LeavesOutASoluteThatIsAbsent)
    {
      const auto one = run(*make_sph_mixture(), nitrate_slab(13200), 40);
      const auto two
          = run(*make_sph_mixture(), with_two_salts(nitrate_concentration, 0), 40);
      EXPECT_EQ(largest_difference(one.temperature, two.temperature), 0);
      EXPECT_TRUE(two.concentration[1].empty());
    }

    // A liquidus given by a table that is straight.
    TEST(Mixture, FollowsACurvedLiquidus)
    {
      const auto straight = run(*make_sph_mixture(), nitrate_slab(13200), 40,
                                {{"conductivity", "arithmetic"}});
      Scene scene = nitrate_slab(13200);
      std::vector<std::pair<double, double>> points;
      for(int i = 0; i <= 10; ++i)
        points.push_back({0.05 * i, -nitrate_slope * 0.05 * i});
      cases::Solute &salt = scene.alloy->solutes[0];
      salt.liquidus_slope = 0;
      salt.liquidus_curve = cases::liquidus_through(points, 0);
      salt.largest_concentration = 0.5;
      const auto curved = run(*make_sph_mixture(), scene, 40);
      EXPECT_LT(largest_difference(straight.temperature, curved.temperature), 1e-8);
    }

    // Below the eutectic temperature all is solid, and its front is a sharp one.
    TEST(Mixture, FreezesWhatIsLeftAtTheEutecticTemperature)
    {
      Scene scene = nitrate_slab(91800);
      scene.alloy->eutectic_temperature = -17.7;
      const auto exact = std::make_shared<cases::MushyLayer>(
          scene.material, *scene.alloy, std::vector<double>{nitrate_concentration}, -30,
          14.7);
      scene.boundaries[0] = fixed_wall(-30);
      scene.boundaries[1] = exact_wall(exact);
      std::vector<double> errors, spacing;
      for(const int n : {30, 60, 120, 240})
      {
        const auto found = run(*make_sph_mixture(), scene, n);
        double sum = 0;
        for(std::size_t i = 0; i < found.x.size(); ++i)
        {
          const double deviation
              = found.temperature[i]
                - exact->temperature(Position{found.x[i], 0, 0}, scene.end_time);
          sum += deviation * deviation;
        }
        errors.push_back(std::sqrt(sum / found.x.size()));
        spacing.push_back(found.description.spacing);
        EXPECT_NEAR(found.solid
                        / exact->solid_volume(0, scene.domain.upper[0], scene.end_time),
                    1, 1.2 / n)
            << n;
        EXPECT_LT(found.heat_defect, 1e-12);
        EXPECT_LT(found.solute_defect, 1e-12);
        EXPECT_EQ(
            *std::max_element(found.solid_fraction.begin(), found.solid_fraction.end()),
            1.);
      }
      EXPECT_LT(errors[2], 0.06);
      EXPECT_GT(fitted_order(spacing, errors), 1.2);
    }

    // Diffusion against the similarity solution with it: the front is shorter and the
    // liquid ahead of it enriched.
    TEST(Mixture, DiffusesSoluteAsTheMushyLayerDoes)
    {
      const double diffusivity = 6.8e-7 / nitrate_density;
      const Scene scene = nitrate_slab(91800, diffusivity);
      const cases::MushyLayer exact(scene.material, *scene.alloy, {nitrate_concentration},
                                    -16.5, 14.7);
      const auto deviation = [&](const AlloyOutcome &outcome)
      {
        double sum = 0;
        for(std::size_t i = 0; i < outcome.x.size(); ++i)
        {
          const double d
              = outcome.temperature[i]
                - exact.temperature(Position{outcome.x[i], 0, 0}, scene.end_time);
          sum += d * d;
        }
        return std::sqrt(sum / outcome.x.size());
      };
      const auto check = [&](const cases::Method &method, int n, double bound)
      {
        const auto found = run(method, scene, n);
        EXPECT_LT(deviation(found), bound) << method.name();
        EXPECT_LT(found.solute_defect, 1e-12);
        EXPECT_LT(found.heat_defect, 1e-12);
        // Next to the wall solute leaves a layer that is thinner than the spacing.
        double sum = 0;
        int rows = 0;
        for(std::size_t i = 0; i < found.x.size(); ++i)
          if(found.x[i] > 0.01)
          {
            const double d = found.concentration[0][i]
                             - exact.concentration(found.x[i], scene.end_time);
            sum += d * d;
            ++rows;
          }
        EXPECT_LT(std::sqrt(sum / rows), 5e-4) << method.name();
      };
      check(*make_sph_mixture(), 120, 0.017);
      check(*make_sph_mixture(), 240, 0.01);
      check(*make_sph_two_population(), 120, 0.018);
      EXPECT_GT(deviation(run(*make_sph_mixture(), nitrate_slab(91800), 240)), 0.015);
    }

    // The wall becomes as warm as the brine was: all ice melts.
    TEST(Mixture, MeltsBack)
    {
      Scene scene = nitrate_slab(2e6);
      scene.boundaries[0] = cases::Boundary{
          cases::BoundaryKind::fixed_temperature,
          {"if(t < 13200, -16.5, 14.7)",
           [](const Position &, double t) { return t < 13200 ? -16.5 : 14.7; }, false},
          false};
      scene.boundaries[1] = cases::Boundary{};
      for(const auto &method : {make_sph_mixture(), make_sph_two_population()})
      {
        const auto outcome = run(*method, scene, 20, {}, 1);
        EXPECT_GT(*std::max_element(outcome.solids.begin(), outcome.solids.end()), 0.01);
        EXPECT_EQ(outcome.solid, 0) << method->name();
        for(const double t : outcome.temperature)
        {
          EXPECT_GT(t, 14.58);
          EXPECT_LT(t, 14.7);
        }
        EXPECT_LT(outcome.heat_defect, 1e-11);
        EXPECT_LT(outcome.solute_defect, 1e-12);
      }
    }

    // Brine with irregular temperatures and concentrations: at the largest step that is
    // allowed the entropies of heat and of mixing never fall.
    TEST(Mixture, MakesEntropy)
    {
      for(const double diffusivity : {6.2e-10, 1e-7}) // the second as fast as heat
      {
        Scene scene = nitrate_slab(2000, diffusivity);
        scene.domain.upper = {0.05, 0, 0};
        scene.boundaries[0] = scene.boundaries[1] = cases::Boundary{};
        scene.initial.temperature
            = {"irregular",
               [](const Position &p, double)
               { return 15 + 12 * std::sin(1e5 * (p[0] + 0.013) * (p[0] + 0.013)); },
               false};
        scene.initial.concentration
            = {{"irregular",
                [](const Position &p, double)
                { return 0.15 + 0.1 * std::sin(2.3e5 * (p[0] + 0.02) * (p[0] + 0.02)); },
                false}};
        for(const auto &method : {make_sph_mixture(), make_sph_two_population()})
        {
          OptionTexts options;
          if(method->name() == "sph-mixture")
            options = {{"time_scheme", "euler"}};
          const auto outcome = run(*method, scene, 64, options, 1);
          EXPECT_GT(outcome.entropies.back(), outcome.entropies.front() * (1 + 1e-6));
          EXPECT_GT(outcome.mixing_entropies.back(),
                    1.005 * outcome.mixing_entropies.front());
          for(std::size_t i = 1; i < outcome.entropies.size(); ++i)
          {
            EXPECT_GE(outcome.entropies[i], outcome.entropies[i - 1] * (1 - 1e-14)) << i;
            EXPECT_GE(outcome.mixing_entropies[i],
                      outcome.mixing_entropies[i - 1] * (1 - 1e-14))
                << i;
          }
          EXPECT_LT(outcome.solute_defect, 1e-12);
        }
      }
    }

    // Two cold walls that meet, particles that are displaced, solute that diffuses.
    TEST(Mixture, FreezesACorner)
    {
      Scene scene = nitrate_slab(4000, 6.2e-10);
      scene.symmetry = cases::Symmetry::none;
      scene.domain = {};
      scene.domain.shape = cases::DomainShape::box;
      scene.domain.dimension = 2;
      scene.domain.upper = {0.1, 0.1, 0};
      scene.boundaries[1] = cases::Boundary{};
      scene.boundaries[2] = fixed_wall(-16.5);
      scene.boundaries[3] = cases::Boundary{};
      for(const auto &method : {make_sph_mixture(), make_sph_two_population()})
        for(const char *layout : {"cell", "edge"})
        {
          const auto found
              = run(*method, scene, 24,
                    {{"layout", layout}, {"smoothing_length", "1.3"}, {"jitter", "0.1"}});
          EXPECT_LT(found.heat_defect, 1e-12);
          EXPECT_LT(found.mass_defect, 1e-12);
          EXPECT_LT(found.solute_defect, 1e-12);
          EXPECT_GT(found.solid, 2 * 0.1 * 0.005) << method->name() << layout;
          EXPECT_LT(found.solid, 2 * 0.1 * 0.016) << method->name() << layout;
        }
    }

    TEST(Mixture, StopsWhereAWallIsNotANumber)
    {
      Scene scene = nitrate_slab(13200);
      scene.boundaries[0]->value
          = {"nan",
             [](const Position &, double t)
             { return t > 6000 ? std::numeric_limits<double>::quiet_NaN() : -16.5; },
             false};
      for(const auto &method : {make_sph_mixture(), make_sph_two_population()})
        EXPECT_THROW(run(*method, scene, 20), cases::NumericalError) << method->name();
    }
  } // namespace
} // namespace meltfront::particles::testing
