#ifndef meltfront_particles_scattered_linear_growth_h
#define meltfront_particles_scattered_linear_growth_h

#include <particles/scattered/linear_problem.h>
#include <particles/scattered/linear_solver.h>

namespace meltfront::particles
{
  /**
   * By how much what nothing heats or cools grows per step, in the long run: the spectral
   * radius of (rate M - A)^-1 rate M by power iteration from values of either sign, 1 for
   * a state that an insulated body keeps, less where heat flows out. Rows of collocation
   * about an inclusion, or of nodes some of which nearly coincide, may have eigenvalues
   * with a positive real part: what they hold then grows without bound, however short the
   * step.
   *
   * @param solver of rate M - A
   * @param rate over a step (1/s); of backward Euler, one over its length
   * @return NaN where the solver fails
   */
  double growth_per_step(LinearSolver &solver, const CompressedRows &mass, double rate);

  /**
   * For steady states.
   * @throws cases::Refusal where rows hold what grows by itself as slowly as what a
   * steady state is made of decays: they answer with the wrong sign, and without bound
   * near zero
   */
  void require_steady_rows(const cases::Scene &scene, const LinearProblem &problem,
                           const LinearSolverParameters &parameters,
                           const std::string &method);

  /**
   * For steps.
   * @param solver of rate M - A @param rate of a step (1/s)
   * @throws cases::Refusal where they would at least double an error within the run
   */
  void require_stable_steps(const LinearProblem &problem, LinearSolver &solver,
                            double rate, long steps, const std::string &method);
} // namespace meltfront::particles

#endif
