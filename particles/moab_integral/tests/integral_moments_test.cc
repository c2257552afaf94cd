#include <cases/error.h>
#include <particles/moab_integral/integral_moments.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meltfront::particles
{
  namespace
  {
    using boost::math::quadrature::gauss_kronrod;

    double shape_value(KernelShape shape, double q)
    {
      double value = 0;
      evaluate_shape(shape, {&q, 1}, std::span<double>(&value, 1));
      return value;
    }

    /** Adaptive, in pieces between which the shape may have a knot. */
    template <typename Function>
    double adaptive(const Function &function, double from, double to)
    {
      constexpr double knots[]
          = {-1, -2. / 3, -0.6, -0.5, -1. / 3, -0.2, 0, 0.2, 1. / 3, 0.5, 0.6, 2. / 3, 1};
      double sum = 0, begin = from;
      for(const double knot : knots)
        if(const double end = std::min(knot, to); end > begin)
        {
          sum += gauss_kronrod<double, 31>::integrate(function, begin, end, 12, 1e-13);
          begin = end;
        }
      return sum;
    }

    TEST(KernelMoments, OnALineAgainstAdaptiveQuadrature)
    {
      for(const std::string &name : kernel_names())
      {
        const KernelShape shape = kernel_shape(name);
        const KernelMoments moments(shape, 1, 2);
        for(const double lower : {-1.3, -0.8, -0.31, 0.})
          for(const double upper : {0., 0.4, 0.77, 2.})
          {
            std::array<double, 3> found{};
            moments.evaluate({{lower, 0}, {upper, 0}}, found);
            for(int a = 0; a <= 2; ++a)
              EXPECT_NEAR(
                  found[static_cast<std::size_t>(a)],
                  adaptive([&](double z)
                           { return shape_value(shape, std::abs(z)) * std::pow(z, a); },
                           std::max(lower, -1.), std::min(upper, 1.)),
                  1e-13)
                  << name << ' ' << a << ' ' << lower << ' ' << upper;
          }
      }
    }

    /** The moment by nested adaptive quadrature over strips. */
    double strips(KernelShape shape, const ScaledBox &box, const Exponents &powers)
    {
      // x = sin(angle) takes away the root with which strips begin at the support's ends.
      const auto strip = [&](double angle)
      {
        const double x = std::sin(angle), half = std::cos(angle);
        const auto along = [&](double y)
        { return shape_value(shape, std::hypot(x, y)) * std::pow(y, powers[1]); };
        const double low = std::max(box.lower[1], -half);
        const double high = std::min(box.upper[1], half);
        const auto piece = [&](double begin, double end)
        {
          return begin < end
                     ? gauss_kronrod<double, 31>::integrate(along, begin, end, 2, 1e-12)
                     : 0;
        };
        return std::pow(x, powers[0]) * half
               * (piece(low, std::min(high, 0.)) + piece(std::max(low, 0.), high));
      };
      // In pieces, between which a wall begins to cut strips.
      const double from = std::asin(std::max(box.lower[0], -1.));
      const double to = std::asin(std::min(box.upper[0], 1.));
      std::vector<double> ends{from, to};
      for(const double wall : {-box.lower[1], box.upper[1]})
        if(wall < 1)
          for(const double sign : {-1., 1.})
            ends.push_back(std::clamp(sign * std::acos(wall), from, to));
      ends.push_back(std::clamp(0., from, to));
      std::ranges::sort(ends);
      double sum = 0;
      for(std::size_t k = 1; k < ends.size(); ++k)
        if(ends[k] > ends[k - 1])
          sum += gauss_kronrod<double, 31>::integrate(strip, ends[k - 1], ends[k], 2,
                                                      1e-10);
      return sum;
    }

    TEST(KernelMoments, InThePlaneAgainstAdaptiveQuadrature)
    {
      const ScaledBox boxes[] = {{{-0.4, -3}, {5, 4}},
                                 {{-0.3, -0.7}, {0.2, 9}},
                                 {{0, -1.5}, {1.2, 1.1}},
                                 {{-2, 0}, {0, 0.8}},
                                 {{-0.02, -0.9}, {0.95, 0.01}}};
      for(const KernelShape shape :
          {KernelShape::wendland_c4, KernelShape::epanechnikov, KernelShape::triweight})
      {
        const KernelMoments moments(shape, 2, 2);
        std::vector<double> found(moments.exponents().size());
        for(const ScaledBox &box : boxes)
        {
          moments.evaluate(box, found);
          for(std::size_t a = 0; a < found.size(); ++a)
            EXPECT_NEAR(found[a], strips(shape, box, moments.exponents()[a]), 1e-9)
                << kernel_name(shape) << ' ' << a << ' ' << box.lower[0] << ' '
                << box.lower[1];
        }
      }
    }

    TEST(KernelMoments, PartsOfTheSupportAddUpToTheWhole)
    {
      for(const std::string &name : kernel_names())
      {
        const KernelShape shape = kernel_shape(name);
        const KernelMoments moments(shape, 2, 2);
        // A kernel whose centre a corner cuts into quarters.
        std::vector<double> whole(6), part(6), sum(6, 0.);
        moments.evaluate({}, whole);
        const double rounding = 1e-14 * std::max(1., whole[0]);
        for(const ScaledBox &quarter :
            {ScaledBox{{0, 0}, {3, 3}}, ScaledBox{{-3, 0}, {0, 3}},
             ScaledBox{{-3, -3}, {0, 0}}, ScaledBox{{0, -3}, {3, 0}}})
        {
          moments.evaluate(quarter, part);
          for(std::size_t a = 0; a < 6; ++a)
            sum[a] += part[a];
          EXPECT_NEAR(part[0], whole[0] / 4, rounding) << name;
          EXPECT_NEAR(part[3], whole[3] / 4, rounding) << name;
        }
        for(std::size_t a = 0; a < 6; ++a)
          EXPECT_NEAR(sum[a], whole[a], rounding) << name << ' ' << a;
        EXPECT_NEAR(whole[0], 1 / kernel_norm(shape, 2), 1e-13) << name;
      }
    }

    TEST(KernelMoments, RefusesThreeDimensions)
    {
      EXPECT_THROW(KernelMoments(KernelShape::cubic_spline, 3, 1), cases::InputError);
    }
  } // namespace
} // namespace meltfront::particles
