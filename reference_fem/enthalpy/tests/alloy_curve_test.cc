#include <cases/error.h>
#include <cases/exact/mushy_layer.h>
#include <reference_fem/enthalpy/mush_conduction.h>
#include <reference_fem/enthalpy/mush_graph.h>
#include <reference_fem/enthalpy/tests/alloy_support.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meltfront::reference_fem::tests
{
  namespace
  {
    using namespace cases;

    constexpr double infinity = std::numeric_limits<double>::infinity();

    /** Falls ever more steeply: d = 25 C + 45 C^2, known up to 0.6 (31.2 K). */
    double curve(double c)
    {
      return c * (25 + 45 * c);
    }

    /** Its inverse in closed form. */
    double curve_inverse(double depression)
    {
      return 2 * depression / (25 + std::sqrt(625 + 180 * depression));
    }

    Alloy curved(double eutectic = Alloy().eutectic_temperature)
    {
      Alloy alloy;
      Solute salt{"salt"};
      salt.liquidus_curve = curve;
      salt.largest_concentration = 0.6;
      alloy.solutes = {salt};
      alloy.crystal_density = 917;
      alloy.eutectic_temperature = eutectic;
      return alloy;
    }

    /** A straight liquidus as a table, by which it becomes a curve. */
    void state_as_table(Solute &solute)
    {
      std::vector<std::pair<double, double>> points;
      for(const double c : {0., 0.05, 0.12, 0.2, 0.35, 0.5, 0.6})
        points.emplace_back(c, -slope * c);
      solute.liquidus_curve = liquidus_through(points, 0);
      solute.largest_concentration = 0.6;
      solute.liquidus_slope = 0;
    }

    Scene freezing(double end = 91800)
    {
      Scene scene = melt(0.5, start_temperature, end);
      set_boundary(scene, Side::x_min, fixed_wall(wall));
      return scene;
    }

    Scene freezing_on_curve(double end = 91800)
    {
      Scene scene = freezing(end);
      scene.alloy = curved();
      return scene;
    }

    TEST(Liquidus, IsInvertedToRoundOff)
    {
      const Liquidus line(curved());
      EXPECT_FALSE(line.straight());
      for(const double depression : {1e-9, 1e-4, 0.1, 3., 5.9192, 16.5, 31.2})
      {
        const double solute = curve_inverse(depression);
        EXPECT_NEAR(line.solute_at(depression), solute, 1e-15 * solute);
        EXPECT_NEAR(line.depression(solute), depression, 1e-15 + 1e-15 * depression);
      }
      for(const double solute : {0.01, 0.14, 0.3, 0.59})
        EXPECT_NEAR(line.slope(solute), 25 + 90 * solute, 1e-7);
      EXPECT_NEAR(line.slope(0), 25, 1e-3);
      EXPECT_EQ(line.solute_at(0), 0);
      EXPECT_EQ(line.solute_at(-4), 0);
      EXPECT_NEAR(line.largest_depression(), 31.2, 1e-14);
      // Beyond what is known it goes on and still is its own inverse.
      EXPECT_NEAR(line.depression(line.solute_at(90)), 90, 1e-12);
    }

    TEST(Liquidus, MeanDilutionIsTheIntegral)
    {
      const Liquidus line(curved());
      const auto dilution
          = [](double depression) { return 1 / curve_inverse(depression); };
      for(const double low : {1e-6, 0.3, 7., 16.})
        for(const double share : {1.001, 1.03, 1.6, 1.9})
        {
          const double integral
              = boost::math::quadrature::gauss_kronrod<double, 61>::integrate(
                  dilution, low, share * low, 10, 1e-14);
          EXPECT_NEAR(line.mean_dilution(low, share * low),
                      integral / ((share - 1) * low), 2e-13 * dilution(low));
        }
      // Temperatures that nearly agree: nothing cancels.
      EXPECT_NEAR(line.mean_dilution(7, 7 + 1e-12), dilution(7), 1e-12);
    }

    TEST(Liquidus, MustFall)
    {
      Alloy alloy = curved();
      alloy.solutes[0].liquidus_curve = [](double c) { return c * (0.8 - c); };
      EXPECT_THROW(Liquidus{alloy}, InputError);
      alloy.solutes[0].liquidus_curve = [](double c) { return 1 + c; };
      EXPECT_THROW(Liquidus{alloy}, InputError);
      alloy.solutes[0].liquidus_curve = [](double) { return std::nan(""); };
      EXPECT_THROW(Liquidus{alloy}, InputError);
    }

    /** Lever rule and energy of a cell, by a bracketed root over the temperature. */
    double excess_by_lever_rule(double enthalpy, double concentration)
    {
      const auto surplus = [&](double excess)
      {
        const double f = std::min(concentration / curve_inverse(-excess), 1.);
        return (1 - f) * 2006 * excess + f * (4180 * excess + 334400) - enthalpy;
      };
      std::uintmax_t iterations = 200;
      const auto bracket = boost::math::tools::toms748_solve(
          surplus, -31., -1e-9, boost::math::tools::eps_tolerance<double>(53),
          iterations);
      return 0.5 * (bracket.first + bracket.second);
    }

    TEST(CurvedMushGraph, StateIsTheLeverRules)
    {
      const double density = 1097;
      const MushGraph graph(solvent(), curved());
      const PhaseDiagram diagram(solvent(), curved());
      for(const double concentration : {1e-4, 0.02, 0.14, 0.4})
      {
        const Composition node = graph.composition(concentration);
        const double whole = 334400 - 4180 * curve(concentration);
        for(const double share : {0.95, 0.7, 0.5, 0.3})
        {
          const double enthalpy = diagram.enthalpy(
              -curve(concentration) * share - 30 * (1 - share), concentration);
          ASSERT_LT(enthalpy, whole);
          const double excess = excess_by_lever_rule(enthalpy, concentration);
          const PhaseState state = graph.state(density * enthalpy, node);
          EXPECT_NEAR(state.temperature, excess, 1e-12);
          EXPECT_NEAR(state.liquid_fraction, concentration / curve_inverse(-excess),
                      1e-12);
          const PhaseState other = diagram.equilibrium(enthalpy, concentration);
          EXPECT_NEAR(state.temperature, other.temperature, 1e-12);
          EXPECT_NEAR(graph.enthalpy(excess, node), density * enthalpy,
                      1e-12 * density * 334400);
        }
      }
    }

    TEST(CurvedMushGraph, SlopeIsTheDerivativeAndTheInclusionIsResolved)
    {
      const MushGraph graph(solvent(), curved(-18));
      const double volume = 0.3, d = 1e-4;
      for(const double solute : {0., 1e-6, 0.01, 0.14, 0.39, 0.5})
      {
        const Composition node = graph.composition(solute);
        for(const double excess : {-30., -17., -8.3, -0.3, -1e-3, 9.})
        {
          if(std::abs(excess) > 10 * d)
          {
            const double quotient
                = (graph.enthalpy(excess + d, node) - graph.enthalpy(excess - d, node))
                  / (2 * d);
            EXPECT_NEAR(graph.slope(excess, node), quotient, 1e-6 * quotient);
          }
          for(const double stiffness : {1e2, 1e6, 1e9})
            EXPECT_NEAR(
                graph.resolve(volume * graph.enthalpy(excess, node) + stiffness * excess,
                              volume, stiffness, node),
                excess, 1e-9);
        }
        const double jump = graph.jump(node), lower = graph.lower_enthalpy(jump);
        const double step = graph.enthalpy(jump, node) - lower;
        EXPECT_NEAR(graph.state(lower + 0.4 * step, node).temperature, jump, 1e-12);
      }
      // What is liquid when the eutectic is reached.
      EXPECT_NEAR(graph.eutectic_liquid_fraction(graph.composition(0.14)),
                  0.14 / curve_inverse(18), 1e-15);
    }

    TEST(CurvedMushConductivity, IsTheMeanOfTheMixture)
    {
      for(const double density : {917., 1097., 1300.})
      {
        Alloy alloy = curved(-18);
        alloy.crystal_density = density;
        const MushConductivity conductivity(solvent(), alloy);
        const PhaseDiagram diagram(solvent(), alloy);
        const MushGraph graph(solvent(), alloy);
        const double c = 0.14;
        const auto at = [&](double excess)
        { return diagram.conductivity(diagram.solid_fraction(excess, c)); };
        std::vector<double> ends{-30, -18, -17.9, -9, -8, -curve(c), -1, 20};
        if(density < 1097)
          ends.push_back(-curve(c / (1 - density / 1097)));
        std::sort(ends.begin(), ends.end());
        for(std::size_t i = 0; i < ends.size(); ++i)
        {
          double integral = 0;
          for(std::size_t j = i + 1; j < ends.size(); ++j)
          {
            integral += boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
                at, ends[j - 1], ends[j], 8, 1e-12);
            EXPECT_NEAR(conductivity.mean(ends[i], ends[j], graph.composition(c)),
                        integral / (ends[j] - ends[i]), 1e-10);
          }
        }
        EXPECT_NEAR(conductivity.mean(-9, -9, graph.composition(c)), at(-9), 1e-13);
      }
    }

    TEST(CurvedAlloy, AStraightLineAsATableIsTheStraightLine)
    {
      Scene straight = freezing();
      for(const bool diffuses : {false, true})
        for(const double eutectic : {-infinity, -12.})
        {
          straight.alloy->solutes[0].diffusivity = diffuses ? diffusivity : 0;
          straight.alloy->eutectic_temperature = eutectic;
          Scene table = straight;
          state_as_table(table.alloy->solutes[0]);
          const RunRecord a = run(straight, 40), b = run(table, 40);
          expect_same(a, b, diffuses ? 1e-8 : 1e-9);
          expect_closed(b);
          for(std::size_t i = 0; i < a.temperature.size(); ++i)
            EXPECT_NEAR(a.concentration[0][i], b.concentration[0][i], 1e-9);
        }
    }

    TEST(CurvedAlloy, MeetsTheSimilaritySolution)
    {
      const auto exact = std::make_shared<const MushyLayer>(
          solvent(), curved(), std::vector<double>{bulk}, wall, start_temperature);
      Scene scene = freezing_on_curve();
      set_boundary(scene, Side::x_max, exact_wall(exact));
      const std::vector<int> n{30, 60, 120, 240};
      std::vector<double> errors;
      for(const int cells : n)
      {
        const RunRecord record = run(scene, cells);
        expect_closed(record);
        double sum = 0, total = 0;
        for(std::size_t i = 0; i < record.temperature.size(); ++i)
        {
          const double off
              = record.temperature[i] - exact->temperature(record.positions[0][i], 91800);
          sum += record.weights[i] * off * off;
          total += record.weights[i];
        }
        errors.push_back(std::sqrt(sum / total));
      }
      EXPECT_LE(errors[2], 6e-3);
      EXPECT_LE(errors[3], 2e-3);
      EXPECT_GE(fitted_order(n, errors), 1.5);
    }

    TEST(CurvedAlloy, ConservesWithDiffusionAndMeltsBack)
    {
      Scene scene = freezing_on_curve(2e6);
      scene.alloy->solutes[0].diffusivity = diffusivity;
      set_boundary(scene, Side::x_min,
                   varying_wall([](double time)
                                { return time < 13200 ? wall : start_temperature; }));
      const RunRecord record = run(scene, 40, {{"steps", "1000"}});
      expect_closed(record);
      EXPECT_GT(*std::max_element(record.front.begin(), record.front.end()), 0.01);
      EXPECT_EQ(total_solid(record), 0);
    }

    /** Left to itself an insulated slab of even composition ends in equilibrium. */
    TEST(CurvedAlloy, EvensOutToTheLeverRule)
    {
      Scene scene = melt(0.05, 0, 1e7);
      scene.alloy = curved();
      scene.initial.temperature = along_x([](double x) { return x < 0.026 ? -14. : 6.; });
      const RunRecord record = run(scene, 20);
      expect_closed(record);
      const PhaseDiagram diagram(solvent(), curved());
      // Ten and a half of twenty cells are cold.
      const double enthalpy
          = (10.5 * diagram.enthalpy(-14, bulk) + 9.5 * diagram.enthalpy(6, bulk)) / 20;
      const double expected = excess_by_lever_rule(enthalpy, bulk);
      for(const double temperature : record.temperature)
        EXPECT_NEAR(temperature, expected, 1e-9);
    }

    TEST(CurvedAlloy, ColderThanTheLiquidusIsKnownIsSaid)
    {
      Scene scene = freezing_on_curve();
      set_boundary(scene, Side::x_min, fixed_wall(-35));
      EXPECT_THROW(run(scene, 20), InputError);
      scene.alloy->eutectic_temperature = -25;
      expect_closed(run(scene, 20));
      scene.alloy->solutes.push_back({"second", 10});
      scene.initial.concentration.push_back(Field::uniform(0.01));
      EXPECT_THROW(run(scene, 20), InputError);
    }
  } // namespace
} // namespace meltfront::reference_fem::tests
