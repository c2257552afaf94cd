// Freezing that displaces liquid through the far end of a slab.

#include <cases/error.h>
#include <cases/exact/planar_neumann.h>
#include <particles/sph/tests/scenes.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace meltfront::particles::testing
{
  namespace
  {
    const auto method = make_sph();

    cases::Material with_densities(double solid, double liquid)
    {
      cases::Material material = unit_material(0);
      material.solid.density = solid;
      material.liquid.density = liquid;
      return material;
    }

    /** From the exact state between exact walls. */
    Problem displacing_slab(const cases::Material &material)
    {
      const auto exact = std::make_shared<cases::PlanarNeumann>(material, -0.5, 0.5);
      Problem problem{slab(material, 1, 0.5, 0.2, exact_wall(exact), exact_wall(exact)),
                      exact};
      problem.scene.start_time = 0.02;
      start_from(problem.scene, exact);
      return problem;
    }

    double length_of(const Outcome &outcome)
    {
      return std::accumulate(outcome.weights.begin(), outcome.weights.end(), 0.);
    }

    /** Root mean square over the length, at the end. */
    double temperature_error(const Outcome &outcome, const Problem &problem)
    {
      double sum = 0;
      for(std::size_t i = 0; i < outcome.weights.size(); ++i)
        sum += outcome.weights[i]
               * std::pow(outcome.temperature[i]
                              - problem.exact->temperature(outcome.position_x[i],
                                                           problem.scene.end_time),
                          2);
      return std::sqrt(sum);
    }

    // Lighter solid, contrast of the other properties, heavier solid.
    TEST(OpenEnd, ConvergesToNeumannsSolutionWithMotion)
    {
      cases::Material contrast = with_densities(0.917, 1);
      contrast.solid.conductivity = 3;
      contrast.liquid.specific_heat_capacity = 2;
      for(const cases::Material &material :
          {with_densities(0.5, 1), with_densities(0.917, 1), contrast,
           with_densities(2, 1), with_densities(4, 3)})
      {
        const Problem problem = displacing_slab(material);
        const Convergence found = converge(*method, problem, {20, 40, 80, 160});
        EXPECT_GE(found.order, 1.75);
        EXPECT_LE(found.errors.back(), 6e-5);
        const Outcome outcome = run(*method, problem, 80);
        EXPECT_NEAR(length_of(outcome), 1, 1e-12);
        EXPECT_LE(outcome.largest_defect, 1e-12);
        // Of the particle that melts, which is not at the front, most of all.
        EXPECT_LE(temperature_error(outcome, problem), 3e-3);
        // Through walls, conducted and carried along.
        const double change = problem.exact->heat_content(0, 1, 0.2)
                              - problem.exact->heat_content(0, 1, 0.02);
        EXPECT_NEAR(outcome.heat.boundary, change, 2e-4 * std::abs(change));
      }
    }

    // Implicit steps differentiate the wide last particle as well.
    TEST(OpenEnd, ImplicitStepsAgree)
    {
      const Problem problem = displacing_slab(with_densities(0.5, 1));
      const Outcome explicit_steps = run(*method, problem, 80);
      const Outcome implicit
          = run(*method, problem, 80,
                {{"time_scheme", "crank-nicolson"}, {"step_factor", "4"}});
      EXPECT_EQ(implicit.cost.capped_steps, 0);
      EXPECT_LE(implicit.largest_defect, 1e-12);
      EXPECT_LE(implicit.front_rms, 1.2 * explicit_steps.front_rms);
      EXPECT_NEAR(implicit.front_end, explicit_steps.front_end, 2e-5);
      EXPECT_LE(temperature_error(implicit, problem), 1e-3);
    }

    // All freezes: what has left the slab is what the denser liquid had too much.
    TEST(OpenEnd, ASlabFreezesThrough)
    {
      for(const double solid_density : {0.8, 1.25})
      {
        Problem problem;
        problem.scene = slab(with_densities(solid_density, 1), 1, 0, 2, fixed_wall(-1),
                             cases::Boundary());
        const Outcome outcome = run(*method, problem, 40);
        EXPECT_NEAR(outcome.front_end, 1, 1e-6);
        EXPECT_NEAR(length_of(outcome), 1, 1e-6);
        EXPECT_LE(outcome.largest_defect, 1e-12);
        EXPECT_NEAR(outcome.heat.latent, 0, 1e-6);
        // Liquid at the melting point left with its latent heat, or came in with it.
        EXPECT_NEAR(outcome.heat.initial, 1, 1e-12);
        EXPECT_LE(outcome.highest, 1e-12);
      }
    }

    // The wall that froze liquid melts the solid again from the far side.
    TEST(OpenEnd, MeltingDrawsLiquidInAgain)
    {
      for(const double solid_density : {0.5, 2.})
      {
        Problem problem;
        problem.scene
            = slab(with_densities(solid_density, 1), 1, 0.2, 3, fixed_wall(-1),
                   varying_wall([](double time)
                                { return time < 1 ? 0.2 : 3 * (time - 1) + 0.2; }));
        const Outcome outcome = run(*method, problem, 40);
        EXPECT_GT(outcome.steepest_retreat, 0);
        EXPECT_NEAR(length_of(outcome), 1, 1e-12);
        EXPECT_LE(outcome.largest_defect, 1e-12);
        EXPECT_GE(outcome.lowest, -1 - 1e-9);
        EXPECT_LE(outcome.highest, 6.2 + 1e-9);
      }
    }

    void expect_refusal(const Problem &problem, const OptionTexts &options,
                        const std::string &word)
    {
      try
      {
        run(*method, problem, 20, options);
        FAIL() << "not refused: " << word;
      }
      catch(const cases::Refusal &refusal)
      {
        EXPECT_NE(std::string(refusal.what()).find(word), std::string::npos)
            << refusal.what();
      }
    }

    TEST(OpenEnd, RefusesWhatItDoesNotMove)
    {
      const Problem problem = displacing_slab(with_densities(0.5, 1));
      expect_refusal(problem, {{"layout", "edge"}}, "layout = cell");
      expect_refusal(problem, {{"jitter", "0.1"}}, "jitter = 0");
      expect_refusal(problem, {{"smoothing_length", "1.3"}}, "smoothing_length");
      expect_refusal(problem, {{"moment_correction", "false"}}, "moment_correction");

      const cases::Material material = with_densities(0.5, 1);
      Problem other;
      // Solid at the open end at the start, and later.
      other.scene = slab(material, 1, 0, 0, 1);
      other.scene.initial.temperature
          = field_of([](const cases::Position &p) { return p[0] < 0.5 ? 1. : -1.; });
      expect_refusal(other, {}, "at the start there is solid elsewhere");
      other.scene = slab(material, 1, 0.1, 1, cases::Boundary(), flux_wall(-3));
      expect_refusal(other, {}, "solid beyond liquid");
      other.scene = slab(material, 1, -0.1, 1, flux_wall(3), cases::Boundary());
      expect_refusal(other, {}, "solid beyond liquid");
      // Heat from within.
      other = problem;
      other.scene.volumetric_source = cases::Field::uniform(0.1);
      expect_refusal(other, {}, "volumetric_source");
      // The published form does without.
      EXPECT_THROW(run(*make_sph_2005(), problem, 21), cases::Refusal);
    }
  } // namespace
} // namespace meltfront::particles::testing
