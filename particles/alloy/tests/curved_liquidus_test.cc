#include <cases/error.h>
#include <cases/exact/mushy_layer.h>
#include <particles/alloy/phase_exchange.h>
#include <particles/alloy/solid_path.h>
#include <particles/alloy/tests/alloy_scenes.h>
#include <particles/sph/tests/scenes.h>

#include <boost/math/tools/toms748_solve.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

namespace meltfront::particles::testing
{
  namespace
  {
    constexpr double no_eutectic = -std::numeric_limits<double>::infinity();

    double bent(double c)
    {
      return 37 * c * (1 + 0.64 * c);
    }

    /** Brine whose liquidus is bent, known up to 0.6. */
    cases::Scene bent_slab(double end_time, double eutectic = no_eutectic,
                           double diffusivity = 0)
    {
      cases::Scene scene = nitrate_slab(end_time, diffusivity);
      cases::Solute &salt = scene.alloy->solutes[0];
      salt.liquidus_slope = 0;
      salt.liquidus_curve = bent;
      salt.largest_concentration = 0.6;
      scene.alloy->eutectic_temperature = eutectic;
      return scene;
    }

    /** Brine whose straight liquidus is given by a table. */
    cases::Scene with_table(cases::Scene scene)
    {
      std::vector<std::pair<double, double>> points;
      for(int i = 0; i <= 10; ++i)
        points.push_back({0.1 * i, -nitrate_slope * 0.1 * i});
      cases::Solute &salt = scene.alloy->solutes[0];
      salt.liquidus_slope = 0;
      salt.liquidus_curve = cases::liquidus_through(points, 0);
      salt.largest_concentration = 1;
      return scene;
    }

    /** With crystals of another density. */
    AlloySubstance substance_of(cases::Scene scene, double crystal_density = 917)
    {
      scene.alloy->crystal_density = crystal_density;
      return {scene, "test"};
    }

    TEST(CurvedLiquidus, HasTheSolidPathOfAStraightLine)
    {
      for(const double crystal_density : {917., 1097., 1500.})
        for(const double eutectic : {no_eutectic, -17.7})
        {
          cases::Scene scene = nitrate_slab(1);
          scene.alloy->eutectic_temperature = eutectic;
          const SolidPath line(substance_of(scene, crystal_density));
          const CurvedLiquidus curve(substance_of(with_table(scene), crystal_density));
          for(const double c : {0.05, 0.14, 0.3})
            for(const double x : {10., -0.5, -3., -8., -16., -30., -40.})
              EXPECT_NEAR(curve.solid_path(x, c), line.whole(x, nitrate_slope * c), 1e-7)
                  << crystal_density << " " << eutectic << " " << c << " " << x;
        }
    }

    // Against the midpoint rule over the lever rule, whose y(x) is known in closed form.
    TEST(CurvedLiquidus, IntegratesTheVolumeFraction)
    {
      const AlloySubstance substance = substance_of(bent_slab(1));
      const CurvedLiquidus curve(substance);
      for(const double c : {0.05, 0.14, 0.3})
        for(const double end : {-1., -6., -12., -25.})
        {
          constexpr int steps = 20000;
          double sum = 0;
          for(int i = 0; i < steps; ++i)
          {
            const double x = end * (i + 0.5) / steps;
            const double y = (std::sqrt(1 - 4 * 0.64 * x / 37) - 1) / (2 * 0.64);
            const double solid = std::max(1 - c / y, 0.);
            sum += std::min(solid * 1097 / 917, 1.);
          }
          EXPECT_NEAR(curve.solid_path(end, c), sum * end / steps, 1e-5) << c << end;
          EXPECT_NEAR(curve.depression(curve.solute_at(-end)), -end, 1e-13 * -end);
        }
      EXPECT_NEAR(curve.slope(0.2), 37 * (1 + 1.28 * 0.2), 1e-7);
    }

    /** One site of the bent brine. */
    struct BentSite
    {
      explicit BentSite(double eutectic = no_eutectic)
        : substance(bent_slab(1, eutectic), "test")
        , curve(substance)
        , exchange(substance, mass, false, true)
      {
      }

      CurvedSolute solute(double concentration) const
      {
        return {&curve, concentration * mass};
      }

      static constexpr double mass = 3;
      AlloySubstance substance;
      CurvedLiquidus curve;
      SiteExchange exchange;
    };

    /** Where a function of the liquid's concentration y vanishes. */
    template <typename Function>
    double bracketed(const Function &function, double from, double to)
    {
      std::uintmax_t iterations = 300;
      const auto [a, b] = boost::math::tools::toms748_solve(
          function, from, to, [](double p, double q) { return std::abs(p - q) < 1e-16; },
          iterations);
      return 0.5 * (a + b);
    }

    // From almost none to most of the latent heat.
    TEST(CurvedExchange, FreezesAsTheBalanceOfHeatSays)
    {
      const BentSite at;
      for(const double c : {0.02, 0.14, 0.3})
        for(const double heat : {1e-6, 1., 1e3, 3e4, 1.5e5})
        {
          const double m = 1.7, salt = c * m;
          const double heat_before = m * (334400 - 4180 * bent(c) - heat);
          SiteContent<double> site{m, heat_before, 0, 0};
          const CurvedSolute solute{&at.curve, salt};
          ASSERT_TRUE(at.exchange.freezes(site, solute));
          const auto made = at.exchange.freeze_liquid(site, solute);
          const double y = bracketed(
              [&](double content)
              {
                const double liquid = salt / content, x = -bent(content);
                return heat_before - liquid * (334400 + 4180 * x)
                       - (m - liquid) * 2006 * x;
              },
              c * (1 - 1e-12), 0.59999);
          EXPECT_NEAR(site.liquid_mass, salt / y, 1e-13 * m) << c << " " << heat;
          EXPECT_NEAR(at.exchange.liquid_excess(site), -bent(y), 1e-11);
          EXPECT_NEAR(made.heat, made.mass * 2006 * -bent(y), 1e-12 * heat_before);
          EXPECT_NEAR(site.liquid_mass + made.mass, m, 1e-15 * m);
          EXPECT_NEAR(site.liquid_heat + made.heat, heat_before, 1e-15 * heat_before);
        }
    }

    TEST(CurvedExchange, MeltsAsTheBalanceOfHeatSays)
    {
      const BentSite at;
      int all = 0;
      for(const double c : {0.02, 0.14, 0.3})
        for(const double heat : {1e-6, 1., 1e3, 3e4, 1.5e5, 4e5})
          for(const double own : {-30., -5.})
          {
            const double m = 1.7, salt = c * m, ice = 1.1;
            const double heat_before = m * (334400 - 4180 * bent(c) + heat);
            SiteContent<double> site{m, heat_before, ice, ice * 2006 * own};
            at.exchange.melt_ice(site, CurvedSolute{&at.curve, salt});
            const auto surplus = [&](double melted)
            {
              const double liquid = m + melted;
              return heat_before + melted * 2006 * own
                     - liquid * (334400 - 4180 * bent(salt / liquid));
            };
            if(surplus(ice) >= 0)
            {
              ++all;
              EXPECT_EQ(site.ice_mass, 0);
              EXPECT_EQ(site.liquid_mass, m + ice);
              continue;
            }
            EXPECT_NEAR(site.liquid_mass, m + bracketed(surplus, -1e-9, ice), 1e-13);
            EXPECT_NEAR(at.exchange.liquid_excess(site), -bent(salt / site.liquid_mass),
                        1e-10);
            EXPECT_NEAR(site.liquid_mass + site.ice_mass, m + ice, 1e-15);
            EXPECT_NEAR(site.liquid_heat + site.ice_heat, heat_before + ice * 2006 * own,
                        1e-15 * heat_before);
          }
      EXPECT_GT(all, 2);
    }

    template <typename Check>
    void for_random_sites(const BentSite &site, const Check &check)
    {
      std::mt19937_64 random(5);
      std::uniform_real_distribution<double> part(0, 1);
      for(int i = 0; i < 2000; ++i)
      {
        const double ice = i % 4 == 0 ? 0 : BentSite::mass * part(random);
        const double liquid = BentSite::mass - ice;
        const SiteContent<double> content{
            liquid, liquid * (334400 + 4180 * (40 * part(random) - 30)), ice,
            ice * 2006 * (40 * part(random) - 40)};
        check(content, site.solute(0.01 + 0.2 * part(random)));
      }
    }

    // Mass and heat stay; liquid ends at its liquidus, at the eutectic temperature or
    // without ice; crowded sites and eutectic ones have the equilibrium of the diagram.
    TEST(CurvedExchange, SettlesInEquilibrium)
    {
      for(const double eutectic : {no_eutectic, -17.7})
      {
        const BentSite at(eutectic);
        int kept = 0, mushes = 0, eutectics = 0;
        for_random_sites(
            at,
            [&](const SiteContent<double> &before, const CurvedSolute &solute)
            {
              SiteContent<double> site = before;
              const bool is_kept = at.exchange.settle(site, solute);
              const double heat = before.liquid_heat + before.ice_heat;
              EXPECT_NEAR(site.liquid_heat + site.ice_heat, heat, 1e-9);
              EXPECT_NEAR(site.liquid_mass + site.ice_mass, BentSite::mass, 1e-14);
              EXPECT_GE(site.liquid_mass, 0);
              EXPECT_GE(site.ice_mass, 0);
              if(site.liquid_mass > 0)
              {
                const double y = solute.mass / site.liquid_mass;
                const double liquidus = std::max(-at.curve.depression(y), eutectic);
                const double x = at.exchange.liquid_excess(site);
                EXPECT_GE(x, liquidus - 1e-9);
                mushes += site.ice_mass > 0;
                if(site.ice_mass > 0)
                {
                  EXPECT_NEAR(x, liquidus, 1e-9);
                }
                eutectics += x < eutectic + 1e-9;
              }
              if(is_kept && solute.mass < 0.59 * site.liquid_mass)
              {
                ++kept;
                const cases::PhaseState state = at.substance.diagram.equilibrium(
                    heat / BentSite::mass, solute.mass / BentSite::mass);
                EXPECT_NEAR(site.liquid_mass / BentSite::mass, state.liquid_fraction,
                            1e-12);
                EXPECT_NEAR(at.exchange.liquid_excess(site), state.temperature, 1e-10);
              }
              SiteContent<double> again = site;
              at.exchange.settle(again, solute);
              EXPECT_NEAR(again.liquid_mass, site.liquid_mass, 1e-9);
              EXPECT_NEAR(again.ice_heat, site.ice_heat, 1e-4);
            });
        EXPECT_GT(kept, 50);
        EXPECT_GT(mushes, 500);
        EXPECT_EQ(eutectics > 50, std::isfinite(eutectic)) << eutectics;
      }
    }

    // Automatic derivatives against differences.
    TEST(CurvedExchange, KnowsItsDerivative)
    {
      const BentSite at(-17.7);
      int compared = 0;
      const auto temperatures = [&](auto site, const CurvedSolute &solute)
      {
        at.exchange.settle(site, solute);
        const auto liquid = value_of(site.liquid_mass) > 0
                                ? at.exchange.liquid_excess(site)
                                : at.exchange.ice_excess(site);
        const auto ice
            = value_of(site.ice_mass) > 0 ? at.exchange.ice_excess(site) : liquid;
        return std::array{liquid, ice};
      };
      for_random_sites(at,
                       [&](const SiteContent<double> &site, const CurvedSolute &solute)
                       {
                         const auto exact = temperatures(
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
                             return temperatures(other, solute);
                           };
                           const auto below = moved(-width), here = moved(0),
                                      above = moved(width);
                           for(int of = 0; of < 2; ++of)
                           {
                             const double left = (here[of] - below[of]) / width;
                             const double right = (above[of] - here[of]) / width;
                             EXPECT_NEAR(exact[of].value, here[of], 1e-11);
                             if(std::abs(left - right) > 1e-9)
                               continue; // a kink
                             ++compared;
                             EXPECT_NEAR(exact[of].slope[by], 0.5 * (left + right), 1e-8);
                           }
                         }
                       });
      EXPECT_GT(compared, 5000);
    }

    const std::vector<OptionTexts> all_schemes{
        {{"time_scheme", "euler"}},
        {{"time_scheme", "rkl2"}},
        {{"time_scheme", "backward-euler"}, {"step_factor", "20"}},
        {{"time_scheme", "crank-nicolson"}, {"step_factor", "20"}}};

    double largest_difference(const std::vector<double> &a, const std::vector<double> &b)
    {
      double largest = 0;
      for(std::size_t i = 0; i < a.size(); ++i)
        largest = std::max(largest, std::abs(a[i] - b[i]));
      return largest;
    }

    // Explicit steps only with a eutectic: an implicit one may have two solutions where a
    // site gets there, and the last bit decides, on the straight line itself too.
    TEST(TwoPopulationOnACurve, IsThatOnALineForATableOfIt)
    {
      const auto method = make_sph_two_population();
      for(const double eutectic : {no_eutectic, -14.})
        for(const double diffusivity : {0., 6.2e-10})
          for(const OptionTexts &options : all_schemes)
          {
            const std::string &scheme = options[0].second;
            if(std::isfinite(eutectic) && scheme != "euler" && scheme != "rkl2")
              continue;
            cases::Scene scene = nitrate_slab(40000, diffusivity);
            scene.alloy->eutectic_temperature = eutectic;
            const auto line = run(*method, scene, 40, options);
            const auto table = run(*method, with_table(scene), 40, options);
            EXPECT_LT(largest_difference(line.temperature, table.temperature), 1e-9)
                << scheme << " " << eutectic << " " << diffusivity;
            EXPECT_LT(largest_difference(line.solid_fraction, table.solid_fraction),
                      1e-9);
          }
    }

    /** The bent brine with its exact mushy layer. */
    Problem bent_layer(double end_time)
    {
      cases::Scene scene = bent_slab(end_time);
      const auto exact = std::make_shared<cases::MushyLayer>(
          scene.material, *scene.alloy, std::vector<double>{nitrate_concentration}, -16.5,
          14.7);
      scene.boundaries[1] = exact_wall(exact);
      return {scene, exact};
    }

    double temperature_error(const AlloyOutcome &found, const Problem &problem)
    {
      double sum = 0;
      for(std::size_t i = 0; i < found.x.size(); ++i)
      {
        const double deviation
            = found.temperature[i]
              - problem.exact->temperature(cases::Position{found.x[i], 0, 0},
                                           problem.scene.end_time);
        sum += deviation * deviation;
      }
      return std::sqrt(sum / static_cast<double>(found.x.size()));
    }

    TEST(TwoPopulationOnACurve, ConvergesToTheMushyLayer)
    {
      const Problem problem = bent_layer(91800);
      for(const OptionTexts &options : all_schemes)
      {
        std::vector<double> spacing, errors;
        for(const int n : {30, 45, 60, 120})
        {
          const auto found
              = run(*make_sph_two_population(), problem.scene, n, options, 100);
          errors.push_back(temperature_error(found, problem));
          spacing.push_back(found.description.spacing);
          EXPECT_LT(found.heat_defect, 1e-12);
          EXPECT_LT(found.mass_defect, 1e-12);
          EXPECT_LT(found.solute_defect, 1e-12);
          EXPECT_GE(found.lowest, -16.5 - 1e-7);
          EXPECT_LE(found.highest, 14.7 + 1e-7);
        }
        EXPECT_LT(errors.back(), 0.011) << options[0].second;
        EXPECT_GT(fitted_order(spacing, errors), 1.2) << options[0].second;
      }
    }

    // Through the eutectic temperature and back.
    TEST(TwoPopulationOnACurve, GivesBackWhatFroze)
    {
      for(const double diffusivity : {0., 6.2e-10})
        for(const OptionTexts &options : all_schemes)
        {
          cases::Scene scene = bent_slab(2e6, -17.7, diffusivity);
          scene.boundaries[0]->value = {"",
                                        [](const cases::Position &, double t)
                                        { return t < 20000 ? -30. : 14.7; },
                                        false};
          scene.boundaries[1] = insulated();
          const auto found = run(*make_sph_two_population(), scene, 20, options, 10);
          EXPECT_GT(*std::max_element(found.solids.begin(), found.solids.end()), 0.035);
          EXPECT_EQ(found.solid, 0) << options[0].second;
          EXPECT_LT(found.heat_defect, 1e-12) << options[0].second;
          EXPECT_LT(found.mass_defect, 1e-12);
          EXPECT_LT(found.solute_defect, 1e-12);
        }
    }

    // Beyond the largest known concentration a run ends and says where.
    TEST(TwoPopulationOnACurve, StopsWhereTheLiquidusIsNotKnown)
    {
      const auto method = make_sph_two_population();
      cases::Scene scene = bent_slab(91800);
      scene.alloy->solutes[0].largest_concentration = 0.3; // down to -13.2
      for(const OptionTexts &options : all_schemes)
        try
        {
          run(*method, scene, 40, options);
          FAIL() << options[0].second;
        }
        catch(const cases::NumericalError &error)
        {
          EXPECT_EQ(error.method, "sph-two-population");
          EXPECT_GT(error.step, 0);
          EXPECT_GT(error.time, 0);
          EXPECT_LT(error.time, 91800);
          const std::string text = error.what();
          EXPECT_NE(error.quantity.find("liquid particle 0 at x = 0.00625 m"),
                    std::string::npos)
              << text;
          EXPECT_NE(text.find("the liquidus is known up to 0.3"), std::string::npos)
              << text;
        }
      scene.alloy->eutectic_temperature = -15; // not on the curve either
      EXPECT_THROW(run(*method, scene, 40), cases::NumericalError);
      scene.alloy->eutectic_temperature = -13;
      EXPECT_NO_THROW(run(*method, scene, 40));
    }

    TEST(TwoPopulationOnACurve, RefusesWhatItCannotDo)
    {
      const auto method = make_sph_two_population();
      const cases::Scene scene = bent_slab(1000);
      EXPECT_THROW(run(*make_sph_two_population_2005(), scene, 20), cases::Refusal);
      EXPECT_THROW(run(*method, scene, 20, {{"new_ice", "kernel"}}), cases::Refusal);
      EXPECT_THROW(run(*method, scene, 20, {{"latent_heat", "constant"}}),
                   cases::Refusal);
      EXPECT_THROW(run(*method, scene, 20, {{"exchange", "published"}}), cases::Refusal);
      cases::Scene salty = scene;
      salty.alloy->solutes[0].largest_concentration = 0.1;
      EXPECT_THROW(run(*method, salty, 20), cases::InputError);
      for(const auto &curve :
          std::vector<std::function<double(double)>>{
              [](double c) { return 3 + 37 * c; },
              [](double c) { return 37 * c * (1 - c); },
              [](double c) { return c < 0.4 ? 37 * c : std::nan(""); }})
      {
        cases::Scene wrong = scene;
        wrong.alloy->solutes[0].liquidus_curve = curve;
        EXPECT_THROW(run(*method, wrong, 20), cases::InputError);
      }
    }
  } // namespace
} // namespace meltfront::particles::testing
