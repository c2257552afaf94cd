#include <reference_fem/enthalpy/linear_solver.h>

#include <stdexcept>

namespace meltfront::reference_fem
{
  namespace
  {
    /**
     * Thomas' algorithm, read as the reduction of a chain of resistors: a node that leaks
     * s to the ground and w to its neighbour is replaced by the leak s w/(s + w) of the
     * neighbour. Nothing is subtracted, so every pivot keeps full relative accuracy
     * however large the Fourier number is.
     */
    class TridiagonalSolver : public LinearSolver
    {
    public:
      explicit TridiagonalSolver(const ConductionMatrix &matrix)
        : matrix(matrix)
        , link(matrix.size())
        , pivot(matrix.size())
        , load(matrix.size())
      {
        TridiagonalSolver::conductances_changed();
      }

      void conductances_changed() override
      {
        for(std::size_t i = 0; i < matrix.size(); ++i)
          for(std::size_t k = matrix.row_start[i]; k < matrix.row_start[i + 1]; ++k)
            if(matrix.column[k] == i + 1)
              link[i] = matrix.conductance[k];
            else if(matrix.column[k] + 1 != i)
              throw std::logic_error(
                  "the tridiagonal solver needs nodes numbered along a line");
      }

      std::string description() const override
      {
        return "tridiagonal elimination";
      }

      void solve(const NewtonSystem &system, double, std::vector<double> &x) override
      {
        const std::size_t n = link.size();
        const double c = system.step_factor;
        double leak = 0, inflow = 0;
        for(std::size_t i = 0; i < n; ++i)
        {
          const double forward = c * link[i];
          if(!system.active[i])
          {
            leak = forward;
            inflow = 0;
            continue;
          }
          const double ground = system.heat_capacity[i] + leak;
          load[i] = system.residual[i] + inflow;
          pivot[i] = ground + forward;
          leak = forward * (ground / pivot[i]);
          inflow = load[i] * (forward / pivot[i]);
        }
        double next = 0;
        for(std::size_t i = n; i-- > 0;)
        {
          next = system.active[i] ? (load[i] + c * link[i] * next) / pivot[i] : 0;
          x[i] = next;
        }
        entries_touched += 3 * static_cast<long>(n);
      }

    private:
      const ConductionMatrix &matrix;
      std::vector<double> link; ///< conductance to the next node, 0 for the last
      std::vector<double> pivot, load;
    };
  } // namespace

  std::unique_ptr<LinearSolver> make_tridiagonal_solver(const ConductionMatrix &matrix)
  {
    return std::make_unique<TridiagonalSolver>(matrix);
  }
} // namespace meltfront::reference_fem
