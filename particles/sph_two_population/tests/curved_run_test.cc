#include <cases/error.h>
#include <cases/exact/mushy_layer.h>
#include <particles/sph/tests/scenes.h>
#include <particles/sph_two_population/tests/curved_scenes.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace meltfront::particles::testing
{
  namespace
  {
    const std::vector<OptionTexts> all_schemes{
        {{"time_scheme", "euler"}},
        {{"time_scheme", "rkl2"}},
        {{"time_scheme", "backward-euler"}, {"step_factor", "60"}},
        {{"time_scheme", "crank-nicolson"}, {"step_factor", "60"}}};

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
          scene.boundaries[1] = cases::Boundary{};
          const auto found = run(*make_sph_two_population(), scene, 20, options,
                                 options.size() > 1 ? 1 : 10);
          EXPECT_GT(*std::max_element(found.solids.begin(), found.solids.end()), 0.03);
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
