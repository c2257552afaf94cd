#include "integral_scenes.h"

#include <cases/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace meltfront::particles
{
  namespace
  {
    using namespace integral_scenes;
    constexpr double pi = std::numbers::pi;

    IntegralParameters with(KernelShape kernel, int order, double dilation)
    {
      IntegralParameters parameters;
      parameters.kernel = kernel;
      parameters.order = order;
      parameters.dilation = dilation;
      return parameters;
    }

    /** One set of weights at the report's dilation, met as well as it allows. */
    IntegralParameters published(WeightPolicy weights, KernelShape kernel)
    {
      IntegralParameters parameters = with(kernel, 3, 2.5);
      parameters.weights = weights;
      parameters.enlarge = false;
      return parameters;
    }

    std::vector<double> sine_errors(const IntegralParameters &parameters,
                                    std::uint8_t flux_sides)
    {
      std::vector<double> errors;
      for(const int n : {15, 30, 60, 120})
        errors.push_back(
            poisson_error(arrange(1, n, -pi, pi, 0, 1, flux_sides), parameters, sine()));
      return errors;
    }

    /** Geometric mean over five seeds. */
    double displaced_error(int dimension, int n, std::uint8_t flux_sides,
                           const IntegralParameters &parameters, const Solution &solution,
                           double lower, double upper)
    {
      double sum = 0;
      for(unsigned seed = 1; seed <= 5; ++seed)
        sum += std::log(
            poisson_error(arrange(dimension, n, lower, upper, 0.2, seed, flux_sides),
                          parameters, solution));
      return std::exp(sum / 5);
    }

    /** sin(pi x + 0.3) cos(1.5 pi y + 0.2) */
    Solution wave()
    {
      const auto x_part = [](double x) { return pi * x + 0.3; };
      const auto y_part = [](double y) { return 1.5 * pi * y + 0.2; };
      return {[=](double x, double y)
              { return std::sin(x_part(x)) * std::cos(y_part(y)); },
              [=](double x, double y)
              { return -3.25 * pi * pi * std::sin(x_part(x)) * std::cos(y_part(y)); },
              {[=](double x, double y)
               { return pi * std::cos(x_part(x)) * std::cos(y_part(y)); },
               [=](double x, double y)
               { return -1.5 * pi * std::sin(x_part(x)) * std::sin(y_part(y)); }}};
    }

    TEST(IntegralRows, AreExactForPolynomialsUpToTheConstraintOrder)
    {
      for(const int dimension : {1, 2})
        for(const int order : {3, 4})
          for(const std::uint8_t flux_sides : {0, 2, 15})
            for(const bool sampled : {false, true})
            {
              const Particles particles
                  = arrange(dimension, 14, -0.3, 0.7, 0.2, 7, flux_sides);
              IntegralParameters parameters
                  = with(KernelShape::wendland_c4, order, dimension == 1 ? 2.5 : 3.5);
              parameters.sampled_moments = sampled;
              const IntegralRows rows
                  = integral_rows(particles.nodes, particles.walls, parameters);
              EXPECT_LT(rows.largest_residual, 1e-11);
              for(const Exponents &e : monomials(dimension, order))
                EXPECT_LT(row_defect(particles, rows, monomial(e[0], e[1])), 1e-11)
                    << dimension << ' ' << order << ' ' << int(flux_sides) << ' ' << e[0]
                    << ' ' << e[1];
            }
    }

    TEST(IntegralRows, HaveTheParabolaExactlyWithAllKernelsButOne)
    {
      // Equation (3.16).
      Solution parabola = monomial(2, 0);
      parabola.value = [](double x, double) { return x * x - pi * pi; };
      for(const std::string &name : kernel_names())
      {
        const KernelShape kernel = kernel_shape(name);
        if(kernel == KernelShape::hat || kernel == KernelShape::epanechnikov)
          continue;
        for(const int n : {15, 30, 60, 120})
          for(const std::uint8_t flux_sides : {0, 2})
            EXPECT_LT(poisson_error(arrange(1, n, -pi, pi, 0, 1, flux_sides),
                                    with(kernel, 3, 2.5), parabola),
                      1e-11)
                << name << ' ' << n;
      }
      EXPECT_LT(poisson_error(arrange(1, 120, -pi, pi, 0, 1, 0),
                              published(WeightPolicy::single, KernelShape::epanechnikov),
                              parabola),
                1e-11);
    }

    TEST(IntegralRows, ConvergeOnASineAsTheirOrderSays)
    {
      // Equation (3.17), N = 15, 30, 60, 120.
      for(const KernelShape kernel :
          {KernelShape::cubic_spline, KernelShape::wendland_c4})
      {
        const auto third = sine_errors(with(kernel, 3, 2.5), 0);
        EXPECT_LT(third.back(), 1.5e-4);
        EXPECT_GT(std::log2(third.front() / third.back()) / 3, 1.8);
        const auto fourth = sine_errors(with(kernel, 4, 2.5), 0);
        EXPECT_LT(fourth.back(), 3e-7);
        EXPECT_GT(std::log2(fourth.front() / fourth.back()) / 3, 3.8);
        const auto third_flux = sine_errors(with(kernel, 3, 2.5), 2);
        EXPECT_LT(third_flux.back(), 6e-4);
        EXPECT_GT(orders(third_flux).back(), 1.8);
        const auto fourth_flux = sine_errors(with(kernel, 4, 2.5), 2);
        EXPECT_LT(fourth_flux.back(), 4e-6);
        EXPECT_GT(orders(fourth_flux).back(), 3.8);
      }
    }

    TEST(IntegralRows, ConvergeOnDisplacedParticles)
    {
      for(const int order : {3, 4})
      {
        std::vector<double> errors;
        for(const int n : {15, 30, 60, 120})
          errors.push_back(displaced_error(
              1, n, 0, with(KernelShape::wendland_c4, order, 2.5), sine(), -pi, pi));
        EXPECT_GT(std::log2(errors.front() / errors.back()) / 3, order == 3 ? 1.8 : 3.8);
        EXPECT_LT(errors.back(), order == 3 ? 1e-4 : 5e-7);
      }
    }

    TEST(IntegralRows, ConvergeInThePlane)
    {
      for(const std::uint8_t flux_sides : {0, 2})
      {
        const double dilation = flux_sides == 0 ? 2.6 : 3.5;
        std::vector<double> errors;
        for(const int n : {9, 13, 19, 27})
          errors.push_back(displaced_error(2, n, flux_sides,
                                           with(KernelShape::wendland_c4, 3, dilation),
                                           wave(), 0, 1));
        EXPECT_GT(std::log(errors.front() / errors.back()) / std::log(26. / 8), 1.6)
            << int(flux_sides);
        EXPECT_LT(errors.back(), flux_sides == 0 ? 5e-4 : 3e-3);
      }
    }

    TEST(IntegralRows, OneSetOfWeightsIsTheReportsWithItsKernel)
    {
      // Its own figures for Epanechnikov's kernel; the others converge with order one.
      const double expected[] = {1.9e-1, 4.2e-2, 1.0e-2, 2.5e-3};
      const auto errors
          = sine_errors(published(WeightPolicy::single, KernelShape::epanechnikov), 0);
      for(std::size_t k = 0; k < 4; ++k)
        EXPECT_NEAR(errors[k], expected[k], 0.1 * expected[k]);
      const auto others
          = sine_errors(published(WeightPolicy::single, KernelShape::cubic_spline), 0);
      EXPECT_GT(others.back(), 0.02);
      EXPECT_LT(orders(others).back(), 1.2);
    }

    TEST(IntegralRows, OneSetFitsNextToAWallWithEpanechnikovsKernelOnly)
    {
      // At a dilation of 2.5 spacings the particle next to a wall has four neighbours,
      // itself counted, for the five constraints of order 3. The Laplacian of
      // Epanechnikov's kernel is constant, psi = 1 + z^2 lap psi / 2, so that the second
      // of the constraints (3.14) follows from the zeroth: four are left.
      const auto make = [](int first, int last)
      {
        IntegralStencil stencil;
        for(int i = first; i <= last; ++i)
        {
          stencil.positions.push_back({i / 2.5, 0});
          stencil.volumes.push_back(1 / 2.5);
        }
        return stencil;
      };
      std::array<double, 9> unused{}, unused_too{};
      for(const std::string &name : kernel_names())
      {
        const KernelShape kernel = kernel_shape(name);
        if(kernel == KernelShape::hat)
          continue;
        IntegralWeights weights(kernel, 1, WeightPolicy::single, 3);
        EXPECT_EQ(weights.n_constraints(), 5U);
        IntegralStencil stencil = make(-1, 2);
        stencil.moments.resize(2);
        KernelMoments(kernel, 1, 1).evaluate({{-0.4, -1}, {1, 1}}, stencil.moments);
        const double residual
            = weights.compute(stencil, {unused.data(), 4}, {unused_too.data(), 4});
        if(kernel == KernelShape::epanechnikov)
          EXPECT_LT(residual, 1e-14);
        else
          EXPECT_GT(residual, 1e-6) << name;
        // The number of independent constraints shows where there are particles enough.
        stencil = make(-2, 2);
        for(std::array<double, 2> &z : stencil.positions)
          z[0] *= 0.7;
        stencil.positions.push_back({0.9, 0});
        stencil.positions.push_back({-0.8, 0});
        stencil.volumes.resize(7, 0.3);
        stencil.moments.resize(2);
        KernelMoments(kernel, 1, 1).evaluate({}, stencil.moments);
        weights.compute(stencil, {unused.data(), 7}, {unused_too.data(), 7});
        // The half cosine is a multiple of its own Laplacian.
        const bool one_fewer
            = kernel == KernelShape::epanechnikov || kernel == KernelShape::half_cosine;
        EXPECT_EQ(weights.rank(), one_fewer ? 4 : 5) << name;
      }
    }

    TEST(IntegralRows, TheIntegralOfAConstantIsNotEnough)
    {
      for(const WeightPolicy policy : {WeightPolicy::mass_only, WeightPolicy::uniform})
      {
        const auto errors = sine_errors(published(policy, KernelShape::cubic_spline), 0);
        EXPECT_GT(errors.back(), 0.5);
        EXPECT_GT(errors.back(), errors.front());
      }
    }

    TEST(IntegralRows, ContradictionsAreRecordedOrEndTheRun)
    {
      const Particles line = arrange(1, 30, -pi, pi, 0, 1, 0);
      const IntegralRows rows
          = integral_rows(line.nodes, line.walls,
                          published(WeightPolicy::single, KernelShape::cubic_spline));
      EXPECT_EQ(rows.unmet, 2);
      EXPECT_GT(rows.largest_residual, 0.1);
      const Particles few = arrange(1, 5, 0, 1, 0, 1, 0);
      EXPECT_THROW(
          integral_rows(few.nodes, few.walls, with(KernelShape::wendland_c4, 4, 2.5)),
          cases::NumericalError);
      EXPECT_THROW(IntegralWeights(KernelShape::hat, 1, WeightPolicy::separate, 3),
                   cases::InputError);
    }

    TEST(IntegralRows, LoadsThatCancelEndTheRun)
    {
      Particles line = arrange(1, 30, -pi, pi, 0, 1, 0);
      const IntegralParameters parameters
          = published(WeightPolicy::uniform, KernelShape::cubic_spline);
      EXPECT_NO_THROW(integral_rows(line.nodes, line.walls, parameters));
      std::ranges::fill(line.nodes.weights, 0.);
      try
      {
        integral_rows(line.nodes, line.walls, parameters);
        FAIL() << "was divided by zero";
      }
      catch(const cases::NumericalError &error)
      {
        EXPECT_NE(std::string(error.what()).find("loads of its row cancel"),
                  std::string::npos)
            << error.what();
      }
    }

    TEST(IntegralRows, HaveTheSameBitsForAnyNumberOfThreads)
    {
      const Particles square = arrange(2, 20, 0, 1, 0.2, 3, 2);
      IntegralParameters parameters = with(KernelShape::wendland_c4, 3, 2.6);
      const IntegralRows one = integral_rows(square.nodes, square.walls, parameters);
      parameters.threads = 2;
      const IntegralRows two = integral_rows(square.nodes, square.walls, parameters);
      EXPECT_EQ(one.laplacian.columns, two.laplacian.columns);
      EXPECT_EQ(one.laplacian.coefficients, two.laplacian.coefficients);
      EXPECT_EQ(one.load.coefficients, two.load.coefficients);
      EXPECT_EQ(one.flux.coefficients, two.flux.coefficients);
    }
  } // namespace
} // namespace meltfront::particles
