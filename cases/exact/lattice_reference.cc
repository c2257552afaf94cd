#include <cases/error.h>
#include <cases/exact/lattice_reference.h>

#include <Eigen/SparseCholesky>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::cases
{
  LatticeReference::LatticeReference(const LatticeProblem &problem)
    : FrontlessSolution(Symmetry::none)
    , lower(problem.lower)
    , spacing((problem.upper[0] - problem.lower[0]) / problem.intervals)
    , points(static_cast<std::size_t>(problem.intervals) + 1)
    , value(points * points)
  {
    const double height = problem.upper[1] - problem.lower[1];
    if(problem.intervals < 4)
      throw InputError(fmt::format(
          "a lattice of {} intervals is too coarse for cubics; take 4 or more",
          problem.intervals));
    if(std::abs(height - spacing * problem.intervals) > 1e-9 * height)
      throw InputError("the lattice needs a square");
    const auto index = [this](std::size_t i, std::size_t j) { return j * points + i; };
    const auto position = [this](std::size_t i, std::size_t j) {
      return Position{lower[0] + spacing * double(i), lower[1] + spacing * double(j), 0};
    };
    const std::size_t inner = points - 2;
    const auto unknown = [inner](std::size_t i, std::size_t j)
    { return static_cast<int>((j - 1) * inner + i - 1); };
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd right(static_cast<Eigen::Index>(inner * inner));
    for(std::size_t j = 0; j < points; ++j)
      for(std::size_t i = 0; i < points; ++i)
        if(i == 0 || j == 0 || i == points - 1 || j == points - 1)
          value[index(i, j)] = problem.wall_temperature(position(i, j));
    for(std::size_t j = 1; j <= inner; ++j)
      for(std::size_t i = 1; i <= inner; ++i)
      {
        const int row = unknown(i, j);
        right[row] = problem.volumetric_source(position(i, j)) * spacing * spacing
                     / problem.conductivity;
        entries.emplace_back(row, row, 4.);
        const std::array<std::array<std::size_t, 2>, 4> neighbours{
            {{i - 1, j}, {i + 1, j}, {i, j - 1}, {i, j + 1}}};
        for(const auto &[k, l] : neighbours)
          if(k == 0 || l == 0 || k == points - 1 || l == points - 1)
            right[row] += value[index(k, l)];
          else
            entries.emplace_back(row, unknown(k, l), -1.);
      }
    Eigen::SparseMatrix<double> matrix(right.size(), right.size());
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
    const Eigen::VectorXd solution = factor.solve(right);
    for(std::size_t j = 1; j <= inner; ++j)
      for(std::size_t i = 1; i <= inner; ++i)
        value[index(i, j)] = solution[unknown(i, j)];
  }

  std::string LatticeReference::description() const
  {
    return fmt::format(
        "five-point scheme on a lattice of {} x {} points, interpolated by "
        "cubics",
        points, points);
  }

  /** Lagrange's weights of the four lattice points around a coordinate. */
  std::array<double, 4> LatticeReference::weights(double coordinate,
                                                  std::size_t &first) const
  {
    const double place = coordinate / spacing;
    const auto wanted = static_cast<long>(std::floor(place)) - 1;
    first = static_cast<std::size_t>(std::clamp(wanted, 0L, long(points) - 4));
    std::array<double, 4> result;
    for(std::size_t a = 0; a < 4; ++a)
    {
      result[a] = 1;
      for(std::size_t b = 0; b < 4; ++b)
        if(b != a)
          result[a] *= (place - double(first + b)) / (double(a) - double(b));
    }
    return result;
  }

  double LatticeReference::temperature(const Position &position, double) const
  {
    std::size_t column, row;
    const std::array<double, 4> across = weights(position[0] - lower[0], column);
    const std::array<double, 4> along = weights(position[1] - lower[1], row);
    double sum = 0;
    for(std::size_t b = 0; b < 4; ++b)
      for(std::size_t a = 0; a < 4; ++a)
        sum += along[b] * across[a] * value[(row + b) * points + column + a];
    return sum;
  }
} // namespace meltfront::cases
