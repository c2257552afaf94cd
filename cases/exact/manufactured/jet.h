#ifndef meltfront_cases_exact_manufactured_jet_h
#define meltfront_cases_exact_manufactured_jet_h

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace meltfront::cases::manufactured
{
  /** A function of time as its Taylor polynomial c0 + c1 dt + c2 dt^2. */
  struct TimeJet
  {
    std::array<double, 3> c{};

    TimeJet() = default;
    TimeJet(double constant)
      : c{constant, 0, 0}
    {
    }
    TimeJet(double c0, double c1, double c2)
      : c{c0, c1, c2}
    {
    }
  };

  inline TimeJet operator+(const TimeJet &a, const TimeJet &b)
  {
    return {a.c[0] + b.c[0], a.c[1] + b.c[1], a.c[2] + b.c[2]};
  }

  inline TimeJet operator-(const TimeJet &a, const TimeJet &b)
  {
    return {a.c[0] - b.c[0], a.c[1] - b.c[1], a.c[2] - b.c[2]};
  }

  inline TimeJet operator*(const TimeJet &a, const TimeJet &b)
  {
    return {a.c[0] * b.c[0], a.c[0] * b.c[1] + a.c[1] * b.c[0],
            a.c[0] * b.c[2] + a.c[1] * b.c[1] + a.c[2] * b.c[0]};
  }

  /** The polynomial of g(a) from g and its first two derivatives at the value of a. */
  inline TimeJet composed(const TimeJet &a, double g, double g1, double g2)
  {
    return {g, g1 * a.c[1], g1 * a.c[2] + g2 / 2 * a.c[1] * a.c[1]};
  }

  inline TimeJet operator/(const TimeJet &a, const TimeJet &b)
  {
    const double r = 1 / b.c[0];
    return a * composed(b, r, -r * r, 2 * r * r * r);
  }

  inline TimeJet sin(const TimeJet &a)
  {
    return composed(a, std::sin(a.c[0]), std::cos(a.c[0]), -std::sin(a.c[0]));
  }

  inline TimeJet cos(const TimeJet &a)
  {
    return composed(a, std::cos(a.c[0]), -std::sin(a.c[0]), -std::cos(a.c[0]));
  }

  inline bool operator<(const TimeJet &a, double b)
  {
    return a.c[0] < b;
  }

  /** How many monomials of a number of variables have at most a degree. */
  constexpr std::size_t count_monomials(int variables, int degree)
  {
    std::size_t count = 1;
    for(int n = 1; n <= variables; ++n)
      count = count * static_cast<std::size_t>(degree + n) / static_cast<std::size_t>(n);
    return count;
  }

  /**
   * The monomials of a Jet: those of space up to `space_degree` without time, up to
   * `rate_degree` times dt, and dt^2 alone, in this order. With 3 and 2 that is what
   * a manufactured heat source needs of a level set, with 5 and 3 what it needs where the
   * front's curvature is in the temperature, with 2 and -1, which is without time, what a
   * search for the front needs. Any product's terms outside come from factors outside or
   * stay outside, so that the rest can be left away.
   */
  template <int dim, int space_degree = 3, int rate_degree = 2>
  struct Monomials
  {
    static_assert(rate_degree < space_degree);
    static constexpr bool moves = rate_degree >= 0;
    struct Exponents
    {
      std::array<int, 3> space;
      int time;
    };
    struct Product
    {
      std::size_t left, right, result;
    };

    /** The highest degree, dt counted too. */
    static constexpr int highest = space_degree;
    /** Those of space that stand with dt^0, dt^1 and dt^2. */
    static constexpr std::array<int, 3> highest_of{space_degree, rate_degree,
                                                   moves ? 0 : -1};

    /** How many hold dt^0 and dt^1; then comes dt^2. */
    static constexpr std::size_t timeless = count_monomials(dim, space_degree);
    static constexpr std::size_t linear = moves ? count_monomials(dim, rate_degree) : 0;
    static constexpr std::size_t count = timeless + (moves ? linear + 1 : 0);
    /** Pairs of monomials of which the product is one: those of space alone, as many as
     * monomials of twice as many variables; with dt in either; with dt^2. */
    static constexpr std::size_t n_products
        = count_monomials(2 * dim, space_degree)
          + (moves ? 2 * count_monomials(2 * dim, rate_degree) + 3 : 0);

    static constexpr std::array<Exponents, count> list()
    {
      std::array<Exponents, count> all{};
      std::size_t n = 0;
      for(int time = 0; time < 3; ++time)
        for(int degree = 0; degree <= highest_of[time]; ++degree)
          for(int i = degree; i >= 0; --i)
            for(int j = degree - i; j >= (dim == 2 ? degree - i : 0); --j)
              all[n++] = {{i, j, degree - i - j}, time};
      return all;
    }

    /** Place in the list; `count` where it is not there. */
    static constexpr std::size_t index(const Exponents &wanted)
    {
      const int degree = wanted.space[0] + wanted.space[1] + wanted.space[2];
      if(wanted.time > 2 || degree > highest_of[wanted.time])
        return count;
      constexpr auto all = list();
      std::size_t n = 0;
      for(; n < count; ++n)
        if(all[n].time == wanted.time && all[n].space[0] == wanted.space[0]
           && all[n].space[1] == wanted.space[1] && all[n].space[2] == wanted.space[2])
          break;
      return n;
    }

    /** For each of them the place of its product with a coordinate. */
    static constexpr std::array<std::size_t, count> raised(int direction)
    {
      auto all = list();
      std::array<std::size_t, count> places{};
      for(std::size_t i = 0; i < count; ++i)
      {
        ++all[i].space[direction];
        places[i] = index(all[i]);
      }
      return places;
    }

    static constexpr std::array<Product, n_products> products()
    {
      constexpr auto all = list();
      std::array<Product, n_products> pairs{};
      std::size_t n = 0;
      for(std::size_t i = 0; i < count; ++i)
        for(std::size_t j = 0; j < count; ++j)
        {
          const auto &a = all[i], &b = all[j];
          const std::size_t result
              = index({{a.space[0] + b.space[0], a.space[1] + b.space[1],
                        a.space[2] + b.space[2]},
                       a.time + b.time});
          if(result < count)
            pairs[n++] = {i, j, result};
        }
      return pairs;
    }
  };

  /** A function of place and time as its Taylor polynomial with Monomials. */
  template <typename Terms>
  struct Jet
  {
    std::array<double, Terms::count> c{};

    /** A coordinate: value + slope dx. */
    static Jet variable(int direction, double value, double slope)
    {
      Jet x;
      x.c[0] = value;
      x.c[1 + static_cast<std::size_t>(direction)] = slope;
      return x;
    }
  };

  template <typename Terms>
  Jet<Terms> operator*(const Jet<Terms> &a, const Jet<Terms> &b)
  {
    static constexpr auto pairs = Terms::products();
    Jet<Terms> result;
    // Written out by the compiler: a loop over the table would be several times slower.
    [&]<std::size_t... n>(std::index_sequence<n...>)
    {
      ((result.c[pairs[n].result] += a.c[pairs[n].left] * b.c[pairs[n].right]), ...);
    }
    (std::make_index_sequence<Terms::n_products>());
    return result;
  }

  template <typename Terms>
  Jet<Terms> operator*(const Jet<Terms> &a, const TimeJet &b)
  {
    Jet<Terms> result;
    for(std::size_t i = 0; i < Terms::timeless; ++i)
      result.c[i] = a.c[i] * b.c[0];
    for(std::size_t i = 0; i < Terms::linear; ++i)
      result.c[Terms::timeless + i] = a.c[Terms::timeless + i] * b.c[0] + a.c[i] * b.c[1];
    if constexpr(Terms::moves)
      result.c[Terms::count - 1] = a.c[Terms::count - 1] * b.c[0]
                                   + a.c[Terms::timeless] * b.c[1] + a.c[0] * b.c[2];
    return result;
  }

  template <typename Terms>
  Jet<Terms> operator/(const Jet<Terms> &a, const TimeJet &b)
  {
    return a * (TimeJet(1) / b);
  }

  template <typename Terms>
  Jet<Terms> operator*(double factor, Jet<Terms> a)
  {
    for(double &coefficient : a.c)
      coefficient *= factor;
    return a;
  }

  template <typename Terms>
  Jet<Terms> operator+(Jet<Terms> a, const Jet<Terms> &b)
  {
    for(std::size_t i = 0; i < a.c.size(); ++i)
      a.c[i] += b.c[i];
    return a;
  }

  template <typename Terms>
  Jet<Terms> operator-(Jet<Terms> a, const Jet<Terms> &b)
  {
    for(std::size_t i = 0; i < a.c.size(); ++i)
      a.c[i] -= b.c[i];
    return a;
  }

  template <typename Terms>
  Jet<Terms> operator+(Jet<Terms> a, const TimeJet &b)
  {
    a.c[0] += b.c[0];
    if constexpr(Terms::moves)
    {
      a.c[Terms::timeless] += b.c[1];
      a.c.back() += b.c[2];
    }
    return a;
  }

  template <typename Terms>
  Jet<Terms> operator-(Jet<Terms> a, const TimeJet &b)
  {
    return a + TimeJet(-b.c[0], -b.c[1], -b.c[2]);
  }

  /** By the geometric series of 1/(1 + e), which ends as a power of e above the highest
   * degree is beyond all Monomials. */
  template <typename Terms>
  Jet<Terms> operator/(const Jet<Terms> &a, const Jet<Terms> &b)
  {
    static_assert(Terms::highest <= 5);
    Jet<Terms> e = (1 / b.c[0]) * b;
    e.c[0] = 0;
    const auto square = e * e;
    auto even = square + TimeJet(1);
    if constexpr(Terms::highest > 3)
      even = square * even + TimeJet(1);
    return (1 / b.c[0]) * ((a - a * e) * even);
  }

  /** a^exponent for a positive a, by the binomial series about its value. */
  template <typename Terms>
  Jet<Terms> power(const Jet<Terms> &a, double exponent)
  {
    Jet<Terms> e = (1 / a.c[0]) * a, sum;
    e.c[0] = 0;
    sum.c[0] = 1;
    for(int n = Terms::highest; n > 0; --n)
      sum = ((exponent - n + 1) / n) * (e * sum) + TimeJet(1);
    return std::pow(a.c[0], exponent) * sum;
  }

  /** Along a coordinate; its coefficients of the highest degrees, which need higher ones
   * of a, are left zero. */
  template <typename Terms>
  Jet<Terms> derivative(const Jet<Terms> &a, int direction)
  {
    static constexpr auto all = Terms::list();
    static constexpr std::array raised{Terms::raised(0), Terms::raised(1),
                                       Terms::raised(2)};
    Jet<Terms> result;
    for(std::size_t i = 0; i < Terms::count; ++i)
      if(const std::size_t higher = raised[direction][i]; higher < Terms::count)
        result.c[i] = all[higher].space[direction] * a.c[higher];
    return result;
  }
} // namespace meltfront::cases::manufactured

#endif
