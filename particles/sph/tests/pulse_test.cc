#include <cases/time_integral.h>
#include <particles/sph/sph.h>
#include <particles/sph/tests/scenes.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meltfront::particles::testing
{
  namespace
  {
    const auto method = make_sph();

    /** 1e4 between two times (s), an energy of 1 if they are 1e-4 s apart. */
    cases::Field pulse(double begin, double end)
    {
      return {"",
              [begin, end](const cases::Position &, double t)
              { return t >= begin && t < end ? 1e4 : 0.; },
              false,
              {begin, end}};
    }

    /** A slab that holds no latent heat, and takes 1 J/m^2 in all. */
    Problem without_latent_heat()
    {
      Problem problem;
      cases::Material material = unit_material();
      material.latent_heat = 0;
      problem.scene = slab(material, 1, 0, 0.2, {}, {});
      return problem;
    }

    void expect_one(const Outcome &outcome, double booked)
    {
      EXPECT_NEAR(booked, 1, 1e-9);
      EXPECT_NEAR(outcome.heat.stored + outcome.heat.latent - outcome.heat.initial, 1,
                  1e-9);
      EXPECT_LE(outcome.largest_defect, 1e-11);
    }

    const std::vector<OptionTexts> schemes{{{"time_scheme", "rkl2"}},
                                           {{"time_scheme", "backward-euler"}},
                                           {{"time_scheme", "crank-nicolson"}},
                                           {{"time_scheme", "euler"}}};

    // Within a step, and over the end of one: 0.1 s is that of a step of every scheme.
    const std::vector<std::pair<double, double>> spans{{0.10021, 0.10031},
                                                       {0.09996, 0.10006}};

    TEST(Pulse, OfFluxBringsItsEnergy)
    {
      for(const OptionTexts &options : schemes)
        for(const auto &[begin, end] : spans)
        {
          Problem problem = without_latent_heat();
          problem.scene.boundaries[0]
              = cases::Boundary{cases::BoundaryKind::flux, pulse(begin, end)};
          const Outcome outcome = run(*method, problem, 10, options);
          expect_one(outcome, outcome.heat.boundary);
        }
    }

    TEST(Pulse, OfReleasedHeatBringsItsEnergy)
    {
      for(const OptionTexts &options : schemes)
        for(const auto &[begin, end] : spans)
        {
          Problem problem = without_latent_heat();
          problem.scene.volumetric_source = pulse(begin, end);
          const Outcome outcome = run(*method, problem, 10, options);
          expect_one(outcome, outcome.heat.sources);
          for(const double temperature : outcome.temperature)
            EXPECT_NEAR(temperature, 1, 1e-9);
        }
    }

    // Ice at the melting point all over: what comes in melts as much as its energy says.
    TEST(Pulse, OfFluxMeltsWhatItsEnergySays)
    {
      Problem problem;
      problem.scene = slab(unit_material(), 1, 0, 0.2, {}, {});
      problem.scene.initial.solid_fraction_at_melting = 1;
      const auto melted = [&](const cases::Boundary &wall)
      {
        problem.scene.boundaries[0] = wall;
        const Outcome outcome = run(*method, problem, 20);
        double liquid = 0;
        for(std::size_t i = 0; i < outcome.weights.size(); ++i)
          liquid += outcome.weights[i] * (1 - outcome.solid_fraction[i]);
        EXPECT_NEAR(outcome.heat.boundary, wall.value.constant ? 0 : 0.4, 1e-9);
        EXPECT_NEAR(outcome.heat.latent, liquid, 1e-12);
        return liquid;
      };
      EXPECT_EQ(melted(flux_wall(0)), 0);
      const double by_pulse
          = melted(cases::Boundary{cases::BoundaryKind::flux, pulse(0.10021, 0.10025)});
      // Stored heat in the layer at the wall is conducted to the front meanwhile.
      EXPECT_GT(by_pulse, 0.2);
      EXPECT_LT(by_pulse, 0.4);
    }

    TEST(Pulse, OfAWallsTemperatureActsForItsTimeOnly)
    {
      for(const OptionTexts &options : schemes)
      {
        Problem problem = without_latent_heat();
        const auto heat = [&](double begin, double end)
        {
          cases::Field wall = pulse(begin, end);
          wall.value = [begin, end](const cases::Position &, double t)
          { return t >= begin && t < end ? 1. : 0.; };
          problem.scene.boundaries[0]
              = cases::Boundary{cases::BoundaryKind::fixed_temperature, wall};
          const Outcome outcome = run(*method, problem, 10, options);
          EXPECT_LE(outcome.largest_defect, 1e-11);
          return outcome.heat.stored - outcome.heat.initial;
        };
        // Later or earlier by a tenth of a step: nearly the same.
        const double one = heat(0.10041, 0.12041), other = heat(0.10001, 0.12001);
        EXPECT_GT(one, 0.02);
        EXPECT_NEAR(one / other, 1, 0.02);
      }
    }

    TEST(Pulse, ABodyAtRestStaysAtRest)
    {
      for(const double temperature : {1.2, 300.})
        for(const OptionTexts &options : schemes)
        {
          Problem problem;
          problem.scene = slab(unit_material(0.7), 1, temperature, 0.2, {}, {});
          const Outcome outcome = run(*method, problem, 10, options);
          EXPECT_NEAR(outcome.lowest, temperature, 1e-12 * temperature);
          EXPECT_NEAR(outcome.highest, temperature, 1e-12 * temperature);
        }
    }

    // Wherever they are beside the particles: by the particles' own values half a spacing
    // of heat would be too much or too little.
    TEST(Jumps, AlongAWallInABodyAndAtTheStartBringTheirHeat)
    {
      cases::Material material = unit_material();
      for(const double at : {0.25, 0.5, 0.513, 0.537})
        for(const int n : {10, 16})
        {
          Problem problem;
          problem.scene = box(material, 2, {0, 0, 0}, {1, 1, 0}, 0, 0.02);
          set_boundary(problem.scene, cases::Side::y_max,
                       {cases::BoundaryKind::flux, step_along_x(at, -6, 2)});
          problem.scene.volumetric_source = step_along_x(at, 1, -3);
          problem.scene.initial.temperature = step_along_x(at, -2, 1);
          const Outcome outcome = run(*method, problem, n);
          EXPECT_NEAR(outcome.heat.boundary, 0.02 * (2 - 8 * at), 1e-4);
          EXPECT_NEAR(outcome.heat.sources, 0.02 * (-3 + 4 * at), 1e-4);
          // Of unit heat capacities and latent heat.
          EXPECT_NEAR(outcome.heat.initial, -2 * at + 2 * (1 - at), 5e-3);
        }
    }

    // Particles lie at irregular distances along a rim.
    TEST(Jumps, AroundARimBringTheirHeat)
    {
      for(const bool hollow : {false, true})
        for(const double at : {0., 0.113, 0.31})
          for(const int n : {16, 20})
          {
            Problem problem;
            cases::Scene &scene = problem.scene;
            scene = ball(unit_material(), 2, 0.5, 0, 0.02);
            scene.symmetry = cases::Symmetry::none;
            double expected = 0;
            const auto heat = [&](cases::Side side, double radius)
            {
              set_boundary(scene, side,
                           {cases::BoundaryKind::flux, step_along_x(at, -6, 2)});
              const double above = at < radius ? 2 * radius * std::acos(at / radius) : 0;
              expected
                  += 0.02 * (2 * above - 6 * (2 * std::numbers::pi * radius - above));
            };
            heat(cases::Side::outer, 0.5);
            if(hollow)
            {
              scene.domain.shape = cases::DomainShape::shell;
              scene.domain.inner_radius = 0.2;
              heat(cases::Side::inner, 0.2);
            }
            const Outcome outcome = run(*method, problem, n);
            EXPECT_NEAR(outcome.heat.boundary, expected, 5e-4);
          }
    }
  } // namespace
} // namespace meltfront::particles::testing
