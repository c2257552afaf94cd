#include <particles/sph/displacement_solver.h>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>

#include <cmath>
#include <numeric>

namespace meltfront::particles
{
  namespace
  {
    /** Iterations more than with new factors, beyond which these cost less. */
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

  class DisplacementSolver::Factors
  {
  public:
    using Matrix = Eigen::SparseMatrix<double>;
    using Vector = Eigen::Map<Eigen::VectorXd>;

    virtual ~Factors() = default;
    virtual bool factorise() = 0;
    virtual void solve(const Vector &right, Vector result) const = 0;
    virtual std::size_t entries() const = 0;

    Matrix matrix; ///< its lower part, of all pairs whether they are liquid or not
    bool computed = false;
  };

  namespace
  {
    /** By one of Eigen's Cholesky decompositions. */
    template <typename Base, typename Decomposition>
    struct FactorsBy : Base
    {
      bool factorise() override
      {
        if(!analysed)
          decomposition.analyzePattern(this->matrix);
        analysed = true;
        decomposition.factorize(this->matrix);
        return decomposition.info() == Eigen::Success;
      }

      void solve(const typename Base::Vector &right,
                 typename Base::Vector result) const override
      {
        result = decomposition.solve(right);
      }

      std::size_t entries() const override
      {
        if constexpr(requires { decomposition.matrixL().nonZeros(); })
          return decomposition.matrixL().nonZeros();
        else
          return decomposition.matrixL().nestedExpression().nonZeros();
      }

      Decomposition decomposition;
      bool analysed = false;
    };
  } // namespace

  DisplacementSolver::DisplacementSolver(const ParticleOperator &rows,
                                         std::vector<double> of_outlet, int dimension,
                                         int threads)
    : rows(rows)
    , links(std::move(of_outlet))
    , threads(threads)
  {
    if(dimension < 3)
      factors = std::make_unique<
          FactorsBy<Factors, Eigen::SimplicialLDLT<Factors::Matrix>>>();
    else
      factors = std::make_unique<FactorsBy<Factors, Eigen::IncompleteCholesky<double>>>();
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
  void DisplacementSolver::renew_factors(std::span<const double> liquid)
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
    factors->computed = factors->factorise();
  }

  void DisplacementSolver::precondition(std::span<const double> liquid)
  {
    const auto n = static_cast<Eigen::Index>(rows.rows());
    factors->solve(Factors::Vector(residual.data(), n),
                   Factors::Vector(smoothed.data(), n));
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
    bool renewed = !factors->computed;
    if(renewed)
      renew_factors(liquid);
    double before = 0;
    int iterations = 0, since_renewal = 0;
    for(; sum_of_magnitudes(live(residual)) > tolerance; ++iterations)
    {
      if(!renewed && iterations == with_new_factors + few)
      {
        renew_factors(liquid);
        renewed = true;
        before = since_renewal = 0;
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
      ++since_renewal;
    }
    // As it is, not as the recursion has it.
    apply(liquid, potential, product);
    for(std::size_t a = 0; a < n; ++a)
      due[a] -= product[a];
    iterations_made += iterations;
    if(renewed)
      with_new_factors = since_renewal;
    return true;
  }

  std::size_t DisplacementSolver::bytes() const
  {
    constexpr std::size_t per_entry = sizeof(double) + sizeof(int);
    const std::size_t of_factors = factors->computed ? factors->entries() : 0;
    return (links.size() + 4 * residual.size()) * sizeof(double)
           + (factors->matrix.nonZeros() + of_factors) * per_entry;
  }
} // namespace meltfront::particles
