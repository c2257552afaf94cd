#include <cases/error.h>
#include <particles/core/kernels.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meltfront::particles
{
  namespace
  {
    constexpr KernelShape shapes[]
        = {KernelShape::cubic_spline, KernelShape::quintic_spline,
           KernelShape::wendland_c2, KernelShape::wendland_c4, KernelShape::wendland_c6};

    /** Integral of W over space by Simpson's rule between the splines' knots. */
    double integral(const SmoothingKernel &kernel)
    {
      const double surface[] = {2, 2 * std::numbers::pi, 4 * std::numbers::pi};
      const int d = kernel.dimension();
      const int intervals = 6000;
      const double step = kernel.support() / intervals;
      double sum = 0;
      for(int i = 0; i <= intervals; ++i)
      {
        const double r = i * step;
        const double factor = i == 0 || i == intervals ? 1 : (i % 2 == 1 ? 4 : 2);
        sum += factor * kernel.value(r) * std::pow(r, d - 1);
      }
      return surface[d - 1] * sum * step / 3;
    }

    TEST(Kernels, IntegrateToOne)
    {
      for(const KernelShape shape : shapes)
        for(int d = 1; d <= 3; ++d)
          EXPECT_NEAR(integral(SmoothingKernel(shape, d, 0.37)), 1, 1e-11)
              << kernel_name(shape) << ' ' << d;
    }

    TEST(Kernels, SlopeIsTheDerivativeOfTheValue)
    {
      for(const KernelShape shape : shapes)
        for(int d = 1; d <= 3; ++d)
        {
          const SmoothingKernel kernel(shape, d, 0.8);
          const double scale = kernel.value(0) / 0.64;
          for(double r = 0.013; r < kernel.support(); r += 0.0371)
          {
            const double step = 1e-5;
            const double difference
                = (kernel.value(r + step) - kernel.value(r - step)) / (2 * step);
            EXPECT_NEAR(kernel.radial_derivative_over_distance(r), difference / r,
                        1e-7 * scale)
                << kernel_name(shape) << ' ' << d << ' ' << r;
          }
        }
    }

    TEST(Kernels, SlopeHasAFiniteLimitAtTheCentre)
    {
      const double h = 0.3;
      const SmoothingKernel cubic(KernelShape::cubic_spline, 2, h);
      EXPECT_NEAR(cubic.radial_derivative_over_distance(0),
                  -30 / (7 * std::numbers::pi * std::pow(h, 4)), 1e-10);
      for(const KernelShape shape : shapes)
        for(int d = 1; d <= 3; ++d)
        {
          const SmoothingKernel kernel(shape, d, h);
          EXPECT_NEAR(kernel.radial_derivative_over_distance(0)
                          / kernel.radial_derivative_over_distance(1e-9),
                      1, 1e-6);
        }
    }

    TEST(Kernels, VanishBeyondTheirSupport)
    {
      for(const KernelShape shape : shapes)
      {
        const SmoothingKernel kernel(shape, 3, 0.5);
        EXPECT_GT(kernel.value(0.999 * kernel.support()), 0);
        EXPECT_EQ(kernel.value(kernel.support()), 0);
        EXPECT_EQ(kernel.radial_derivative_over_distance(kernel.support()), 0);
      }
    }

    struct MomentCase
    {
      KernelShape shape;
      double smoothing;
      double moment;
    };

    // Second moments on the square lattice, computed independently to six digits.
    TEST(Kernels, SecondMomentOnTheSquareLattice)
    {
      const MomentCase table[] = {{KernelShape::cubic_spline, 1.0, 1.013099},
                                  {KernelShape::cubic_spline, 1.1, 0.996650},
                                  {KernelShape::cubic_spline, 1.2, 0.990793},
                                  {KernelShape::cubic_spline, 1.3, 1.010543},
                                  {KernelShape::cubic_spline, 1.4, 1.016890},
                                  {KernelShape::cubic_spline, 1.5, 1.006725},
                                  {KernelShape::cubic_spline, 1.75, 0.993485},
                                  {KernelShape::cubic_spline, 2.0, 0.999100},
                                  {KernelShape::wendland_c2, 1.2, 0.963850},
                                  {KernelShape::wendland_c2, 1.3, 0.973921},
                                  {KernelShape::wendland_c2, 1.5, 0.997399},
                                  {KernelShape::wendland_c2, 2.0, 0.999199},
                                  {KernelShape::quintic_spline, 1.0, 1.000795},
                                  {KernelShape::quintic_spline, 1.3, 1.000608},
                                  {KernelShape::quintic_spline, 1.5, 1.000157}};
      for(const MomentCase &c : table)
      {
        const double spacing = 0.025;
        const SmoothingKernel kernel(c.shape, 2, c.smoothing * spacing);
        EXPECT_NEAR(lattice_second_moment(kernel, spacing), c.moment, 1e-6)
            << kernel_name(c.shape) << ' ' << c.smoothing;
      }
    }

    TEST(Kernels, SecondMomentTendsToOneWithManyNeighbours)
    {
      for(const KernelShape shape : shapes)
        for(int d = 1; d <= 3; ++d)
          EXPECT_NEAR(lattice_second_moment(SmoothingKernel(shape, d, 5), 1), 1, 3e-4);
    }

    TEST(Kernels, AreFoundByName)
    {
      for(std::size_t i = 0; i < std::size(shapes); ++i)
        EXPECT_EQ(kernel_shape(smoothing_kernel_names()[i]), shapes[i]);
      EXPECT_THROW(kernel_shape("gaussian"), cases::InputError);
      EXPECT_THROW(SmoothingKernel(KernelShape::hat, 2, 1), cases::Refusal);
    }

    struct NormCase
    {
      KernelShape shape;
      double centre[3]; ///< W(0) h^d in 1D, 2D, 3D
    };

    // Dehnen and Aly 2012, table 1, with the support at 2 h (quintic spline: 3 h).
    TEST(Kernels, ValuesAtTheCentreAreThePublishedOnes)
    {
      const double pi = std::numbers::pi;
      const NormCase table[]
          = {{KernelShape::cubic_spline, {2. / 3, 10 / (7 * pi), 1 / pi}},
             {KernelShape::quintic_spline, {11. / 20, 462 / (478 * pi), 66 / (120 * pi)}},
             {KernelShape::wendland_c2, {5. / 8, 7 / (4 * pi), 21 / (16 * pi)}},
             {KernelShape::wendland_c4, {3. / 4, 9 / (4 * pi), 495 / (256 * pi)}},
             {KernelShape::wendland_c6, {55. / 64, 39 / (14 * pi), 1365 / (512 * pi)}}};
      for(const NormCase &c : table)
        for(int d = 1; d <= 3; ++d)
          EXPECT_NEAR(SmoothingKernel(c.shape, d, 1).value(0) / c.centre[d - 1], 1, 1e-14)
              << kernel_name(c.shape) << ' ' << d;
    }
  } // namespace
} // namespace meltfront::particles
