#include <reference_fem/fitted/fitted_problem.h>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <random>

namespace meltfront::reference_fem::fitted
{
  namespace
  {
    using dealii::SparseMatrix;
    using dealii::Vector;

    Physics physics()
    {
      Physics result;
      result.phases = {Phase{true, 2.3, 1.7, 0}, Phase{false, 0.9, 2.9, 3.1}};
      result.inner_wall
          = {cases::BoundaryKind::fixed_temperature, cases::Field::uniform(-1), false};
      result.outer_wall = {cases::BoundaryKind::flux, cases::Field::uniform(0.3), false};
      result.clock = {true, 0};
      return result;
    }

    /** Random temperatures and a front that waves around @p front. */
    Vector<double> random_state(const FittedProblem &problem, double front, double wave)
    {
      std::mt19937 generator(3);
      std::uniform_real_distribution<double> uniform(-1, 1);
      Vector<double> u(problem.size());
      for(double &value : u)
        value = uniform(generator);
      for(unsigned int ray = 0; ray < problem.mesh().surface.n_rays(); ++ray)
        u[problem.mesh().front_node(ray)] = front + wave * uniform(generator);
      return u;
    }

    struct Values
    {
      explicit Values(unsigned int n)
        : mass(n)
        , flow(n)
      {
      }
      Vector<double> mass, flow;
    };

    /** Largest difference of the Jacobians from central differences along a random
     * direction, over their size. */
    double worst_difference(const FittedProblem &problem, const Vector<double> &u)
    {
      const unsigned int n = problem.size();
      const Vector<double> rate = random_state(problem, 0.2, 0.1);
      const Vector<double> direction = random_state(problem, 0.3, 0.7);
      SparseMatrix<double> mass(problem.sparsity()), flow(problem.sparsity()),
          by_rate(problem.sparsity());
      const double clock = 0.7, step = 1e-5;
      Values at(n), upper(n), lower(n);
      problem.linearise(clock, u, rate, at.mass, at.flow, mass, flow, by_rate);

      double worst = 0;
      const auto compare = [&](const SparseMatrix<double> &matrix,
                               const Vector<double> &high, const Vector<double> &low)
      {
        Vector<double> expected(n), difference(high);
        matrix.vmult(expected, direction);
        difference -= low;
        difference /= 2 * step;
        difference -= expected;
        worst = std::max(worst, difference.linfty_norm() / expected.linfty_norm());
      };
      Vector<double> moved(u);
      moved.add(step, direction);
      problem.evaluate(clock, moved, rate, upper.mass, upper.flow);
      moved.add(-2 * step, direction);
      problem.evaluate(clock, moved, rate, lower.mass, lower.flow);
      compare(mass, upper.mass, lower.mass);
      compare(flow, upper.flow, lower.flow);
      moved = rate;
      moved.add(step, direction);
      problem.evaluate(clock, u, moved, upper.mass, upper.flow);
      moved.add(-2 * step, direction);
      problem.evaluate(clock, u, moved, lower.mass, lower.flow);
      compare(by_rate, upper.flow, lower.flow);
      return worst;
    }

    double worst_difference(const FrontSurface &surface, double inner,
                            const Physics &laws, double wave)
    {
      const FittedProblem problem(
          RayMesh(surface, inner, 1.1, {{0, 0.4, 1}, {0, 0.5, 1}}), laws);
      const Vector<double> u = random_state(problem, 0.6, wave);
      EXPECT_EQ(problem.reason_invalid(u), "");
      return worst_difference(problem, u);
    }

    TEST(FittedDerivatives, MatchDifferencesInOneDimension)
    {
      for(const int exponent : {0, 1, 2})
        EXPECT_LT(
            worst_difference(FrontSurface::point(3, 2, exponent), 0.2, physics(), 0),
            1e-7)
            << exponent;
    }

    TEST(FittedDerivatives, MatchDifferencesWithMovingLiquid)
    {
      Physics laws = physics();
      laws.displacement = 0.083;
      for(const int exponent : {0, 1, 2})
        EXPECT_LT(worst_difference(FrontSurface::point(3, 2, exponent), 0.2, laws, 0),
                  1e-7)
            << exponent;
    }

    TEST(FittedDerivatives, MatchDifferencesAlongWavingFronts)
    {
      EXPECT_LT(
          worst_difference(FrontSurface::line(3, 2, 0, 1, false), 0, physics(), 0.1),
          1e-7);
      EXPECT_LT(worst_difference(FrontSurface::circle(3, 4), 0.2, physics(), 0.1), 1e-7);
      EXPECT_LT(worst_difference(FrontSurface::circle(3, 4), 0, physics(), 0.1), 1e-7);
      EXPECT_LT(worst_difference(FrontSurface::rectangle(2, {2, 1}, {0, 0, 0}, {0, 1, 2},
                                                         {true, false}),
                                 0, physics(), 0.1),
                1e-7);
      EXPECT_LT(worst_difference(FrontSurface::sphere(2, 1), 0.2, physics(), 0.1), 1e-7);
      EXPECT_LT(worst_difference(FrontSurface::sphere(2, 1), 0, physics(), 0.1), 1e-7);
    }

    TEST(FittedDerivatives, MatchDifferencesWithASourceAtTheCentre)
    {
      Physics laws = physics();
      laws.power = [](double time) { return -5 - time; };
      EXPECT_LT(worst_difference(FrontSurface::point(3, 6.3, 1), 0, laws, 0), 1e-7);
      EXPECT_LT(worst_difference(FrontSurface::point(3, 12.6, 2), 0, laws, 0), 1e-7);
      EXPECT_LT(worst_difference(FrontSurface::circle(3, 4), 0, laws, 0.1), 1e-7);
      EXPECT_LT(worst_difference(FrontSurface::sphere(2, 1), 0, laws, 0.1), 1e-7);
    }

    TEST(FittedDerivatives, MatchDifferencesWithHeatReleasedThroughout)
    {
      Physics laws = physics();
      laws.volumetric_source = {"", [](const cases::Position &p, double time) {
                                  return 5 * std::sin(3 * p[0] + 2 * p[1] - p[2] + time);
                                }};
      EXPECT_LT(worst_difference(FrontSurface::point(3, 2, 0), 0.2, laws, 0), 1e-7);
      EXPECT_LT(worst_difference(FrontSurface::point(3, 12.6, 2), 0, laws, 0), 1e-7);
      EXPECT_LT(worst_difference(FrontSurface::line(3, 2, 0, 1, false), 0, laws, 0.1),
                1e-7);
      EXPECT_LT(worst_difference(FrontSurface::circle(3, 4), 0, laws, 0.1), 1e-7);
      EXPECT_LT(worst_difference(FrontSurface::sphere(2, 1), 0.2, laws, 0.1), 1e-7);
    }

    TEST(FittedProblem, FlowsSumToNothingWhateverTheState)
    {
      // All heat is accounted for: test functions add up to one.
      Physics laws = physics();
      laws.inner_wall = {cases::BoundaryKind::flux, cases::Field::uniform(2), false};
      const FittedProblem problem(
          RayMesh(FrontSurface::sphere(2, 2), 0.2, 1.1, {{0, 0.4, 1}, {0, 1}}), laws);
      const Vector<double> u = random_state(problem, 0.6, 0.1);
      Values at(problem.size());
      problem.evaluate(0.7, u, random_state(problem, 0.2, 0.1), at.mass, at.flow);
      EXPECT_LT(std::abs(at.flow.mean_value()), 1e-14 * at.flow.linfty_norm());
    }

    TEST(FrontSurface, MeasuresCirclesAndSpheresExactly)
    {
      const auto measure = [](const FrontSurface &surface)
      {
        double sum = 0;
        for(const auto &cell : surface.rule(8).cells)
          for(const double weight : cell.weight)
            sum += weight;
        return sum;
      };
      EXPECT_NEAR(measure(FrontSurface::circle(2, 3)), 2 * std::numbers::pi, 1e-13);
      EXPECT_NEAR(measure(FrontSurface::sphere(2, 2)), 4 * std::numbers::pi, 1e-9);
      EXPECT_EQ(FrontSurface::sphere(2, 2).n_rays(), 98u);
    }

    TEST(FrontSurface, DifferentiatesAlongTheSphere)
    {
      // Surface gradient of z on the unit sphere: 1 - z^2 squared in size.
      const FrontSurface surface = FrontSurface::sphere(4, 8);
      const SurfaceRule rule = surface.rule(3);
      for(std::size_t s = 0; s < surface.cells.size(); ++s)
        for(Eigen::Index q = 0; q < rule.value.rows(); ++q)
        {
          Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
          for(std::size_t a = 0; a < surface.cells[s].size(); ++a)
            for(int j = 0; j < 2; ++j)
              gradient[j] += rule.cells[s].gradient[j](q, a)
                             * surface.direction[surface.cells[s][a]][2];
          const double z = rule.cells[s].points[q].direction[2];
          EXPECT_NEAR(gradient.squaredNorm(), 1 - z * z, 1e-5);
        }
    }
  } // namespace
} // namespace meltfront::reference_fem::fitted
