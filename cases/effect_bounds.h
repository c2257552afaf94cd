#ifndef meltfront_cases_effect_bounds_h
#define meltfront_cases_effect_bounds_h

#include <cases/effects.h>
#include <cases/numbers.h>

#include <string>
#include <vector>

namespace meltfront::cases
{
  struct Scene;

  /** By how much a scene changes at most if an effect is left out; infinite where nothing
   * is known. */
  struct EffectBound
  {
    /** Of the front by latent heat over the domain's side; of the solid's volume over the
     * domain's where nothing is symmetric. At all times. */
    double front = infinity;
    /** Mean of |change of T| over the domain, over the range of initial and wall
     * temperatures. At all times. */
    double temperature = infinity;
    /** What it was computed from, or why there is none; a clause. */
    std::string words;

    double largest() const;
  };

  /**
   * A bound from the data of a scene, before anything is solved.
   *
   * Let H_1, T_1 solve dH/dt = div(k grad T) + q with an effect (without it, for
   * displaced liquid), and T_2 the same without it (with it). T_2 solves the first
   * problem with an additional source f, and by the contraction of enthalpy in L1 (H and
   * T are increasing functions of each other, at walls of Newton's and Stefan's law too;
   * Kato's inequality),
   *
   *   int |H_1(T_1) - H_1(T_2)| dx  <=  int_0^t int |f| dx dt  =:  B        (J)
   *
   * at any time t. Both parts of H, rho c T and rho L (1 - f_s), differ with the same
   * sign, so that int |f_s1 - f_s2| dx <= B/(rho L) and int |T_1 - T_2| dx <= B/(rho c).
   * With V the volume of the domain, the front moves by B/(rho L V) of the side in a
   * planar scene, and as the d-th root in round ones, |r_1 - r_2|^d <= |r_1^d - r_2^d|.
   *
   * B is the heat that the effect handles (bound_scene_heat(): volume V, largest excess
   * theta of each phase, E what it takes up and gives away, F what it passes at fronts, W
   * what it passes at walls of given flux, Newton's and Stefan's law):
   *
   * - sources: int |Q| dt; twice that for the path of a moving one.
   * - volumetric source: V t max |q|.
   * - flux, Robin, radiating walls: A t max |q(T)| over all temperatures that there may
   *   be; over rho L V, the product of Biot, Fourier and Stefan number.
   * - wall temperature: all that the domain can exchange with walls of one temperature.
   * - phase conductivity: f = -(k_l - k_s) lap T_2 in the liquid. With k_s lap theta =
   *   rho c dtheta/dt + q delta(front), q >= 0 what the liquid gives to the front,
   *   B = |k_l/k_s - 1| (E + F + W).
   * - phase heat capacity: f = rho (c_l - c_s) dtheta/dt, B = |c_l - c_s|/c E.
   * - k(T): f = -div((k(T) - k_m) grad T), in each phase B = max |k/k_m - 1| (E + W)
   *   + max |k'| theta/k_m (F + rho c theta V), for int int k_m |grad theta|^2 dx dt
   *   <= theta (F + rho c theta V).
   * - c(T): in each phase B = max |c/c_m - 1| E.
   * - displaced liquid, in a slab that freezes from x_min, where the solid rests and the
   *   liquid moves by u = (1 - rho_s/rho_l) ds/dt: f = -(rho_l - rho_s) c_l (dT/dt +
   *   (ds/dt) dT/dx), B = 2 |rho_l - rho_s| c_l theta V.
   * - phase change where no temperature reaches T_m, properties of a phase that never
   *   leaves T_m, Gibbs-Thomson of a flat front: B = 0.
   *
   * These hold for all shapes and dimensions, and are proved up to the sampling of data
   * that vary and E in scenes that are driven both ways (PhaseHeat::turned).
   * There is no bound, and the effect stays on, for a melting range (how much of it lies
   * at temperatures between depends on the solution), for curved fronts that melt at
   * another temperature, solutes, inclusions, metastable phases and steady scenes; nor
   * for anything else beside these, whose enthalpy does not contract.
   *
   * @param with the scene with the effect, @param without as simulated without it
   */
  EffectBound bound_of_effect(Effect effect, const Scene &with, const Scene &without);

  /**
   * The effects that a scene calls for (effects_called_for()) without those that are
   * negligible: again and again the one with the least bound in the scene without those
   * that are off already is switched off, as long as the sum of all stays within the
   * tolerance, so that the sum bounds what all of them change together (triangle
   * inequality). Reasons get the bounds, also of what stays on. What the case file says
   * is on or off is left alone.
   *
   * @param tolerance Case::effect_tolerance; 0: nothing is left out, no bound is computed
   */
  EffectSet effects_within(const Scene &scene, double tolerance);
} // namespace meltfront::cases

#endif
