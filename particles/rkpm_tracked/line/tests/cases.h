#ifndef meltfront_particles_rkpm_tracked_line_tests_cases_h
#define meltfront_particles_rkpm_tracked_line_tests_cases_h

#include <particles/rkpm_tracked/line/stepper.h>

#include <functional>
#include <string>
#include <vector>

namespace meltfront::particles::rkpm_tracked
{
  /** Material of SAND2016-9800's example made whole: liquid at 500, solid at 380, melting
   * at 430 K; rho_l = c = k_l = 1, L = 110 by default. */
  cases::Material bar_material(double conductivity_ratio = 2, double latent_heat = 110,
                               double density_ratio = 1);

  inline constexpr double hot = 500, cold = 380;

  /** A similarity solution: what a run starts from and is held against. */
  struct ExactLine
  {
    std::function<double(double time)> front;
    std::function<double(double x, double time)> temperature;

    /** When the front is at a place, for a front that grows like sqrt(t). */
    double time_of(double place) const;
  };

  /** Melting from x = 0 of a half space: the phase at the wall at rest. */
  ExactLine neumann(const cases::Material &material);

  /** The same with the solid at rest: liquid comes in or leaves through the wall. The
   * similarity solution in eta = x/(2 sqrt(a t)): T'' + 2 (eta - q) T' = 0 with q = (1 -
   * rho_s/rho_l) lambda. */
  ExactLine neumann_with_open_wall(const cases::Material &material);

  /** A unit slab between walls that are held at given temperatures. */
  LineProblem unit_slab(const cases::Material &material, int n,
                        std::function<double(double)> lower_wall,
                        std::function<double(double)> upper_wall, double jitter = 0);

  /** Nodes' temperatures and the front of an exact solution. */
  LineState state_of(const ExactLine &exact, const LineProblem &problem, double time);

  /** How a run of melting from 0.06 to 0.18 is made. */
  struct MeltingRun
  {
    cases::Material material = bar_material();
    ExactLine exact;
    int n = 40;
    int steps = 20;
    int time_order = 2;
    int basis_order = 2;
    double jitter = 0;
    double interpolation_distance = 0.1;
    Displaced displaced = Displaced::liquid;
  };

  struct MeltingResult
  {
    double front = 0;             ///< at the end
    double front_error = 0;       ///< with its sign
    double temperature_error = 0; ///< largest at a node
  };

  /** Steps of equal length with the exact history before the first; every step must be
   * accepted. */
  MeltingResult melt(const MeltingRun &run);

  /** Exponents of h or dt between errors of n, 2 n, 4 n, ...: fitted by least squares. */
  double fitted_order(const std::vector<double> &errors);

  /** Kernel radius that the method uses by default, over the spacing. */
  double default_dilation(int basis_order);
} // namespace meltfront::particles::rkpm_tracked

#endif
