#include <cases/error.h>
#include <cases/tests/support/course.h>
#include <cases/tests/support/scenes.h>
#include <particles/moab_integral/moab_integral.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meltfront::particles
{
  namespace
  {
    constexpr double pi = std::numbers::pi;
    using Formula = std::function<double(const cases::Position &, double)>;
    using namespace test_support;

    struct Measured : Course
    {
      double error = 0; ///< root mean square at the end over the largest exact value
    };

    cases::Scene steady(int dimension, const Formula &exact, const Formula &release)
    {
      cases::Scene scene = steady_box(dimension, {"", exact});
      scene.initial.temperature = {"", exact};
      scene.volumetric_source = cases::Field{"", release};
      return scene;
    }

    Measured run(const cases::Scene &scene, const Formula &exact, int n,
                 const OptionTexts &options = {})
    {
      Measured result;
      static_cast<Course &>(result) = course_of(*make_moab_integral(), scene, n, options);
      EXPECT_FALSE(result.heat.conservative);
      double square = 0, largest = 0;
      for(std::size_t i = 0; i < result.temperature.size(); ++i)
      {
        const double expected = exact(result.place(i), result.time.back());
        square += (result.temperature[i] - expected) * (result.temperature[i] - expected);
        largest = std::max(largest, std::abs(expected));
      }
      result.error = std::sqrt(square / double(result.temperature.size())) / largest;
      return result;
    }

    double quadratic(const cases::Position &p, double)
    {
      return 1 + p[0] - 2 * p[1] + p[0] * p[0] - p[0] * p[1] + 2 * p[1] * p[1];
    }

    TEST(MoabIntegral, HasQuadraticsExactlyBetweenWallsOfAllKinds)
    {
      constexpr double conductivity = 3;
      cases::Scene scene
          = steady(2, quadratic,
                   [](const cases::Position &, double) { return -6 * conductivity; });
      scene.material.solid.conductivity = conductivity;
      scene.material.liquid.conductivity = conductivity;
      // dT/dx = 1 + 2 x - y, dT/dy = -2 - x + 4 y
      scene.boundaries[1] = cases::Boundary{cases::BoundaryKind::flux,
                                            {"", [](const cases::Position &p, double)
                                             { return conductivity * (3 - p[1]); }}};
      scene.boundaries[2]
          = cases::Boundary{cases::BoundaryKind::heat_transfer,
                            {"", [](const cases::Position &p, double t)
                             { return quadratic(p, t) + conductivity * (2 + p[0]) / 5; }},
                            false,
                            5};
      for(const char *order : {"3", "4"})
        for(const char *arrangement : {"lattice", "jittered"})
          EXPECT_LT(run(scene, quadratic, 15,
                        {{"constraint_order", order}, {"arrangement", arrangement}})
                        .error,
                    1e-11)
              << order << ' ' << arrangement;
    }

    TEST(MoabIntegral, HeatThatDecaysConvergesAsTheOrderSays)
    {
      const Formula decay = [](const cases::Position &p, double t)
      { return std::sin(pi * p[0]) * std::exp(-pi * pi * t); };
      cases::Scene scene
          = steady(1, decay, [](const cases::Position &, double) { return 0.; });
      scene.problem = cases::ProblemKind::stefan;
      scene.volumetric_source.reset();
      scene.end_time = 0.1;
      std::vector<double> errors;
      for(const int n : {21, 41, 81, 161})
        errors.push_back(run(scene, decay, n, {{"steps", "1000"}}).error);
      EXPECT_GT(std::log2(errors.front() / errors.back()) / 3, 1.8);
      EXPECT_LT(errors.back(), 3e-5);
      const double fourth
          = run(scene, decay, 41, {{"constraint_order", "4"}, {"steps", "4000"}}).error;
      EXPECT_LT(fourth, 1e-5);
    }

    TEST(MoabIntegral, SaysWhereConstraintsContradictEachOther)
    {
      const Formula parabola
          = [](const cases::Position &p, double) { return p[0] * p[0]; };
      const cases::Scene scene
          = steady(1, parabola, [](const cases::Position &, double) { return -2.; });
      const Measured met = run(scene, parabola, 31);
      const Measured unmet = run(scene, parabola, 31,
                                 {{"weights", "single"},
                                  {"support", "fixed"},
                                  {"kernel", "cubic_spline"},
                                  {"dilation", "2.5"}});
      EXPECT_LT(met.error, 1e-11);
      EXPECT_GT(unmet.error, 1e-2);
      EXPECT_EQ(met.description.parameters[8].value, "0");
      EXPECT_EQ(unmet.description.parameters[8].value, "2");
    }

    TEST(MoabIntegral, RefusesWhatItCannotTreat)
    {
      const Formula zero = [](const cases::Position &, double) { return 0.; };
      EXPECT_THROW(run(steady(3, zero, zero), zero, 11), cases::Refusal);
      cases::Scene scene = steady(2, zero, zero);
      scene.inclusion = cases::Inclusion{
          {"", [](const cases::Position &p, double) { return p[0] - 0.5; }}, 10};
      EXPECT_THROW(run(scene, zero, 11), cases::Refusal);
      EXPECT_THROW(run(steady(1, zero, zero), zero, 11, {{"kernel", "hat"}}),
                   cases::InputError);
    }

    TEST(MoabIntegral, AFlatKernelsZeroModeEndsTheRun)
    {
      const Formula wave
          = [](const cases::Position &p, double) { return std::sin(pi * p[0]); };
      const cases::Scene scene = steady(1, wave,
                                        [](const cases::Position &p, double)
                                        { return pi * pi * std::sin(pi * p[0]); });
      EXPECT_THROW(run(scene, wave, 60, {{"kernel", "epanechnikov"}}),
                   cases::NumericalError);
    }
  } // namespace
} // namespace meltfront::particles
