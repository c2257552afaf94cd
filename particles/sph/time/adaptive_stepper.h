#ifndef meltfront_particles_sph_time_adaptive_stepper_h
#define meltfront_particles_sph_time_adaptive_stepper_h

#include <particles/sph/time/explicit_scheme.h>
#include <particles/sph/time/implicit_heat_flow.h>
#include <particles/sph/time/stepper.h>

#include <optional>

namespace meltfront::particles
{
  /**
   * Steps as long as an error allows, each by the cheaper of two second-order schemes:
   * RKL2 with as many stages as reach so far, or along a line two implicit stages
   * (ImplicitSolver::take_two_stage_step), whose cost does not depend on the length.
   *
   * What is kept small is by how much a step differs from one of backward Euler,
   *
   *   sum_a |H_a(t + dt) - H_a(t) - dt F_a(t + dt)/m| / (heat of a particle * front),
   *
   * about dt^2 H''/2: the share of a particle by which a front that moved at its last
   * speed would be elsewhere. `heat of a particle` is that between the extremes of the
   * scene, at least the latent heat; `front` the number of particles that melt.
   *
   * Where a particle begins or ceases to melt the flows jump, and no scheme is of second
   * order across. Along a line, where few do so, steps end there.
   *
   * A step whose error is too large, that breaks a bound or is not solved, is made anew
   * and shorter; one no longer than monotone_step() stands, of explicit Euler if RKL2
   * broke a bound.
   */
  class AdaptiveStepper : public Stepper
  {
  public:
    AdaptiveStepper(const SphParameters &parameters, HeatFlow &heat_flow,
                    const Discretisation &discretisation, const StepPlan &plan,
                    std::vector<double> enthalpy, const std::string &method);

    StepCounts counts() const override;

  private:
    /** Of a step that was tried. */
    struct Trial
    {
      bool sound; ///< solved, within its bounds
      double error;
      double through_walls, dirichlet; ///< heat (J)
    };

    double make_step(long step, double begin) override;

    /** Where a step is to end. */
    double aim(double begin);

    void choose_next_step(double duration, const Trial &trial);

    /** Time until the first particle begins or ceases to melt, if flows stay what they
     * are, not counting those that do so in a hundredth of `step` or hardly change in it;
     * infinite if none does (s). */
    double time_to_kink(double step) const;

    /** Whether a particle melts or lies beside one of the other phase: others may come
     * near to the melting point for ever. */
    bool changes_phase(std::size_t a) const;

    /** The share of the step just made after which a particle was the first to begin or
     * cease to melt; 1 if none did. */
    double first_kink_crossed() const;

    Trial attempt(double begin, double end, bool by_euler);
    void step_explicitly(double duration, int stages, Trial &trial);
    void step_implicitly(double duration, Trial &trial);
    void step_by_euler(double duration, Trial &trial);

    double error_of(double duration);

    double wanted_error;
    double explicit_step;      ///< the longest of Euler's that is certain (s)
    double longest;            ///< of all steps (s)
    double next_step;          ///< by the error (s)
    bool ends_at_kink = false; ///< the step that aim() gave
    double last_error = 0, last_duration = 0; ///< of the last step (s)
    double jump;          ///< latent heat exchanged at one temperature (J/kg)
    double heat_span;     ///< between the extremes of the scene (J/kg)
    double front_at_rest; ///< particles across the domain, where none melts
    ExplicitScheme explicit_scheme;
    std::optional<ImplicitHeatFlow> implicit_flow; ///< along a line
    std::optional<ImplicitSolver> solver;
    double newton_work;                 ///< evaluations by iteration of Newton's method
    double last_newton;                 ///< iterations in the last implicit step
    std::vector<double> before;         ///< the state at the begin of a step
    std::vector<double> flow, end_flow; ///< at the begin and at the end of a step
    long implicit_steps = 0;
  };
} // namespace meltfront::particles

#endif
