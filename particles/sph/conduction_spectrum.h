#ifndef meltfront_particles_sph_conduction_spectrum_h
#define meltfront_particles_sph_conduction_spectrum_h

#include <particles/sph/conduction_rows.h>

#include <cstdint>
#include <span>

namespace meltfront::particles
{
  /**
   * The largest eigenvalue of the assembled rows of conduction, the links to walls that
   * prescribe a temperature included: of the matrix A in
   *
   *   flow into a cell = -A u,  u = k (T - T_m), walls at T_m.
   *
   * Explicit Euler steps of a body of one phase are stable up to 2 m c/(k lambda)
   * (m^(d-2)). By power iteration from a random vector, to about 1e-6; never above the
   * true one by more than round-off, so that the limit is not underestimated.
   *
   * @param held particles that hold a wall's temperature
   */
  double largest_eigenvalue(const ConductionRows &conduction,
                            std::span<const std::uint32_t> held);
} // namespace meltfront::particles

#endif
