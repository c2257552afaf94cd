#include <cases/error.h>
#include <particles/alloy/solid_path.h>
#include <particles/alloy/solute_diffusion.h>
#include <particles/alloy/tests/alloy_scenes.h>
#include <particles/sph/tests/scenes.h>
#include <particles/sph_mixture/mixture_conduction.h>
#include <particles/sph_two_population/two_population_exchange.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace meltfront::particles::testing
{
  namespace
  {
    AlloySubstance brine(double crystal_density = 917, double eutectic = -1e300)
    {
      cases::Scene scene = nitrate_slab(1);
      scene.alloy->crystal_density = crystal_density;
      scene.alloy->eutectic_temperature = eutectic;
      return {scene, "test"};
    }

    // The integral of the volume fraction by the midpoint rule.
    double integrated(const AlloySubstance &substance, double from, double to,
                      double depression)
    {
      const int steps = 20000;
      double sum = 0;
      for(int i = 0; i < steps; ++i)
      {
        const double x = from + (to - from) * (i + 0.5) / steps;
        double solid = x < -depression ? 1 + depression / x : 0;
        if(x < substance.eutectic_excess)
          solid = 1;
        sum += substance.diagram.volume_fraction(solid);
      }
      return sum * (to - from) / steps;
    }

    TEST(SolidPath, IntegratesTheVolumeFraction)
    {
      for(const double crystal_density : {917., 1097., 1500.})
        for(const double eutectic : {-1e300, -17.7})
        {
          const AlloySubstance substance = brine(crystal_density, eutectic);
          const SolidPath path(substance);
          for(const double depression : {0., 0.01, 2., 6.})
            for(const double x : {10., -0.5, -3., -8., -16., -30., -60.})
              EXPECT_NEAR(path.whole(x, depression),
                          integrated(substance, 0, x, depression), 0.02)
                  << crystal_density << " " << eutectic << " " << depression << " " << x;
        }
    }

    /** A crowd of random states in equilibrium. */
    struct Crowd
    {
      static constexpr std::size_t size = 60;

      explicit Crowd(const AlloySubstance &substance)
        : substance(substance)
        , path(substance)
      {
        std::mt19937_64 random(7);
        std::uniform_real_distribution<double> enthalpy(-40000, 420000), content(0, 0.3),
            part(0, 1);
        for(std::size_t a = 0; a < size; ++a)
        {
          const double c = a % 5 == 0 ? 0. : content(random);
          const cases::PhaseState state
              = substance.diagram.equilibrium(enthalpy(random), c);
          const SolidPath::Point point = path.point(state.temperature);
          excess.push_back(state.temperature);
          conductivity.push_back(
              substance.diagram.conductivity(1 - state.liquid_fraction));
          depression.push_back(substance.diagram.depression(c));
          constant.push_back(SolidPath::constant(depression[a]));
          above.push_back(point.excess);
          logarithm.push_back(point.logarithm);
          own.push_back(
              path.integral(above[a], logarithm[a], depression[a], constant[a]));
          linear.push_back(substance.material.liquid.conductivity * excess[a]);
          for(Population *p : {&liquid, &ice})
          {
            p->share.push_back(part(random));
            p->excess.push_back(30 * part(random) - 15);
          }
          solid.push_back(part(random));
        }
      }

      IntegralMeanPair integral() const
      {
        return {linear.data(),
                above.data(),
                logarithm.data(),
                depression.data(),
                constant.data(),
                own.data(),
                0.5
                    * (substance.material.solid.conductivity
                       - substance.material.liquid.conductivity),
                path};
      }

      const AlloySubstance &substance;
      SolidPath path;
      std::vector<double> excess, conductivity, depression, constant, above, logarithm,
          own, linear, solid;
      Population liquid, ice;
    };

    template <typename Pair>
    void expect_antisymmetric(const Pair &pair)
    {
      for(std::size_t a = 0; a < Crowd::size; ++a)
      {
        EXPECT_EQ(pair(a, a), 0);
        for(std::size_t b = 0; b < Crowd::size; ++b)
          EXPECT_EQ(pair(a, b), -pair(b, a)) << a << " " << b;
      }
    }

    // Heat flows down the temperature, and what one gains the other loses to the last
    // bit.
    TEST(Exchange, OfMixturesIsAntisymmetric)
    {
      const AlloySubstance substance = brine(917, -14);
      const Crowd crowd(substance);
      const auto integral = crowd.integral();
      expect_antisymmetric(
          ArithmeticMeanPair{crowd.excess.data(), crowd.conductivity.data()});
      expect_antisymmetric(
          HarmonicMeanPair{crowd.excess.data(), crowd.conductivity.data()});
      expect_antisymmetric(integral);
      const double k_l = substance.material.liquid.conductivity;
      const double k_s = substance.material.solid.conductivity;
      for(std::size_t a = 0; a < Crowd::size; ++a)
        for(std::size_t b = 0; b < Crowd::size; ++b)
        {
          const double difference = crowd.excess[b] - crowd.excess[a];
          const double flow = integral(a, b);
          if(difference <= 0)
            continue;
          EXPECT_GE(flow, k_l * difference * (1 - 1e-12) - 1e-12);
          EXPECT_LE(flow, k_s * difference * (1 + 1e-12) + 1e-12);
        }
    }

    // What liquid gives to ice is what that ice takes: with shares of one population
    // only, each of the four exchanges can be seen alone.
    TEST(Exchange, OfPopulationsIsAntisymmetric)
    {
      const AlloySubstance substance = brine();
      Crowd crowd(substance);
      const auto check = [&]
      {
        const PopulationView liquid(crowd.liquid), ice(crowd.ice);
        const double *solid = crowd.solid.data();
        const CorrectedPair to_liquid{liquid, ice, false, 0.498, 1.453},
            to_ice{ice, liquid, true, 2.408, 1.453};
        const PublishedPair old_to_liquid{liquid, ice, solid, false, 0.498, 2.408},
            old_to_ice{ice, liquid, solid, true, 2.408, 0.498};
        for(std::size_t a = 0; a < Crowd::size; ++a)
        {
          EXPECT_EQ(to_liquid.at_site(a), -to_ice.at_site(a));
          EXPECT_EQ(old_to_liquid.at_site(a), -old_to_ice.at_site(a));
          for(std::size_t b = 0; b < Crowd::size; ++b)
          {
            const double sum
                = to_liquid(a, b) + to_ice(a, b) + to_liquid(b, a) + to_ice(b, a);
            const double old_sum = old_to_liquid(a, b) + old_to_ice(a, b)
                                   + old_to_liquid(b, a) + old_to_ice(b, a);
            EXPECT_NEAR(sum, 0, 1e-13);
            EXPECT_NEAR(old_sum, 0, 1e-13);
          }
        }
      };
      check();
      // Liquid at even sites, ice at odd ones: single exchanges, to the last bit.
      for(std::size_t a = 0; a < Crowd::size; ++a)
        (a % 2 ? crowd.liquid : crowd.ice).share[a] = 0;
      const PopulationView liquid(crowd.liquid), ice(crowd.ice);
      const CorrectedPair to_liquid{liquid, ice, false, 0.498, 1.453},
          to_ice{ice, liquid, true, 2.408, 1.453};
      for(std::size_t a = 0; a < Crowd::size; a += 2)
        for(std::size_t b = 1; b < Crowd::size; b += 2)
          EXPECT_EQ(to_liquid(a, b), -to_ice(b, a));
    }

    // Both populations together conduct as a mush does.
    TEST(Exchange, OfPopulationsConductsAsAMush)
    {
      Population liquid, ice;
      for(const double x : {0., 1.})
      {
        liquid.share.push_back(0.3);
        ice.share.push_back(0.7);
        liquid.excess.push_back(x);
        ice.excess.push_back(x);
      }
      const PopulationView l(liquid), i(ice);
      const double both = CorrectedPair{l, i, false, 0.498, 1.453}(0, 1)
                          + CorrectedPair{i, l, true, 2.408, 1.453}(0, 1);
      EXPECT_NEAR(both, 0.3 * 0.498 + 0.7 * 2.408, 1e-14);
      // As published: twice the harmonic mean of both on top.
      const double solid[] = {0.7, 0.7};
      for(Population *p : {&liquid, &ice})
        p->share = {1, 1}; // masses over the densities that are summed
      const PopulationView l1(liquid), i1(ice);
      const double published = PublishedPair{l1, i1, solid, false, 0.498, 2.408}(0, 1)
                               + PublishedPair{i1, l1, solid, true, 2.408, 0.498}(0, 1);
      const double a = 0.3 * 0.498, b = 0.7 * 2.408;
      EXPECT_NEAR(published, a + b + 4 * a * b / (a + b), 1e-14);
    }

    // Rows are summed in one order.
    TEST(Exchange, GivesTheSameBitsWithTwoThreads)
    {
      const cases::Scene scene = nitrate_slab(1, 6.2e-10);
      const AlloySubstance substance(scene, "test");
      cases::Resolution resolution;
      resolution.n = 3001;
      resolution.options = cases::Options(cases::options_of(MixtureParameters()));
      const MixtureParameters parameters = resolve_mixture_parameters(scene, resolution);
      const Discretisation dis(scene, parameters.sph);
      const ConductionRows rows(dis, true);
      const std::size_t size = rows.rows.padded_rows();
      std::vector<double> enthalpy(size), content(size);
      std::mt19937_64 random(3);
      std::uniform_real_distribution<double> of_enthalpy(-20000, 400000),
          of_content(0.01, 0.3);
      for(std::size_t a = 0; a < size; ++a)
      {
        enthalpy[a] = of_enthalpy(random);
        content[a] = of_content(random);
      }
      const std::vector<std::span<const double>> composition{content};
      std::vector<double> heat[2], solute[2];
      for(const int threads : {1, 2})
      {
        MixtureConduction conduction(substance, MeanConductivity::integral, false,
                                     dis.particles.size(), size);
        SoluteDiffusion diffusion(dis, parameters.sph, substance, rows.rows);
        conduction.follow(enthalpy, composition, threads);
        diffusion.follow(conduction.liquid_fraction(), conduction.depressions(),
                         composition);
        heat[threads - 1].resize(size);
        solute[threads - 1].resize(size);
        conduction.conduct(rows.rows, heat[threads - 1], threads);
        diffusion.flow(0, rows.rows, solute[threads - 1], threads);
      }
      EXPECT_EQ(heat[0], heat[1]);
      EXPECT_EQ(solute[0], solute[1]);
      EXPECT_GT(std::abs(heat[0][100]), 0);
      EXPECT_GT(std::abs(solute[0][100]), 0);
    }

    const cases::EffectCost *find(const AlloyOutcome &outcome, cases::Effect effect)
    {
      for(const cases::EffectCost &cost : outcome.cost.effects)
        if(cost.effect == effect)
          return &cost;
      return nullptr;
    }

    TEST(AlloyEffects, AbsentOnesCostNothing)
    {
      using cases::Effect;
      for(const auto &method :
          {make_sph_mixture(), make_sph_two_population(), make_sph_two_population_2005()})
        for(const double diffusivity : {0., 6.2e-10})
        {
          const cases::Scene scene = nitrate_slab(2000, diffusivity);
          const auto outcome = run(*method, scene, 30);
          const auto effects = cases::effects_called_for(scene);
          for(const Effect effect : cases::all_effects())
          {
            const cases::EffectCost *cost = find(outcome, effect);
            ASSERT_EQ(cost != nullptr, effects.contains(effect))
                << method->name() << " " << cases::to_string(effect);
            if(cost == nullptr)
              continue;
            EXPECT_GT(cost->calls, 0) << cases::to_string(effect);
            EXPECT_GT(cost->bytes, 0) << cases::to_string(effect);
            EXPECT_GE(cost->seconds, 0);
          }
        }
    }

    TEST(AlloyRefusals, SayWhatCannotBeTreated)
    {
      const auto mixture = make_sph_mixture();
      const auto corrected = make_sph_two_population();
      const auto published = make_sph_two_population_2005();
      EXPECT_THROW(run(*mixture, nitrate_slab(100), 20, {{"step_factor", "1.1"}}),
                   cases::Refusal);
      EXPECT_THROW(run(*corrected, nitrate_slab(100), 20, {{"step_factor", "1.1"}}),
                   cases::Refusal);
      // A pure substance has no solution to freeze from.
      EXPECT_THROW(run(*corrected, plane_freezing_water().scene, 20), cases::Refusal);
      cases::Scene partly = nitrate_slab(100);
      partly.initial.concentration
          = {{"", [](const cases::Position &p, double) { return p[0] < 0.3 ? 0.1 : 0.; },
              false}};
      EXPECT_THROW(run(*corrected, partly, 20), cases::Refusal);
      EXPECT_NO_THROW(run(*mixture, partly, 20));
      // Ice that was spread over the kernel cannot melt.
      cases::Scene warming = nitrate_slab(20000);
      warming.boundaries[0]->value
          = {"", [](const cases::Position &, double t) { return t < 1e4 ? -16.5 : 5.; },
             false};
      EXPECT_THROW(run(*published, warming, 20), cases::Refusal);
      EXPECT_NO_THROW(run(*corrected, warming, 20));
      cases::Scene frozen = nitrate_slab(100);
      frozen.initial.temperature = cases::Field::uniform(-8);
      EXPECT_THROW(run(*published, frozen, 20), cases::Refusal);
      cases::Scene eutectic = nitrate_slab(100);
      eutectic.alloy->eutectic_temperature = -10;
      EXPECT_THROW(run(*published, eutectic, 20), cases::Refusal);
      EXPECT_THROW(run(*corrected, eutectic, 20, {{"new_ice", "kernel"}}),
                   cases::Refusal);
      EXPECT_THROW(run(*corrected, eutectic, 20, {{"latent_heat", "constant"}}),
                   cases::Refusal);
      cases::Scene negative = nitrate_slab(100);
      negative.initial.concentration = {cases::Field::uniform(-0.1)};
      for(const auto *method : {&mixture, &corrected, &published})
        EXPECT_THROW(run(**method, negative, 20), cases::InputError);
    }
  } // namespace
} // namespace meltfront::particles::testing
