#ifndef meltfront_particles_sph_liquid_flow_h
#define meltfront_particles_sph_liquid_flow_h

#include <cases/compensated_sum.h>
#include <cases/effect_meter.h>
#include <particles/sph/displacement_solver.h>
#include <particles/sph/enclosed_liquid.h>
#include <particles/sph/liquid_outlet.h>

#include <span>
#include <vector>

namespace meltfront::particles
{
  /**
   * Liquid that moves because it freezes, past particles that stay where they are (effect
   * liquid_motion in the plane and in space): a projection among resting particles (Lind
   * and Stansby, J. Comput. Phys. 326, 2016).
   *
   * Two particles that hold liquid let pass g_ab (phi_a - phi_b) from a to b, with
   * symmetric coefficients as of heat. After every step phi makes these volumes, and what
   * leaves through the outlet, add up to what freezing has set free: liquid flows as
   * -grad phi does, with phi = 0 in the outlet. It takes along its sensible heat during
   * the next step, and its latent heat at once. That heat is the mean of both particles',
   * with as much of an upwind share as keeps the maximum principle where liquid flows
   * faster than heat spreads from one to the other. What a pair passes on one gains and
   * the other loses, to the last bit.
   */
  class LiquidFlow
  {
  public:
    /** @param discretisation of the scene at rest
     * @param enthalpy at the start, which has displaced nothing
     * @param explicit_step the longest Euler step that is made (s) */
    LiquidFlow(const LiquidBalance &balance, const Discretisation &discretisation,
               std::span<const double> enthalpy, double explicit_step, int threads);

    LiquidFlow(const LiquidFlow &) = delete;
    LiquidFlow &operator=(const LiquidFlow &) = delete;

    /**
     * Add the sensible heat that liquid carries to the particles' flows.
     * @return what comes in with it through the outlet (W in the measure of the strip).
     */
    double add(std::span<const double> enthalpy, std::span<double> flow);

    /**
     * After a step: let liquid make room.
     * @return latent heat that came in through the outlet (J in the measure of the
     * scene).
     * @throws cases::Refusal where solid and closed walls enclose what freezes or melts,
     * and where liquid flows too fast for the explicit steps; cases::NumericalError where
     * the potential is not found.
     */
    double displace(double begin, double end, std::span<const double> enthalpy);

    /** All matter that there is, and that has left (kg in the measure of the scene). */
    double mass() const;

    cases::EffectCost cost() const;

    /** Interactions touched so far. */
    long work() const;

  private:
    void free_volumes(std::span<const double> enthalpy);
    void settle_enclosed(double time);
    void solve(double time);
    void require_short_steps(double time) const;
    double leave();

    const LiquidBalance &balance;
    const cases::Material &material;
    int thread_count;
    double cross_section, explicit_step;
    ConductionRows conduction; ///< of the potential
    LiquidOutlet outlet;
    DisplacementSolver solver;
    EnclosedLiquid enclosed;
    std::vector<double> volume;   ///< of each particle (m^d)
    std::vector<double> fraction; ///< of solid, after the last step
    /** Volume that has been set free and has not been displaced yet (m^d). */
    std::vector<double> due;
    std::vector<double> liquid;    ///< 1 for particles that let liquid pass, else 0
    std::vector<double> potential; ///< of the volumes of the last step
    std::vector<double> carried;   ///< sensible heat per volume
    std::vector<double> passed;    ///< heat into each particle
    double total_volume;
    double duration = 0; ///< of the last step; 0: nothing has flowed yet
    long steps = 0, evaluations = 0;
    double straight_out = 0;    ///< of the last step, from enclosed particles (m^d)
    cases::CompensatedSum left; ///< volume of liquid, through the outlet (m^d)
    cases::EffectMeter meter;
  };
} // namespace meltfront::particles

#endif
