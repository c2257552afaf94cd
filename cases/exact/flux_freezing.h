#ifndef meltfront_cases_exact_flux_freezing_h
#define meltfront_cases_exact_flux_freezing_h

#include <cases/exact_solution.h>
#include <cases/material.h>

#include <vector>

namespace meltfront::cases
{
  /**
   * Liquid between x = 0, where the flux q leaves it, and an insulated wall at x = l; it
   * cools without changing its shape,
   *
   *   T = T_far - q (l - x)^2/(2 k_l l) - q a_l t/(k_l l),
   *
   * until x = 0 reaches the melting temperature. From then on ice grows under the same
   * flux. With lengths in l, times in l^2/a_l from the onset, tau the root of the time,
   * the front is a power series in tau that begins with tau^3, and
   *
   *   k_l (T - T_m)/(q l) = x - x^2/2 - tau^2 + sum_n b_n W_n   in the liquid,
   *   k_s (T - T_m)/(q l) = x + sum_j w^(j)(t) (a_l/a_s)^j x^(2j)/(2j)!   in the ice,
   *
   * W_n = Gamma(n/2 + 1) (2 tau)^n i^n erfc(x/(2 tau)) being tau^n at x = 0 (Carslaw and
   * Jaeger 1959, 2.5) and w, the temperature of the wall, a series in tau. T = T_m on
   * both sides of the front and the Stefan condition give all coefficients in turn. The
   * series is used as long as its end is at round-off and the layer does not see the
   * insulated wall: up to end_time(), from which an oracle may go on.
   */
  class FluxFreezing : public ExactSolution
  {
  public:
    /**
     * @param flux             leaves the domain at x = 0 (W/m^2), positive
     * @param far_temperature  at the insulated wall at the start, T_far
     * @throws InputError unless the liquid is warmer than the melting temperature at the
     * start; for a property that is not positive or unequal densities.
     */
    FluxFreezing(const Material &material, double length, double flux,
                 double far_temperature, double start_time);

    /** When the wall reaches the melting temperature (s). */
    double onset() const;

    /** Until when the solution holds (s). */
    double end_time() const;

    std::string description() const override;
    Symmetry symmetry() const override;
    double start_time() const override;

    /** 0 before the onset. @throws InputError after end_time(), as all that take a time.
     */
    double front(double time) const override;

    using ExactSolution::temperature;
    double temperature(double coordinate, double time) const override;

    /** By Gauss quadrature over panels that resolve the layer, to about 1e-14. */
    double heat_content(double lower, double upper, double time) const override;

  private:
    void find_coefficients();

    /** Root of the scaled time since the onset; 0 before it. */
    double clock(double time) const;

    double scaled_solid(double x, double tau) const;
    double scaled_liquid(double x, double tau) const;

    Material material;
    double length, flux, far_temperature, start;
    double time_scale;                ///< l^2/a_l (s)
    double last_clock = 0;            ///< tau at end_time()
    std::vector<double> front_series; ///< by power of tau
    std::vector<double> layer_series; ///< b_n
    std::vector<double> wall_series;  ///< w, by power of tau
  };
} // namespace meltfront::cases

#endif
