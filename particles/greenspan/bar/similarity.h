#ifndef meltfront_particles_greenspan_bar_similarity_h
#define meltfront_particles_greenspan_bar_similarity_h

#include <vector>

namespace meltfront::particles::greenspan
{
  /** A property that depends on temperature: at_melting + slope (T - T_m). */
  struct LinearProperty
  {
    double at_melting = 0;
    double slope = 0;

    /** @param excess T - T_m */
    double operator()(double excess) const
    {
      return at_melting + slope * excess;
    }
  };

  /** A phase at constant pressure. */
  struct ContinuumPhase
  {
    LinearProperty density;       ///< mass per area
    LinearProperty conductivity;  ///< heat flux over temperature gradient
    LinearProperty heat_capacity; ///< at constant pressure, per mass

    /** Conductivity in Lagrange's mass coordinate, density times conductivity. */
    double mass_conductivity(double excess) const
    {
      return density(excess) * conductivity(excess);
    }
  };

  /** What the continuum needs to know of a substance. */
  struct Substance
  {
    double melting_temperature = 0;
    double latent_heat = 0; ///< jump of enthalpy, per mass
    ContinuumPhase solid, liquid;
  };

  /** Melting of a half space from a wall that is suddenly hot, in mass coordinates:
   * the front is where m^2 = slope t. */
  struct SimilaritySolution
  {
    double slope = 0;
    std::vector<double> coordinate;  ///< m / sqrt(t), from the wall on
    std::vector<double> temperature; ///< there
  };

  /**
   * Stefan's problem of two phases with properties that depend on temperature. In the
   * mass coordinate m, dm = rho dx, expansion drops out:
   *
   *   c dT/dt = d/dm (rho k dT/dm), T(0) = T_w, T(infinity) = T_0,
   *   T = T_m and L dm_f/dt = [rho k dT/dm] (solid less liquid) at the front m_f.
   *
   * With eta = m / sqrt(t) this is an ordinary equation (Boltzmann, Annalen der Physik
   * 53, 1894), (kappa T')' = -eta c T' / 2, whose flux kappa T' is proportional to
   * exp(-integral of eta c / (2 kappa)); fixed-point iteration for T in each phase,
   * bisection for the front.
   * @throws cases::InputError unless T_w > T_m >= T_0 and all properties are positive
   * between them
   */
  SimilaritySolution melt_half_space(const Substance &substance, double wall_temperature,
                                     double initial_temperature);
} // namespace meltfront::particles::greenspan

#endif
