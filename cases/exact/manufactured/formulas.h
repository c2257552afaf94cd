#ifndef meltfront_cases_exact_manufactured_formulas_h
#define meltfront_cases_exact_manufactured_formulas_h

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

/**
 * The level sets of the families, in lengths of the length scale and times of the period:
 * negative in the solid. Each is written once, for any kind of number: doubles, Taylor
 * polynomials for the derivatives, and fifty digits for the tests. `Space` is the number
 * that depends on the place, `Time` one that depends on the time alone.
 *
 * `kappa` is what the temperature adds per length to the square of the gradient. The
 * solid's volume (an area in two dimensions) is counted within the default box from
 * `lower` to `upper`.
 */
namespace meltfront::cases::manufactured
{
  template <typename Number>
  Number square(const Number &x)
  {
    return x * x;
  }

  /** Sum of the squares of the coordinates from the first one on. */
  template <typename Space, std::size_t dim>
  Space sum_of_squares(const std::array<Space, dim> &x, std::size_t first = 0)
  {
    Space sum = square(x[first]);
    for(std::size_t d = first + 1; d < dim; ++d)
      sum = sum + square(x[d]);
    return sum;
  }

  template <typename Time>
  Time sine_wave(const Time &tau)
  {
    using std::sin;
    return sin(Time(2 * std::numbers::pi) * tau);
  }

  template <typename Time>
  Time cosine_wave(const Time &tau)
  {
    using std::cos;
    return cos(Time(2 * std::numbers::pi) * tau);
  }

  /** The cosine wave c as c |c|^(power-1): how the front's constant passes a merge. */
  template <typename Time>
  Time odd_power_of_cosine(const Time &tau, int power)
  {
    const Time wave = cosine_wave(tau);
    Time result = wave;
    for(int i = 1; i < power; ++i)
      result = result * wave;
    return power % 2 == 0 && wave < 0 ? Time(0) - result : result;
  }

  /** A plane that swings to and fro. */
  struct Plane
  {
    static constexpr const char *what = "plane that swings to and fro";
    static constexpr double kappa = 1;
    static constexpr std::array<double, 3> lower{0, 0, 0}, upper{1, 1, 1};

    template <typename Time>
    Time place(const Time &tau) const
    {
      return Time(0.5) + Time(0.2) * sine_wave(tau);
    }

    template <typename Space, typename Time, std::size_t dim>
    Space operator()(const std::array<Space, dim> &x, const Time &tau) const
    {
      return x[0] - place(tau);
    }

    double solid_volume(double tau, int dimension) const;
  };

  /** A disk or a ball that breathes; kappa = 4 makes the square of the gradient plus
   * kappa |f| the same everywhere in the solid. */
  struct Disk
  {
    static constexpr const char *what = "disk or ball that breathes";
    static constexpr double kappa = 4;
    static constexpr std::array<double, 3> lower{-1, -1, -1}, upper{1, 1, 1};

    template <typename Time>
    Time radius(const Time &tau) const
    {
      return Time(0.5) + Time(0.15) * sine_wave(tau);
    }

    template <typename Space, typename Time, std::size_t dim>
    Space operator()(const std::array<Space, dim> &x, const Time &tau) const
    {
      return sum_of_squares(x) - square(radius(tau));
    }

    double solid_volume(double tau, int dimension) const;
  };

  /**
   * A star that breathes and rotates once in a period. The front is r = R (1 + e cos(m
   * phi) + O(e^2)); unlike that, the form with w = (x + i y)/R, rotated,
   *
   *   (|w|^2 - 1)/2 - 2 e Re(w^m)/(1 + |w|^(2m))
   *
   * is smooth at the centre and has one closed front for every e.
   */
  struct Star
  {
    static constexpr const char *what = "star that breathes and rotates";
    static constexpr double kappa = 4;
    static constexpr std::array<double, 3> lower{-1, -1, 0}, upper{1, 1, 0};

    int points;
    double amplitude;
    double area_over_square_of_radius;

    template <typename Time>
    Time radius(const Time &tau) const
    {
      return Time(0.5) + Time(0.1) * sine_wave(tau);
    }

    template <typename Space, typename Time>
    Space operator()(const std::array<Space, 2> &x, const Time &tau) const
    {
      const Time mean = radius(tau);
      const Time cosine = cosine_wave(tau) / mean, sine = sine_wave(tau) / mean;
      const Space u = x[0] * cosine + x[1] * sine, v = x[1] * cosine - x[0] * sine;
      const Space rho_squared = square(u) + square(v);
      // Re(w^n) = 2 Re(w) Re(w^(n-1)) - |w|^2 Re(w^(n-2))
      Space before = u, wave = 2. * square(u) - rho_squared, power = square(rho_squared);
      for(int n = 2; n < points; ++n)
      {
        const Space next = 2. * (u * wave) - rho_squared * before;
        before = wave;
        wave = next;
        power = power * rho_squared;
      }
      const Space bumps = (2 * amplitude) * wave / (power + Time(1));
      return (0.5 * (rho_squared - Time(1)) - bumps) * (Time(2) * square(mean));
    }

    double solid_volume(double tau, int dimension) const;
  };

  /** An ellipse or ellipsoid that moves and grows. */
  struct Ellipse
  {
    static constexpr const char *what = "ellipse or ellipsoid that moves and grows";
    static constexpr double kappa = 5;
    static constexpr std::array<double, 3> lower{-1, -1, -1}, upper{1, 1, 1};

    template <typename Time>
    std::array<Time, 3> half_axes(const Time &tau) const
    {
      return {Time(0.4) + Time(0.12) * tau, Time(0.25) + Time(0.15) * tau,
              Time(0.3) + Time(0.06) * tau};
    }

    template <typename Space, typename Time, std::size_t dim>
    Space operator()(const std::array<Space, dim> &x, const Time &tau) const
    {
      const auto axes = half_axes(tau);
      Space sum = square(x[0] + (Time(0.3) - Time(0.6) * tau)) / square(axes[0])
                  + square(x[1] + (Time(0.1) - Time(0.2) * tau)) / square(axes[1]);
      if constexpr(dim == 3)
        sum = sum + square(x[2]) / square(axes[2]);
      return 0.2 * (sum - Time(1));
    }

    double solid_volume(double tau, int dimension) const;
  };

  /** Two bodies about x = -1/2 and 1/2 that merge at the origin and part again: the
   * product of the squares of the distances from the two points is constant on the front
   * (Cassini's ovals). */
  struct TwoDisks
  {
    static constexpr const char *what = "two bodies that merge and part";
    static constexpr double kappa = 4;
    static constexpr std::array<double, 3> lower{-1, -0.6, -0.6}, upper{1, 0.6, 0.6};
    static constexpr double place = 0.5;

    int power;

    /** What the product of the squares of the distances lacks to that at contact. */
    template <typename Time>
    Time gap(const Time &tau) const
    {
      const double at_contact = place * place * place * place;
      return Time(at_contact / 2) * odd_power_of_cosine(tau, power);
    }

    /** The product of the squares multiplied out, without the constants that would cancel
     * at the saddle and leave round-off. */
    template <typename Space, typename Time, std::size_t dim>
    Space operator()(const std::array<Space, dim> &x, const Time &tau) const
    {
      const Space along = square(x[0]), across = sum_of_squares(x, 1);
      return (1 / (4 * place * place * place))
             * (square(along + across) + (2 * place * place) * (across - along)
                + gap(tau));
    }

    double solid_volume(double tau, int dimension) const;
  };

  /** A finger from the wall x = -0.6 with a neck at x = 0 that pinches off. */
  struct Finger
  {
    static constexpr const char *what = "finger that pinches off and joins again";
    static constexpr double kappa = 4;
    static constexpr std::array<double, 3> lower{-0.6, -0.8, -0.8}, upper{1, 0.8, 0.8};

    int power;

    /** The square of the half width of the neck. */
    template <typename Time>
    Time neck(const Time &tau) const
    {
      return Time(0.012) * odd_power_of_cosine(tau, power);
    }

    template <typename Space, typename Time, std::size_t dim>
    Space operator()(const std::array<Space, dim> &x, const Time &tau) const
    {
      const Space slope = (-1 / 1.2) * x[0] + Time(0.5);
      return 2. * (sum_of_squares(x, 1) - square(x[0]) * slope - neck(tau));
    }

    double solid_volume(double tau, int dimension) const;
  };

  inline Star three_pointed_star()
  {
    return {3, 0.2, 3.1586603521700985};
  }

  inline Star five_pointed_star()
  {
    return {5, 0.15, 3.1528172290517888};
  }
} // namespace meltfront::cases::manufactured

#endif
