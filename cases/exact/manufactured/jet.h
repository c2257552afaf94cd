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

  /**
   * The monomials of a Jet: those of space up to degree 3 without time, up to degree 2
   * times dt, and dt^2 alone, in this order. That is what a manufactured heat source
   * needs of a level set; any product's terms outside come from factors outside or stay
   * outside, so that the rest can be left away.
   */
  template <int dim>
  struct Monomials
  {
    struct Exponents
    {
      std::array<int, 3> space;
      int time;
    };
    struct Product
    {
      std::size_t left, right, result;
    };

    /** How many hold dt^0 and dt^1; then comes dt^2. */
    static constexpr std::size_t timeless = dim == 2 ? 10 : 20;
    static constexpr std::size_t linear = dim == 2 ? 6 : 10;
    static constexpr std::size_t count = timeless + linear + 1;
    static constexpr std::size_t n_products = dim == 2 ? 68 : 143;

    static constexpr std::array<Exponents, count> list()
    {
      std::array<Exponents, count> all{};
      std::size_t n = 0;
      const std::array<int, 3> highest{3, 2, 0};
      for(int time = 0; time < 3; ++time)
        for(int degree = 0; degree <= highest[time]; ++degree)
          for(int i = degree; i >= 0; --i)
            for(int j = degree - i; j >= (dim == 2 ? degree - i : 0); --j)
              all[n++] = {{i, j, degree - i - j}, time};
      return all;
    }

    /** Place in the list; `count` where it is not there. */
    static constexpr std::size_t index(const Exponents &wanted)
    {
      constexpr auto all = list();
      std::size_t n = 0;
      for(; n < count; ++n)
        if(all[n].time == wanted.time && all[n].space[0] == wanted.space[0]
           && all[n].space[1] == wanted.space[1] && all[n].space[2] == wanted.space[2])
          break;
      return n;
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

  /** A function of place and time as its Taylor polynomial with the above Monomials. */
  template <int dim>
  struct Jet
  {
    using Terms = Monomials<dim>;
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

  template <int dim>
  Jet<dim> operator*(const Jet<dim> &a, const Jet<dim> &b)
  {
    using Terms = Monomials<dim>;
    static constexpr auto pairs = Terms::products();
    Jet<dim> result;
    // Written out by the compiler: a loop over the table would be several times slower.
    [&]<std::size_t... n>(std::index_sequence<n...>)
    {
      ((result.c[pairs[n].result] += a.c[pairs[n].left] * b.c[pairs[n].right]), ...);
    }
    (std::make_index_sequence<Terms::n_products>());
    return result;
  }

  template <int dim>
  Jet<dim> operator*(const Jet<dim> &a, const TimeJet &b)
  {
    using Terms = Monomials<dim>;
    Jet<dim> result;
    for(std::size_t i = 0; i < Terms::timeless; ++i)
      result.c[i] = a.c[i] * b.c[0];
    for(std::size_t i = 0; i < Terms::linear; ++i)
      result.c[Terms::timeless + i] = a.c[Terms::timeless + i] * b.c[0] + a.c[i] * b.c[1];
    result.c[Terms::count - 1] = a.c[Terms::count - 1] * b.c[0]
                                 + a.c[Terms::timeless] * b.c[1] + a.c[0] * b.c[2];
    return result;
  }

  template <int dim>
  Jet<dim> operator/(const Jet<dim> &a, const TimeJet &b)
  {
    return a * (TimeJet(1) / b);
  }

  template <int dim>
  Jet<dim> operator*(double factor, Jet<dim> a)
  {
    for(double &coefficient : a.c)
      coefficient *= factor;
    return a;
  }

  template <int dim>
  Jet<dim> operator+(Jet<dim> a, const Jet<dim> &b)
  {
    for(std::size_t i = 0; i < a.c.size(); ++i)
      a.c[i] += b.c[i];
    return a;
  }

  template <int dim>
  Jet<dim> operator-(Jet<dim> a, const Jet<dim> &b)
  {
    for(std::size_t i = 0; i < a.c.size(); ++i)
      a.c[i] -= b.c[i];
    return a;
  }

  template <int dim>
  Jet<dim> operator+(Jet<dim> a, const TimeJet &b)
  {
    a.c[0] += b.c[0];
    a.c[Monomials<dim>::timeless] += b.c[1];
    a.c.back() += b.c[2];
    return a;
  }

  template <int dim>
  Jet<dim> operator-(Jet<dim> a, const TimeJet &b)
  {
    return a + TimeJet(-b.c[0], -b.c[1], -b.c[2]);
  }

  /** By the geometric series of 1/(1 + e), which ends as the fourth power of e is beyond
   * all Monomials. */
  template <int dim>
  Jet<dim> operator/(const Jet<dim> &a, const Jet<dim> &b)
  {
    Jet<dim> e = (1 / b.c[0]) * b;
    e.c[0] = 0;
    return (1 / b.c[0]) * ((a - a * e) * (e * e + TimeJet(1)));
  }
} // namespace meltfront::cases::manufactured

#endif
