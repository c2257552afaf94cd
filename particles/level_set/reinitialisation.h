#ifndef meltfront_particles_level_set_reinitialisation_h
#define meltfront_particles_level_set_reinitialisation_h

#include <particles/level_set/runge_kutta.h>

namespace meltfront::particles::level_set
{
  /**
   * Makes phi a distance again without moving the front: phi_tau + S (|grad phi| - 1) = 0
   * with S = phi_0 / sqrt(phi_0^2 + dx^2) of the phi_0 at hand at first (Sussman, Smereka
   * and Osher 1994; SAND2016-9800, equations 4.7 and 4.8). |grad phi| by Godunov's choice
   * among one-sided WENO derivatives, the sign from phi_0; Runge-Kutta steps of order 3
   * and length dx / 2, so that n iterations reach n / 2 spacings far.
   */
  class Reinitialisation
  {
  public:
    /**
     * Some iterations; then the band is laid anew.
     * @throws cases::NumericalError if phi is no longer a number
     */
    void operator()(LevelSet &level_set, int iterations = 10);

  private:
    RungeKutta runge_kutta;
    std::vector<double> sign; ///< S along the band
  };
} // namespace meltfront::particles::level_set

#endif
