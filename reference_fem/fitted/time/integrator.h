#ifndef meltfront_reference_fem_fitted_time_integrator_h
#define meltfront_reference_fem_fitted_time_integrator_h

#include <reference_fem/fitted/conservation_problem.h>

#include <functional>
#include <memory>
#include <string>

namespace meltfront::reference_fem::fitted
{
  /** A scheme for d/dsigma M(u) = F(sigma, u, du/dsigma). */
  enum class Scheme
  {
    bdf2,   ///< backward differentiation of order 2
    bdf3,   ///< of order 3
    bdf4,   ///< of order 4
    radau3, ///< Radau IIA with two stages, order 3
    radau5  ///< Radau IIA with three stages, order 5
  };

  /** The scheme of a name, `bdf2` and so on. Throws cases::InputError for another one. */
  Scheme scheme_of(const std::string &name);

  /** How a problem is integrated. */
  struct IntegrationOptions
  {
    Scheme scheme = Scheme::radau5;

    /**
     * 0: equal steps. Else the error of a step in units of ConservationProblem::scale()
     * that steps are chosen for (Radau only).
     */
    double tolerance = 0;

    /** Where Newton's iteration ends: size of the error that is left, in units of
     * scale(). */
    double solver_tolerance = 1e-13;

    /** Iterations after which a step is given up. */
    unsigned int iteration_limit = 12;

    /**
     * Up to this size the Jacobian of all stages is solved exactly in each iteration;
     * beyond it a Jacobian is kept for as long as the iteration contracts well.
     */
    unsigned int largest_exact_size = 400;

    /** Halvings of a failed step after which the run is given up (Radau only). */
    unsigned int halving_limit = 10;

    /** For messages: the name of the method, and the time (s) of a clock. */
    std::string method = "fem-fitted";
    std::function<double(double)> time = [](double clock) { return clock; };
  };

  /** What the steps so far have cost; deterministic. */
  struct IntegrationCost
  {
    long steps = 0;           ///< accepted
    long halved = 0;          ///< steps that Radau did not converge on and divided in two
    long repeated = 0;        ///< for the step control
    long fallbacks = 0;       ///< steps that BDF did not converge on and Radau took
    long starts = 0;          ///< steps that Radau took because BDF had no past
    long iterations = 0;      ///< of Newton's method, those of rejected steps too
    long most_iterations = 0; ///< of an accepted step
    long factorisations = 0;
    long work = 0; ///< entries of matrices that were filled, factorised or solved with
  };

  /** A step that has been taken. */
  struct AcceptedStep
  {
    long number = 0; ///< from 1 on
    double clock = 0;
    double size = 0;
    unsigned int iterations = 0;
    const dealii::Vector<double> &u;
    const dealii::Vector<double> &rate; ///< du/dsigma at the end of the step
  };

  /** Integrates a ConservationProblem. */
  class Integrator
  {
  public:
    /** Called after each step. False ends the run. */
    using AfterStep = std::function<bool(const AcceptedStep &)>;

    /** The problem must outlive the integrator. */
    Integrator(const ConservationProblem &problem, IntegrationOptions options);
    ~Integrator();

    /** Set the state; what is known of the past is forgotten, counts go on. */
    void start(double clock, const dealii::Vector<double> &u);

    /**
     * Integrate to @p end, which is met exactly, unless @p after_step ends the run.
     *
     * Without step control the interval is divided into equal steps of at most
     * @p step (up to rounding). With it @p step is the first one tried. Returns
     * whether the end was reached.
     *
     * Throws cases::NumericalError where the iteration does not converge or leaves the
     * states on which the equations have a meaning, after halvings for Radau.
     */
    bool advance_to(double end, double step, const AfterStep &after_step = {});

    double clock() const;
    const dealii::Vector<double> &state() const;

    /** The next step that the step control would try; the last one without it. */
    double proposed_step() const;

    const IntegrationCost &cost() const;

  private:
    class Implementation;
    std::unique_ptr<Implementation> implementation;
  };
} // namespace meltfront::reference_fem::fitted

#endif
