#include <cases/error.h>
#include <cases/exact/formula_solution.h>
#include <cases/tests/support/course.h>
#include <cases/tests/support/scenes.h>
#include <particles/rkpm/rkpm.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace meltfront;
using namespace meltfront::test_support;

namespace
{
  constexpr double pi = std::numbers::pi;
  using Formula = std::function<double(const cases::Position &, double)>;

  const cases::Method &method_named(const std::string &name)
  {
    static const auto methods = particles::make_rkpm_methods();
    for(const auto &method : methods)
      if(method->name() == name)
        return *method;
    throw std::logic_error(name);
  }

  /** A steady unit box whose walls hold the formula. */
  cases::Scene box(int dimension, const Formula &formula, const Formula &release)
  {
    cases::Scene scene = steady_box(dimension, {"", formula});
    scene.initial.temperature = {"", formula};
    scene.volumetric_source = cases::Field{"", release};
    return scene;
  }

  Course run(const std::string &name, const cases::Scene &scene, int n,
             const OptionTexts &options = {}, std::uint64_t seed = 1)
  {
    const cases::Method &method = method_named(name);
    Course course;
    solve(method, scene, resolution_of(method, n, options, 1, seed), course);
    EXPECT_FALSE(course.heat.conservative);
    EXPECT_FALSE(course.obeys_maximum_principle);
    return course;
  }

  double largest_error(const Course &course, const Formula &formula, double time)
  {
    double largest = 0;
    for(std::size_t i = 0; i < course.temperature.size(); ++i)
      largest = std::max(
          largest, std::abs(course.temperature[i] - formula(course.place(i), time)));
    return largest;
  }

  double quadratic(const cases::Position &p, double)
  {
    return 1 + p[0] - 2 * p[1] + 3 * p[2] + p[0] * p[0] - p[0] * p[1] + 2 * p[1] * p[1]
           + p[2] * p[2] - p[1] * p[2];
  }

  double laplacian(int dimension)
  {
    return dimension == 1 ? 2 : dimension == 2 ? 6 : 8;
  }
} // namespace

TEST(RkpmMethods, QuadraticsAreExactInAllForms)
{
  for(const int dimension : {1, 2, 3})
  {
    const Formula release
        = [dimension](const cases::Position &, double) { return -laplacian(dimension); };
    const cases::Scene scene = box(dimension, quadratic, release);
    for(const auto &method : particles::make_rkpm_methods())
      for(const char *unknowns : {"nodal", "reconstructed"})
      {
        // In the corners of a cube too few of the neighbours' own supports reach the
        // node: its order is lowered, as the run says.
        if(dimension == 3 && method->name() == "rkpm-multiple-fixed")
          continue;
        const Course course = run(
            method->name(), scene, dimension == 3 ? 7 : 11,
            {{"unknowns", unknowns}, {"arrangement", "jittered"}, {"jitter", "0.1"}});
        EXPECT_LT(largest_error(course, quadratic, 1), 1e-9)
            << method->name() << " " << dimension << " " << unknowns;
      }
  }
}

TEST(RkpmMethods, WallsOfAllKinds)
{
  cases::Scene scene
      = box(2, quadratic, [](const cases::Position &, double) { return -6.; });
  // dT/dx = 1 + 2 x - y, dT/dy = -2 - x + 4 y
  scene.boundaries[1]
      = cases::Boundary{cases::BoundaryKind::flux,
                        {"", [](const cases::Position &p, double) { return 3 - p[1]; }}};
  scene.boundaries[2] = cases::Boundary{cases::BoundaryKind::heat_transfer,
                                        {"", [](const cases::Position &p, double t)
                                         { return quadratic(p, t) + (2 + p[0]) / 5; }},
                                        false,
                                        5};
  for(const char *unknowns : {"nodal", "reconstructed"})
    EXPECT_LT(largest_error(run("rkpm-fixed-point", scene, 11,
                                {{"unknowns", unknowns}, {"arrangement", "jittered"}}),
                            quadratic, 1),
              1e-10);
}

TEST(RkpmMethods, APrintedFluxRowIsSingular)
{
  cases::Scene scene = box(
      1, [](const cases::Position &p, double) { return p[0] * p[0]; },
      [](const cases::Position &, double) { return -2.; });
  scene.boundaries[1]
      = cases::Boundary{cases::BoundaryKind::flux, cases::Field::uniform(2)};
  EXPECT_LT(largest_error(
                run("rkpm-fixed-point", scene, 21),
                [](const cases::Position &p, double) { return p[0] * p[0]; }, 1),
            1e-12);
  EXPECT_THROW(run("rkpm-fixed-point", scene, 21, {{"flux_row", "printed"}}),
               cases::NumericalError);
}

TEST(RkpmMethods, SpuriousModesAreRefusedWithTheLargestSafeDilation)
{
  const cases::Scene scene
      = box(1, quadratic, [](const cases::Position &, double) { return -2.; });
  const OptionTexts flat{{"kernel", "hat"}, {"support", "dilation"}, {"dilation", "3.5"}};
  try
  {
    run("rkpm-fixed-point", scene, 21, flat);
    FAIL();
  }
  catch(const cases::Refusal &refusal)
  {
    EXPECT_NE(std::string(refusal.what()).find("safe up to 2.25"), std::string::npos)
        << refusal.what();
  }
  OptionTexts reported = flat;
  reported.emplace_back("stability", "report");
  EXPECT_LT(largest_error(run("rkpm-fixed-point", scene, 21, reported), quadratic, 1),
            1e-10);
}

TEST(RkpmMethods, AnInclusionsSurfaceKeepsTheFlux)
{
  // Linear on either side: exact.
  const Formula bent = [](const cases::Position &p, double)
  { return p[0] < 0.5 ? 0.2 * (p[0] - 0.5) : 2 * (p[0] - 0.5); };
  for(const int dimension : {1, 2})
  {
    cases::Scene scene
        = box(dimension, bent, [](const cases::Position &, double) { return 0.; });
    scene.inclusion = cases::Inclusion{
        {"", [](const cases::Position &p, double) { return p[0] - 0.5; }}, 10};
    for(const int n : {21, 24})
      EXPECT_LT(largest_error(run("rkpm-fixed-point", scene, n), bent, 1), 1e-11);
    EXPECT_THROW(run("rkpm-fixed-point", scene, 11, {{"unknowns", "reconstructed"}}),
                 cases::Refusal);
  }
}

TEST(RkpmMethods, HeatThatDecaysIsOfSecondOrder)
{
  const Formula wave = [](const cases::Position &p, double t)
  { return std::sin(pi * p[0]) * std::exp(-pi * pi * t); };
  cases::Scene scene = box(1, wave, [](const cases::Position &, double) { return 0.; });
  scene.problem = cases::ProblemKind::stefan;
  scene.volumetric_source.reset();
  scene.end_time = 0.1;
  for(const char *unknowns : {"nodal", "reconstructed"})
  {
    std::vector<double> errors;
    for(const int n : {11, 21, 41, 81})
      errors.push_back(largest_error(
          run("rkpm-fixed-point", scene, n, {{"unknowns", unknowns}}), wave, 0.1));
    EXPECT_GT(std::log2(errors.front() / errors.back()) / 3, 1.8) << unknowns;
    EXPECT_LT(errors.back(), 3e-4);
  }
}
