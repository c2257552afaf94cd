#include <particles/sph/displacement_solver.h>

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>

#include <cmath>
#include <numeric>

namespace meltfront::particles
{
  namespace
  {
    /** Iterations beyond which new factors cost less. */
    constexpr int few = 12;
    constexpr int most = 400;

    double dot(std::span<const double> a, std::span<const double> b)
    {
      return std::inner_product(a.begin(), a.end(), b.begin(), 0.);
    }

    double sum_of_magnitudes(std::span<const double> values)
    {
      return std::transform_reduce(values.begin(), values.end(), 0., std::plus<>(),
                                   [](double x) { return std::abs(x); });
    }

    /** What a pair passes on to its first particle. */
    struct LiquidPair
    {
      double operator()(std::size_t a, std::size_t b) const
      {
        return liquid[a] * liquid[b] * (potential[b] - potential[a]);
      }

      const double *liquid;
      const double *potential;
    };
  } // namespace

  struct DisplacementSolver::Factors
  {
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver;
    Eigen::SparseMatrix<double> matrix; ///< its lower part, of all pairs
    bool computed = false;
  };

  DisplacementSolver::DisplacementSolver(const ParticleOperator &rows,
                                         std::vector<double> of_outlet, int threads)
    : rows(rows)
    , links(std::move(of_outlet))
    , threads(threads)
    , factors(std::make_unique<Factors>())
  {
    links.resize(rows.padded_rows(), 0.);
    for(auto *array : {&residual, &direction, &product, &smoothed})
      array->resize(rows.padded_rows());
    std::vector<Eigen::Triplet<double>> entries;
    for(std::size_t a = 0; a < rows.rows(); ++a)
    {
      entries.emplace_back(a, a, 1.);
      rows.visit_row(a,
                     [&](std::uint32_t b, double)
                     {
                       if(b < a)
                         entries.emplace_back(a, b, 0.);
                     });
    }
    const auto n = static_cast<Eigen::Index>(rows.rows());
    factors->matrix.resize(n, n);
    factors->matrix.setFromTriplets(entries.begin(), entries.end());
    factors->solver.analyzePattern(factors->matrix);
  }

  DisplacementSolver::~DisplacementSolver() = default;

  void DisplacementSolver::apply(std::span<const double> liquid,
                                 std::span<const double> potential,
                                 std::span<double> result) const
  {
    rows.apply_pairs(LiquidPair{liquid.data(), potential.data()}, result, threads);
    for(std::size_t a = 0; a < rows.rows(); ++a)
      result[a] = liquid[a] * links[a] * potential[a] - result[a];
  }

  /** Of particles without liquid the unit matrix. */
  void DisplacementSolver::factorise(std::span<const double> liquid)
  {
    Eigen::SparseMatrix<double> &matrix = factors->matrix;
    for(std::size_t a = 0; a < rows.rows(); ++a)
    {
      double diagonal = links[a];
      rows.visit_row(a,
                     [&](std::uint32_t b, double g)
                     {
                       diagonal += g * liquid[b];
                       if(b < a)
                         matrix.coeffRef(a, b) = -g * liquid[a] * liquid[b];
                     });
      matrix.coeffRef(a, a) = liquid[a] > 0 && diagonal > 0 ? diagonal : 1.;
    }
    factors->solver.factorize(matrix);
    factors->computed = factors->solver.info() == Eigen::Success;
  }

  void DisplacementSolver::precondition(std::span<const double> liquid)
  {
    const auto n = static_cast<Eigen::Index>(rows.rows());
    const Eigen::Map<const Eigen::VectorXd> right(residual.data(), n);
    Eigen::Map<Eigen::VectorXd> result(smoothed.data(), n);
    result = factors->solver.solve(right);
    for(std::size_t a = 0; a < rows.rows(); ++a)
      smoothed[a] *= liquid[a];
  }

  bool DisplacementSolver::solve(std::span<const double> liquid, std::span<double> due,
                                 std::span<double> potential, double tolerance)
  {
    const std::size_t n = rows.rows();
    const auto live
        = [n](std::vector<double> &array) { return std::span(array).first(n); };
    apply(liquid, potential, product);
    for(std::size_t a = 0; a < n; ++a)
      residual[a] = liquid[a] * due[a] - product[a];
    if(!factors->computed)
      factorise(liquid);
    double before = 0;
    int iterations = 0;
    for(; sum_of_magnitudes(live(residual)) > tolerance; ++iterations)
    {
      if(iterations == few)
      {
        factorise(liquid);
        before = 0;
      }
      if(iterations == most)
        return false;
      precondition(liquid);
      const double now = dot(live(residual), live(smoothed));
      const double kept = before > 0 ? now / before : 0;
      before = now;
      for(std::size_t a = 0; a < n; ++a)
        direction[a] = smoothed[a] + kept * direction[a];
      apply(liquid, direction, product);
      const double length = now / dot(live(direction), live(product));
      for(std::size_t a = 0; a < n; ++a)
      {
        potential[a] += length * direction[a];
        residual[a] -= length * product[a];
      }
    }
    // As it is, not as the recursion has it.
    apply(liquid, potential, product);
    for(std::size_t a = 0; a < n; ++a)
      due[a] -= product[a];
    iterations_made += iterations;
    return true;
  }

  std::size_t DisplacementSolver::bytes() const
  {
    constexpr std::size_t per_entry = sizeof(double) + sizeof(int);
    const std::size_t of_factors
        = factors->computed ? factors->solver.matrixL().nestedExpression().nonZeros() : 0;
    return (links.size() + 4 * residual.size()) * sizeof(double)
           + (factors->matrix.nonZeros() + of_factors) * per_entry;
  }
} // namespace meltfront::particles
