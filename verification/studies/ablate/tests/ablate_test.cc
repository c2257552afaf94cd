#include <cases/error.h>
#include <verification/record/json_values.h>
#include <verification/studies/ablate/ablate.h>
#include <verification/studies/ablate/tests/study_case.h>

#include <gtest/gtest.h>

#include <cmath>

namespace meltfront::verification::tests
{
  namespace
  {
    using nlohmann::json;

    const json &row_of(const json &ablation, const std::string &effect)
    {
      for(const json &row : ablation.at("effects"))
        if(row.at("effect") == effect)
          return row;
      throw std::out_of_range(effect);
    }

    double exact_front(const cases::Material &material)
    {
      return cases::PlanarNeumann(material, -1, 0.5).front(0.01);
    }
  } // namespace

  TEST(Ablate, ChangesAreThoseOfNeumannsSolution)
  {
    ScratchStudy study(neumann_slab, 200);
    const json ablation = ablate(study.settings);
    EXPECT_EQ(ablation.at("method"), "fem-enthalpy");
    EXPECT_EQ(ablation.at("n"), (std::vector<int>{100, 141, 200}));
    const double full = exact_front(neumann_material());
    const json &front = ablation.at("full").at("front");
    EXPECT_NEAR(front.at("value").get<double>(), full, front.at("bar").get<double>());
    cases::Material less = neumann_material();
    less.liquid.conductivity = 2;
    const double by_conductivity = exact_front(less) - full;
    less = neumann_material();
    less.liquid.specific_heat_capacity = 1;
    const double by_capacity = exact_front(less) - full;
    for(const auto &[effect, expected] :
        {std::pair("phase_conductivity", by_conductivity),
         std::pair("phase_heat_capacity", by_capacity)})
    {
      const json &row = row_of(ablation, effect);
      const json &change = row.at("changes").at("front");
      EXPECT_NEAR(change.at("change").get<double>(), expected,
                  change.at("bar").get<double>())
          << effect;
      EXPECT_LT(change.at("bar").get<double>(), 0.3 * std::abs(expected)) << effect;
      EXPECT_GT(change.at("bound").get<double>(), std::abs(expected)) << effect;
      EXPECT_NEAR(change.at("in_bars").get<double>(),
                  std::abs(change.at("change").get<double>())
                      / front.at("bar").get<double>(),
                  1e-9);
      EXPECT_GT(row.at("changes").at("temperature").at("change").get<double>(), 0);
    }
    // Nothing freezes where no wall is cold: there is no front to compare.
    const json &insulated = row_of(ablation, "wall_temperature").at("changes");
    EXPECT_TRUE(insulated.at("front").at("change").is_null());
    EXPECT_TRUE(insulated.at("front_over_time").at("change").is_null());
    EXPECT_NEAR(insulated.at("solid_volume").at("change").get<double>(),
                -front.at("value").get<double>(), 1e-12);
    EXPECT_EQ(read_json(study.directory.path("results/ablate.json")), ablation);
    EXPECT_NE(ablation_text(ablation).find("phase_conductivity"), std::string::npos);
  }

  TEST(Ablate, WhatLeavesNoSceneIsRefusedAndTheOthersGoOn)
  {
    std::string lighter = neumann_slab;
    lighter.insert(lighter.find("      set specific heat capacity = 1.5"),
                   "      set density = 1.1\n");
    ScratchStudy study(lighter, 40);
    const json ablation = ablate(study.settings);
    // Displaced liquid follows a front, and without latent heat there is none.
    const json &refused = row_of(ablation, "phase_change");
    EXPECT_NE(refused.at("refused").get<std::string>().find("liquid_motion"),
              std::string::npos);
    EXPECT_FALSE(refused.contains("changes"));
    for(const char *effect : {"phase_conductivity", "liquid_motion"})
      EXPECT_GT(std::abs(row_of(ablation, effect)
                             .at("changes")
                             .at("front")
                             .at("change")
                             .get<double>()),
                1e-5)
          << effect;
    EXPECT_NE(ablation_text(ablation).find("refused: "), std::string::npos);
  }

  TEST(Ablate, NoMethodForTheCaseIsARefusalWithItsReason)
  {
    ScratchStudy study(neumann_slab + R"(
subsection Effects
  set phase_change = off
end
)",
                       16);
    study.settings.method = "fem-enthalpyy";
    EXPECT_THROW(ablate(study.settings), cases::InputError);
  }
} // namespace meltfront::verification::tests
