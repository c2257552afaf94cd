#ifndef meltfront_verification_measure_formulas_entropy_h
#define meltfront_verification_measure_formulas_entropy_h

#include <cases/alloy.h>
#include <cases/scene.h>
#include <cases/snapshot.h>

#include <optional>

namespace meltfront::verification
{
  /** Entropy in the measure of a scene (J/K, J/(K m) or J/(K m^2)). */
  struct Entropy
  {
    /**
     * With temperatures from absolute zero and f the mass fraction of liquid, the sum
     * over all mass of
     *
     *   (1 - f) c_s ln(T/T_m) + f [c_l ln(T/T_m) + L/T_m + s_mix(C_liquid)].
     *
     * NaN for a curved liquidus and for two solutes.
     */
    double total;
    /** Ideal mixing alone: minus the sum over all liquid mass of sum_i C_i ln C_i, the
     * solvent among the i, in units of a gas constant per mass. NaN without solute. */
    double mixing;
  };

  /**
   * The entropy of snapshots, which conduction, diffusion and freezing must never lower
   * in an isolated scene.
   *
   * The mixing entropy that goes with a straight liquidus T_L = T_m (1 - x),
   * x = Gamma C/T_m, follows from equilibrium of solvent and crystals there: with heats
   * of melting L + (c_l - c_s)(T - T_m) and mixing without heat,
   *
   *   s_mix - C s_mix' = Delta h(T_L)/T_L - Delta s(T_L)
   *   => s_mix = -(L/T_m) x ln(x/(1 - x)) - (c_l - c_s) ln(1 - x)
   *
   * up to a term linear in C, which is conserved. At small C it is the -C ln C of an
   * ideal dilute solution. With it total entropy is a concave function of enthalpy and
   * concentration whose derivative by the enthalpy is 1/T, in the mush too.
   */
  class EntropyMeter
  {
  public:
    /**
     * @param scene as it was simulated
     * @param absolute_zero on its scale of temperature
     * @throws InputError if absolute zero is not below the melting temperature
     */
    EntropyMeter(const cases::Scene &scene, double absolute_zero);

    /** NaN where a site is not above absolute zero. */
    Entropy of(const cases::Snapshot &snapshot) const;

  private:
    double site_entropy(double temperature, double liquid, double concentration) const;

    cases::Material material;
    std::size_t solutes = 0;
    bool straight = true;
    double slope = 0; ///< Gamma (K)
    double absolute_zero;
    double melting; ///< T_m above absolute zero (K)
  };
} // namespace meltfront::verification

#endif
