#include <cases/error.h>
#include <particles/core/arrangement.h>
#include <particles/core/neighbour_list.h>
#include <particles/rkpm/moment_engine.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meltfront::particles::rkpm
{
  namespace
  {
    constexpr Variant all_variants[]
        = {Variant::point_collocation, Variant::fixed_point, Variant::moving,
           Variant::multiple_fixed, Variant::derivative_free};

    /** Particles in a unit box moved by at most a quarter of the spacing. */
    ParticleStorage perturbed_box(int dimension, int per_side, std::uint64_t seed)
    {
      std::array<LatticeDirection, 3> sides;
      sides.fill({0, 1, LatticeLayout::on_edge});
      const double h = 1. / (per_side - 1);
      ParticleStorage particles = arrange_in_box(dimension, sides, h);
      jitter(particles, 0.25 * h, seed,
             [](const std::array<double, 3> &) { return true; });
      return particles;
    }

    std::vector<std::uint32_t> everyone(const ParticleStorage &particles)
    {
      std::vector<std::uint32_t> all(particles.size());
      std::iota(all.begin(), all.end(), 0);
      return all;
    }

    int degree(const MultiIndex &a)
    {
      return a[0] + a[1] + a[2];
    }

    double power(double base, int exponent)
    {
      double product = 1;
      for(int i = 0; i < exponent; ++i)
        product *= base;
      return product;
    }

    /** A way to evaluate: particles per side so that the support lies in the box. */
    struct Setting
    {
      int dimension;
      int order;
      int per_side;
    };

    constexpr Setting settings[]
        = {{1, 1, 15}, {1, 2, 15}, {1, 3, 15}, {1, 4, 19}, {1, 5, 21},
           {2, 1, 11}, {2, 2, 11}, {2, 3, 13}, {2, 4, 13}, {2, 5, 15},
           {3, 1, 7},  {3, 2, 7},  {3, 3, 9},  {3, 4, 11}, {3, 5, 13}};

    /** Largest error with which a variant reproduces polynomials, as a share of h^-|a|.
     */
    double reproduction_error(const Setting &setting, const MomentSettings &how,
                              std::uint64_t seed)
    {
      const ParticleStorage particles
          = perturbed_box(setting.dimension, setting.per_side, seed);
      const auto all = everyone(particles);
      const double h = 1. / (setting.per_side - 1);
      const double dilation = (setting.order + 1.5) * h;
      std::vector<double> dilations(particles.size(), dilation);
      if(how.variant == Variant::multiple_fixed)
        for(std::size_t i = 0; i < dilations.size(); ++i)
          dilations[i] *= 1 + 0.2 * std::sin(3. * i);
      std::array<double, 3> point{0.52, 0.47, 0.49};
      for(int d = setting.dimension; d < 3; ++d)
        point[d] = 0;
      MomentEngine engine(how);
      EXPECT_TRUE(engine.evaluate(point, particles, all, dilation, dilations));
      const MonomialBasis numbers(setting.dimension, how.derivatives);
      double worst = 0;
      for(int j = 0; j < engine.n_derivatives(); ++j)
        for(int f = 0; f < engine.basis().size(); ++f)
        {
          double sum = 0;
          for(std::size_t i = 0; i < all.size(); ++i)
          {
            std::array<double, 3> z = particles.point(i);
            for(int d = 0; d < setting.dimension; ++d)
              z[d] -= point[d] - 0.1 * h; // the point itself is not a root
            sum += engine.weights(j)[i] * engine.basis().derivative(f, {}, z);
          }
          const std::array<double, 3> centre{0.1 * h, 0.1 * h, 0.1 * h};
          const double exact = engine.basis().derivative(f, numbers.exponents(j), centre);
          const double scale = power(dilation, degree(engine.basis().exponents(f)))
                               / power(h, degree(numbers.exponents(j)));
          worst = std::max(worst, std::abs(sum - exact) / scale);
        }
      return worst;
    }

    TEST(MomentEngine, ReproducesPolynomialsAndTheirDerivatives)
    {
      for(const Setting &setting : settings)
        for(const Variant form : all_variants)
        {
          const double error = reproduction_error(
              setting, {form, KernelShape::wendland_c4, setting.dimension, setting.order},
              7);
          EXPECT_LT(error, 1e-11) << variant_name(form) << ' ' << setting.dimension
                                  << "D, order " << setting.order;
          RecordProperty("worst", std::to_string(error));
        }
    }
  } // namespace
} // namespace meltfront::particles::rkpm
