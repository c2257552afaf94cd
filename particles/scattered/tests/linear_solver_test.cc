#include <cases/error.h>
#include <particles/scattered/linear_solver.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

using namespace meltfront::particles;

namespace
{
  /** The five-point Laplacian on an n x n lattice, with upwind transport of a strength.
   */
  CompressedRows five_points(int n, double transport)
  {
    CompressedRows rows;
    std::vector<std::uint32_t> scratch;
    for(int j = 0; j < n; ++j)
      for(int i = 0; i < n; ++i)
      {
        std::vector<std::uint32_t> columns{static_cast<std::uint32_t>(j * n + i)};
        std::vector<double> values{4 + transport};
        const auto add = [&](int k, int l, double value)
        {
          if(k < 0 || l < 0 || k >= n || l >= n)
            return;
          columns.push_back(static_cast<std::uint32_t>(l * n + k));
          values.push_back(value);
        };
        add(i + 1, j, -1);
        add(i - 1, j, -1 - transport);
        add(i, j + 1, -1);
        add(i, j - 1, -1);
        rows.add_row(columns, values, scratch);
      }
    return rows;
  }

  std::vector<double> wanted(std::size_t n)
  {
    std::vector<double> x(n);
    for(std::size_t i = 0; i < n; ++i)
      x[i] = std::sin(0.37 * double(i)) + 0.1;
    return x;
  }

  double error_of(LinearMethod method, double transport, int &iterations)
  {
    const CompressedRows matrix = five_points(40, transport);
    const std::vector<double> exact = wanted(matrix.rows());
    std::vector<double> load(matrix.rows()), x(matrix.rows());
    matrix.multiply(exact, load, 1);
    LinearSolverParameters parameters;
    parameters.method = method;
    parameters.symmetric = transport == 0;
    LinearSolver solver(matrix, parameters);
    const LinearSolver::Outcome outcome = solver.solve(load, x);
    EXPECT_TRUE(outcome.converged);
    EXPECT_EQ(solver.method(), method);
    iterations = outcome.iterations;
    double largest = 0;
    for(std::size_t i = 0; i < x.size(); ++i)
      largest = std::max(largest, std::abs(x[i] - exact[i]));
    return largest;
  }
} // namespace

TEST(CompressedRows, SortsAndAddsUp)
{
  CompressedRows rows;
  std::vector<std::uint32_t> scratch;
  const std::vector<std::uint32_t> columns{2, 0, 2, 1};
  const std::vector<double> values{1, 2, 3, 4};
  rows.add_row(columns, values, scratch);
  rows.add_row({}, {}, scratch);
  rows.add_row(columns, values, scratch);
  EXPECT_EQ(rows.columns, (std::vector<std::uint32_t>{0, 1, 2, 0, 1, 2}));
  EXPECT_EQ(rows.coefficients, (std::vector<double>{2, 4, 4, 2, 4, 4}));
  EXPECT_EQ(rows.diagonal(), (std::vector<double>{2, 0, 4}));
  std::vector<double> result(3);
  rows.multiply(std::vector<double>{1, 10, 100}, result, 2);
  EXPECT_EQ(result, (std::vector<double>{442, 0, 442}));
  EXPECT_EQ(rows.asymmetry(), 1);
  const CompressedRows sum = sum_of(2, rows, -1, rows);
  EXPECT_EQ(sum.coefficients, rows.coefficients);
}

TEST(LinearSolver, AllMethodsSolveASymmetricSystem)
{
  EXPECT_EQ(five_points(5, 0).asymmetry(), 0);
  int iterations = -1;
  EXPECT_LT(error_of(LinearMethod::direct, 0, iterations), 1e-12);
  EXPECT_EQ(iterations, 0);
  for(const LinearMethod method :
      {LinearMethod::gmres_ilut, LinearMethod::cg_jacobi, LinearMethod::cg_multigrid,
       LinearMethod::gmres_multigrid})
  {
    EXPECT_LT(error_of(method, 0, iterations), 1e-8);
    EXPECT_GT(iterations, 2);
    EXPECT_LT(iterations, method == LinearMethod::cg_jacobi ? 300 : 40);
  }
}

TEST(LinearSolver, MethodsForAnyMatrixSolveTransport)
{
  int iterations = -1;
  for(const LinearMethod method :
      {LinearMethod::direct, LinearMethod::gmres_ilut, LinearMethod::gmres_multigrid})
    EXPECT_LT(error_of(method, 5, iterations), 1e-8);
  EXPECT_THROW(error_of(LinearMethod::cg_jacobi, 5, iterations),
               meltfront::cases::InputError);
}

TEST(LinearSolver, ASingularMatrixIsTold)
{
  CompressedRows rows;
  std::vector<std::uint32_t> scratch;
  const std::vector<std::uint32_t> columns{0, 1};
  for(const double factor : {1., 3.})
    rows.add_row(columns, std::vector<double>{factor, 2 * factor}, scratch);
  LinearSolverParameters parameters;
  parameters.method = LinearMethod::direct;
  LinearSolver solver(rows, parameters);
  EXPECT_LT(solver.reciprocal_condition(), 1e-15);
  std::vector<double> x(2);
  EXPECT_FALSE(solver.solve(std::vector<double>{1, 0}, x).converged);
}

TEST(LinearSolver, AutomaticGoesBySizeAndSymmetry)
{
  LinearSolverParameters parameters;
  parameters.dimension = 3;
  EXPECT_EQ(LinearSolver(five_points(20, 0), parameters).method(), LinearMethod::direct);
  EXPECT_EQ(LinearSolver(five_points(80, 1), parameters).method(),
            LinearMethod::gmres_ilut);
  parameters.symmetric = true;
  EXPECT_EQ(LinearSolver(five_points(80, 0), parameters).method(),
            LinearMethod::cg_jacobi);
  parameters.dimension = 2;
  EXPECT_EQ(LinearSolver(five_points(80, 0), parameters).method(), LinearMethod::direct);
}

/** One iteration does not do, whatever the preconditioner. */
TEST(LinearSolver, AutomaticGetsStrongerWhereIterationsFail)
{
  const CompressedRows matrix = five_points(80, 1);
  const std::vector<double> exact = wanted(matrix.rows());
  std::vector<double> load(matrix.rows());
  matrix.multiply(exact, load, 1);
  LinearSolverParameters parameters;
  parameters.dimension = 3;
  parameters.most_iterations = 1;
  for(const bool automatic : {false, true})
  {
    parameters.method = automatic ? LinearMethod::automatic : LinearMethod::gmres_ilut;
    LinearSolver solver(matrix, parameters);
    std::vector<double> x(matrix.rows());
    EXPECT_EQ(solver.solve(load, x).converged, automatic);
    EXPECT_EQ(solver.method(),
              automatic ? LinearMethod::direct : LinearMethod::gmres_ilut);
    for(std::size_t i = 0; automatic && i < exact.size(); ++i)
      ASSERT_NEAR(x[i], exact[i], 1e-9);
  }
}

TEST(LinearSolver, RowsOfAnyScaleAreSolvedAlike)
{
  CompressedRows matrix = five_points(10, 2);
  std::vector<double> load(100), x(100);
  const std::vector<double> exact = wanted(100);
  for(std::size_t i = 0; i < 100; ++i)
    for(std::size_t e = matrix.offsets[i]; e < matrix.offsets[i + 1]; ++e)
      matrix.coefficients[e] *= std::pow(10., double(i % 40) - 20);
  matrix.multiply(exact, load, 1);
  LinearSolverParameters parameters;
  parameters.method = LinearMethod::gmres_ilut;
  ASSERT_TRUE(LinearSolver(matrix, parameters).solve(load, x).converged);
  for(std::size_t i = 0; i < 100; ++i)
    EXPECT_NEAR(x[i], exact[i], 1e-9);
}
