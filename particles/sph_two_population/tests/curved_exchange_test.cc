#include <particles/alloy/solid_path.h>
#include <particles/sph_two_population/phase_exchange.h>
#include <particles/sph_two_population/tests/curved_scenes.h>

#include <boost/math/tools/toms748_solve.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace meltfront::particles::testing
{
  namespace
  {
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

    // The rates of super steps against the change of phase after a short time.
    TEST(CurvedExchange, KnowsTheRateOfFreezing)
    {
      const BentSite at;
      const double m = 1.9, ice = BentSite::mass - m, duration = 0.01;
      for(const double c : {0.05, 0.2})
        for(const double heat_flow : {-100., 100.})
          for(const double solute_flow : {-1e-5, 0., 1e-5})
          {
            const double x = -bent(c);
            SiteContent<double> site{m, m * (334400 + 4180 * x), ice, ice * 2006 * x};
            const auto rate = at.exchange.freezing_rate(
                site, CurvedSolute{&at.curve, c * m}, heat_flow, solute_flow);
            site.liquid_heat += heat_flow * duration;
            const CurvedSolute after{&at.curve, c * m + solute_flow * duration};
            ASSERT_FALSE(at.exchange.settle(site, after));
            const double found = (site.ice_mass - ice) / duration;
            EXPECT_NEAR(rate.mass / found, 1, 1e-5) << c << heat_flow << solute_flow;
            EXPECT_NEAR(rate.heat / rate.mass, 2006 * x, 1e-9);
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
  } // namespace
} // namespace meltfront::particles::testing
