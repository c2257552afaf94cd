#include <cases/error.h>
#include <cases/tests/support/course.h>
#include <particles/scattered/given_values.h>
#include <particles/scattered/linear_growth.h>
#include <particles/scattered/linear_problem.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace meltfront;
using namespace meltfront::particles;
using meltfront::test_support::Course;

namespace
{
  constexpr double pi = std::numbers::pi;
  constexpr int cells = 20;
  constexpr double spacing = 1. / cells;

  /** Cells of a slab of unit conductivity and capacity between walls at temperatures
   * that may change, and heat released in them. */
  struct Slab
  {
    struct Posed : PosedProblem
    {
      explicit Posed(const Slab &slab)
        : slab(slab)
      {
      }

      const LinearProblem &linear() const override
      {
        return slab.problem;
      }

      LinearSites sites() const override
      {
        return {1, {slab.x, {}, {}}, slab.weights};
      }

      LinearDescription description() const override
      {
        return slab.description;
      }

      std::vector<cases::EffectCost> effect_costs(const cases::EffectSet &) const override
      {
        return {};
      }

      const Slab &slab;
    };

    Slab()
    {
      scene.symmetry = cases::Symmetry::planar;
      scene.domain.upper = {1, 0, 0};
      scene.material.latent_heat = 0;
      scene.boundaries[0] = scene.boundaries[1] = cases::Boundary{
          cases::BoundaryKind::fixed_temperature, cases::Field::uniform(0)};
      scene.initial.temperature = {"", [](const cases::Position &p, double)
                                   { return std::sin(pi * p[0]) + 1; }};
      std::vector<std::uint32_t> scratch;
      for(int i = 0; i < cells; ++i)
      {
        std::vector<std::uint32_t> columns{static_cast<std::uint32_t>(i)};
        const double ends = (i == 0 || i == cells - 1) ? 3 : 2;
        std::vector<double> values{-ends / spacing};
        for(const int j : {i - 1, i + 1})
          if(j >= 0 && j < cells)
          {
            columns.push_back(static_cast<std::uint32_t>(j));
            values.push_back(1 / spacing);
          }
        problem.operator_rows.add_row(columns, values, scratch);
        problem.mass.add_row(std::span(columns).first(1), std::vector<double>{spacing},
                             scratch);
        x.push_back((i + 0.5) * spacing);
        weights.push_back(spacing);
      }
      problem.symmetric = true;
      problem.source = [this](const LinearStep &step, std::span<double> source)
      {
        std::ranges::fill(source, release * spacing);
        source.front() += 2 / spacing * wall(step.at);
        source.back() += 2 / spacing * wall(step.at);
      };
      problem.inflow = [this](const LinearStep &step, std::span<const double> u) {
        return HeatInflow{2 / spacing * (2 * wall(step.at) - u.front() - u.back()),
                          release};
      };
      description.method = "test";
    }

    Course run(const std::string &scheme, int steps)
    {
      cases::Resolution resolution;
      resolution.n = cells;
      resolution.options = cases::Options(cases::options_of(LinearOptions()));
      resolution.options.set("time_scheme", scheme);
      resolution.options.set("steps", std::to_string(steps));
      Course course;
      const cases::Stopwatch watch;
      const cases::EffectSet effects = cases::effects_called_for(scene);
      cost = make_linear_run(scene, effects, std::make_unique<Posed>(*this), resolution)
                 ->carry_out(scene, watch, course);
      return course;
    }

    double wall(double time) const
    {
      return offset + slope * time;
    }

    cases::Scene scene;
    LinearProblem problem;
    LinearDescription description;
    std::vector<double> x, weights;
    double release = 0, offset = 1, slope = 0;
    cases::Cost cost;
  };

  /** The slab's own answer: its sine is an eigenvector of the operator. */
  double decayed(double x, double time)
  {
    const double rate = 4 / (spacing * spacing) * std::pow(std::sin(pi * spacing / 2), 2);
    return std::sin(pi * x) * std::exp(-rate * time) + 1;
  }

  double error(const std::string &scheme, int steps)
  {
    Slab slab;
    slab.scene.end_time = 0.2;
    const Course course = slab.run(scheme, steps);
    EXPECT_EQ(course.time.back(), 0.2);
    double largest = 0;
    for(int i = 0; i < cells; ++i)
      largest
          = std::max(largest, std::abs(course.temperature[i] - decayed(slab.x[i], 0.2)));
    return largest;
  }

  double order(const std::string &scheme)
  {
    return std::log2(error(scheme, 20) / error(scheme, 160)) / 3;
  }
} // namespace

TEST(LinearRun, OrdersInTime)
{
  EXPECT_NEAR(order("backward-euler"), 1, 0.1);
  EXPECT_NEAR(order("crank-nicolson"), 2, 0.15);
  EXPECT_NEAR(order("bdf2"), 2, 0.15);
}

TEST(LinearRun, HeatIsBooked)
{
  for(const char *scheme : {"backward-euler", "crank-nicolson", "bdf2"})
  {
    Slab slab;
    slab.release = 3;
    slab.slope = 5;
    slab.scene.end_time = 0.3;
    slab.scene.volumetric_source = cases::Field::uniform(3);
    slab.scene.boundaries[1] = cases::Boundary(); // no bound on the temperature matters
    const Course course = slab.run(scheme, 37);
    EXPECT_LT(course.worst_budget_defect(), 1e-13) << scheme;
    EXPECT_GT(course.heat.boundary + course.heat.sources, 0.5);
  }
}

/** An ambient temperature that falls from 1 to 0 within a step; the walls exchange heat
 * as fast as a cell does. */
TEST(LinearRun, WhatJumpsWithinAStepIsNotContinued)
{
  for(const char *scheme : {"backward-euler", "crank-nicolson", "bdf2"})
  {
    Slab slab;
    slab.scene.end_time = 0.2;
    cases::Field ambient = cases::Field::uniform(0);
    ambient = {"", [](const cases::Position &, double t) { return t < 0.1 ? 1. : 0.; }};
    ambient.breakpoints = {0.1};
    for(const std::size_t side : {0, 1})
    {
      slab.scene.boundaries[side]
          = cases::Boundary{cases::BoundaryKind::heat_transfer, ambient};
      slab.scene.boundaries[side]->heat_transfer_coefficient = 2 / spacing;
    }
    slab.scene.initial.temperature = cases::Field::uniform(1);
    const GivenValues given(slab.scene);
    const auto mean = [&](const LinearStep &step)
    { return given.wall(*slab.scene.boundaries[0], {}, step); };
    slab.problem.source = [&](const LinearStep &step, std::span<double> source)
    {
      std::ranges::fill(source, 0.);
      source.front() = source.back() = 2 / spacing * mean(step);
    };
    slab.problem.inflow = [&](const LinearStep &step, std::span<const double> u) {
      return HeatInflow{2 / spacing * (2 * mean(step) - u.front() - u.back()), 0};
    };
    const Course course = slab.run(scheme, 37); // refuses what is below zero
    EXPECT_GT(*std::ranges::min_element(course.temperature), 0) << scheme;
    EXPECT_LT(course.worst_budget_defect(), 1e-13) << scheme;
  }
}

TEST(LinearRun, ASteadySceneIsSolvedAtOnce)
{
  Slab slab;
  slab.scene.problem = cases::ProblemKind::poisson;
  slab.scene.end_time = 1;
  slab.release = 8;
  const Course course = slab.run("bdf2", 0);
  EXPECT_EQ(slab.cost.steps, 1);
  EXPECT_LT(course.heat.defect(), 1e-13);
  for(int i = 0; i < cells; ++i)
    EXPECT_NEAR(course.temperature[i],
                1 + 4 * slab.x[i] * (1 - slab.x[i]) + spacing * spacing, 1e-12);
}

TEST(LinearRun, UnknownsNeedNotBeTemperatures)
{
  Slab plain, reconstructed;
  plain.scene.end_time = reconstructed.scene.end_time = 0.1;
  // Unknowns that are half the temperatures.
  for(CompressedRows *rows :
      {&reconstructed.problem.operator_rows, &reconstructed.problem.mass})
    for(double &value : rows->coefficients)
      value *= 2;
  reconstructed.problem.inflow = {};
  std::vector<std::uint32_t> scratch;
  for(std::uint32_t i = 0; i < cells; ++i)
    reconstructed.problem.reconstruction.add_row(std::vector{i}, std::vector{2.},
                                                 scratch);
  const Course one = plain.run("bdf2", 30), other = reconstructed.run("bdf2", 30);
  for(int i = 0; i < cells; ++i)
    EXPECT_NEAR(one.temperature[i], other.temperature[i], 1e-13);
  EXPECT_TRUE(std::isnan(other.heat.defect()));
}

TEST(LinearRun, ASingularMatrixStopsTheRun)
{
  Slab slab;
  slab.scene.problem = cases::ProblemKind::poisson;
  slab.problem.symmetric = false;
  CompressedRows &rows = slab.problem.operator_rows;
  // Without walls any constant solves it.
  rows.coefficients.front() = -1 / spacing;
  rows.coefficients.back() = -1 / spacing;
  EXPECT_THROW(slab.run("bdf2", 0), cases::NumericalError);
}

/** The slowest sine decays like 1/(1 + lambda/rate); with the operator's sign turned the
 * fastest grows. */
TEST(LinearRun, GrowthOfTheRowsIsFound)
{
  const Slab slab;
  const CompressedRows &mass = slab.problem.mass;
  const double slowest
      = 4 / (spacing * spacing) * std::pow(std::sin(pi * spacing / 2), 2);
  const auto growth = [&](double sign, double rate)
  {
    LinearSolver solver(sum_of(rate, mass, -sign, slab.problem.operator_rows), {});
    return growth_per_step(solver, mass, rate);
  };
  EXPECT_NEAR(growth(1, 2 * slowest), 2. / 3, 1e-6);
  const double fastest = 4 / (spacing * spacing);
  EXPECT_NEAR(growth(-1, 1.01 * fastest), 101, 0.1);
}

TEST(LinearRun, AnInclusionWithoutStableRowsIsRefused)
{
  Slab slab;
  slab.scene.end_time = 0.1;
  for(double &value : slab.problem.operator_rows.coefficients)
    value = -value;
  slab.problem.symmetric = false;
  slab.scene.inclusion.emplace();
  EXPECT_THROW(slab.run("backward-euler", 50), cases::Refusal);
}

// Refused by what is at fault, the rows, which are looked at once the bounds are left.
TEST(LinearRun, WhatLeavesItsBoundsIsNoResult)
{
  Slab slab;
  slab.scene.end_time = 0.1;
  for(double &value : slab.problem.operator_rows.coefficients)
    value = -value;
  slab.problem.symmetric = false;
  EXPECT_THROW(slab.run("backward-euler", 50), cases::Refusal);
}
