#ifndef meltfront_particles_sph_time_stepper_h
#define meltfront_particles_sph_time_stepper_h

#include <cases/compensated_sum.h>
#include <cases/scene.h>
#include <particles/sph/heat_flow.h>
#include <particles/sph/time/time_stepping.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace meltfront::particles
{
  /** What a stepper counted. */
  struct StepCounts
  {
    long repeated = 0;          ///< steps that were rejected and made anew
    long linear_iterations = 0; ///< of implicit schemes
    long most_iterations = 0;   ///< Newton's, of the solve with the most
  };

  /** Advances the particles' enthalpy in time, and books the heat that walls give. */
  class Stepper
  {
  public:
    /**
     * @param enthalpy at the start, of all particles
     * @param method its name, for errors
     */
    Stepper(HeatFlow &heat_flow, const Discretisation &discretisation,
            const StepPlan &plan, std::vector<double> enthalpy, std::string method);
    virtual ~Stepper() = default;
    Stepper(const Stepper &) = delete;
    Stepper &operator=(const Stepper &) = delete;

    /** Make a step, the first is 1, from a time on. @return its end. */
    double advance(long step, double begin);

    virtual StepCounts counts() const
    {
      return {repeated, 0, 0};
    }

    std::span<const double> enthalpies() const
    {
      return std::span(enthalpy).first(n);
    }

    /** Heat through walls since the start, in the measure of the scene (J m^(d-3)). */
    double boundary_heat() const
    {
      return booked.value();
    }

  protected:
    virtual double make_step(long step, double begin) = 0;

    /** Time after a step of the plan; the end exactly. */
    double time_of(long step) const;

    /** Of a particle, in the measure of the simulated strip (kg m^(d-3)). */
    double mass() const
    {
      return particle_mass;
    }

    /** Let the heat flow follow the state, which other processes tell of their particles.
     */
    void follow();

    /** Hold the walls, follow the state and find its extremes. @return heat from the
     * walls that particles hold. */
    double finish();

    bool breaks_bounds() const;

    /** @param through_walls over the step; held, likewise of finish() */
    void book(double through_walls, double dirichlet);

    HeatFlow &heat_flow;
    const Discretisation &dis;
    const StepPlan plan;
    const std::size_t n; ///< particles
    const std::string method;
    std::vector<double> enthalpy; ///< per mass, the state (J/kg), padded
    long repeated = 0;

  private:
    void check(long step, double time) const;

    cases::TemperatureBounds bounds;
    double particle_mass;
    Extremes extremes{}; ///< of the temperature
    cases::CompensatedSum booked;
  };

  /** The stepper of a scheme. */
  std::unique_ptr<Stepper>
  make_stepper(const SphParameters &parameters, HeatFlow &heat_flow,
               const Discretisation &discretisation, const StepPlan &plan,
               std::vector<double> enthalpy, const std::string &method);
} // namespace meltfront::particles

#endif
