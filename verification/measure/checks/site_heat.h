#ifndef meltfront_verification_measure_checks_site_heat_h
#define meltfront_verification_measure_checks_site_heat_h

#include <cases/scene.h>
#include <cases/snapshot.h>

namespace meltfront::verification
{
  /** Heat that the sites of a snapshot hold, in the measure of the scene, as it is
   * defined for cases::HeatBudget. */
  struct SiteHeat
  {
    double stored = 0;
    double latent = 0;
    double magnitude = 0; ///< of all terms: sum of their absolute values

    /** How far a method's book of stored and latent heat is off the sites'. */
    double difference(const cases::HeatBudget &book) const;

    /** Largest magnitude among both. */
    double scale(const cases::HeatBudget &book) const;
  };

  /** Heat per mass at a site beside the latent heat of what is liquid (J/kg): c (T - T_m)
   * with the heat capacity of the phases that are there; where properties depend on
   * temperature the integral of c, in equilibrium. */
  double sensible_heat(const cases::Material &material, double temperature,
                       double solid_fraction);

  /**
   * Sum over the sites of weight times
   *
   *   (f rho_s c_s + (1 - f) rho_l c_l) (T - T_m) and rho_l L (1 - f)
   *
   * with the solid fraction f; where properties depend on temperature, sensible_heat()
   * for the first.
   */
  SiteHeat heat_of_sites(const cases::Material &material,
                         const cases::Snapshot &snapshot);
} // namespace meltfront::verification

#endif
