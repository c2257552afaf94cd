#include <cases/error.h>
#include <particles/alloy/tests/alloy_scenes.h>
#include <particles/sph/tests/scenes.h>
#include <particles/sph_two_population/phase_exchange.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace meltfront::particles::testing
{
  namespace
  {
    AlloyOutcome march(const cases::Scene &scene, int n, OptionTexts options)
    {
      return run(*make_sph_two_population(), scene, n, options, 10);
    }

    /** Limit of Euler steps, from two lengths of these. */
    std::vector<double> limit_of_euler_steps(const cases::Scene &scene, int n)
    {
      const auto coarse = march(scene, n, {{"step_factor", "0.0625"}}).temperature;
      auto fine = march(scene, n, {{"step_factor", "0.03125"}}).temperature;
      for(std::size_t i = 0; i < fine.size(); ++i)
        fine[i] = 2 * fine[i] - coarse[i];
      return fine;
    }

    double difference(const std::vector<double> &a, const std::vector<double> &b)
    {
      double sum = 0;
      for(std::size_t i = 0; i < a.size(); ++i)
        sum += (a[i] - b[i]) * (a[i] - b[i]);
      return std::sqrt(sum / a.size());
    }

    /** Errors (K) with so many steps. */
    std::vector<double> errors_in_time(const cases::Scene &scene, int n,
                                       const std::string &scheme,
                                       const std::vector<double> &limit,
                                       const std::vector<double> &steps)
    {
      std::vector<double> errors;
      for(const double count : steps)
        errors.push_back(difference(march(scene, n,
                                          {{"time_scheme", scheme},
                                           {"stages", "64"},
                                           {"steps", std::to_string(std::lround(count))}})
                                        .temperature,
                                    limit));
      return errors;
    }

    double order_in_time(const std::vector<double> &steps,
                         const std::vector<double> &errors)
    {
      return -fitted_order(steps, errors);
    }

    /** A mush between insulated walls that levels its temperatures out. */
    cases::Scene levelling_mush()
    {
      cases::Scene scene = nitrate_slab(2e5);
      scene.initial.temperature
          = {"",
             [](const cases::Position &p, double)
             { return -10 + 3 * std::cos(std::numbers::pi * p[0] / 0.5); },
             false};
      scene.boundaries[0] = scene.boundaries[1] = cases::Boundary{};
      return scene;
    }

    const std::vector<double> few_steps{50, 100, 200, 400};

    TEST(TwoPopulationSteps, AreOfTheirOrderInAMush)
    {
      const cases::Scene scene = levelling_mush();
      const auto limit = limit_of_euler_steps(scene, 20);
      const auto errors = [&](const std::string &scheme)
      { return errors_in_time(scene, 20, scheme, limit, few_steps); };
      const auto backward = errors("backward-euler"),
                 trapezoidal = errors("crank-nicolson"), super = errors("rkl2");
      EXPECT_NEAR(order_in_time(few_steps, backward), 1, 0.05);
      EXPECT_NEAR(order_in_time(few_steps, trapezoidal), 2, 0.05);
      EXPECT_LT(trapezoidal.front(), 1e-4);
      // The first eight super steps are resolved by Euler steps: what remains is their
      // error, a share of that of Euler steps alone.
      const double euler = difference(march(scene, 20, {}).temperature, limit);
      EXPECT_LT(super.front(), 0.2 * euler);
      EXPECT_GT(order_in_time(few_steps, super), 0.7);
    }

    // Liquid that begins to freeze within a step makes the error uneven.
    TEST(TwoPopulationSteps, ConvergeWhereAMushGrows)
    {
      const cases::Scene scene = nitrate_slab(91800);
      const auto limit = limit_of_euler_steps(scene, 30);
      const auto backward = errors_in_time(scene, 30, "backward-euler", limit, few_steps);
      const auto trapezoidal
          = errors_in_time(scene, 30, "crank-nicolson", limit, few_steps);
      EXPECT_NEAR(order_in_time(few_steps, backward), 1, 0.1);
      EXPECT_GT(order_in_time(few_steps, trapezoidal), 1);
      for(std::size_t i = 0; i < few_steps.size(); ++i)
        EXPECT_LT(trapezoidal[i], 0.2 * backward[i]) << few_steps[i];
      const std::vector<double> super_steps{200, 400, 800, 1600};
      for(const double error : errors_in_time(scene, 30, "rkl2", limit, super_steps))
        EXPECT_LT(error, 2e-4);
    }

    /** The wall freezes all at the eutectic temperature, then melts it. */
    cases::Scene there_and_back(double diffusivity)
    {
      cases::Scene scene = nitrate_slab(2e6, diffusivity);
      scene.alloy->eutectic_temperature = -17.7;
      scene.boundaries[0]->value = {
          "", [](const cases::Position &, double t) { return t < 20000 ? -30. : 14.7; },
          false};
      scene.boundaries[1] = cases::Boundary{};
      return scene;
    }

    // Sixty times the explicit step and more: what breaks a bound is repeated.
    TEST(TwoPopulationSteps, KeepBudgetsAndBounds)
    {
      const std::vector<OptionTexts> choices{
          {{"time_scheme", "rkl2"}},
          {{"time_scheme", "backward-euler"}, {"step_factor", "60"}},
          {{"time_scheme", "backward-euler"}, {"step_factor", "1000"}},
          {{"time_scheme", "crank-nicolson"}, {"step_factor", "60"}},
          {{"time_scheme", "rkl2"}, {"layout", "edge"}},
          {{"time_scheme", "backward-euler"}, {"step_factor", "60"}, {"layout", "edge"}}};
      for(const double diffusivity : {0., 6.2e-10})
        for(const OptionTexts &options : choices)
        {
          const auto grown = march(nitrate_slab(91800, diffusivity), 30, options);
          const auto molten = march(there_and_back(diffusivity), 20, options);
          for(const AlloyOutcome *outcome : {&grown, &molten})
          {
            EXPECT_LT(outcome->heat_defect, 1e-12) << options[0].second;
            EXPECT_LT(outcome->mass_defect, 1e-12) << options[0].second;
            EXPECT_LT(outcome->solute_defect, 1e-12) << options[0].second;
            EXPECT_LE(outcome->highest, 14.7 + 1e-7);
          }
          EXPECT_GE(grown.lowest, -16.5 - 1e-7);
          EXPECT_GE(molten.lowest, -30 - 1e-7);
          EXPECT_GT(grown.solid, 0.03);
          EXPECT_EQ(molten.solid, 0) << options[0].second;
        }
    }

    // The trapezoidal rule overshoots where a wall jumps.
    TEST(TwoPopulationSteps, AreRepeatedWhereTheyBreakABound)
    {
      const auto outcome
          = march(there_and_back(0), 20,
                  {{"time_scheme", "crank-nicolson"}, {"step_factor", "60"}});
      EXPECT_GT(outcome.cost.capped_steps, 0);
      EXPECT_LT(outcome.cost.capped_steps, 20);
    }

    TEST(TwoPopulationSteps, RefuseWhatTheyCannotDo)
    {
      const cases::Scene scene = nitrate_slab(1000);
      for(const auto &[key, value] : OptionTexts{{"exchange", "published"},
                                                 {"new_ice", "kernel"},
                                                 {"latent_heat", "constant"}})
        for(const char *scheme : {"rkl2", "backward-euler", "crank-nicolson"})
          EXPECT_THROW(march(scene, 20, {{"time_scheme", scheme}, {key, value}}),
                       cases::Refusal);
      EXPECT_THROW(march(scene, 20, {{"step_factor", "2"}}), cases::Refusal);
      EXPECT_THROW(march(nitrate_slab(91800), 60,
                         {{"time_scheme", "rkl2"}, {"steps", "3"}, {"stages", "5"}}),
                   cases::Refusal);
      EXPECT_THROW(
          run(*make_sph_two_population_2005(), scene, 20, {{"time_scheme", "rkl2"}}),
          std::exception);
    }

    /** One site of brine with a eutectic temperature. */
    struct Site
    {
      Site()
        : scene(with_eutectic())
        , substance(scene, "test")
        , exchange(substance, mass, false, true)
      {
      }

      static cases::Scene with_eutectic()
      {
        cases::Scene scene = nitrate_slab(1);
        scene.alloy->eutectic_temperature = -17.7;
        return scene;
      }

      static constexpr double mass = 3;
      cases::Scene scene;
      AlloySubstance substance;
      SiteExchange exchange;
    };

    template <typename Check>
    void for_random_sites(const Site &site, const Check &check)
    {
      std::mt19937_64 random(11);
      std::uniform_real_distribution<double> part(0, 1);
      for(int i = 0; i < 2000; ++i)
      {
        const double ice = i % 4 == 0 ? 0 : Site::mass * part(random);
        const double liquid = Site::mass - ice;
        const SiteContent<double> content{
            liquid, liquid * (334400 + 4180 * (40 * part(random) - 30)), ice,
            ice * 2006 * (40 * part(random) - 40)};
        check(content, StraightSolute{Site::mass * (0.5 + 8 * part(random))}, site);
      }
    }

    // Mass and heat stay, and liquid ends at its liquidus, at the eutectic temperature or
    // without ice; a second time nothing happens.
    TEST(SiteExchange, SettlesInEquilibrium)
    {
      int kept = 0, mushes = 0;
      for_random_sites(Site(),
                       [&](const SiteContent<double> &before,
                           const StraightSolute &solute, const Site &at)
                       {
                         SiteContent<double> site = before;
                         kept += at.exchange.settle(site, solute);
                         const double heat = before.liquid_heat + before.ice_heat;
                         EXPECT_NEAR(site.liquid_heat + site.ice_heat, heat, 1e-9);
                         EXPECT_NEAR(site.liquid_mass + site.ice_mass, Site::mass, 1e-14);
                         EXPECT_GE(site.liquid_mass, 0);
                         EXPECT_GE(site.ice_mass, 0);
                         if(site.liquid_mass > 0)
                         {
                           const double x = at.exchange.liquid_excess(site);
                           const double liquidus = -solute.depression(site.liquid_mass);
                           EXPECT_GE(x, std::max(liquidus, -17.7) - 1e-9);
                           if(site.ice_mass > 0)
                           {
                             ++mushes;
                             EXPECT_NEAR(x, std::max(liquidus, -17.7), 1e-9);
                           }
                         }
                         SiteContent<double> again = site;
                         at.exchange.settle(again, solute);
                         EXPECT_NEAR(again.liquid_mass, site.liquid_mass, 1e-9);
                         EXPECT_NEAR(again.ice_heat, site.ice_heat, 1e-4);
                       });
      EXPECT_GT(kept, 100);
      EXPECT_GT(mushes, 500);
    }

    // Automatic derivatives against differences.
    TEST(SiteExchange, KnowsItsDerivative)
    {
      int compared = 0;
      const auto temperatures
          = [](const auto &exchange, auto site, const StraightSolute &solute)
      {
        exchange.settle(site, solute);
        const auto liquid = value_of(site.liquid_mass) > 0 ? exchange.liquid_excess(site)
                                                           : exchange.ice_excess(site);
        const auto ice = value_of(site.ice_mass) > 0 ? exchange.ice_excess(site) : liquid;
        return std::array{liquid, ice};
      };
      for_random_sites(Site(),
                       [&](const SiteContent<double> &site, const StraightSolute &solute,
                           const Site &at)
                       {
                         const auto exact = temperatures(
                             at.exchange,
                             SiteContent<DualNumber>{
                                 site.liquid_mass, DualNumber(site.liquid_heat, {1, 0}),
                                 site.ice_mass, DualNumber(site.ice_heat, {0, 1})},
                             solute);
                         for(int by = 0; by < 2; ++by)
                         {
                           if(by == 1 && site.ice_mass < 0.1)
                             continue;
                           const double width = 1.;
                           const auto moved = [&](double change)
                           {
                             SiteContent<double> other = site;
                             (by == 0 ? other.liquid_heat : other.ice_heat) += change;
                             return temperatures(at.exchange, other, solute);
                           };
                           const auto below = moved(-width), here = moved(0),
                                      above = moved(width);
                           for(int of = 0; of < 2; ++of)
                           {
                             const double left = (here[of] - below[of]) / width;
                             const double right = (above[of] - here[of]) / width;
                             const double slope = exact[of].slope[by];
                             EXPECT_NEAR(exact[of].value, here[of], 1e-12);
                             if(std::abs(left - right) > 1e-9)
                               continue; // a kink
                             ++compared;
                             EXPECT_NEAR(slope, 0.5 * (left + right), 1e-8);
                           }
                         }
                       });
      EXPECT_GT(compared, 5000);
    }
  } // namespace
} // namespace meltfront::particles::testing
