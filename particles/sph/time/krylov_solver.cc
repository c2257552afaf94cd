#include <particles/sph/time/krylov_solver.h>

#include <BelosBiCGStabSolMgr.hpp>
#include <BelosEpetraAdapter.hpp>
#include <BelosLinearProblem.hpp>
#include <Epetra_Map.h>
#include <Epetra_Operator.h>
#include <Epetra_SerialComm.h>
#include <Epetra_Vector.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace meltfront::particles
{
  namespace
  {
    /** What Trilinos asks of a matrix that need not be stored. */
    class OperatorBase : public Epetra_Operator
    {
    public:
      OperatorBase(const Epetra_Map &map, const char *label)
        : map(map)
        , label(label)
      {
      }

      int SetUseTranspose(bool) override
      {
        return -1; // not provided
      }

      double NormInf() const override
      {
        return 0;
      }

      const char *Label() const override
      {
        return label;
      }

      bool UseTranspose() const override
      {
        return false;
      }

      bool HasNormInf() const override
      {
        return false;
      }

      const Epetra_Comm &Comm() const override
      {
        return map.Comm();
      }

      const Epetra_Map &OperatorDomainMap() const override
      {
        return map;
      }

      const Epetra_Map &OperatorRangeMap() const override
      {
        return map;
      }

    private:
      const Epetra_Map &map;
      const char *label;
    };

    class MatrixOfProducts : public OperatorBase
    {
    public:
      MatrixOfProducts(const Epetra_Map &map, KrylovSolver::Product product)
        : OperatorBase(map, "products")
        , product(std::move(product))
      {
      }

      int Apply(const Epetra_MultiVector &x, Epetra_MultiVector &y) const override
      {
        const auto size = static_cast<std::size_t>(x.MyLength());
        for(int k = 0; k < x.NumVectors(); ++k)
          product({x[k], size}, {y[k], size});
        return 0;
      }

      int ApplyInverse(const Epetra_MultiVector &, Epetra_MultiVector &) const override
      {
        return -1; // not provided
      }

    private:
      KrylovSolver::Product product;
    };

    class Diagonal : public OperatorBase
    {
    public:
      explicit Diagonal(const Epetra_Map &map)
        : OperatorBase(map, "diagonal")
        , inverse(static_cast<std::size_t>(map.NumMyElements()))
      {
      }

      void set(std::span<const double> diagonal)
      {
        for(std::size_t i = 0; i < inverse.size(); ++i)
          inverse[i] = 1 / diagonal[i];
      }

      int Apply(const Epetra_MultiVector &, Epetra_MultiVector &) const override
      {
        return -1; // not provided
      }

      int ApplyInverse(const Epetra_MultiVector &x, Epetra_MultiVector &y) const override
      {
        for(int k = 0; k < x.NumVectors(); ++k)
          for(std::size_t i = 0; i < inverse.size(); ++i)
            y[k][i] = inverse[i] * x[k][i];
        return 0;
      }

    private:
      std::vector<double> inverse;
    };
  } // namespace

  using Problem = Belos::LinearProblem<double, Epetra_MultiVector, Epetra_Operator>;
  using BiCgStab = Belos::BiCGStabSolMgr<double, Epetra_MultiVector, Epetra_Operator>;

  struct KrylovSolver::Implementation
  {
    Implementation(std::size_t unknowns, Product product)
      : map(static_cast<int>(unknowns), 0, communicator)
      , matrix(Teuchos::rcp(new MatrixOfProducts(map, std::move(product))))
      , diagonal(Teuchos::rcp(new Diagonal(map)))
      , solution(Teuchos::rcp(new Epetra_Vector(map)))
      , load(Teuchos::rcp(new Epetra_Vector(map)))
      , problem(Teuchos::rcp(new Problem(matrix, solution, load)))
      , parameters(Teuchos::parameterList())
    {
      problem->setRightPrec(Teuchos::rcp(new Belos::EpetraPrecOp(diagonal)));
      parameters->set("Verbosity", static_cast<int>(Belos::Errors));
      solver.setProblem(problem);
    }

    Epetra_SerialComm communicator;
    Epetra_Map map;
    Teuchos::RCP<MatrixOfProducts> matrix;
    Teuchos::RCP<Diagonal> diagonal;
    Teuchos::RCP<Epetra_Vector> solution, load;
    Teuchos::RCP<Problem> problem;
    Teuchos::RCP<Teuchos::ParameterList> parameters;
    BiCgStab solver;
  };

  KrylovSolver::KrylovSolver(std::size_t unknowns, Product product)
    : implementation(std::make_unique<Implementation>(unknowns, std::move(product)))
  {
  }

  KrylovSolver::~KrylovSolver() = default;

  KrylovSolver::Outcome KrylovSolver::solve(std::span<const double> diagonal,
                                            std::span<const double> right_hand_side,
                                            std::span<double> x, double tolerance,
                                            int most_iterations)
  {
    Implementation &impl = *implementation;
    impl.diagonal->set(diagonal);
    impl.solution->PutScalar(0);
    std::copy(right_hand_side.begin(), right_hand_side.end(), impl.load->Values());
    impl.problem->setProblem();
    impl.parameters->set("Convergence Tolerance", tolerance);
    impl.parameters->set("Maximum Iterations", most_iterations);
    impl.solver.setParameters(impl.parameters);
    bool converged = false;
    try
    {
      converged = impl.solver.solve() == Belos::Converged;
    }
    catch(const Belos::StatusTestError &)
    {
      // A value that is not a number: no solution.
      return {false, 0};
    }
    std::copy_n(impl.solution->Values(), x.size(), x.begin());
    return {converged, impl.solver.getNumIters()};
  }
} // namespace meltfront::particles
