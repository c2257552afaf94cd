#include <cases/error.h>
#include <particles/core/kernel_shapes.h>

#include <boost/math/quadrature/gauss.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace meltfront::particles
{
  namespace
  {
    std::vector<KernelShape> all_shapes()
    {
      std::vector<KernelShape> shapes;
      for(const std::string &name : kernel_names())
        shapes.push_back(kernel_shape(name));
      return shapes;
    }

    /** Integral of a function over 0 <= r <= length by Gauss's rule on sixty intervals,
     * among whose ends are all knots of the splines. */
    template <typename Function>
    double integral(const Function &function, double length)
    {
      double sum = 0;
      for(int i = 0; i < 60; ++i)
        sum += boost::math::quadrature::gauss<double, 30>::integrate(
            function, length * i / 60, length * (i + 1) / 60);
      return sum;
    }

    TEST(KernelShapes, IntegrateToOneInAllDimensions)
    {
      const double surface[] = {2, 2 * std::numbers::pi, 4 * std::numbers::pi};
      for(const KernelShape shape : all_shapes())
        for(int dim = 1; dim <= 3; ++dim)
        {
          const Kernel kernel(shape, dim, 0.37);
          const auto shell = [&](double r)
          { return kernel.value(r) * (dim > 1 ? r : 1) * (dim > 2 ? r : 1); };
          EXPECT_NEAR(surface[dim - 1] * integral(shell, kernel.dilation()), 1, 1e-12)
              << kernel_name(shape) << ' ' << dim;
        }
    }

    TEST(KernelShapes, AreEvenNonNegativeAndFalling)
    {
      for(const KernelShape shape : all_shapes())
      {
        const Kernel kernel(shape, 2, 1);
        double previous = kernel.value(0);
        // Towards the edge the steps shrink to the last bit.
        for(double gap = 0.99; gap > 1e-16; gap *= gap > 0.01 ? 0.99 : 0.9)
        {
          const double q = 1 - gap;
          EXPECT_EQ(kernel.value(-q), kernel.value(q));
          EXPECT_GE(kernel.value(q), 0) << kernel_name(shape) << ' ' << q;
          EXPECT_LE(kernel.value(q), previous) << kernel_name(shape) << ' ' << q;
          EXPECT_LE(kernel.derivative(q), 0) << kernel_name(shape) << ' ' << q;
          previous = kernel.value(q);
        }
      }
    }

    TEST(KernelShapes, ArePositiveUpToTheEdge)
    {
      for(const KernelShape shape : all_shapes())
      {
        // Only the bump, exp(-1/gap), underflows.
        const double last = Kernel(shape, 1, 1).value(std::nextafter(1., 0.));
        EXPECT_EQ(last > 0, shape != KernelShape::bump) << kernel_name(shape);
      }
    }

    TEST(KernelShapes, VanishExactlyFromTheEdgeOn)
    {
      for(const KernelShape shape : all_shapes())
        for(const double q : {1., 1.0000001, 2., 1e300})
        {
          const Kernel kernel(shape, 3, 1);
          EXPECT_EQ(kernel.value(q), 0);
          EXPECT_EQ(kernel.derivative(q), 0);
          EXPECT_EQ(kernel.second_derivative(q), 0);
          EXPECT_EQ(kernel.derivative_over_distance(q), 0);
        }
    }

    TEST(KernelShapes, DerivativesAreThoseOfDifferences)
    {
      const double step = 1e-4;
      for(const KernelShape shape : all_shapes())
      {
        const Kernel kernel(shape, 1, 0.8);
        const double scale = kernel.value(0);
        for(double r = 0.0131; r < 0.79; r += 0.0173)
        {
          const double left = kernel.value(r - step), right = kernel.value(r + step);
          const double slope = (right - left) / (2 * step);
          const double second
              = (kernel.derivative(r + step) - kernel.derivative(r - step)) / (2 * step);
          EXPECT_NEAR(kernel.derivative(r), slope, 1e-5 * scale)
              << kernel_name(shape) << r;
          EXPECT_NEAR(kernel.second_derivative(r), second, 1e-3 * scale)
              << kernel_name(shape) << ' ' << r;
          EXPECT_NEAR(kernel.derivative_over_distance(r) * r, kernel.derivative(r),
                      1e-13 * scale);
        }
      }
    }

    TEST(KernelShapes, IntegralsOfDerivativesGiveTheValues)
    {
      for(const KernelShape shape : all_shapes())
      {
        const Kernel kernel(shape, 1, 1);
        const auto slope = [&](double r) { return kernel.derivative(r); };
        const auto second = [&](double r) { return kernel.second_derivative(r); };
        const double edge = std::nextafter(1., 0.);
        EXPECT_NEAR(integral(slope, 1), -kernel.value(0), 1e-12) << kernel_name(shape);
        // The slope of the hat jumps at its centre.
        const double centre = shape == KernelShape::hat ? kernel.derivative(1e-300)
                                                        : kernel.derivative(0);
        EXPECT_NEAR(integral(second, 1), kernel.derivative(edge) - centre, 1e-11)
            << kernel_name(shape);
      }
    }

    TEST(KernelShapes, SlopeOverDistanceTendsToTheCurvatureAtTheCentre)
    {
      for(const KernelShape shape : all_shapes())
      {
        const Kernel kernel(shape, 3, 0.3);
        if(shape == KernelShape::hat)
        {
          EXPECT_THROW(kernel.derivative_over_distance(0), cases::Refusal);
          EXPECT_THROW(kernel.hessian({}), cases::Refusal);
          continue;
        }
        const double centre = kernel.second_derivative(0);
        EXPECT_NEAR(kernel.derivative_over_distance(0) / centre, 1, 1e-14)
            << kernel_name(shape);
        EXPECT_NEAR(kernel.derivative_over_distance(1e-9) / centre, 1, 1e-7)
            << kernel_name(shape);
        EXPECT_EQ(kernel.derivative(0), 0);
      }
    }

    TEST(KernelShapes, SecondDerivativeChangesSignWhereItShould)
    {
      const std::pair<KernelShape, double> zeros[]
          = {{KernelShape::biweight, 1 / std::sqrt(3.)},
             {KernelShape::triweight, 1 / std::sqrt(5.)},
             {KernelShape::cubic_spline, 1. / 3},
             {KernelShape::efg_quartic, 1. / 3},
             {KernelShape::quartic_spline, 0.2764},
             {KernelShape::quintic_spline, 0.2531},
             {KernelShape::wendland_c2, 0.25},
             {KernelShape::wendland_c4, 0.2356},
             {KernelShape::wendland_c6, 0.2153},
             {KernelShape::cosine, 0.5},
             {KernelShape::gaussian_3, 0.2357},
             {KernelShape::gaussian_2, 0.3536},
             {KernelShape::bump, 0.7598}};
      for(const auto &[shape, zero] : zeros)
      {
        const Kernel kernel(shape, 1, 1);
        EXPECT_LT(kernel.second_derivative(zero - 1e-4), 0) << kernel_name(shape);
        EXPECT_GT(kernel.second_derivative(zero + 1e-4), 0) << kernel_name(shape);
      }
    }

    TEST(KernelShapes, GradientAndHessianAreThoseOfDifferences)
    {
      std::mt19937 random(5);
      std::uniform_real_distribution<double> coordinate(-0.4, 0.4);
      const double step = 1e-5;
      for(const KernelShape shape :
          {KernelShape::wendland_c4, KernelShape::quintic_spline, KernelShape::triweight,
           KernelShape::bump})
        for(int dim = 1; dim <= 3; ++dim)
        {
          const Kernel kernel(shape, dim, 1);
          std::array<double, 3> x{};
          for(int i = 0; i < dim; ++i)
            x[i] = coordinate(random);
          const auto gradient = kernel.gradient(x);
          const auto hessian = kernel.hessian(x);
          for(int i = 0; i < dim; ++i)
          {
            auto left = x, right = x;
            left[i] -= step;
            right[i] += step;
            const auto value = [&](const std::array<double, 3> &y)
            { return kernel.value(std::hypot(y[0], y[1], y[2])); };
            EXPECT_NEAR(gradient[i], (value(right) - value(left)) / (2 * step), 1e-7);
            for(int j = 0; j < dim; ++j)
              EXPECT_NEAR(hessian[i][j],
                          (kernel.gradient(right)[j] - kernel.gradient(left)[j])
                              / (2 * step),
                          1e-6);
          }
        }
    }

    TEST(KernelShapes, SmoothnessIsThatOfTheDerivativesAtTheEdge)
    {
      for(const KernelShape shape : all_shapes())
      {
        const Kernel kernel(shape, 1, 1);
        const double edge = 1 - 1e-9, scale = kernel.value(0);
        const int k = kernel_smoothness(shape);
        // The lowered Gaussians have a slope of 1e-3 and more at the edge.
        const bool flat = std::abs(kernel.derivative(edge)) < 1e-6 * scale;
        const bool straight = std::abs(kernel.second_derivative(edge)) < 1e-6 * scale;
        EXPECT_EQ(flat, k >= 1) << kernel_name(shape);
        EXPECT_EQ(flat && straight, k >= 2) << kernel_name(shape);
      }
    }

    TEST(KernelShapes, ManyAtOnceAreTheSameAsOneByOne)
    {
      std::vector<double> q;
      for(double r = 1e-3; r < 1.2; r += 0.011)
        q.push_back(r);
      std::vector<double> value(q.size());
      std::vector<KernelProfile> profile(q.size());
      for(const KernelShape shape : all_shapes())
      {
        const Kernel kernel(shape, 2, 1);
        const double norm = kernel_norm(shape, 2);
        evaluate_shape(shape, q, value);
        evaluate_shape(shape, q, profile);
        for(std::size_t i = 0; i < q.size(); ++i)
        {
          EXPECT_DOUBLE_EQ(norm * value[i], kernel.value(q[i]));
          EXPECT_DOUBLE_EQ(norm * profile[i].value, kernel.value(q[i]));
          EXPECT_DOUBLE_EQ(norm * profile[i].slope_over_distance,
                           kernel.derivative_over_distance(q[i]));
          EXPECT_DOUBLE_EQ(norm * profile[i].second, kernel.second_derivative(q[i]));
        }
      }
    }

    TEST(KernelShapes, BadInputIsRefusedInWords)
    {
      EXPECT_THROW(kernel_shape("top_hat"), cases::InputError);
      EXPECT_THROW(Kernel(KernelShape::hat, 4, 1), cases::InputError);
      EXPECT_THROW(Kernel(KernelShape::hat, 0, 1), cases::InputError);
      EXPECT_THROW(Kernel(KernelShape::hat, 2, 0), cases::InputError);
      EXPECT_THROW(Kernel(KernelShape::hat, 2, std::nan("")), cases::InputError);
      EXPECT_EQ(kernel_names().size(), 18u);
    }
  } // namespace
} // namespace meltfront::particles
