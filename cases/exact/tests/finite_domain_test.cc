// The oracle where no closed form exists: its budget, its convergence, an independent
// scheme.

#include <cases/error.h>
#include <cases/exact/line_sink.h>
#include <cases/exact/oracle.h>
#include <cases/exact/planar_neumann.h>
#include <cases/exact/tests/materials.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

namespace meltfront::cases
{
  namespace
  {
    /** Largest difference of two fronts over the run. */
    double front_difference(const SpectralOracle &a, const SpectralOracle &b,
                            double start, double end)
    {
      double difference = 0;
      for(int i = 0; i <= 50; ++i)
      {
        const double time = std::lerp(start, end, i / 50.);
        difference = std::max(difference, std::abs(a.front(time) - b.front(time)));
      }
      return difference;
    }

    /** The same front with more nodes, with a smaller tolerance, and with both. */
    void expect_converged(OracleProblem problem, double tolerance)
    {
      const SpectralOracle oracle(problem);
      const double length = problem.outer - problem.inner;
      const auto expect_same = [&]
      {
        const SpectralOracle other(problem);
        EXPECT_LE(front_difference(oracle, other, problem.start_time, problem.end_time),
                  tolerance * length)
            << other.description();
      };
      problem.tolerance = 1e-13;
      problem.nodes = *std::ranges::max_element(oracle.nodes());
      expect_same();
      problem.nodes += 12;
      expect_same();
    }

    /**
     * A slab that freezes, then melts back: solid 0 ... 0.3 of unit length at T_m
     * = 0 under liquid; heat is drawn at a steady rate on the left and given on the
     * right, more at half time than is drawn.
     */
    OracleProblem oscillating_slab()
    {
      OracleProblem problem;
      problem.material = {{1, 1, 1}, {0.6, 1.5, 1}, 1, 0};
      problem.end_time = 1;
      problem.initial_fronts = {0.3};
      // Meets the walls' conditions at the start, but not those of the moving front.
      problem.initial_temperature = [](double x)
      { return x < 0.3 ? (x - 0.3) : 0.4 * (1 - std::pow((1 - x) / 0.7, 2)); };
      problem.inner_wall = {BoundaryKind::flux, [](double) { return -1.; }};
      problem.outer_wall = {BoundaryKind::flux, [](double time) {
                              return 3 * std::pow(std::sin(std::numbers::pi * time), 2);
                            }};
      return problem;
    }

    /** Heat through both walls from 0 to t in oscillating_slab(). */
    double oscillating_inflow(double time)
    {
      const double omega = 2 * std::numbers::pi;
      return -time + 1.5 * (time - std::sin(omega * time) / omega);
    }
  } // namespace

  TEST(FiniteDomain, FrontTurnsBackAndTheBudgetCloses)
  {
    const OracleProblem problem = oscillating_slab();
    const SpectralOracle oracle(problem);
    const double start = oracle.heat_content(0, 1, 0);
    double highest = 0;
    for(int i = 0; i <= 100; ++i)
    {
      const double time = i / 100.;
      highest = std::max(highest, oracle.front(time));
      EXPECT_NEAR(oracle.heat_content(0, 1, time) - start, oscillating_inflow(time),
                  1e-11)
          << time;
    }
    EXPECT_GT(highest, oracle.front(0) + 0.02);
    EXPECT_LT(oracle.front(1), highest - 0.05);
    expect_converged(problem, 1e-11);
  }

  /** An explicit enthalpy scheme on cells, of first order: another method altogether. */
  TEST(FiniteDomain, FrontThatTurnsBackAgreesWithAnEnthalpyScheme)
  {
    const OracleProblem problem = oscillating_slab();
    const SpectralOracle oracle(problem);
    const Material &material = problem.material;
    std::vector<double> errors;
    for(const int cells : {50, 100, 200})
    {
      const double h = 1. / cells, dt = 0.3 * h * h;
      const long steps = std::lround(1 / dt);
      std::vector<double> enthalpy(cells), temperature(cells), flux(cells + 1, 0.);
      for(int i = 0; i < cells; ++i)
        enthalpy[i] = oracle.heat_content(i * h, (i + 1) * h, 0) / h;
      double worst = 0;
      for(long step = 0; step < steps; ++step)
      {
        for(int i = 0; i < cells; ++i)
          temperature[i] = material.temperature(enthalpy[i]);
        const auto conductivity = [&](int i)
        {
          return enthalpy[i] < material.latent_heat / 2 ? material.solid.conductivity
                                                        : material.liquid.conductivity;
        };
        flux[0] = problem.inner_wall.value(step * dt);
        flux[cells] = -problem.outer_wall.value(step * dt);
        for(int i = 1; i < cells; ++i)
          flux[i] = 2 * (temperature[i - 1] - temperature[i])
                    / (h / conductivity(i - 1) + h / conductivity(i));
        double solid = 0;
        for(int i = 0; i < cells; ++i)
        {
          enthalpy[i] += dt / h * (flux[i] - flux[i + 1]);
          solid += h * material.solid_fraction(enthalpy[i]);
        }
        worst = std::max(worst,
                         std::abs(solid - oracle.front(std::min(1., (step + 1) * dt))));
      }
      errors.push_back(worst);
    }
    EXPECT_LT(errors[0], 1.5e-2);
    EXPECT_LT(errors[2], 4e-3);
    EXPECT_LT(errors[2], 0.6 * errors[0]);
  }

  TEST(FiniteDomain, WallTemperatureThatOscillates)
  {
    OracleProblem problem;
    problem.material = {{1, 1, 1}, {0.6, 1.5, 1}, 1, 0};
    problem.end_time = 1;
    problem.initial_fronts = {0.3};
    problem.initial_temperature
        = [](double x) { return x < 0.3 ? (x - 0.3) : 1.5 * (x - 0.3); };
    problem.inner_wall = {BoundaryKind::fixed_temperature, [](double time)
                          { return -0.3 * std::cos(2 * time) * std::cos(2 * time); }};
    problem.outer_wall = {BoundaryKind::fixed_temperature, [](double) { return 1.05; }};
    const SpectralOracle oracle(problem);
    double lowest = 1;
    for(int i = 0; i <= 100; ++i)
      lowest = std::min(lowest, oracle.front(i / 100.));
    EXPECT_LT(lowest, oracle.front(0) - 0.01);
    EXPECT_NEAR(oracle.temperature(0, 0.7), problem.inner_wall.value(0.7), 1e-13);
    expect_converged(problem, 1e-10);
  }

  /** The line sink in an insulated disk: heat is lost at the sink only. */
  TEST(FiniteDomain, LineSinkInAnInsulatedDisk)
  {
    const auto sink = std::make_shared<LineSink>(water(), 0.15, 10);
    OracleProblem problem;
    problem.symmetry = Symmetry::cylindrical;
    problem.material = water();
    problem.outer = 0.5;
    problem.start_time = 2000;
    problem.end_time = 475000;
    problem.start = sink;
    problem.line_sink = sink->strength();
    const SpectralOracle oracle(problem);
    const double drawn = sink->strength() * 473000;
    EXPECT_NEAR(oracle.heat_content(0, 0.5, 475000) - oracle.heat_content(0, 0.5, 2000),
                -drawn, 1e-11 * drawn);
    EXPECT_GT(oracle.front(475000) - sink->front(475000), 1e-7);
    EXPECT_LT(oracle.front(475000) - sink->front(475000), 2e-3);
    expect_converged(problem, 1e-11);
  }

  TEST(FiniteDomain, BudgetOfASphereUnderAFlux)
  {
    OracleProblem problem;
    problem.symmetry = Symmetry::spherical;
    problem.material = {{2, 1, 1}, {1, 2, 1}, 3, 0};
    problem.end_time = 0.1;
    problem.initial_fronts = {0.5};
    problem.initial_temperature = [](double r)
    {
      const double liquid = std::sin(std::numbers::pi * (r - 0.5));
      return r < 0.5 ? 2 * (r * r - 0.25) : liquid;
    };
    problem.outer_wall = {BoundaryKind::flux, [](double time) { return 20 * time; }};
    const SpectralOracle oracle(problem);
    const double gained = 4 * std::numbers::pi * 10 * 0.01;
    EXPECT_NEAR(oracle.heat_content(0, 1, 0.1) - oracle.heat_content(0, 1, 0), gained,
                1e-11);
    expect_converged(problem, 1e-10);
  }

  /** With one phase the front meets the far wall at a time known in closed form. */
  TEST(FiniteDomain, StopsWhereTheFrontLeaves)
  {
    const auto exact = std::make_shared<PlanarNeumann>(Material{}, -1, 0);
    OracleProblem problem;
    problem.material = Material{};
    problem.start_time = 0.01;
    problem.end_time = 10;
    problem.start = exact;
    problem.inner_wall = {BoundaryKind::fixed_temperature, [](double) { return -1.; }};
    problem.liquid_at_melting = true;
    const double expected = std::pow(1 / (2 * exact->lambda()), 2);
    try
    {
      const SpectralOracle oracle(problem);
      FAIL() << "the front left unnoticed";
    }
    catch(const NumericalError &error)
    {
      EXPECT_NEAR(error.time, expected, 1e-5 * expected);
      EXPECT_EQ(error.quantity, "the liquid");
    }
  }

  TEST(FiniteDomain, StopsWhereAPhaseVanishes)
  {
    // A solid core at its melting point, melted from outside by a liquid held warm.
    OracleProblem core;
    core.symmetry = Symmetry::cylindrical;
    core.initial_fronts = {0.3};
    core.initial_temperature
        = [](double r) { return r < 0.3 ? 0. : std::log(r / 0.3) / std::log(1 / 0.3); };
    core.outer_wall = {BoundaryKind::fixed_temperature, [](double) { return 1.; }};
    try
    {
      const SpectralOracle oracle(core);
      FAIL() << "the core melted away unnoticed";
    }
    catch(const NumericalError &error)
    {
      EXPECT_EQ(error.quantity, "the solid");
      // The heat that has come in through the wall by then is the latent heat at least.
      EXPECT_GT(error.time, 0.01);
      EXPECT_LT(error.time, 0.2);
    }

    // All liquid of an insulated slab freezes.
    const auto exact = std::make_shared<PlanarNeumann>(unit_material(), unit_wall, 1.2);
    OracleProblem slab;
    slab.material = unit_material();
    slab.start = exact;
    slab.start_time = 1e-3;
    slab.end_time = 10;
    slab.inner_wall = {BoundaryKind::fixed_temperature, [](double) { return unit_wall; }};
    EXPECT_THROW(SpectralOracle{slab}, NumericalError);
  }

  TEST(FiniteDomain, StopsWhereAnotherFrontWouldForm)
  {
    OracleProblem problem = oscillating_slab();
    problem.inner_wall = {BoundaryKind::flux, [](double time) { return -1 + 20 * time; }};
    try
    {
      const SpectralOracle oracle(problem);
      FAIL() << "superheated solid went unnoticed";
    }
    catch(const NumericalError &error)
    {
      EXPECT_EQ(error.quantity, "the temperature");
      EXPECT_GT(error.time, 0.05);
      EXPECT_LT(error.time, 0.2);
    }
  }

  TEST(FiniteDomain, SaysWhereTheDataAreNotSmoothEnough)
  {
    OracleProblem problem = oscillating_slab();
    problem.end_time = 0.1;
    problem.initial_temperature
        = [](double x) { return x < 0.3 ? x - 0.3 : std::min(0.4, 2 * (x - 0.3)); };
    EXPECT_THROW(SpectralOracle{problem}, NumericalError);
    problem.nodes = 24;
    EXPECT_GT(SpectralOracle(problem).resolution_defect(), 1e-4);
  }
} // namespace meltfront::cases
