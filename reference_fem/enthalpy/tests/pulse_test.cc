#include <cases/time_integral.h>
#include <reference_fem/enthalpy/enthalpy.h>
#include <reference_fem/enthalpy/tests/support.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meltfront::reference_fem::tests
{
  namespace
  {
    using namespace cases;

    /** 1e4 between two times (s), an energy of 1 if they are 1e-4 s apart. */
    Field pulse(double begin, double end)
    {
      return {"",
              [begin, end](const Position &, double t)
              { return t >= begin && t < end ? 1e4 : 0.; },
              false,
              {begin, end}};
    }

    Material without_latent_heat()
    {
      Material material = normalised_material();
      material.latent_heat = 0;
      return material;
    }

    // Within a step of 1e-3 s, and over the end of one.
    const std::vector<std::pair<double, double>> spans{{0.10021, 0.10031},
                                                       {0.09996, 0.10006}};
    const std::vector<OptionTexts> schemes{
        {{"steps", "200"}, {"time_scheme", "bdf2"}},
        {{"steps", "200"}, {"time_scheme", "backward-euler"}}};

    TEST(Pulse, OfFluxBringsItsEnergy)
    {
      for(const OptionTexts &options : schemes)
        for(const auto &[begin, end] : spans)
        {
          Scene scene = slab(without_latent_heat(), 1, 0, 0, 0.2);
          set_boundary(scene, Side::x_min, {BoundaryKind::flux, pulse(begin, end)});
          const RunRecord record = run(scene, 20, options);
          EXPECT_NEAR(record.heat.boundary, 1, 1e-9);
          EXPECT_NEAR(record.heat.stored - record.heat.initial, 1, 1e-9);
          EXPECT_LE(record.worst_budget_defect(), 1e-11);
          // The profile 0.1 s later, by its cosine series.
          for(std::size_t i = 0; i < record.temperature.size(); ++i)
          {
            double exact = 1;
            for(int k = 1; k < 20; ++k)
              exact += 2 * std::cos(k * M_PI * record.positions[0][i])
                       * std::exp(-k * k * M_PI * M_PI * (0.2 - 0.5 * (begin + end)));
            EXPECT_NEAR(record.temperature[i], exact, 0.02);
          }
        }
    }

    TEST(Pulse, OfReleasedHeatBringsItsEnergy)
    {
      for(const OptionTexts &options : schemes)
        for(const auto &[begin, end] : spans)
        {
          Scene scene = slab(without_latent_heat(), 1, 0, 0, 0.2);
          scene.volumetric_source = pulse(begin, end);
          const RunRecord record = run(scene, 20, options);
          EXPECT_NEAR(record.heat.sources, 1, 1e-9);
          for(const double temperature : record.temperature)
            EXPECT_NEAR(temperature, 1, 1e-8);
        }
    }

    // Wherever they are beside the nodes: by the nodes' own values half a cell of heat
    // would be too much or too little.
    TEST(Pulse, JumpsAlongAWallAndInABodyBringTheirHeat)
    {
      for(const double at : {0.25, 0.5, 0.513, 0.537})
        for(const int n : {10, 16})
        {
          Scene scene = box(without_latent_heat(), 2, {0, 0, 0}, {1, 1, 0}, 0, 0.2);
          set_boundary(scene, Side::y_max, {BoundaryKind::flux, step_along_x(at, -6, 2)});
          scene.volumetric_source = step_along_x(at, 1, -3);
          const Course record = test_support::course_of(*make_fem_enthalpy(), scene, n);
          EXPECT_NEAR(record.heat.boundary, 0.2 * (2 - 8 * at), 1e-3);
          EXPECT_NEAR(record.heat.sources, 0.2 * (-3 + 4 * at), 1e-3);
        }
    }

    // What jumps at the start is all there, in lines, in boxes, in pipes and in balls.
    TEST(Pulse, JumpsAtTheStartBringTheirHeat)
    {
      for(const double at : {0.25, 0.5, 0.513, 0.537})
        for(const int n : {10, 16})
        {
          const auto heat_of = [&](Scene scene)
          {
            scene.initial.temperature = step_along_x(at, -2, 1);
            return test_support::course_of(*make_fem_enthalpy(), scene, n).heat.initial;
          };
          const Material material = without_latent_heat();
          // The melting temperature, where there is none, is one.
          EXPECT_NEAR(heat_of(slab(material, 1, 0, 0, 1e-3)), -3 * at, 1e-5);
          EXPECT_NEAR(heat_of(box(material, 2, {0, 0, 0}, {1, 1, 0}, 0, 1e-3)), -3 * at,
                      2.5e-3);
          EXPECT_NEAR(heat_of(ball(material, 2, 1, 0, 1e-3)),
                      -3 * std::numbers::pi * at * at, 1e-3);
          // The mean over a volume about the centre is that of a uniform body there.
          EXPECT_NEAR(heat_of(ball(material, 3, 1, 0, 1e-3)),
                      -4 * std::numbers::pi * at * at * at, 1e-3);
        }
    }

    // Nodes on a rim are farther apart than cells are wide, or nearer, within a pipe.
    TEST(Pulse, JumpsAroundARimBringTheirHeat)
    {
      for(const bool hollow : {false, true})
        for(const double at : {0., 0.113, 0.31})
          for(const int n : {8, 16})
          {
            Scene scene = ball(without_latent_heat(), 2, 0.5, 0, 0.2);
            scene.symmetry = Symmetry::none;
            double expected = 0;
            const auto heat = [&](Side side, double radius)
            {
              set_boundary(scene, side, {BoundaryKind::flux, step_along_x(at, -6, 2)});
              const double above = at < radius ? 2 * radius * std::acos(at / radius) : 0;
              expected += 0.2 * (2 * above - 6 * (2 * std::numbers::pi * radius - above));
            };
            heat(Side::outer, 0.5);
            if(hollow)
            {
              scene.domain.shape = cases::DomainShape::shell;
              scene.domain.inner_radius = 0.2;
              heat(Side::inner, 0.2);
            }
            const Course record = test_support::course_of(*make_fem_enthalpy(), scene, n);
            EXPECT_NEAR(record.heat.boundary, expected, 2e-3);
          }
    }

    // What has no breakpoint that a step ends at, since it moves.
    TEST(Pulse, TheFormulaOfTwoStepsAddsUpToTheIntegral)
    {
      Scene scene = slab(without_latent_heat(), 1, 0, 0, 1);
      set_boundary(scene, Side::x_min,
                   {BoundaryKind::flux, {"", [](const Position &, double t) {
                                           return 3 + std::sin(40 * t)
                                                  + (t > 0.31234 ? 2 : 0);
                                         }}});
      const RunRecord record = run(scene, 20, {{"steps", "50"}, {"time_scheme", "bdf2"}});
      const double energy = 3 + (1 - std::cos(40)) / 40 + 2 * (1 - 0.31234);
      EXPECT_NEAR(record.heat.boundary, energy, 1e-7);
      EXPECT_NEAR(record.heat.stored - record.heat.initial, energy, 1e-7);
    }

    TEST(Pulse, OfAWallsTemperatureActsForItsTimeOnly)
    {
      for(const OptionTexts &options : schemes)
      {
        const auto heat = [&](double begin, double end)
        {
          Scene scene = slab(without_latent_heat(), 1, 0, 0, 0.2);
          Field wall = pulse(begin, end);
          wall.value = [begin, end](const Position &, double t)
          { return t >= begin && t < end ? 1. : 0.; };
          set_boundary(scene, Side::x_min, {BoundaryKind::fixed_temperature, wall});
          const RunRecord record = run(scene, 40, options);
          EXPECT_LE(record.worst_budget_defect(), 1e-11);
          return record.heat.stored - record.heat.initial;
        };
        const double one = heat(0.10041, 0.12041), other = heat(0.10001, 0.12001);
        EXPECT_GT(one, 0.02);
        EXPECT_NEAR(one / other, 1, 0.02);
      }
    }

    TEST(Pulse, ABodyAtRestStaysAtRest)
    {
      for(const double temperature : {1.2, 300.})
      {
        const Scene scene = slab(normalised_material(), 1, temperature, 0, 1);
        const RunRecord record = run(scene, 20);
        for(const double found : record.temperature)
          EXPECT_NEAR(found, temperature, 1e-12 * temperature);
      }
    }
  } // namespace
} // namespace meltfront::reference_fem::tests
