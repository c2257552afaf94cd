#ifndef meltfront_particles_sph_time_implicit_solver_h
#define meltfront_particles_sph_time_implicit_solver_h

#include <particles/sph/time/banded_solver.h>
#include <particles/sph/time/krylov_solver.h>

#include <cmath>
#include <optional>
#include <span>
#include <vector>

namespace meltfront::particles
{
  /**
   * Flows of heat between particles as functions of their enthalpies: what an implicit
   * step has to know of them. Temperature is a function of enthalpy on branches that meet
   * at kinks, as where melting begins and ends.
   */
  class ImplicitFlow
  {
  public:
    virtual ~ImplicitFlow() = default;

    /** Particles. */
    virtual std::size_t size() const = 0;

    /** Length of arrays of enthalpy and flow. */
    virtual std::size_t padded_size() const = 0;

    /** Unit of the flows (W for 1). */
    virtual double scale() const = 0;

    /** Heat flow into each particle at a fraction of the step, over scale().
     * @return heat flow through walls into the scene, likewise. */
    virtual double evaluate(std::span<const double> enthalpy, double fraction,
                            std::span<double> flow)
        = 0;

    /** Prepare products with the derivative of the flows by the enthalpy, at the enthalpy
     * and the fraction that evaluate() was last called with. */
    virtual void linearise(std::span<const double> enthalpy, double fraction) = 0;

    /** How the flows follow a change of the enthalpy, to first order. */
    virtual void apply_derivative(std::span<const double> change,
                                  std::span<double> flow_change)
        = 0;

    /** How each particle's flow follows its own enthalpy. */
    virtual std::span<const double> derivative_diagonal() const = 0;

    /** How far apart the numbers of particles are at most that exchange heat, where that
     * is a few, as along a line; else 0. */
    virtual std::size_t half_bandwidth() const
    {
      return 0;
    }

    /** Add a correction; a particle that would leave its branch of T(H) stops at the
     * first kink on its way, where the next branch begins. */
    virtual void correct(std::span<const double> correction,
                         std::span<double> enthalpy) const = 0;

    /** The largest sensible heat of a particle (J/kg), what residuals are measured by. */
    virtual double largest_sensible_heat(std::span<const double> enthalpy) const = 0;
  };

  /** Heat that came through walls and that particles on Dirichlet walls took (J). */
  struct WallHeat
  {
    double through = 0, dirichlet = 0;
  };

  /** For every particle H - factor * flow(H) = base, with flow a function of all H. */
  struct ImplicitEquation
  {
    std::span<const double> base; ///< J/kg
    double factor;                ///< from a flow to a change of enthalpy (s/kg)
    double fraction;              ///< of the step, at which walls are taken
  };

  /**
   * Newton's method for an implicit step, with the derivative of whichever branch of T(H)
   * a particle is on (semismooth: Qi and Sun 1993) and the exchange between particles
   * differentiated in full.
   *
   * Columns of I - factor * (derivative of the flows) add up to one or more, for what a
   * particle loses others or walls gain; where its other entries are negative, as they
   * are unless conductivities follow the state, its inverse is never larger than one in
   * the sum norm, whatever the step. Along a line they are solved for directly, else by a
   * Krylov method.
   */
  class ImplicitSolver
  {
  public:
    explicit ImplicitSolver(ImplicitFlow &heat_flow);

    struct Outcome
    {
      bool converged;
      int iterations;       ///< of Newton's method
      double through_walls; ///< heat flow, as of ImplicitFlow::evaluate
    };

    /**
     * Solve from `enthalpy` as a first guess. On return it is base + factor * flow, the
     * flow taken at the last iterate: what particles exchange cancels to the last bit
     * however far the iteration got.
     */
    Outcome solve(const ImplicitEquation &equation, std::span<double> enthalpy);

    /**
     * A step of backward Euler, or of Crank-Nicolson.
     * @param hold hold(enthalpy) sets particles on walls to the temperature at the end
     * and returns the heat that this took
     * @return whether the equations were solved; if not, the enthalpy is of no use.
     */
    template <typename Hold>
    bool take_step(std::span<double> enthalpy, double duration, bool trapezoidal,
                   double mass, const Hold &hold, WallHeat &heat)
    {
      const double weighted = (trapezoidal ? 0.5 : 1.) * duration;
      const double change = weighted * heat_flow.scale() / mass;
      base.assign(enthalpy.begin(), enthalpy.end());
      if(trapezoidal)
        heat.through += weighted * heat_flow.scale() * add_flow(change, enthalpy);
      heat.dirichlet += hold(std::span(base));
      hold(enthalpy);
      const Outcome outcome
          = solve({std::span(base).first(heat_flow.size()), change, 1.}, enthalpy);
      heat.through += weighted * heat_flow.scale() * outcome.through_walls;
      return outcome.converged;
    }

    /**
     * A step of the two-stage, second-order, L-stable diagonally implicit Runge-Kutta
     * scheme (Alexander 1977), gamma = 1 - 1/sqrt(2):
     *
     *   H_1 = H_0 + gamma dt F(H_1),
     *   H_2 = H_0 + (1 - gamma) dt F(H_1) + gamma dt F(H_2).
     *
     * @param hold hold(fraction, enthalpy) sets particles on walls to the temperature at
     * a fraction of the step and returns the heat that this took
     * @return whether the equations were solved; if not, the enthalpy is of no use.
     */
    template <typename Hold>
    bool take_two_stage_step(std::span<double> enthalpy, double duration, double mass,
                             const Hold &hold, WallHeat &heat)
    {
      const double gamma = 1 - std::sqrt(0.5);
      const double weighted = gamma * duration * heat_flow.scale();
      base.assign(enthalpy.begin(), enthalpy.end());
      const std::size_t n = heat_flow.size();
      start.assign(base.begin(), base.begin() + static_cast<std::ptrdiff_t>(n));
      hold(gamma, std::span(base));
      hold(gamma, enthalpy);
      const Outcome first
          = solve({std::span(base).first(n), weighted / mass, gamma}, enthalpy);
      if(!first.converged)
        return false;
      for(std::size_t a = 0; a < n; ++a)
        base[a] = start[a] + (1 - gamma) / gamma * (enthalpy[a] - start[a]);
      heat.dirichlet += hold(1., std::span(start));
      hold(1., std::span(base));
      hold(1., enthalpy);
      const Outcome second
          = solve({std::span(base).first(n), weighted / mass, 1.}, enthalpy);
      heat.through
          += duration * heat_flow.scale()
             * ((1 - gamma) * first.through_walls + gamma * second.through_walls);
      return second.converged;
    }

    /** The flows at the last iterate, over ImplicitFlow::scale(). */
    std::span<const double> last_flow() const
    {
      return flow;
    }

    /** Of Newton's method so far. */
    long newton_iterations() const
    {
      return all_iterations;
    }

    /** Newton's, of the solve with the most. */
    long most_iterations() const
    {
      return longest;
    }

    /** Iterations of the linear solver so far. */
    long linear_iterations() const
    {
      return krylov_iterations;
    }

  private:
    /** @return the largest residual. */
    double evaluate(const ImplicitEquation &equation, std::span<double> enthalpy);
    double tolerance(const ImplicitEquation &equation,
                     std::span<const double> enthalpy) const;

    /** result = (I - factor * derivative of the flows) change */
    void multiply(std::span<const double> change, std::span<double> result);

    /** Solve for Newton's correction. @return iterations of the linear solver, 1 for a
     * direct one; 0 if there is no solution. */
    int find_correction();

    /** Add the flows at the start of a step to its base. @return flow through walls. */
    double add_flow(double change, std::span<const double> enthalpy);

    ImplicitFlow &heat_flow;
    double factor = 0;
    std::optional<BandedSolver> banded; ///< along a line
    std::optional<KrylovSolver> krylov; ///< elsewhere
    std::vector<double> base, start, flow, residual, correction, diagonal;
    double wall_flow = 0;
    long krylov_iterations = 0;
    long longest = 0, all_iterations = 0;
  };
} // namespace meltfront::particles

#endif
