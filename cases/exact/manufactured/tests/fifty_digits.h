#ifndef meltfront_cases_exact_manufactured_tests_fifty_digits_h
#define meltfront_cases_exact_manufactured_tests_fifty_digits_h

// The families and the temperature over fifty digits, by differences of the level set
// alone: nothing of the derivatives under test is used.

#include <cases/exact/manufactured/formulas.h>
#include <cases/exact/manufactured/manufactured_solution.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <random>

namespace meltfront::cases::manufactured
{
  /** Twice fifty, as differences of the fifth order lose half of them. */
  using Real = boost::multiprecision::cpp_bin_float_100;

  inline constexpr double period = 3, length_scale = 0.4;

  /** Contrasts of one, ten, a hundred and its mirror; densities differ in the second. */
  inline std::vector<Material> materials()
  {
    return {{{1, 1, 1}, {1, 1, 1}, 1, 0},
            {{1, 1, 0.9}, {0.1, 2, 1}, 0.7, 0},
            {{1, 1, 1}, {0.01, 4, 1}, 1, 0},
            {{1, 1, 1}, {100, 0.25, 1}, 1, 0}};
  }

  /** Call f(name, formula, dimension as an integral constant) for all families. */
  template <typename Function>
  void for_each_family(const Function &f, int power = 3)
  {
    const std::integral_constant<int, 2> two;
    const std::integral_constant<int, 3> three;
    f("plane", Plane(), two);
    f("plane", Plane(), three);
    f("disk", Disk(), two);
    f("disk", Disk(), three);
    f("star-3", three_pointed_star(), two);
    f("star-5", five_pointed_star(), two);
    f("ellipse", Ellipse(), two);
    f("ellipse", Ellipse(), three);
    f("two-disks", TwoDisks{power}, two);
    f("two-disks", TwoDisks{power}, three);
    f("finger", Finger{power}, two);
    f("finger", Finger{power}, three);
  }

  inline std::vector<std::shared_ptr<const FrontFamily>>
  all_families(double family_period, double family_length)
  {
    std::vector<std::shared_ptr<const FrontFamily>> all;
    for_each_family(
        [&](const char *name, const auto &, auto dim) {
          all.push_back(make_front_family({name, dim, family_period, family_length, 3}));
        });
    return all;
  }

  class RandomPlace
  {
  public:
    explicit RandomPlace(const FrontFamily &family)
      : corners(family.domain())
    {
    }

    Position operator()()
    {
      Position p{};
      for(int d = 0; d < 3; ++d)
        p[d] = corners.first[d] + share() * (corners.second[d] - corners.first[d]);
      return p;
    }

    double share()
    {
      return std::uniform_real_distribution<double>(0, 1)(generator);
    }

  private:
    std::pair<Position, Position> corners;
    std::mt19937 generator{12345};
  };

  /** A place on the front between two random places, one in each phase. */
  inline Position random_front_place(const FrontFamily &family, RandomPlace &random,
                                     double time)
  {
    Position solid = random(), liquid = random();
    while(family.level_set(solid, time) >= 0)
      solid = random();
    while(family.level_set(liquid, time) < 0)
      liquid = random();
    Position middle{};
    for(int n = 0; n < 60; ++n)
    {
      for(int d = 0; d < 3; ++d)
        middle[d] = (solid[d] + liquid[d]) / 2;
      (family.level_set(middle, time) < 0 ? solid : liquid) = middle;
    }
    return middle;
  }

  /** Level set, temperature and source of a formula by differences. */
  template <typename Formula, int dim>
  class Differences
  {
  public:
    using Place = std::array<Real, dim>;

    explicit Differences(const Formula &formula)
      : formula(formula)
    {
    }

    Real level_set(const Place &x, const Real &t) const
    {
      Place scaled;
      for(int d = 0; d < dim; ++d)
        scaled[d] = x[d] / Real(length_scale);
      return length_scale * formula(scaled, Real(t / period));
    }

    /** Once along each of the directions, where 3 is time. */
    Real derivative(std::vector<int> along, const Place &x, const Real &t) const
    {
      return nested([&](const Place &y, const Real &s) { return level_set(y, s); },
                    std::move(along), x, t, 1e-8);
    }

    /** T - T_m in the phase that the sign of the level set tells. */
    Real excess_temperature(const Material &material, double g, double d, const Place &x,
                            const Real &t) const
    {
      const Real f = level_set(x, t);
      const auto function
          = [&](const Place &y, const Real &s) { return level_set(y, s); };
      Real square = 0;
      for(int i = 0; i < dim; ++i)
      {
        const Real slope = nested(function, {i}, x, t, 1e-13);
        square += slope * slope;
      }
      const Real rate = nested(function, {3}, x, t, 1e-13);
      const Real latent = Real(material.solid.density) * material.latent_heat;
      Real theta = 0, carried = 0;
      if(material.gibbs_thomson_coefficient != 0)
      {
        const auto shift = [&](const Place &y, const Real &s)
        { return Real(-material.gibbs_thomson_coefficient * curvature(y, s)); };
        theta = shift(x, t);
        for(int i = 0; i < dim; ++i)
          carried += nested(shift, {i}, x, t, 1e-14) * nested(function, {i}, x, t, 1e-13);
        carried *= material.solid.conductivity - material.liquid.conductivity;
      }
      const Real J = (-latent * rate - carried)
                     / (square + Formula::kappa / length_scale * abs(f));
      const Real root = sqrt(J * J + Real(d) * d);
      return theta
             + (f < 0 ? Real((g + (J + root) / 2) * f / material.solid.conductivity)
                      : Real((g + (root - J) / 2) * f / material.liquid.conductivity));
    }

    /** The front's, continued: (S lap f - G.H G)/(S + (kappa f)^2)^(3/2). */
    Real curvature(const Place &x, const Real &t) const
    {
      const auto function
          = [&](const Place &y, const Real &s) { return level_set(y, s); };
      Place slope;
      Real square = 0, laplacian = 0, along = 0;
      for(int i = 0; i < dim; ++i)
      {
        slope[i] = nested(function, {i}, x, t, 1e-14);
        square += slope[i] * slope[i];
      }
      for(int i = 0; i < dim; ++i)
        for(int j = 0; j < dim; ++j)
        {
          const Real second = nested(function, {i, j}, x, t, 1e-14);
          laplacian += i == j ? second : Real(0);
          along += slope[i] * second * slope[j];
        }
      const Real f = Formula::kappa / length_scale * level_set(x, t);
      return (square * laplacian - along) / pow(Real(square + f * f), Real(1.5));
    }

    /** rho c T_t - k lap T. */
    Real source(const Material &material, double g, double d, const Place &x,
                const Real &t) const
    {
      const auto T = [&](const Place &y, const Real &s)
      { return excess_temperature(material, g, d, y, s); };
      const PhaseProperties &phase
          = level_set(x, t) < 0 ? material.solid : material.liquid;
      Real sum = phase.volumetric_heat_capacity() * nested(T, {3}, x, t, 1e-12);
      for(int i = 0; i < dim; ++i)
        sum -= phase.conductivity * nested(T, {i, i}, x, t, 1e-12);
      return sum;
    }

  private:
    Formula formula;

    template <typename Function>
    static Real nested(const Function &f, std::vector<int> along, const Place &x,
                       const Real &t, double step)
    {
      if(along.empty())
        return f(x, t);
      const int direction = along.back();
      along.pop_back();
      Place ahead = x, behind = x;
      Real later = t, earlier = t;
      (direction == 3 ? later : ahead[direction]) += step;
      (direction == 3 ? earlier : behind[direction]) -= step;
      return (nested(f, along, ahead, later, step)
              - nested(f, along, behind, earlier, step))
             / (2 * step);
    }
  };

  template <int dim>
  std::array<Real, dim> in_fifty_digits(const Position &p)
  {
    std::array<Real, dim> x;
    for(int d = 0; d < dim; ++d)
      x[d] = p[d];
    return x;
  }
} // namespace meltfront::cases::manufactured

#endif
