#include <reference_fem/enthalpy/linear_solver.h>

#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/sparsity_pattern.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/vector.h>

#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace meltfront::reference_fem
{
  namespace
  {
    /** Trilinos' vectors need MPI, which a program that runs alone starts when first
     * needed and ends with itself. */
    void start_mpi()
    {
      int started = 0;
      MPI_Initialized(&started);
      if(started)
        return;
      MPI_Init(nullptr, nullptr);
      const auto end_mpi = []
      {
        int ended = 0;
        MPI_Finalized(&ended);
        if(!ended)
          MPI_Finalize();
      };
      std::atexit(end_mpi);
      // The runs of a matrix are processes of their own, which end quickly.
      std::at_quick_exit(end_mpi);
    }

    class KrylovSolver : public LinearSolver
    {
    public:
      KrylovSolver(const ConductionMatrix &conduction, Preconditioner preconditioner);

      std::string description() const override;

      void solve(const NewtonSystem &system, double reduction,
                 std::vector<double> &x) override;

    private:
      void assemble(const NewtonSystem &system);
      bool multigrid_pays(const NewtonSystem &system) const;
      template <class Precondition>
      unsigned int iterate(const Precondition &precondition, const NewtonSystem &system,
                           double reduction, long passes);
      void iterate_with_multigrid(const NewtonSystem &system, double reduction);

      const ConductionMatrix &conduction;
      Preconditioner preconditioner;
      dealii::SparsityPattern pattern;
      dealii::SparseMatrix<double> matrix;
      dealii::Vector<double> solution, right_side;
      std::unique_ptr<dealii::TrilinosWrappers::PreconditionAMG> multigrid;
      double multigrid_step_factor = 0;
      unsigned int multigrid_iterations = 0; ///< with a fresh hierarchy
    };

    KrylovSolver::KrylovSolver(const ConductionMatrix &conduction,
                               Preconditioner preconditioner)
      : conduction(conduction)
      , preconditioner(preconditioner)
    {
      const std::size_t n = conduction.size();
      std::vector<unsigned int> row_lengths(n);
      for(std::size_t i = 0; i < n; ++i)
        row_lengths[i] = static_cast<unsigned int>(conduction.row_start[i + 1]
                                                   - conduction.row_start[i] + 1);
      pattern.reinit(n, n, row_lengths);
      for(std::size_t i = 0; i < n; ++i)
        for(std::size_t k = conduction.row_start[i]; k < conduction.row_start[i + 1]; ++k)
          pattern.add(i, conduction.column[k]);
      pattern.compress();
      matrix.reinit(pattern);
      solution.reinit(n);
      right_side.reinit(n);
    }

    std::string KrylovSolver::description() const
    {
      switch(preconditioner)
      {
      case Preconditioner::ssor:
        return "conjugate gradients, SSOR";
      case Preconditioner::amg:
        return "conjugate gradients, Trilinos ML";
      default:
        return "conjugate gradients, SSOR or (from 50000 nodes and a Fourier number of "
               "1000) Trilinos ML";
      }
    }

    void KrylovSolver::assemble(const NewtonSystem &system)
    {
      const double c = system.step_factor;
      for(std::size_t i = 0; i < conduction.size(); ++i)
      {
        const bool active = system.active[i];
        matrix.diag_element(i)
            = active ? system.heat_capacity[i] + c * conduction.diagonal[i] : 1;
        right_side[i] = active ? system.residual[i] : 0;
        // deal.II stores a row's diagonal first and its other columns in ascending order,
        // as ConductionMatrix does.
        auto entry = matrix.begin(i);
        for(std::size_t k = conduction.row_start[i]; k < conduction.row_start[i + 1]; ++k)
        {
          ++entry;
          entry->value() = active && system.active[conduction.column[k]]
                               ? -c * conduction.conductance[k]
                               : 0;
        }
      }
      entries_touched += conduction.entries();
    }

    bool KrylovSolver::multigrid_pays(const NewtonSystem &system) const
    {
      if(preconditioner != Preconditioner::automatic)
        return preconditioner == Preconditioner::amg;
      constexpr std::size_t many_nodes = 50000;
      constexpr double long_step = 1000;
      if(conduction.size() < many_nodes)
        return false;
      double fourier = 0;
      for(std::size_t i = 0; i < conduction.size(); ++i)
        if(system.active[i])
          fourier = std::max(fourier, system.step_factor * conduction.diagonal[i]
                                          / system.heat_capacity[i]);
      return fourier > long_step;
    }

    template <class Precondition>
    unsigned int KrylovSolver::iterate(const Precondition &precondition,
                                       const NewtonSystem &system, double reduction,
                                       long passes)
    {
      // Stopping early is safe: the outer iteration goes on until the graph holds.
      constexpr unsigned int most_iterations = 2000;
      dealii::ReductionControl control(most_iterations, system.sufficient_residual,
                                       reduction, false, false);
      dealii::SolverCG<dealii::Vector<double>> solver(control);
      solution = 0;
      try
      {
        solver.solve(matrix, solution, right_side, precondition);
      }
      catch(const dealii::SolverControl::NoConvergence &)
      {
      }
      linear_iterations += control.last_step();
      entries_touched
          += static_cast<long>(control.last_step() + 1) * passes * conduction.entries();
      return control.last_step();
    }

    /**
     * The hierarchy is kept from step to step: the matrix changes at the front only. It
     * is built anew when the iterations grow by a half or the step changes by a tenth:
     * with that of a step r times as long they grow by the root of r, a twentieth, and
     * steps that are to be equal differ by round-off.
     */
    void KrylovSolver::iterate_with_multigrid(const NewtonSystem &system,
                                              double reduction)
    {
      constexpr double same_step = 0.1;
      constexpr long passes_of_set_up = 10;
      const bool fresh
          = !multigrid
            || std::abs(system.step_factor / multigrid_step_factor - 1) > same_step;
      if(fresh)
      {
        start_mpi();
        multigrid = std::make_unique<dealii::TrilinosWrappers::PreconditionAMG>();
        multigrid->initialize(matrix);
        multigrid_step_factor = system.step_factor;
        multigrid_iterations = 0;
        entries_touched += passes_of_set_up * conduction.entries();
      }
      // A product and a cycle, counted as five passes over the finest matrix.
      const unsigned int iterations = iterate(*multigrid, system, reduction, 6);
      if(multigrid_iterations == 0)
        multigrid_iterations = iterations;
      else if(2 * iterations > 3 * multigrid_iterations + 8)
        multigrid.reset();
    }

    void KrylovSolver::solve(const NewtonSystem &system, double reduction,
                             std::vector<double> &x)
    {
      assemble(system);
      if(right_side.l2_norm() == 0)
        solution = 0;
      else if(multigrid_pays(system))
        iterate_with_multigrid(system, reduction);
      else
      {
        dealii::PreconditionSSOR<dealii::SparseMatrix<double>> ssor;
        ssor.initialize(matrix, 1.2);
        iterate(ssor, system, reduction, 3);
      }
      std::copy(solution.begin(), solution.end(), x.begin());
    }
  } // namespace

  std::unique_ptr<LinearSolver> make_krylov_solver(const ConductionMatrix &matrix,
                                                   Preconditioner preconditioner)
  {
    return std::make_unique<KrylovSolver>(matrix, preconditioner);
  }
} // namespace meltfront::reference_fem
