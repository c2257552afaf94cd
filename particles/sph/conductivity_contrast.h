#ifndef meltfront_particles_sph_conductivity_contrast_h
#define meltfront_particles_sph_conductivity_contrast_h

#include <particles/sph/discretisation.h>
#include <particles/sph/parameters.h>

#include <span>
#include <string>

namespace meltfront::particles
{
  /**
   * By how much fronts half way between particles (FrontRule::partner, liquid) are held
   * back. A solid and a liquid particle exchange by the harmonic mean of their
   * conductivities, so that what the phase behind the front conducts to the next particle
   * meets the resistance of this length of that phase too much (m):
   *
   *   dp/2 (k_behind/k_ahead - 1).
   */
  double front_lag(double spacing, double behind, double ahead);

  /**
   * A front whose way is s covers sqrt(s^2 + lag^2) - lag only, less than half of it
   * where the lag exceeds 3/4 s.
   *
   * @param enthalpy at the start: phases that are there may lie ahead of a front, and so
   * may both where a wall turns from freezing to melting
   * @throws cases::Refusal where the lag exceeds a quarter of the domain's side: even a
   * front that is to cross a third of the domain would miss half of its way
   */
  void require_moderate_contrast(const Discretisation &discretisation, FrontRule rule,
                                 std::span<const double> enthalpy,
                                 const std::string &method);
} // namespace meltfront::particles

#endif
