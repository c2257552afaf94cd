#include <cases/error.h>
#include <particles/scattered/iterative_solver.h>

#include <BelosEpetraAdapter.hpp>
#include <BelosLinearProblem.hpp>
#include <BelosPseudoBlockCGSolMgr.hpp>
#include <BelosPseudoBlockGmresSolMgr.hpp>
#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>
#include <Epetra_SerialComm.h>
#include <Epetra_Vector.h>
#include <Ifpack_ILUT.h>
#include <Ifpack_PointRelaxation.h>
#include <ml_MultiLevelPreconditioner.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles
{
  namespace
  {
    using Problem = Belos::LinearProblem<double, Epetra_MultiVector, Epetra_Operator>;
    using Manager = Belos::SolverManager<double, Epetra_MultiVector, Epetra_Operator>;
    using Gmres
        = Belos::PseudoBlockGmresSolMgr<double, Epetra_MultiVector, Epetra_Operator>;
    using ConjugateGradients
        = Belos::PseudoBlockCGSolMgr<double, Epetra_MultiVector, Epetra_Operator>;

    constexpr int restart = 200;

    /** MPI of one process: ML takes no other communicator. */
    struct SingleProcess
    {
      SingleProcess()
      {
        int running = 0;
        MPI_Initialized(&running);
        started = running == 0;
        if(started)
          MPI_Init(nullptr, nullptr);
      }

      ~SingleProcess()
      {
        if(started)
          MPI_Finalize();
      }

      bool started;
    };

    std::unique_ptr<Epetra_Comm> communicator_for(LinearMethod method)
    {
      if(method != LinearMethod::cg_multigrid && method != LinearMethod::gmres_multigrid)
        return std::make_unique<Epetra_SerialComm>();
      static const SingleProcess process;
      return std::make_unique<Epetra_MpiComm>(MPI_COMM_SELF);
    }

    bool symmetric(LinearMethod method)
    {
      return method == LinearMethod::cg_jacobi || method == LinearMethod::cg_multigrid;
    }

    Teuchos::RCP<Epetra_CrsMatrix> stored(const Epetra_Map &map,
                                          const CompressedRows &rows)
    {
      std::vector<int> count(rows.rows());
      for(std::size_t i = 0; i < rows.rows(); ++i)
        count[i] = static_cast<int>(rows.offsets[i + 1] - rows.offsets[i]);
      auto matrix = Teuchos::rcp(new Epetra_CrsMatrix(Copy, map, count.data(), true));
      const std::vector<int> columns(rows.columns.begin(), rows.columns.end());
      for(std::size_t i = 0; i < rows.rows(); ++i)
        matrix->InsertGlobalValues(static_cast<int>(i), count[i],
                                   rows.coefficients.data() + rows.offsets[i],
                                   columns.data() + rows.offsets[i]);
      matrix->FillComplete();
      return matrix;
    }

    template <typename Preconditioner>
    Teuchos::RCP<Preconditioner> prepared(Teuchos::RCP<Preconditioner> preconditioner,
                                          Teuchos::ParameterList &list)
    {
      preconditioner->SetParameters(list);
      if(preconditioner->Initialize() != 0 || preconditioner->Compute() != 0)
        throw cases::InputError(fmt::format("the preconditioner {} cannot be computed: a "
                                            "diagonal entry is zero or lost",
                                            preconditioner->Label()));
      return preconditioner;
    }
  } // namespace

  struct IterativeSolver::Implementation
  {
    Implementation(const CompressedRows &rows, LinearMethod method,
                   const LinearSolverParameters &parameters)
      : communicator(communicator_for(method))
      , map(static_cast<int>(rows.rows()), 0, *communicator)
      , matrix(stored(map, rows))
      , solution(Teuchos::rcp(new Epetra_Vector(map)))
      , load(Teuchos::rcp(new Epetra_Vector(map)))
      , problem(Teuchos::rcp(new Problem(matrix, solution, load)))
    {
      set_preconditioner(method, parameters);
      const auto inverse = Teuchos::rcp(new Belos::EpetraPrecOp(preconditioner));
      auto list = Teuchos::parameterList();
      list->set("Verbosity", static_cast<int>(Belos::Errors));
      list->set("Convergence Tolerance", parameters.tolerance);
      list->set("Maximum Iterations", parameters.most_iterations);
      if(symmetric(method))
      {
        problem->setLeftPrec(inverse);
        problem->setHermitian();
        list->set("Residual Scaling", "Norm of RHS");
        solver = std::make_unique<ConjugateGradients>(problem, list);
        return;
      }
      problem->setRightPrec(inverse);
      list->set("Num Blocks", std::min(restart, parameters.most_iterations));
      list->set("Maximum Restarts", parameters.most_iterations / restart + 1);
      list->set("Implicit Residual Scaling", "Norm of RHS");
      list->set("Explicit Residual Scaling", "Norm of RHS");
      solver = std::make_unique<Gmres>(problem, list);
    }

    void set_preconditioner(LinearMethod method, const LinearSolverParameters &parameters)
    {
      Teuchos::ParameterList list;
      switch(method)
      {
      case LinearMethod::cg_jacobi:
        list.set("relaxation: type", "Jacobi");
        preconditioner
            = prepared(Teuchos::rcp(new Ifpack_PointRelaxation(matrix.get())), list);
        break;
      case LinearMethod::gmres_ilut:
      {
        list.set("fact: ilut level-of-fill", parameters.ilut_fill);
        list.set("fact: drop tolerance", parameters.drop_tolerance);
        auto factors = prepared(Teuchos::rcp(new Ifpack_ILUT(matrix.get())), list);
        fill = double(factors->NumGlobalNonzeros64()) / matrix->NumGlobalNonzeros();
        preconditioner = factors;
        break;
      }
      default:
      {
        const bool plain = symmetric(method);
        ML_Epetra::SetDefaults(plain ? "SA" : "NSSA", list);
        list.set("ML output", 0);
        list.set("smoother: type", plain ? "symmetric Gauss-Seidel" : "Gauss-Seidel");
        list.set("smoother: sweeps", 2);
        list.set("coarse: type", "Amesos-KLU");
        auto grids
            = Teuchos::rcp(new ML_Epetra::MultiLevelPreconditioner(*matrix, list, true));
        preconditioner = grids;
      }
      }
    }

    std::unique_ptr<Epetra_Comm> communicator;
    Epetra_Map map;
    Teuchos::RCP<Epetra_CrsMatrix> matrix;
    Teuchos::RCP<Epetra_Operator> preconditioner;
    double fill = 1;
    Teuchos::RCP<Epetra_Vector> solution, load;
    Teuchos::RCP<Problem> problem;
    std::unique_ptr<Manager> solver;
  };

  IterativeSolver::IterativeSolver(const CompressedRows &matrix, LinearMethod method,
                                   const LinearSolverParameters &parameters)
    : implementation(std::make_unique<Implementation>(matrix, method, parameters))
  {
  }

  IterativeSolver::~IterativeSolver() = default;

  LinearSolver::Outcome IterativeSolver::solve(std::span<const double> right_hand_side,
                                               std::span<double> x)
  {
    Implementation &impl = *implementation;
    std::ranges::copy(x, impl.solution->Values());
    std::ranges::copy(right_hand_side, impl.load->Values());
    impl.problem->setProblem();
    bool converged = false;
    try
    {
      converged = impl.solver->solve() == Belos::Converged;
    }
    catch(const Belos::StatusTestError &)
    {
      // A value that is not a number: no solution.
      return {};
    }
    std::copy_n(impl.solution->Values(), x.size(), x.begin());
    return {converged, impl.solver->getNumIters(), 0};
  }

  double IterativeSolver::fill() const
  {
    return implementation->fill;
  }
} // namespace meltfront::particles
