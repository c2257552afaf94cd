#ifndef meltfront_particles_sph_time_time_stepping_h
#define meltfront_particles_sph_time_time_stepping_h

#include <particles/sph/conduction_rows.h>
#include <particles/sph/parameters.h>

#include <cstddef>
#include <string>
#include <vector>

namespace meltfront::particles
{
  /**
   * The largest explicit step that is guaranteed to keep the maximum principle:
   *
   *   dt = min over phases p of m c_p / (x k'_p max_a sum_b g_ab),
   *
   * x the largest factor of the exchange at fronts, k'_p the larger of the phase's
   * conductivity and, where phases differ, of the harmonic mean 2 k_s k_l/(k_s + k_l).
   * New temperatures are then convex combinations of old ones
   * and of the walls'; by Gershgorin's theorem the step lies within the linear stability
   * limit 2/lambda_max as well.
   */
  double monotone_step(const cases::Material &material, double particle_mass,
                       double largest_row_sum, double largest_front_factor);

  /** The same of a scene's material: where that has curves, with the least dH/du that
   * they have at the temperatures which the scene's data allow. */
  double monotone_step(const cases::Scene &scene, double particle_mass,
                       double largest_row_sum, double largest_front_factor);

  /** The linear stability limit of explicit Euler, 2 m c/(k lambda), in a body that is
   * all of the phase with the smaller c/k; with curves, of the smallest dH/du. */
  double stable_step(const cases::Scene &scene, double particle_mass,
                     double largest_eigenvalue);

  /** How long explicit steps may be. */
  struct StepLimits
  {
    double monotone;   ///< monotone_step (s)
    double stable = 0; ///< stable_step(), 0 where it is not asked for (s)
  };

  /** 0.15 c rho h^2/k, the smaller of both phases' (Monaghan et al. 2005, equation 2.20).
   */
  double published_step(const cases::Material &material, double smoothing_length);

  /** How a run is divided into steps. */
  struct StepPlan
  {
    long steps;
    double step; ///< s
    int stages;  ///< of each step; 1: explicit Euler or implicit
    StepLimits limits;
    int euler_substeps;  ///< Euler steps in place of a super step, where it is resolved
                         ///< or broke a bound
    long resolved_steps; ///< so many first steps are resolved by Euler steps: a
                         ///< discontinuous start is not smooth enough for a super step
    std::vector<double> ends{}; ///< where steps end in between (s): cases::step_ends()
  };

  /**
   * Divide a duration into equal steps. Super steps are kept short enough for at least
   * 200 of them, with fewer stages where these suffice; implicit steps may be of any
   * length, and so may those in multiples of the stability limit. Unless a number of
   * steps is asked for, steps follow what walls prescribe.
   * @throws cases::Refusal if an explicit step asked for exceeds monotone_step, but for
   * multiples of the stability limit.
   */
  StepPlan plan_steps(const SphParameters &parameters, const cases::Scene &scene,
                      const StepLimits &limits, double smoothing_length);

  /** Fewest steps of a run, so that fronts can be sampled at 100 times. */
  inline constexpr long fewest_steps = 200;

  /** Iterations of Newton's method in both stages of an implicit step, usually. */
  inline constexpr double usual_newton_iterations = 8;

  /** What an iteration of Newton's method costs along a line, in evaluations of the
   * flows: residual, derivative, elimination, and products that give the matrix. */
  double work_of_newton_iteration(std::size_t half_bandwidth);

  /** What `automatic` has to know of a run. */
  struct TimeSchemeDemand
  {
    double duration;            ///< s
    double explicit_step;       ///< the longest of Euler's that is certain (s)
    std::size_t half_bandwidth; ///< HeatFlow::half_bandwidth()
    bool displaces_liquid;
    bool moves_sources;
  };

  /**
   * Settle what `automatic` stands for in a run: steps as long as an error allows
   * (AdaptiveStepper), or equal super steps where those are not for it or cost less:
   * their whole number no more evaluations of the flows than the fewest steps of a run
   * with two implicit stages each.
   * @return why, for the record; empty for other schemes.
   * @throws cases::Refusal where step_error is asked for and cannot be had.
   */
  std::string settle_time_scheme(SphParameters &parameters,
                                 const TimeSchemeDemand &demand);

  /** Fewest stages, at least three, with which a super step reaches so many times the
   * step of explicit Euler. */
  int stages_reaching(double reach);

  /** One stage of a super step; F is the rate of change. */
  struct SuperStage
  {
    double previous;   ///< factor of Y_(j-1)
    double before;     ///< factor of Y_(j-2)
    double start;      ///< factor of Y_0
    double rate;       ///< factor of step * F(Y_(j-1))
    double start_rate; ///< factor of step * F(Y_0)
    double fraction;   ///< of the step, at which F(Y_(j-1)) is taken
  };

  /**
   * Coefficients of the second-order Runge-Kutta-Legendre scheme RKL2 (Meyer, Balsara and
   * Aslam 2014, equations 15 to 18), stages 2 to s; the first is Y_1 = Y_0 +
   * first_rate * step * F(Y_0). Stable for steps up to super_step_reach(s) times the
   * limit of explicit Euler.
   */
  struct SuperStep
  {
    explicit SuperStep(int stages);

    double first_rate;
    std::vector<SuperStage> stages;
  };

  /** (s^2 + s - 2)/4 */
  double super_step_reach(int stages);

  /** The longest Euler step of a plan, or what a super step is stable for (s). */
  double longest_euler_step(const StepPlan &plan);
} // namespace meltfront::particles

#endif
