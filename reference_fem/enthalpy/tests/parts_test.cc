#include <cases/error.h>
#include <cases/scene.h>
#include <reference_fem/enthalpy/compensated_vector.h>
#include <reference_fem/enthalpy/graph.h>
#include <reference_fem/enthalpy/linear_solver.h>
#include <reference_fem/enthalpy/mesh.h>
#include <reference_fem/enthalpy/tests/support.h>
#include <reference_fem/enthalpy/time_scheme.h>

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>
#include <random>

namespace meltfront::reference_fem
{
  namespace
  {
    using namespace tests;
    using cases::Position;
    using cases::Side;

    TEST(EnthalpyGraph, ResolvesTheInclusionOnBothSidesAndOnTheJump)
    {
      const cases::Material material = water();
      const EnthalpyGraph<true, true> graph(material);
      const double volume = 0.3, stiffness = 1e6;
      for(const double u : {-7., -1e-9, 1e-9, 4.})
      {
        const double heat = volume * graph.enthalpy(u) + stiffness * u;
        EXPECT_NEAR(graph.resolve(heat, volume, stiffness), u,
                    1e-13 * std::abs(u) + 1e-12);
      }
      const double latent = volume * material.solid.density * material.latent_heat;
      for(const double share : {0., 0.25, 1.})
        EXPECT_EQ(graph.resolve(share * latent, volume, stiffness), 0);
    }

    TEST(EnthalpyGraph, AgreesWithTheMaterial)
    {
      const cases::Material material = water();
      const EnthalpyGraph<true, true> graph(material);
      for(const double temperature : {-12., -0.1, 0.1, 30.})
      {
        const double u = graph.kirchhoff(temperature);
        EXPECT_NEAR(graph.temperature_excess(u), temperature, 1e-14 * 30);
        EXPECT_NEAR(graph.enthalpy(u) / material.solid.density,
                    material.enthalpy(temperature), 1e-9 * material.latent_heat);
        EXPECT_NEAR(graph.temperature_excess_at_enthalpy(graph.enthalpy(u)), temperature,
                    1e-10);
      }
    }

    TEST(CompensatedVector, KeepsDifferencesFarBelowRoundOff)
    {
      CompensatedVector vector(2);
      vector.set(0, 1e9);
      vector.set(1, 1e9);
      for(int i = 0; i < 1000; ++i)
        vector.add(1, 1e-12);
      EXPECT_EQ(vector[0], vector[1]);
      EXPECT_NEAR(vector.difference(1, 0), 1e-9, 1e-22);
      cases::CompensatedSum sum;
      vector.add_difference(1, 0, 3, sum);
      EXPECT_NEAR(sum.value(), 3e-9, 1e-22);
    }

    TEST(CompensatedSum, LosesNothingToCancellation)
    {
      cases::CompensatedSum sum;
      sum.add(1e16);
      sum.add_product(1 + 1e-8, 1 - 1e-8);
      sum.add(-1e16);
      EXPECT_DOUBLE_EQ(sum.value(), 1);
    }

    TEST(TimeScheme, Bdf2IsExactForQuadraticsWithUnequalSteps)
    {
      const double before = 0.3, now = 0.5, next = 0.9;
      const StepFormula step = bdf2_step(before, now, next);
      const auto value = [](double t) { return 2 - 3 * t + 5 * t * t; };
      const auto slope = [](double t) { return -3 + 10 * t; };
      EXPECT_NEAR(step.combine(value(now), value(before)) + step.c * slope(next),
                  value(next), 1e-14);
      EXPECT_NEAR(step.weight_now + step.weight_before, 1, 1e-15);
    }

    TEST(TimeScheme, StepsEndExactlyAndNeverMoreThanDouble)
    {
      StepQueue queue(0.1, 0.7, 7, 4);
      queue.halve(0.1);
      double now = 0.1, last = 0;
      int steps = 0;
      for(; !queue.empty(); ++steps)
      {
        if(steps == 8)
          queue.halve(now);
        const double size = queue.next() - now;
        ASSERT_GT(size, 0);
        if(last > 0)
        {
          EXPECT_LE(size / last, 2 + 1e-9);
        }
        last = size;
        now = queue.next();
        queue.pop();
      }
      EXPECT_EQ(now, 0.7);
      EXPECT_EQ(steps, 7 + 4 + 2);
    }

    /** Largest residual of (D + c K) x = r on active nodes. */
    double residual(const ConductionMatrix &matrix, const NewtonSystem &system,
                    const std::vector<double> &x)
    {
      double largest = 0;
      for(std::size_t i = 0; i < x.size(); ++i)
        if(system.active[i])
          largest = std::max(largest, std::abs(system.heat_capacity[i] * x[i]
                                               + system.step_factor * matrix.product(i, x)
                                               - system.residual[i]));
        else
        {
          EXPECT_EQ(x[i], 0);
        }
      return largest;
    }

    TEST(LinearSolver, SolvesTheTruncatedSystemInEveryDimension)
    {
      const cases::Scene scene = slab(normalised_material(), 1, 1.2, 0, 1);
      std::mt19937 random(7);
      std::uniform_real_distribution<double> uniform(0.1, 1);
      for(const int dimension : {1, 2, 3})
      {
        const Discretisation mesh = make_mesh(scene, dimension, 16)->discretise();
        const std::size_t n = mesh.volume.size();
        std::vector<double> capacity(n), right(n), x(n);
        std::vector<char> active(n);
        for(std::size_t i = 0; i < n; ++i)
        {
          active[i] = uniform(random) > 0.3;
          capacity[i] = mesh.volume[i] * uniform(random);
          right[i] = uniform(random) - 0.5;
        }
        const NewtonSystem system{capacity, 0.05, active, right, 0};
        std::vector<std::unique_ptr<LinearSolver>> solvers;
        if(dimension == 1)
          solvers.push_back(make_tridiagonal_solver(mesh.conduction));
        else
          for(const auto kind : {Preconditioner::ssor, Preconditioner::amg})
            solvers.push_back(make_krylov_solver(mesh.conduction, kind));
        solvers.push_back(make_multigrid_solver(
            mesh.conduction,
            std::make_shared<const Levels>(lattice_levels(*mesh.lattice))));
        for(const auto &solver : solvers)
        {
          solver->solve(system, 1e-12, x);
          EXPECT_LT(residual(mesh.conduction, system, x), 1e-10) << dimension;
          EXPECT_GT(solver->work(), 0);
        }
      }
    }

    TEST(Mesh, VolumesAndWallsHaveTheMeasureOfTheScene)
    {
      const auto total = [](const std::vector<double> &values)
      { return std::accumulate(values.begin(), values.end(), 0.); };
      const auto wall = [](const Discretisation &mesh, Side side)
      {
        double area = 0;
        for(const WallNode &node : mesh.walls[static_cast<std::size_t>(side)])
          area += node.area;
        return area;
      };
      const cases::Scene plane = slab(water(), 2.5, 1, 0, 1);
      for(const int dimension : {1, 2, 3})
      {
        const Discretisation mesh = make_mesh(plane, dimension, 10)->discretise();
        EXPECT_NEAR(total(mesh.volume), 2.5, 1e-13);
        EXPECT_NEAR(total(mesh.site_weights), 2.5, 1e-13);
        EXPECT_NEAR(wall(mesh, Side::x_min), 1, 1e-14);
        EXPECT_TRUE(mesh.conduction.is_monotone());
        EXPECT_EQ(mesh.cells.size() >> dimension, dimension == 1   ? 10u
                                                  : dimension == 2 ? 40u
                                                                   : 160u);
      }
      const double radius = 0.7, pi = std::numbers::pi;
      for(const int dimension : {2, 3})
      {
        const cases::Scene round = ball(water(), dimension, radius, 1, 1);
        const double volume
            = dimension == 2 ? pi * radius * radius : 4. / 3. * pi * std::pow(radius, 3);
        const double area = dimension == 2 ? 2 * pi * radius : 4 * pi * radius * radius;
        const Discretisation radial = make_mesh(round, 1, 9)->discretise();
        EXPECT_NEAR(total(radial.volume), volume, 1e-13);
        EXPECT_NEAR(wall(radial, Side::outer), area, 1e-13);
        EXPECT_NEAR(radial.spacing, radius / 5, 1e-15);
        const Discretisation full = make_mesh(round, dimension, 16)->discretise();
        EXPECT_NEAR(total(full.volume), volume, 1e-5 * volume);
        EXPECT_NEAR(wall(full, Side::outer), area, 1e-5 * area);
      }
      const Discretisation block
          = make_mesh(box(water(), 3, {-1, 0, 2}, {1, 1.3, 2.5}, 1, 1), 3, 8)
                ->discretise();
      EXPECT_NEAR(total(block.volume), 2 * 1.3 * 0.5, 1e-12);
      EXPECT_NEAR(wall(block, Side::z_max), 2.6, 1e-12);
      EXPECT_TRUE(block.conduction.is_monotone());
    }

    TEST(Mesh, AveragesAtNodesHoldWhatJumpsAroundAWholeRing)
    {
      // Around a ring an error of a cell's rule adds up; the ones of many rings, all
      // within one cell, do not even out.
      const double radius = 0.7, pi = std::numbers::pi;
      const auto mesh = make_mesh(ball(water(), 2, radius, 1, 1), 2, 16);
      const Discretisation full = mesh->discretise();
      double worst = 0;
      for(const bool phases : {false, true})
        for(double ring = 0.40; ring < 0.46; ring += 0.007)
        {
          const auto inside
              = [ring](const Position &p) { return std::hypot(p[0], p[1]) < ring; };
          const std::vector<double> averages = mesh->node_averages(
              [&](const Position &p) { return inside(p) ? 3. : 1.; },
              [&](const Position &p) { return phases && inside(p); }, !phases);
          const double held = std::inner_product(averages.begin(), averages.end(),
                                                 full.volume.begin(), 0.);
          const double within = (held - pi * radius * radius) / 2;
          worst = std::max(worst, std::abs(std::sqrt(within / pi) - ring));
        }
      EXPECT_LT(worst, 0.01 * full.spacing);
    }

    TEST(Mesh, SharesOfASourceReproduceItsPosition)
    {
      const cases::Scene scene = box(water(), 2, {-1, 0, 0}, {1, 1, 0}, 1, 1);
      const auto mesh = make_mesh(scene, 2, 8);
      const Discretisation plain = mesh->discretise();
      for(const Position point : {Position{0.113, 0.771, 0}, {0, 0.5, 0}, {1, 1, 0}})
      {
        double sum = 0, x = 0, y = 0;
        for(const auto &[node, share] : mesh->shares(point))
        {
          sum += share;
          x += share * plain.positions[node][0];
          y += share * plain.positions[node][1];
        }
        EXPECT_NEAR(sum, 1, 1e-14);
        EXPECT_NEAR(x, point[0], 1e-12);
        EXPECT_NEAR(y, point[1], 1e-12);
      }
      EXPECT_EQ(mesh->shares({0, 0.5, 0}).size(), 1u);
      EXPECT_THROW(mesh->shares({1.5, 0.5, 0}), cases::InputError);
    }
  } // namespace
} // namespace meltfront::reference_fem
