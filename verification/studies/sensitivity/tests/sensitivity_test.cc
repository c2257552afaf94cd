#include <verification/record/json_values.h>
#include <verification/studies/ablate/tests/study_case.h>
#include <verification/studies/sensitivity/sensitivity.h>

#include <boost/math/differentiation/finite_difference.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace meltfront::verification::tests
{
  namespace
  {
    using nlohmann::json;

    /** The similarity solution's front with one datum changed. */
    double front_with(
        const std::function<void(cases::Material &, double &wall, double &far)> &change)
    {
      cases::Material material = neumann_material();
      double wall = -1, far = 0.5;
      change(material, wall, far);
      return cases::PlanarNeumann(material, wall, far).front(0.01);
    }

    struct Expected
    {
      const char *name;
      void (*change)(cases::Material &, double &wall, double &far, double s);
    };

    // Temperatures change by s times their range, 1.5; all else by the factor 1 + s.
    constexpr Expected expected[] = {
        {"Material/latent heat", [](cases::Material &m, double &, double &, double s)
         { m.latent_heat *= 1 + s; }},
        {"Material/Solid/conductivity", [](cases::Material &m, double &, double &,
                                           double s) { m.solid.conductivity *= 1 + s; }},
        {"Material/Solid/specific heat capacity",
         [](cases::Material &m, double &, double &, double s)
         { m.solid.specific_heat_capacity *= 1 + s; }},
        {"Material/Solid/density",
         [](cases::Material &m, double &, double &, double s)
         {
           m.solid.density *= 1 + s;
           m.liquid.density *= 1 + s;
         }},
        {"Material/Liquid/conductivity",
         [](cases::Material &m, double &, double &, double s)
         { m.liquid.conductivity *= 1 + s; }},
        {"Material/Liquid/specific heat capacity",
         [](cases::Material &m, double &, double &, double s)
         { m.liquid.specific_heat_capacity *= 1 + s; }},
        {"Material/melting temperature",
         [](cases::Material &m, double &, double &, double s)
         { m.melting_temperature += 1.5 * s; }},
        {"Initial state/temperature",
         [](cases::Material &, double &, double &far, double s) { far += 1.5 * s; }},
        {"Walls/x_min/temperature",
         [](cases::Material &, double &wall, double &, double s) { wall += 1.5 * s; }},
        {"Domain/length", [](cases::Material &, double &, double &, double) {}}};
  } // namespace

  TEST(Sensitivity, DerivativesAreThoseOfNeumannsSolutionWithinTheirErrors)
  {
    ScratchStudy study(neumann_slab, 240);
    const json all = sensitivity(study.settings);
    EXPECT_EQ(all.at("data").size(), std::size(expected));
    double before = INFINITY;
    for(const json &row : all.at("data"))
    {
      const std::string name = row.at("name");
      const auto found = std::ranges::find_if(expected, [&](const Expected &one)
                                              { return name == one.name; });
      ASSERT_NE(found, std::end(expected)) << name;
      const double exact = boost::math::differentiation::finite_difference_derivative(
          [&](double s)
          {
            return front_with([&](cases::Material &m, double &wall, double &far)
                              { found->change(m, wall, far, s); });
          },
          0.);
      const double derivative = row.at("front").at("derivative"),
                   error = row.at("front").at("error");
      EXPECT_NEAR(derivative, exact, error + 1e-9) << name;
      // The errors say something: by 1 % of a datum the front moves by 5e-4 of itself,
      // which is known to a tenth of that.
      EXPECT_LT(error, 0.05 * all.at("front").at("value").get<double>()) << name;
      EXPECT_LE(std::abs(derivative), before); // sorted
      before = std::abs(derivative);
      EXPECT_NEAR(row.at("worth_of_bar").get<double>() * std::abs(derivative),
                  all.at("front").at("bar").get<double>(), 1e-12);
      if(exact != 0)
      {
        EXPECT_GT(row.at("temperature").at("derivative").get<double>(), 0) << name;
      }
    }
    EXPECT_EQ(read_json(study.directory.path("results/sensitivity.json")), all);
    EXPECT_NE(sensitivity_text(all).find("The numerical error of the front equals"),
              std::string::npos);
  }

  TEST(Sensitivity, ADerivativeStatesTheErrorOfItsStepAndOfItsResolution)
  {
    // f = s + 8 s^3 at n, twice that at n/2; s = 0.02, 0.04, 0.08, 0.16.
    std::vector<std::array<double, 2>> fine, coarse;
    for(const double s : relative_steps)
    {
      const double f = s + 8 * s * s * s;
      fine.push_back({-f, f});
      coarse.push_back({-2 * f, 2 * f});
    }
    const Derivative d = derivative(fine, coarse);
    EXPECT_NEAR(d.value, 1, 1e-12);
    EXPECT_EQ(d.step, 0.02);
    EXPECT_NEAR(d.error, 8 * (16e-4 - 4e-4) + 2, 1e-12);
    // A jump within the smallest step: larger ones are taken.
    fine[0][1] += 0.02;
    EXPECT_EQ(derivative(fine, fine).step, 0.04);
    // A front that the largest step makes vanish leaves the others.
    fine[3][0] = std::nan("");
    EXPECT_EQ(derivative(fine, fine).step, 0.04);
  }

  TEST(SceneData, AreTheNumbersOfASceneAndItsExpressions)
  {
    std::string text = neumann_slab;
    const auto replace = [&](const std::string &what, const std::string &by)
    { text.replace(text.find(what), what.size(), by); };
    replace("set temperature = -1", "set temperature = -1 - 0.1*sin(t)");
    replace("set density = 1",
            "set density = 1\n      set specific heat capacity = -2: 1, 0: 1");
    replace("set specific heat capacity = 1\n", "");
    std::vector<std::string> left_out;
    const std::vector<Datum> data
        = data_of(cases::read_case_text(text, "slab.prm"), left_out);
    const auto named = [&](const std::string &name)
    {
      return *std::ranges::find_if(data, [&](const Datum &datum)
                                   { return datum.name == name; });
    };
    EXPECT_EQ(named("Material/latent heat").changed(0.5), "3");
    EXPECT_EQ(named("Walls/x_min/temperature").kind, Datum::Kind::shifted);
    EXPECT_TRUE(named("Walls/x_min/temperature")
                    .changed(0.1)
                    .starts_with("(-1 - 0.1*sin(t)) + (0.15"));
    EXPECT_EQ(left_out, std::vector<std::string>{
                            "Material/Solid/specific heat capacity is a table"});
  }
} // namespace meltfront::verification::tests
