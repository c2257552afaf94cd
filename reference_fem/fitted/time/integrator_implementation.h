#ifndef meltfront_reference_fem_fitted_time_integrator_implementation_h
#define meltfront_reference_fem_fitted_time_integrator_implementation_h

#include <reference_fem/fitted/time/coefficients.h>
#include <reference_fem/fitted/time/integrator.h>
#include <reference_fem/fitted/time/stage_newton.h>

#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace meltfront::reference_fem::fitted
{
  /** The state, the past that steps build on, and the steps. */
  class Integrator::Implementation
  {
  public:
    using Vector = dealii::Vector<double>;

    /** @throws cases::InputError where steps are to be controlled in a scheme of several
     * steps. */
    Implementation(const ConservationProblem &problem, IntegrationOptions given);

    void start(double new_clock, const Vector &new_u);
    bool advance_to(double end, double step, const AfterStep &after_step);

    double clock = 0;
    Vector u;
    double proposal = 0;
    IntegrationCost cost;

  private:
    /** A state and its masses at the end of a step of BDF. */
    struct Past
    {
      double clock;
      Vector u, mass;
    };

    /** What a step led to, before it is accepted. */
    struct Outcome
    {
      double size = 0, end = 0;
      unsigned int iterations = 0;
      Stages stages, rates, flows;
    };

    bool integrate_interval(double end, const AfterStep &after_step);
    void accept(Outcome outcome, const AfterStep &after_step);

    /** Add the present state to what BDF steps build on. */
    void remember();

    Vector mass_of(const Vector &state, double at) const;
    [[noreturn]] void fail(const std::string &reason) const;

    // In step_attempt.cc:

    /** One step to the given clock or to an earlier one, as far as it succeeds. */
    Outcome step_towards(double end);

    /** Try a step; without a value where it failed, and `failure` says why. */
    std::optional<Outcome> try_bdf(double end);
    std::optional<Outcome> try_radau(double end);
    std::optional<Outcome> solve(StageEquations &equations, Stages stages, double end);

    /** The extrapolation of the past to a clock; the present state where the problem
     * objects to it. */
    Vector predict(const std::vector<double> &clocks,
                   const std::vector<const Vector *> &states, double at) const;

    // In step_control.cc:
    void controlled_step(double end, const AfterStep &after_step);

    /** Of the state at the end of a Radau step, in units of scale(). */
    double estimated_error(const Outcome &outcome);

    const ConservationProblem &problem;
    IntegrationOptions options;
    RadauCoefficients radau;
    unsigned int order; ///< of BDF, 0 for Radau
    StageNewton newton;
    SortedPattern pattern;
    Linearisation linearisation;
    CompressedRows<double> estimate_matrix;
    Factorisation<double> estimate_factors;

    Vector mass, scale;
    std::deque<Past> history;        ///< for BDF, the latest first
    double history_step = 0;         ///< between its states
    std::vector<double> past_clocks; ///< of the last Radau step: start and stages
    Stages past_states;
    std::string failure;
    bool stopped = false;
  };
} // namespace meltfront::reference_fem::fitted

#endif
