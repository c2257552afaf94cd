#include <cases/error.h>
#include <cases/exact/frank.h>
#include <cases/exact/line_sink.h>
#include <cases/exact/oracle.h>
#include <cases/exact/planar_neumann.h>
#include <cases/exact/point_sink.h>
#include <cases/exact/tests/materials.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace meltfront::cases
{
  namespace
  {
    using Exact = std::shared_ptr<const ExactSolution>;

    OracleWall exact_wall(const Exact &exact, double coordinate)
    {
      return {BoundaryKind::fixed_temperature,
              [=](double time) { return exact->temperature(coordinate, time); }};
    }

    /** Start from an exact solution, with its temperatures at the ends. */
    OracleProblem exact_problem(const Exact &exact, const Material &material,
                                double inner, double outer, double start_time,
                                double end_time)
    {
      OracleProblem problem;
      problem.symmetry = exact->symmetry();
      problem.material = material;
      problem.inner = inner;
      problem.outer = outer;
      problem.inner_wall = exact_wall(exact, inner);
      problem.outer_wall = exact_wall(exact, outer);
      problem.start_time = start_time;
      problem.end_time = end_time;
      problem.start = exact;
      problem.solid_at_origin = exact->solid_at_origin();
      return problem;
    }

    /** Front to 1e-11, temperature and heat to 1e-10, at times that are no steps. */
    void expect_exact(const OracleProblem &problem)
    {
      const ExactSolution &exact = *problem.start;
      const SpectralOracle oracle(problem);
      SCOPED_TRACE(oracle.description());
      double front = 0, temperature = 0, heat = 0, range = 0, most_heat = 0;
      const int times = 100, points = 60;
      for(int i = 0; i <= times; ++i)
      {
        const double time = std::lerp(problem.start_time, problem.end_time,
                                      static_cast<double>(i) / times);
        front = std::max(front, std::abs(oracle.front(time) / exact.front(time) - 1));
        for(int j = 0; j <= points; ++j)
        {
          const double r
              = std::lerp(problem.inner, problem.outer, (j + 0.5) / (points + 1));
          const double expected = exact.temperature(r, time);
          range = std::max(range,
                           std::abs(expected - problem.material.melting_temperature));
          temperature
              = std::max(temperature, std::abs(oracle.temperature(r, time) - expected));
        }
        const double content = exact.heat_content(problem.inner, problem.outer, time);
        most_heat = std::max(most_heat, std::abs(content));
        heat = std::max(
            heat,
            std::abs(oracle.heat_content(problem.inner, problem.outer, time) - content));
      }
      EXPECT_LE(front, 1e-11);
      EXPECT_LE(temperature, 1e-10 * range);
      EXPECT_LE(heat, 1e-10 * most_heat);
      EXPECT_LE(oracle.resolution_defect(), 1e-13);
    }
  } // namespace

  TEST(Oracle, AgreesWithPlanarNeumann)
  {
    const Exact normalised
        = std::make_shared<PlanarNeumann>(unit_material(), unit_wall, 1.2);
    expect_exact(exact_problem(normalised, unit_material(), 0, 1, 0.01, 0.25));
    expect_exact(exact_problem(normalised, unit_material(), 0, 1, 1e-4, 0.0568));
    const Exact two_phase = std::make_shared<PlanarNeumann>(water(), -10, 10);
    expect_exact(exact_problem(two_phase, water(), 0, 1, 864, 86400));
    expect_exact(exact_problem(two_phase, water(), 0.01, 0.2, 3600, 86400));
    const Material contrast{{1, 1, 1}, {1e-3, 1, 1}, 1, 0};
    expect_exact(exact_problem(std::make_shared<PlanarNeumann>(contrast, -1, 0.5),
                               contrast, 0, 1.5, 0.01, 0.25));
  }

  TEST(Oracle, AgreesWhereTheDensitiesDiffer)
  {
    expect_exact(exact_problem(std::make_shared<PlanarNeumann>(water(917), -10, 10),
                               water(917), 0, 1, 864, 86400));
    expect_exact(exact_problem(std::make_shared<PlanarNeumann>(water(917), 10, -10),
                               water(917), 0, 1, 864, 86400));
  }

  TEST(Oracle, AgreesWithOnePhaseSolutions)
  {
    for(const double wall : {-10., 10.})
    {
      OracleProblem problem = exact_problem(
          std::make_shared<PlanarNeumann>(water(), wall, 0), water(), 0, 1, 864, 86400);
      (wall < 0 ? problem.liquid_at_melting : problem.solid_at_melting) = true;
      expect_exact(problem);
    }
  }

  TEST(Oracle, AgreesWithTheSinks)
  {
    const auto line = std::make_shared<LineSink>(water(), 0.15, 10);
    expect_exact(exact_problem(line, water(), 0.05, 0.5, 47500, 475000));
    OracleProblem problem = exact_problem(line, water(), 0, 0.5, 47500, 475000);
    problem.line_sink = line->strength();
    expect_exact(problem);
    const auto point = std::make_shared<PointSink>(water(), 0.15, 10);
    expect_exact(exact_problem(point, water(), 0.05, 0.5, 47500, 475000));
  }

  TEST(Oracle, AgreesWithFrankThroughTheCentre)
  {
    for(const Symmetry symmetry :
        {Symmetry::planar, Symmetry::cylindrical, Symmetry::spherical})
    {
      OracleProblem problem
          = exact_problem(std::make_shared<FrankGrowth>(Material{}, symmetry, -0.5),
                          Material{}, 0, 4, 0.1, 1);
      problem.metastable = true;
      expect_exact(problem);
    }
  }

  /** A prescribed flux that is the exact one gives the exact solution. */
  TEST(Oracle, AgreesUnderAPrescribedFlux)
  {
    const auto exact = std::make_shared<PlanarNeumann>(water(), -10, 10);
    OracleProblem problem = exact_problem(exact, water(), 0, 1, 864, 86400);
    const double factor = -water().solid.conductivity * 10
                          / std::sqrt(std::numbers::pi * water().solid.diffusivity())
                          / std::erf(exact->lambda());
    problem.inner_wall
        = {BoundaryKind::flux, [=](double time) { return factor / std::sqrt(time); }};
    expect_exact(problem);
  }

  TEST(Oracle, AnswersEarlierTimesFromItsStart)
  {
    const auto exact = std::make_shared<PlanarNeumann>(unit_material(), unit_wall, 1.2);
    const SpectralOracle oracle(exact_problem(exact, unit_material(), 0, 1, 1e-3, 0.05));
    EXPECT_EQ(oracle.start_time(), 0);
    EXPECT_EQ(oracle.end_time(), 0.05);
    EXPECT_EQ(oracle.front(0), 0);
    EXPECT_EQ(oracle.temperature(0.3, 0), 1.2);
    EXPECT_EQ(oracle.temperature(0.01, 5e-4), exact->temperature(0.01, 5e-4));
    EXPECT_EQ(oracle.heat_content(0, 1, 5e-4), exact->heat_content(0, 1, 5e-4));
    EXPECT_THROW(oracle.front(0.051), InputError);
  }

  TEST(Oracle, StartsFromAProfileAsFromASolution)
  {
    const auto exact = std::make_shared<PlanarNeumann>(unit_material(), unit_wall, 1.2);
    OracleProblem problem = exact_problem(exact, unit_material(), 0, 1, 0.01, 0.25);
    const SpectralOracle from_solution(problem);
    problem.start = nullptr;
    problem.initial_fronts = {exact->front(0.01)};
    problem.initial_temperature = [=](double x) { return exact->temperature(x, 0.01); };
    const SpectralOracle from_profile(problem);
    EXPECT_EQ(from_profile.start_time(), 0.01);
    EXPECT_EQ(from_profile.front(0.2), from_solution.front(0.2));
    EXPECT_THROW(from_profile.front(0.009), InputError);
  }

  /** Between two round walls from a profile whose wall values set off at once: the number
   * of nodes does not matter. */
  TEST(Oracle, SolvesAShellFromAProfile)
  {
    const auto profile = [](double r)
    {
      return r < 0.5 ? (1 - std::pow(r / 0.5, -0.4)) / 0.4
                     : 0.25 * (1 - std::pow(r / 0.5, -1.6));
    };
    OracleProblem problem;
    problem.symmetry = Symmetry::cylindrical;
    problem.material = {{2, 1, 1}, {1, 2, 1}, 2, 0};
    problem.inner = 0.3;
    problem.end_time = 0.12;
    problem.inner_wall
        = {BoundaryKind::fixed_temperature, [&](double) { return profile(0.3); }};
    problem.outer_wall
        = {BoundaryKind::fixed_temperature, [&](double) { return profile(1); }};
    problem.initial_fronts = {0.5};
    problem.initial_temperature = profile;
    const double front = SpectralOracle(problem).front(0.12);
    EXPECT_NEAR(front, 0.63204736885, 1e-11);
    for(const int nodes : {40, 60})
    {
      problem.nodes = nodes;
      EXPECT_NEAR(SpectralOracle(problem).front(0.12), front, 1e-12);
    }
  }

  TEST(Oracle, RejectsIncompleteProblems)
  {
    const auto exact = std::make_shared<PlanarNeumann>(unit_material(), unit_wall, 1.2);
    const OracleProblem good = exact_problem(exact, unit_material(), 0, 1, 0.01, 0.25);
    const auto expect_rejected = [&](const auto &spoil)
    {
      OracleProblem problem = good;
      spoil(problem);
      EXPECT_THROW(SpectralOracle{problem}, InputError);
    };
    expect_rejected([](OracleProblem &p) { p.start = nullptr; });
    expect_rejected([](OracleProblem &p) { p.symmetry = Symmetry::none; });
    expect_rejected([](OracleProblem &p) { p.symmetry = Symmetry::spherical; });
    expect_rejected([](OracleProblem &p) { p.solid_at_origin = false; });
    expect_rejected([](OracleProblem &p) { p.end_time = 0.01; });
    expect_rejected([](OracleProblem &p) { p.outer = 0.05; });
    expect_rejected([](OracleProblem &p) { p.outer = -1; });
    expect_rejected([](OracleProblem &p) { p.inner_wall.value = nullptr; });
    expect_rejected([](OracleProblem &p) { p.outer_wall.kind = BoundaryKind::periodic; });
    expect_rejected([](OracleProblem &p) { p.line_sink = 1; });
    expect_rejected([](OracleProblem &p) { p.nodes = 2; });
    expect_rejected([](OracleProblem &p) { p.tolerance = 0; });
    expect_rejected([](OracleProblem &p) { p.material.latent_heat = 0; });
  }
} // namespace meltfront::cases
