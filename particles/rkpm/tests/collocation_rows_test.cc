#include <cases/error.h>
#include <particles/rkpm/collocation_rows.h>
#include <particles/rkpm/tests/scattered.h>
#include <particles/scattered/linear_solver.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace meltfront::particles::rkpm
{
  namespace
  {
    using std::numbers::pi;

    /** div(k grad u) = k lap u + grad k . grad u. */
    RowCoefficients conduction_row(double conductivity,
                                   const std::array<double, 3> &slope = {})
    {
      return {0, slope, conductivity};
    }

    /** The reconstructed value. */
    const RowCoefficients dirichlet_row{1, {}, 0};

    /** The function that a system of rows reconstructs at its particles. */
    std::vector<double> solve(const ReproducingWeights &weights,
                              const std::vector<RowCoefficients> &conditions,
                              const std::vector<double> &right_side)
    {
      const CompressedRows rows = collocation_rows(weights, conditions);
      LinearSolverParameters parameters;
      parameters.method = LinearMethod::direct;
      std::vector<double> nodal(rows.rows()), result;
      EXPECT_TRUE(LinearSolver(rows, parameters).solve(right_side, nodal).converged);
      for(std::size_t i = 0; i < rows.rows(); ++i)
        result.push_back(weights.apply(0, i, nodal));
      return result;
    }

    bool on_edge(const ParticleStorage &particles, std::size_t a)
    {
      for(int d = 0; d < particles.dimension; ++d)
        if(particles.position[d][a] == 0 || particles.position[d][a] == 1)
          return true;
      return false;
    }

    // k = 1 + x, u = x^2 + 2 y^2 - z^2 + y + 3 and each kind of row.
    TEST(CollocationRows, AreExactForQuadraticFunctions)
    {
      for(int dim = 1; dim <= 3; ++dim)
      {
        const ParticleStorage particles = perturbed_box(dim, dim == 3 ? 8 : 15, 4);
        const auto weights = compute_weights(
            particles, particles,
            {Variant::derivative_free, KernelShape::wendland_c4, dim, 2}, {}, 1);
        const std::array<double, 3> normal{0.6, dim > 1 ? 0.8 : 0, 0};
        std::vector<RowCoefficients> conditions;
        std::vector<double> values, expected;
        for(std::size_t a = 0; a < particles.size(); ++a)
        {
          const auto [x, y, z] = particles.point(a);
          const double u = x * x + 2 * y * y - z * z + y + 3;
          const double slope = normal[0] * 2 * x + normal[1] * (4 * y + 1);
          const double laplacian = dim == 1 ? 2 : dim == 2 ? 6 : 4;
          values.push_back(u);
          switch(a % 4)
          {
          case 0:
            conditions.push_back(conduction_row(1 + x, {1, 0, 0}));
            expected.push_back((1 + x) * laplacian + 2 * x);
            break;
          case 1:
            conditions.push_back(dirichlet_row);
            expected.push_back(u);
            break;
          case 2:
            conditions.push_back(robin_row(1 + x, 0, normal));
            expected.push_back((1 + x) * slope);
            break;
          default:
            conditions.push_back(robin_row(1 + x, 7, normal));
            expected.push_back((1 + x) * slope + 7 * u);
          }
        }
        const CompressedRows rows = collocation_rows(weights, conditions);
        std::vector<double> result(rows.rows());
        rows.multiply(values, result, 1);
        for(std::size_t a = 0; a < rows.rows(); ++a)
        {
          double largest = 0;
          for(std::size_t e = rows.offsets[a]; e < rows.offsets[a + 1]; ++e)
            largest = std::max(largest, std::abs(rows.coefficients[e]));
          EXPECT_NEAR(result[a], expected[a], 1e-12 * largest) << dim << ' ' << a;
        }
      }
    }

    /** Largest error of u = x^2 on (-1, 1), u'' = 2, with u or u' given on the right. */
    double parabola_error(const MomentSettings &how, int number, double share,
                          bool neumann)
    {
      ParticleStorage particles = perturbed_box(1, number, 9, share, false);
      for(double &x : particles.position[0])
        x = 2 * x - 1;
      const double h = 2. / (number - 1);
      const auto weights
          = compute_weights(particles, particles, how,
                            {SupportRule::fixed_dilation, how.order + 1.5, h, 0}, 1);
      std::vector<RowCoefficients> conditions(number, conduction_row(1));
      std::vector<double> right(number, 2.);
      conditions.front() = conditions.back() = dirichlet_row;
      right.front() = right.back() = 1;
      if(neumann)
      {
        conditions.back() = robin_row(1, 0, {1, 0, 0});
        right.back() = 2;
      }
      const auto u = solve(weights, conditions, right);
      double worst = 0;
      for(int i = 0; i < number; ++i)
        worst = std::max(
            worst, std::abs(u[i] - particles.position[0][i] * particles.position[0][i]));
      return worst;
    }

    TEST(CollocationRows, AllKernelsSolveForAParabola)
    {
      double dirichlet = 0, neumann = 0;
      for(const std::string &name : kernel_names())
        for(const int order : {2, 3})
          for(const Variant form : {Variant::derivative_free, Variant::fixed_point,
                                    Variant::point_collocation, Variant::moving})
          {
            const KernelShape kernel = kernel_shape(name);
            if(differentiates_kernel(form) && kernel == KernelShape::hat)
              continue;
            const MomentSettings how{form, kernel, 1, order};
            for(const int number : {21, 41})
            {
              dirichlet = std::max(dirichlet, parabola_error(how, number, 0, false));
              if(!differentiates_kernel(form))
                neumann = std::max(neumann, parabola_error(how, number, 0, true));
            }
          }
      EXPECT_LT(dirichlet, 1e-10);
      EXPECT_LT(neumann, 1e-9);
      RecordProperty("dirichlet", std::to_string(std::log10(dirichlet)));
      RecordProperty("neumann", std::to_string(std::log10(neumann)));
    }

    /** Error of a Dirichlet problem with u = sin(pi x + .3) cos(1.5 pi y + .2), as a
     * share of its largest value. */
    double wave_error(int order, int per_side, std::uint64_t seed)
    {
      const ParticleStorage particles = perturbed_box(2, per_side, seed, 0.25, false);
      const auto weights = compute_weights(
          particles, particles,
          {Variant::derivative_free, KernelShape::wendland_c4, 2, order}, {}, 1);
      std::vector<RowCoefficients> conditions;
      std::vector<double> exact, right;
      for(std::size_t a = 0; a < particles.size(); ++a)
      {
        const auto x = particles.point(a);
        exact.push_back(std::sin(pi * x[0] + 0.3) * std::cos(1.5 * pi * x[1] + 0.2));
        const bool wall = on_edge(particles, a);
        conditions.push_back(wall ? dirichlet_row : conduction_row(1));
        right.push_back(wall ? exact[a] : -3.25 * pi * pi * exact[a]);
      }
      const auto u = solve(weights, conditions, right);
      double sum = 0, largest = 0;
      for(std::size_t a = 0; a < particles.size(); ++a)
      {
        sum += (u[a] - exact[a]) * (u[a] - exact[a]);
        largest = std::max(largest, std::abs(exact[a]));
      }
      return std::sqrt(sum / static_cast<double>(particles.size())) / largest;
    }

    /** Slope of the least-squares line of log(error) over log(h), with the geometric mean
     * of three seeds on each of four levels. */
    double fitted_order(int order, double &finest)
    {
      constexpr int levels[] = {11, 17, 27, 41};
      double x[4], y[4], mean_x = 0, mean_y = 0;
      for(int i = 0; i < 4; ++i)
      {
        x[i] = -std::log(levels[i] - 1.);
        y[i] = 0;
        for(const std::uint64_t seed : {1, 2, 3})
          y[i] += std::log(wave_error(order, levels[i], seed)) / 3;
        mean_x += x[i] / 4;
        mean_y += y[i] / 4;
      }
      double above = 0, below = 0;
      for(int i = 0; i < 4; ++i)
      {
        above += (x[i] - mean_x) * (y[i] - mean_y);
        below += (x[i] - mean_x) * (x[i] - mean_x);
      }
      finest = std::exp(y[3]);
      return above / below;
    }

    // An independent program found 8.8e-4 and 2.7e-6 with 41 particles to a side.
    TEST(CollocationRows, SolutionsConvergeOnDisorderedParticles)
    {
      double finest = 0;
      const double second = fitted_order(2, finest);
      EXPECT_NEAR(second, 2, 0.3);
      EXPECT_LT(finest, 2 * 8.8e-4);
      EXPECT_GT(finest, 0.5 * 8.8e-4);
      const double fourth = fitted_order(4, finest);
      EXPECT_GT(fourth, 3.3);
      EXPECT_LT(finest, 2 * 2.7e-6);
      RecordProperty("second", std::to_string(second));
      RecordProperty("fourth", std::to_string(fourth));
    }

    TEST(CollocationRows, BadInputIsRefusedInWords)
    {
      const ParticleStorage particles = perturbed_box(1, 9, 1);
      MomentSettings how{Variant::derivative_free, KernelShape::wendland_c4, 1, 2};
      const auto weights = compute_weights(particles, particles, how, {}, 1);
      std::vector<RowCoefficients> conditions(9, conduction_row(1));
      EXPECT_NO_THROW(collocation_rows(weights, conditions));
      conditions[3] = {};
      EXPECT_THROW(collocation_rows(weights, conditions), cases::NumericalError);
      conditions[3].value = std::numeric_limits<double>::quiet_NaN();
      EXPECT_THROW(collocation_rows(weights, conditions), cases::NumericalError);
      conditions.pop_back();
      EXPECT_THROW(collocation_rows(weights, conditions), cases::InputError);
      how.derivatives = 1;
      const auto first = compute_weights(particles, particles, how, {}, 1);
      EXPECT_THROW(
          collocation_rows(first, std::vector<RowCoefficients>(9, conduction_row(1))),
          cases::InputError);
    }
  } // namespace
} // namespace meltfront::particles::rkpm
