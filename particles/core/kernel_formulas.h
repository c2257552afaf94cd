#ifndef meltfront_particles_core_kernel_formulas_h
#define meltfront_particles_core_kernel_formulas_h

#include <particles/core/kernel_shapes.h>

#include <cmath>
#include <numbers>

/**
 * psi(q), psi'(q)/q and psi''(q) of each shape for 0 <= q < 1, in factored form: the
 * smallest factor is a power of 1 - q, which is exact near the edge.
 */
namespace meltfront::particles::kernel_formulas
{
  using std::numbers::pi;

  template <int Exponent>
  constexpr double power(double base)
  {
    if constexpr(Exponent == 0)
      return 1;
    else
      return base * power<Exponent - 1>(base);
  }

  struct Hat
  {
    static double value(double q)
    {
      return 1 - q;
    }
    static double slope_over_q(double q)
    {
      return -1 / q;
    }
    static double second(double)
    {
      return 0;
    }
  };

  struct Epanechnikov
  {
    static double value(double q)
    {
      return (1 - q) * (1 + q);
    }
    static double slope_over_q(double)
    {
      return -2;
    }
    static double second(double)
    {
      return -2;
    }
  };

  struct Biweight
  {
    static double value(double q)
    {
      return power<2>((1 - q) * (1 + q));
    }
    static double slope_over_q(double q)
    {
      return -4 * (1 - q) * (1 + q);
    }
    static double second(double q)
    {
      return 4 * (3 * q * q - 1);
    }
  };

  struct Triweight
  {
    static double value(double q)
    {
      return power<3>((1 - q) * (1 + q));
    }
    static double slope_over_q(double q)
    {
      return -6 * power<2>((1 - q) * (1 + q));
    }
    static double second(double q)
    {
      return 6 * (1 - q) * (1 + q) * (5 * q * q - 1);
    }
  };

  struct CubicSpline
  {
    static double value(double q)
    {
      return q <= 0.5 ? 2. / 3 - 4 * q * q * (1 - q) : 4. / 3 * power<3>(1 - q);
    }
    static double slope_over_q(double q)
    {
      return q <= 0.5 ? 12 * q - 8 : -4 * power<2>(1 - q) / q;
    }
    static double second(double q)
    {
      return q <= 0.5 ? 24 * q - 8 : 8 * (1 - q);
    }
  };

  struct EfgQuartic
  {
    static double value(double q)
    {
      return power<3>(1 - q) * (1 + 3 * q);
    }
    static double slope_over_q(double q)
    {
      return -12 * power<2>(1 - q);
    }
    static double second(double q)
    {
      return -12 * (1 - q) * (1 - 3 * q);
    }
  };

  /** In s = 5/2 q: (5/2 - s)^4 - 5 (3/2 - s)_+^4 + 10 (1/2 - s)_+^4. */
  struct QuarticSpline
  {
    static double value(double q)
    {
      const double s = 2.5 * q;
      if(q < 0.2)
        return 14.375 + s * s * (6 * s * s - 15);
      const double outer = power<4>(2.5 * (1 - q));
      return q < 0.6 ? outer - 5 * power<4>(1.5 - s) : outer;
    }
    static double slope_over_q(double q)
    {
      const double s = 2.5 * q;
      if(q < 0.2)
        return 6.25 * (24 * s * s - 30);
      const double outer = power<3>(2.5 * (1 - q));
      return -10 * (q < 0.6 ? outer - 5 * power<3>(1.5 - s) : outer) / q;
    }
    static double second(double q)
    {
      const double s = 2.5 * q;
      if(q < 0.2)
        return 6.25 * (72 * s * s - 30);
      const double outer = power<2>(2.5 * (1 - q));
      return 75 * (q < 0.6 ? outer - 5 * power<2>(1.5 - s) : outer);
    }
  };

  /** In s = 3 q: (3 - s)^5 - 6 (2 - s)_+^5 + 15 (1 - s)_+^5. */
  struct QuinticSpline
  {
    static double value(double q)
    {
      const double s = 3 * q;
      if(s < 1)
        return 66 + s * s * (s * s * (30 - 10 * s) - 60);
      const double outer = power<5>(3 * (1 - q));
      return s < 2 ? outer - 6 * power<5>(2 - s) : outer;
    }
    static double slope_over_q(double q)
    {
      const double s = 3 * q;
      if(s < 1)
        return 9 * (s * s * (120 - 50 * s) - 120);
      const double outer = power<4>(3 * (1 - q));
      return -15 * (s < 2 ? outer - 6 * power<4>(2 - s) : outer) / q;
    }
    static double second(double q)
    {
      const double s = 3 * q;
      if(s < 1)
        return 9 * (s * s * (360 - 200 * s) - 120);
      const double outer = power<3>(3 * (1 - q));
      return 180 * (s < 2 ? outer - 6 * power<3>(2 - s) : outer);
    }
  };

  struct WendlandC2
  {
    static double value(double q)
    {
      return power<4>(1 - q) * (1 + 4 * q);
    }
    static double slope_over_q(double q)
    {
      return -20 * power<3>(1 - q);
    }
    static double second(double q)
    {
      return -20 * power<2>(1 - q) * (1 - 4 * q);
    }
  };

  struct WendlandC4
  {
    static double value(double q)
    {
      return power<6>(1 - q) * (1 + q * (6 + 35. / 3 * q));
    }
    static double slope_over_q(double q)
    {
      return -56. / 3 * power<5>(1 - q) * (1 + 5 * q);
    }
    static double second(double q)
    {
      return -56. / 3 * power<4>(1 - q) * (1 + q * (4 - 35 * q));
    }
  };

  struct WendlandC6
  {
    static double value(double q)
    {
      return power<8>(1 - q) * (1 + q * (8 + q * (25 + 32 * q)));
    }
    static double slope_over_q(double q)
    {
      return -22 * power<7>(1 - q) * (1 + q * (7 + 16 * q));
    }
    static double second(double q)
    {
      return -22 * power<6>(1 - q) * (1 + q * (6 - q * (15 + 160 * q)));
    }
  };

  struct WendlandC4Line
  {
    static double value(double q)
    {
      return power<5>(1 - q) * (1 + q * (5 + 8 * q));
    }
    static double slope_over_q(double q)
    {
      return -14 * power<4>(1 - q) * (1 + 4 * q);
    }
    static double second(double q)
    {
      return -14 * power<3>(1 - q) * (1 + q * (3 - 24 * q));
    }
  };

  struct WendlandC6Line
  {
    static double value(double q)
    {
      return power<7>(1 - q) * (1 + q * (7 + q * (19 + 21 * q)));
    }
    static double slope_over_q(double q)
    {
      return -6 * power<6>(1 - q) * (3 + q * (18 + 35 * q));
    }
    static double second(double q)
    {
      return -6 * power<5>(1 - q) * (3 + q * (15 - q * (39 + 315 * q)));
    }
  };

  /** sin(pi q / 2^k) / q of both cosines, with its limit at 0. */
  inline double sine_over(double angle, double q)
  {
    return q > 0 ? std::sin(angle * q) / q : angle;
  }

  struct Cosine
  {
    static double value(double q)
    {
      return power<2>(std::sin(pi / 2 * (1 - q)));
    }
    static double slope_over_q(double q)
    {
      return -pi / 2 * (q < 0.5 ? sine_over(pi, q) : std::sin(pi * (1 - q)) / q);
    }
    static double second(double q)
    {
      return -pi * pi / 2 * std::cos(pi * q);
    }
  };

  struct HalfCosine
  {
    static double value(double q)
    {
      return std::sin(pi / 2 * (1 - q));
    }
    static double slope_over_q(double q)
    {
      return -pi / 2 * sine_over(pi / 2, q);
    }
    static double second(double q)
    {
      return -pi * pi / 4 * value(q);
    }
  };

  /** exp(-(Reach q)^2), lowered and scaled to run from 1 to 0. */
  template <int Reach>
  struct Gaussian
  {
    static constexpr double a = Reach * Reach;

    static double value(double q)
    {
      static const double range = std::expm1(a);
      return std::expm1(a * (1 - q) * (1 + q)) / range;
    }
    static double slope_over_q(double q)
    {
      static const double range = -std::expm1(-a);
      return -2 * a * std::exp(-a * q * q) / range;
    }
    static double second(double q)
    {
      return slope_over_q(q) * (1 - 2 * a * q * q);
    }
  };

  struct Bump
  {
    static double value(double q)
    {
      return std::exp(-q * q / ((1 - q) * (1 + q)));
    }
    static double slope_over_q(double q)
    {
      return -2 * value(q) / power<2>((1 - q) * (1 + q));
    }
    static double second(double q)
    {
      return 2 * value(q) * (3 * power<4>(q) - 1) / power<4>((1 - q) * (1 + q));
    }
  };

  /** Call a generic function with an object of the shape's type: the choice is taken once
   * for a loop over many distances. */
  template <typename Function>
  auto with_formula(KernelShape shape, const Function &function)
  {
    switch(shape)
    {
    case KernelShape::hat:
      return function(Hat());
    case KernelShape::epanechnikov:
      return function(Epanechnikov());
    case KernelShape::biweight:
      return function(Biweight());
    case KernelShape::triweight:
      return function(Triweight());
    case KernelShape::cubic_spline:
      return function(CubicSpline());
    case KernelShape::efg_quartic:
      return function(EfgQuartic());
    case KernelShape::quartic_spline:
      return function(QuarticSpline());
    case KernelShape::quintic_spline:
      return function(QuinticSpline());
    case KernelShape::wendland_c2:
      return function(WendlandC2());
    case KernelShape::wendland_c4:
      return function(WendlandC4());
    case KernelShape::wendland_c6:
      return function(WendlandC6());
    case KernelShape::cosine:
      return function(Cosine());
    case KernelShape::half_cosine:
      return function(HalfCosine());
    case KernelShape::gaussian_3:
      return function(Gaussian<3>());
    case KernelShape::gaussian_2:
      return function(Gaussian<2>());
    case KernelShape::bump:
      return function(Bump());
    case KernelShape::wendland_c4_line:
      return function(WendlandC4Line());
    default:
      return function(WendlandC6Line());
    }
  }
} // namespace meltfront::particles::kernel_formulas

#endif
