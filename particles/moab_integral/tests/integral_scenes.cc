#include "integral_scenes.h"

#include <Eigen/Sparse>
#include <Eigen/SparseLU>

#include <cmath>
#include <random>

namespace meltfront::particles::integral_scenes
{
  namespace
  {
    double normal_derivative(const Particles &particles, const WallParticle &wall,
                             const Solution &solution)
    {
      const std::size_t side = static_cast<std::size_t>(wall.side);
      const cases::Position p = particles.nodes.point(wall.node);
      return (side % 2 == 0 ? -1 : 1) * solution.gradient[side / 2](p[0], p[1]);
    }

    std::vector<double> sampled(const Particles &particles, const Function &function)
    {
      std::vector<double> values(particles.nodes.size());
      for(std::size_t i = 0; i < values.size(); ++i)
      {
        const cases::Position p = particles.nodes.point(i);
        values[i] = function(p[0], p[1]);
      }
      return values;
    }

    std::vector<double> wall_derivatives(const Particles &particles,
                                         const IntegralRows &rows,
                                         const Solution &solution)
    {
      std::vector<double> values;
      for(const WallParticle &wall : rows.wall_particles)
        values.push_back(normal_derivative(particles, wall, solution));
      return values;
    }

    double row_sum(const CompressedRows &rows, std::size_t row,
                   const std::vector<double> &values, double &magnitude)
    {
      double sum = 0;
      for(std::size_t e = rows.offsets[row]; e < rows.offsets[row + 1]; ++e)
      {
        const double term = rows.coefficients[e] * values[rows.columns[e]];
        sum += term;
        magnitude += std::abs(term);
      }
      return sum;
    }
  } // namespace

  Particles arrange(int dimension, int n, double lower, double upper, double jitter,
                    unsigned seed, std::uint8_t flux_sides)
  {
    Particles result;
    NodeSet &nodes = result.nodes;
    nodes.positions.dimension = dimension;
    nodes.spacing = (upper - lower) / (n - 1);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> displacement(-jitter * nodes.spacing,
                                                        jitter * nodes.spacing);
    const auto coordinate
        = [&](int i) { return i + 1 < n ? lower + i * nodes.spacing : upper; };
    for(int j = 0; j < (dimension > 1 ? n : 1); ++j)
      for(int i = 0; i < n; ++i)
      {
        std::uint8_t sides = 0;
        sides |= i == 0 ? 1 : i == n - 1 ? 2 : 0;
        if(dimension > 1)
          sides |= j == 0 ? 4 : j == n - 1 ? 8 : 0;
        cases::Position p{coordinate(i), dimension > 1 ? coordinate(j) : 0, 0};
        double weight = 1;
        for(int d = 0; d < dimension; ++d)
        {
          if(sides == 0)
            p[static_cast<std::size_t>(d)] += displacement(random);
          const int index = d == 0 ? i : j;
          weight *= nodes.spacing * (index == 0 || index == n - 1 ? 0.5 : 1);
        }
        nodes.positions.add(p);
        nodes.weights.push_back(weight);
        nodes.sides.push_back(sides);
        const bool fixed = (sides & ~flux_sides) != 0;
        result.walls.fixed.push_back(fixed ? 1 : 0);
        result.walls.flux_sides.push_back(fixed ? std::uint8_t{0} : sides);
      }
    result.walls.lower = {lower, lower};
    result.walls.upper = {upper, upper};
    return result;
  }

  double row_defect(const Particles &particles, const IntegralRows &rows,
                    const Solution &solution)
  {
    const auto value = sampled(particles, solution.value);
    const auto laplacian = sampled(particles, solution.laplacian);
    const auto flux = wall_derivatives(particles, rows, solution);
    double worst = 0;
    for(std::size_t i = 0; i < value.size(); ++i)
    {
      double magnitude = 0;
      const double left = row_sum(rows.laplacian, i, value, magnitude)
                          + row_sum(rows.flux, i, flux, magnitude);
      const double right = row_sum(rows.load, i, laplacian, magnitude);
      if(magnitude > 0)
        worst = std::max(worst, std::abs(left - right) / magnitude);
    }
    return worst;
  }

  double poisson_error(const Particles &particles, const IntegralParameters &parameters,
                       const Solution &solution)
  {
    const IntegralRows rows = integral_rows(particles.nodes, particles.walls, parameters);
    const auto exact = sampled(particles, solution.value);
    const auto laplacian = sampled(particles, solution.laplacian);
    const auto flux = wall_derivatives(particles, rows, solution);
    const auto n = static_cast<Eigen::Index>(exact.size());
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd rhs(n);
    for(Eigen::Index i = 0; i < n; ++i)
    {
      const auto row = static_cast<std::size_t>(i);
      if(particles.walls.fixed[row] != 0)
      {
        entries.emplace_back(i, i, 1);
        rhs[i] = exact[row];
        continue;
      }
      // In units of the spacing, so that all rows are of the same size.
      const double factor = particles.nodes.spacing * particles.nodes.spacing;
      double unused = 0;
      rhs[i] = factor
               * (row_sum(rows.load, row, laplacian, unused)
                  - row_sum(rows.flux, row, flux, unused));
      const CompressedRows &matrix = rows.laplacian;
      for(std::size_t e = matrix.offsets[row]; e < matrix.offsets[row + 1]; ++e)
        entries.emplace_back(i, static_cast<Eigen::Index>(matrix.columns[e]),
                             factor * matrix.coefficients[e]);
    }
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    Eigen::SparseLU<Eigen::SparseMatrix<double>> factors(matrix);
    const Eigen::VectorXd solved = factors.solve(rhs);
    double square = 0, largest = 0;
    for(Eigen::Index i = 0; i < n; ++i)
    {
      const double error = solved[i] - exact[static_cast<std::size_t>(i)];
      square += error * error;
      largest = std::max(largest, std::abs(exact[static_cast<std::size_t>(i)]));
    }
    return std::sqrt(square / static_cast<double>(n)) / largest;
  }

  Solution sine()
  {
    return {[](double x, double) { return std::sin(x); },
            [](double x, double) { return -std::sin(x); },
            {[](double x, double) { return std::cos(x); },
             [](double, double) { return 0.; }}};
  }

  Solution monomial(int a, int b)
  {
    const auto power = [](double x, int e) {
      return e < 0 ? 0. : e == 0 ? 1. : std::pow(x, e);
    };
    return {[=](double x, double y) { return power(x, a) * power(y, b); },
            [=](double x, double y)
            {
              return a * (a - 1) * power(x, a - 2) * power(y, b)
                     + b * (b - 1) * power(x, a) * power(y, b - 2);
            },
            {[=](double x, double y) { return a * power(x, a - 1) * power(y, b); },
             [=](double x, double y) { return b * power(x, a) * power(y, b - 1); }}};
  }

  std::vector<double> orders(const std::vector<double> &errors)
  {
    std::vector<double> result;
    for(std::size_t k = 1; k < errors.size(); ++k)
      result.push_back(std::log2(errors[k - 1] / errors[k]));
    return result;
  }
} // namespace meltfront::particles::integral_scenes
