#ifndef meltfront_particles_alloy_phase_exchange_h
#define meltfront_particles_alloy_phase_exchange_h

namespace meltfront::particles
{
  /** What a solution at its liquidus does when it loses heat. */
  struct Freezing
  {
    double drop;     ///< of the temperature (K)
    double fraction; ///< of its mass that becomes ice
  };

  /**
   * Ice that a solution makes at its liquidus, which its composition lowers by P, when it
   * loses the heat q per mass (J/kg). The drop d obeys
   *
   *   phi = d/(P + d),  q = phi L + phi c_s d + (1 - phi) c_l d
   *   =>  c_s d^2 + (L + P c_l - q) d - q P = 0
   *
   * (Monaghan, Huppert and Worster 2005, equations 4.4 and 4.9; the root without
   * cancellation). L is the latent heat at the temperature before the drop.
   */
  Freezing freeze(double heat, double depression, double latent_heat,
                  double solid_capacity, double liquid_capacity);
} // namespace meltfront::particles

#endif
