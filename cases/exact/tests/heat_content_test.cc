#include <cases/error.h>
#include <cases/exact/frank.h>
#include <cases/exact/line_sink.h>
#include <cases/exact/planar_neumann.h>
#include <cases/exact/point_sink.h>
#include <cases/exact/tests/materials.h>

#include <boost/math/quadrature/tanh_sinh.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

namespace meltfront::cases
{
  namespace
  {
    struct Problem
    {
      std::shared_ptr<const ExactSolution> solution;
      Material material;
      double time;
    };

    std::vector<Problem> problems()
    {
      const Material contrast{{1, 1, 1}, {0.1, 2, 1}, 1, 0};
      return {{std::make_shared<PlanarNeumann>(unit_material(), unit_wall, 1.2),
               unit_material(), 0.0568},
              {std::make_shared<PlanarNeumann>(water(917), -10, 10), water(917), 86400},
              {std::make_shared<PlanarNeumann>(water(917), 10, -10), water(917), 86400},
              {std::make_shared<PlanarNeumann>(water(), -10, 0), water(), 86400},
              {std::make_shared<PlanarNeumann>(contrast, -1, 0.5), contrast, 0.1},
              {std::make_shared<LineSink>(water(), 0.15, 10), water(), 475000},
              {std::make_shared<LineSink>(water(), 0.001, 10), water(), 475000},
              {std::make_shared<PointSink>(water(), 0.15, 10), water(), 475000},
              {std::make_shared<FrankGrowth>(Material{}, Symmetry::planar, -0.5),
               Material{}, 1},
              {std::make_shared<FrankGrowth>(Material{}, Symmetry::cylindrical, -0.5),
               Material{}, 1},
              {std::make_shared<FrankGrowth>(Material{}, Symmetry::spherical, -0.5),
               Material{}, 1}};
    }

    double measure(Symmetry symmetry, double r)
    {
      const double pi = std::numbers::pi;
      return symmetry == Symmetry::planar        ? 1
             : symmetry == Symmetry::cylindrical ? 2 * pi * r
                                                 : 4 * pi * r * r;
    }

    /** Adaptive quadrature of the enthalpy of temperature(), phase by phase. */
    double integrated_enthalpy(const Problem &problem, double lower, double upper)
    {
      const ExactSolution &solution = *problem.solution;
      const Material &material = problem.material;
      boost::math::quadrature::tanh_sinh<double> rule;
      const auto integrate = [&](double from, double to, bool solid)
      {
        if(from >= to)
          return 0.;
        const PhaseProperties &phase = solid ? material.solid : material.liquid;
        // Over the unit interval: the rule asserts that an interval is no thinner than
        // the spacing of numbers at its ends lets it be.
        return (to - from)
               * rule.integrate(
                   [&](double share)
                   {
                     const double r = from + (to - from) * share;
                     if(r < 1e-100)
                       return 0.; // the limit; the rule goes on until r^2 vanishes
                     const double sensible = phase.specific_heat_capacity
                                             * (solution.temperature(r, problem.time)
                                                - material.melting_temperature);
                     return measure(solution.symmetry(), r) * phase.density
                            * (sensible + (solid ? 0 : material.latent_heat));
                   },
                   0, 1);
      };
      const double split = std::clamp(solution.front(problem.time), lower, upper);
      const bool solid = solution.solid_at_origin();
      return integrate(lower, split, solid) + integrate(split, upper, !solid);
    }

    /** Heat content far beyond the front, minus the same at t = 0. */
    double heat_gained(const ExactSolution &solution, double outer, double time)
    {
      return solution.heat_content(0, outer, time) - solution.heat_content(0, outer, 0);
    }
  } // namespace

  TEST(HeatContent, AgreesWithAdaptiveQuadrature)
  {
    for(const Problem &problem : problems())
    {
      const double front = problem.solution->front(problem.time);
      const double pairs[][2]
          = {{0, 0.3},    {0, 1},    {0, 4},       {0.05, 0.2}, {0.4, 0.41},
             {0.45, 0.9}, {0.6, 3.}, {0.99, 1.01}, {1, 1.5},    {2.5, 2.6}};
      for(const auto &[from, to] : pairs)
      {
        const double expected = integrated_enthalpy(problem, from * front, to * front);
        const double scale
            = std::abs(problem.solution->heat_content(front, to * front, problem.time));
        EXPECT_NEAR(
            problem.solution->heat_content(from * front, to * front, problem.time),
            expected, 1e-12 * std::max(std::abs(expected), 1e-3 * scale))
            << problem.solution->description() << ": " << from << " ... " << to;
      }
    }
  }

  TEST(HeatContent, IsAdditive)
  {
    for(const Problem &problem : problems())
    {
      const ExactSolution &solution = *problem.solution;
      const double outer = 5 * solution.front(problem.time);
      const int cells = 200;
      double sum = 0;
      for(int i = 0; i < cells; ++i)
        sum += solution.heat_content(outer * i / cells, outer * (i + 1) / cells,
                                     problem.time);
      const double liquid = solution.heat_content(outer / 5, outer, problem.time);
      EXPECT_NEAR(sum, solution.heat_content(0, outer, problem.time),
                  1e-13 * std::abs(liquid))
          << solution.description();
    }
  }

  /** What is drawn at the wall or the sink is missing in the whole. */
  TEST(HeatContent, ClosesTheHeatBudget)
  {
    const double time = 86400, pi = std::numbers::pi;
    const Material material = water();
    const PlanarNeumann plane(material, -10, 10);
    const double a = material.solid.diffusivity();
    const double drawn = 2 * material.solid.conductivity * 10 * std::sqrt(time)
                         / (std::sqrt(pi * a) * std::erf(plane.lambda()));
    expect_relative(heat_gained(plane, 3, time), -drawn, 1e-13);

    const LineSink line(material, 0.15, 10);
    expect_relative(heat_gained(line, 3, time), -line.strength() * time, 1e-12);
    expect_relative(heat_gained(line, 6, 475000), -line.strength() * 475000, 1e-12);

    const PointSink point(material, 0.15, 10);
    expect_relative(heat_gained(point, 3, time), -point.energy(time), 1e-11);

    for(const Symmetry symmetry :
        {Symmetry::planar, Symmetry::cylindrical, Symmetry::spherical})
    {
      const FrankGrowth growth(Material{}, symmetry, -0.5);
      EXPECT_NEAR(heat_gained(growth, 20, 1), 0, 1e-13 * growth.heat_content(0, 20, 0));
    }
  }

  TEST(HeatContent, AtTheStart)
  {
    const PlanarNeumann plane(water(917), -10, 10);
    EXPECT_EQ(plane.front(0), 0);
    EXPECT_EQ(plane.temperature(0, 0), -10);
    EXPECT_EQ(plane.temperature(1e-300, 0), 10);
    expect_relative(plane.heat_content(0.2, 0.7, 0), 0.5 * 1000 * (333500 + 41900),
                    1e-15);
    EXPECT_EQ(PlanarNeumann(water(), -10, 0).temperature(0.5, 0), 0);

    const LineSink line(water(), 0.15, 10);
    EXPECT_EQ(line.temperature(0, 0), 10);
    EXPECT_EQ(line.temperature(0.1, 0), 10);
    EXPECT_EQ(line.temperature(0, 1), -std::numeric_limits<double>::infinity());
    expect_relative(line.heat_content(0, 1, 0),
                    std::numbers::pi * 1000 * (333500 + 41900), 1e-15);
  }

  TEST(ClosedForms, RejectDataTheyDoNotHoldFor)
  {
    EXPECT_THROW(PlanarNeumann(water(), -10, -1), InputError);
    EXPECT_THROW(PlanarNeumann(water(), 0, 10), InputError);
    EXPECT_THROW(PlanarNeumann(water(), 10, 1), InputError);
    EXPECT_THROW(PlanarNeumann(water(), std::nan(""), 1), InputError);
    Material material = water();
    material.liquid.conductivity = 0;
    EXPECT_THROW(PlanarNeumann(material, -10, 10), InputError);
    EXPECT_THROW(LineSink(water(), 0, 10), InputError);
    EXPECT_THROW(LineSink(water(), 0.15, -1), InputError);
    EXPECT_THROW(LineSink(water(917), 0.15, 10), InputError);
    EXPECT_THROW(PointSink(water(917), 0.15, 10), InputError);
    EXPECT_THROW(FrankGrowth(Material{}, Symmetry::planar, -1), InputError);
    EXPECT_THROW(FrankGrowth(Material{}, Symmetry::planar, 0.1), InputError);
    EXPECT_THROW(FrankGrowth(Material{}, Symmetry::none, -0.5), InputError);
  }

  TEST(ClosedForms, AreSymmetricFields)
  {
    const LineSink line(water(), 0.15, 10);
    EXPECT_EQ(line.temperature(Position{0.3, -0.4, 7}, 475000),
              line.temperature(0.5, 475000));
    const double front = line.front(475000);
    EXPECT_NEAR(line.signed_distance(Position{0, front + 0.1, 0}, 475000), 0.1, 1e-15);
    EXPECT_TRUE(line.solid_at_origin());
    EXPECT_FALSE(PlanarNeumann(water(), 10, -10).solid_at_origin());
  }
} // namespace meltfront::cases
