#ifndef meltfront_particles_sph_implicit_solver_h
#define meltfront_particles_sph_implicit_solver_h

#include <particles/sph/heat_flow.h>
#include <particles/sph/krylov_solver.h>

#include <span>
#include <vector>

namespace meltfront::particles
{
  /** For every particle H - factor * flow(H) = base, with flow a function of all H. */
  struct ImplicitEquation
  {
    std::span<const double> base; ///< J/kg
    double factor;                ///< from a flow to a change of enthalpy (s/kg)
    double fraction;              ///< of the step, at which walls are taken
  };

  /**
   * Newton's method for an implicit step, with the derivative of whichever branch of T(H)
   * a particle is on (semismooth: Qi and Sun 1993) and the exchange at fronts
   * differentiated in full.
   *
   * Columns of I - factor * (derivative of the flows) add up to one or more, for what a
   * particle loses others or walls gain, and its other entries are negative: its inverse
   * is never larger than one in the sum norm, whatever the step. A particle that would
   * leave its branch stops at the first kink of T(H) beyond it.
   */
  class ImplicitSolver
  {
  public:
    ImplicitSolver(HeatFlow &heat_flow, const cases::Material &material);

    struct Outcome
    {
      bool converged;
      int iterations;       ///< of Newton's method
      double through_walls; ///< heat flow, as of HeatFlow::evaluate
    };

    /**
     * Solve from `enthalpy` as a first guess. On return it is base + factor * flow, the
     * flow taken at the last iterate: what particles exchange cancels to the last bit
     * however far the iteration got.
     */
    Outcome solve(const ImplicitEquation &equation, std::vector<double> &enthalpy);

    /** Iterations of the linear solver so far. */
    long linear_iterations() const
    {
      return krylov_iterations;
    }

  private:
    /** @return the largest residual. */
    double evaluate(const ImplicitEquation &equation, std::vector<double> &enthalpy);
    double tolerance(const ImplicitEquation &equation,
                     std::span<const double> enthalpy) const;
    void correct(std::vector<double> &enthalpy) const;
    double stop_at_kink(double from, double to) const;

    HeatFlow &heat_flow;
    double latent_heat;
    double factor = 0;
    KrylovSolver krylov;
    std::vector<double> flow, residual, correction, diagonal;
    double wall_flow = 0;
    long krylov_iterations = 0;
  };
} // namespace meltfront::particles

#endif
