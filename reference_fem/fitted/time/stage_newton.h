#ifndef meltfront_reference_fem_fitted_time_stage_newton_h
#define meltfront_reference_fem_fitted_time_stage_newton_h

#include <reference_fem/fitted/time/stage_solver.h>

#include <string>

namespace meltfront::reference_fem::fitted
{
  /**
   * Newton's method for the stages of a step.
   *
   * Small problems get the exact Jacobian in each iteration until the corrections are
   * small. Large ones keep a factorised Jacobian from iteration to iteration and from
   * step to step, and learn from the steps that they take by Broyden's update (Broyden
   * 1965, Math. Comp. 19, 577-593; in the form of Kelley 1995, Iterative Methods, section
   * 7.3); they factorise anew where the iteration would otherwise need too long.
   */
  class StageNewton
  {
  public:
    struct Result
    {
      unsigned int iterations = 0;
      std::string problem; ///< empty where it converged; else what went wrong
    };

    StageNewton(const ConservationProblem &problem, const IntegrationOptions &options,
                IntegrationCost &cost);

    /** Improve the states of the stages until their error is below the tolerance in
     * units of @p scale. */
    Result solve(StageEquations &equations, const dealii::Vector<double> &scale,
                 Stages &u);

  private:
    /** Fresh factors at the start of a step where the old ones do not serve. */
    bool prepare_for(const StageEquations &equations, const Stages &u);

    /** Fresh factors within a step where the corrections say so. */
    bool renew(const StageEquations &equations, const Stages &u, unsigned int iteration,
               double size, double contraction);

    /** Turn a correction by frozen factors into that of Broyden's method. */
    void learn(const dealii::Vector<double> &scale, Stages &correction);

    /** Add the correction, or as much of it as the problem has no reason_invalid to;
     * returns the reason_invalid to all of it that remains. */
    std::string apply(const Stages &correction, Stages &u);

    const ConservationProblem &problem;
    const IntegrationOptions &options;
    IntegrationCost &cost;
    bool exact;
    std::unique_ptr<StageSolver> solver;

    std::vector<Stages> past_corrections;
    double factorised_step = 0;
    unsigned int factorised_stages = 0;
    bool factors_serve = false; ///< the last step converged quickly with them
    bool current = false;       ///< made within this step
  };
} // namespace meltfront::reference_fem::fitted

#endif
