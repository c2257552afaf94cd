#include <particles/rkpm_tracked/line/band_matrix.h>
#include <particles/rkpm_tracked/line/history.h>
#include <particles/rkpm_tracked/line/stencils.h>
#include <particles/rkpm_tracked/line/tests/cases.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    TEST(BandMatrix, SolvesWithRowExchanges)
    {
      constexpr std::size_t n = 30, below = 3, above = 2;
      std::mt19937 random(1);
      std::uniform_real_distribution<double> value(-1, 1);
      BandMatrix matrix;
      matrix.reset(n, below, above);
      std::vector<double> solution(n), right(n, 0.);
      for(double &x : solution)
        x = value(random);
      for(std::size_t i = 0; i < n; ++i)
        for(std::size_t j = i - std::min(i, below); j < std::min(n, i + above + 1); ++j)
        {
          // A diagonal of zeros: no elimination without exchanges.
          matrix(i, j) = i == j ? 0. : value(random);
          right[i] += matrix(i, j) * solution[j];
        }
      ASSERT_TRUE(matrix.solve(right));
      for(std::size_t i = 0; i < n; ++i)
        EXPECT_NEAR(right[i], solution[i], 1e-10);
    }

    TEST(BandMatrix, TellsASingularOne)
    {
      BandMatrix matrix;
      matrix.reset(3, 1, 1);
      matrix(0, 0) = matrix(0, 1) = matrix(1, 0) = matrix(1, 1) = 1;
      std::vector<double> right{1, 2, 3};
      EXPECT_FALSE(matrix.solve(right));
    }

    TEST(Differentiation, EqualStepsGiveTheKnownWeights)
    {
      const std::vector<double> known[]
          = {{1, -1}, {1.5, -2, 0.5}, {11. / 6, -3, 1.5, -1. / 3}};
      for(const std::vector<double> &weights : known)
      {
        std::vector<double> times;
        for(std::size_t j = 0; j < weights.size(); ++j)
          times.push_back(5 - 0.25 * static_cast<double>(j));
        const std::vector<double> found = differentiation_weights(times);
        for(std::size_t j = 0; j < weights.size(); ++j)
          EXPECT_NEAR(found[j], weights[j] / 0.25, 1e-12);
      }
    }

    TEST(Differentiation, UnequalStepsAreExactForPolynomials)
    {
      const std::vector<double> times{2, 1.7, 1.1, 0.9};
      const std::vector<double> weights = differentiation_weights(times);
      for(int power = 0; power <= 3; ++power)
      {
        double sum = 0;
        for(std::size_t j = 0; j < times.size(); ++j)
          sum += weights[j] * std::pow(times[j], power);
        EXPECT_NEAR(sum, power == 0 ? 0 : power * std::pow(2., power - 1), 1e-11);
      }
    }

    /** Slope and second derivative of x^power at a place of a cloud. */
    std::array<double, 2> apply(const LineStencil &stencil, const ParticleStorage &cloud,
                                int power)
    {
      std::array<double, 2> result{};
      for(std::size_t j = 0; j < stencil.size(); ++j)
      {
        const double value = std::pow(cloud.position[0][stencil.first + j], power);
        result[0] += stencil.slope[j] * value;
        result[1] += stencil.second[j] * value;
      }
      return result;
    }

    TEST(Stencils, ReproducePolynomialsBesideAFront)
    {
      ParticleStorage cloud;
      cloud.dimension = 1;
      cloud.add({0.13, 0, 0});
      for(int i = 2; i <= 12; ++i)
        cloud.add({0.1 * i, 0, 0});
      for(const int order : {2, 3, 4})
      {
        LineStencils stencils(order);
        LineStencil stencil;
        for(const double place : cloud.position[0])
        {
          stencils.evaluate(place, 0.1 * default_dilation(order), cloud, stencil);
          EXPECT_GE(stencil.size(), static_cast<std::size_t>(order) + 2);
          for(int power = 0; power <= order; ++power)
          {
            const auto [slope, second] = apply(stencil, cloud, power);
            EXPECT_NEAR(slope, power == 0 ? 0 : power * std::pow(place, power - 1),
                        1e-10);
            EXPECT_NEAR(second,
                        power < 2 ? 0 : power * (power - 1) * std::pow(place, power - 2),
                        1e-8);
          }
        }
      }
    }

    TEST(Stencils, FewPointsLowerTheOrder)
    {
      ParticleStorage two;
      two.dimension = 1;
      two.add({0.2, 0, 0});
      two.add({0.2001, 0, 0});
      LineStencils stencils(3);
      LineStencil stencil;
      stencils.evaluate(0.2, 0.36, two, stencil);
      ASSERT_EQ(stencil.size(), 2U);
      EXPECT_NEAR(stencil.slope[1] * 1e-4, 1., 1e-9);
      EXPECT_NEAR(stencil.slope[0] * 1e-4, -1., 1e-9);
      ParticleStorage three = two;
      three.add({0.3, 0, 0});
      stencils.evaluate(0.3, 0.36, three, stencil);
      const auto [slope, second] = apply(stencil, three, 2);
      EXPECT_NEAR(slope, 0.6, 1e-7);
      EXPECT_NEAR(second, 2., 1e-5);
    }

    TEST(History, ExtendsAPhaseAcrossItsFront)
    {
      const auto none = [](double) { return 0.; };
      LineProblem problem = unit_slab(bar_material(), 20, none, none);
      // Cubics that take the melting temperature on the front.
      const double front = 0.512;
      const auto liquid = [&](double x)
      {
        const double d = x - front;
        return 430 - 3 * d + 7 * d * d - 40 * d * d * d;
      };
      const auto solid = [&](double x)
      {
        const double d = x - front;
        return 430 - 5 * d - 2 * d * d + 30 * d * d * d;
      };
      LineState state;
      state.solid_first = false;
      state.fronts = {front};
      for(const double x : problem.nodes)
        state.temperature.push_back(x < front ? liquid(x) : solid(x));
      LineHistory history(problem, {});
      history.restart(state);
      for(const std::size_t node : {11, 12, 13})
        EXPECT_NEAR(history.temperature(0, node, 0), liquid(problem.nodes[node]), 1e-9);
      for(const std::size_t node : {10, 9, 8})
        EXPECT_NEAR(history.temperature(0, node, 1), solid(problem.nodes[node]), 1e-9);
      EXPECT_EQ(history.temperature(0, 5, 0), state.temperature[5]);
    }

    TEST(History, AThinLayerIsExtendedByAStraightLine)
    {
      const auto none = [](double) { return 0.; };
      LineProblem problem = unit_slab(bar_material(), 20, none, none);
      LineState state;
      state.solid_first = false;
      state.fronts = {0.01};
      state.temperature.assign(problem.nodes.size(), 400);
      state.temperature[0] = 500;
      LineHistory history(problem, {});
      history.restart(state);
      EXPECT_NEAR(history.temperature(0, 1, 0), 430 - 70. / 0.01 * 0.04, 1e-9);
    }
  } // namespace
} // namespace meltfront::particles::rkpm_tracked
