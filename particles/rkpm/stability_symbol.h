#ifndef meltfront_particles_rkpm_stability_symbol_h
#define meltfront_particles_rkpm_stability_symbol_h

#include <particles/rkpm/moment_engine.h>

#include <string>

namespace meltfront::particles::rkpm
{
  /** Below this ratio a collocated Laplacian has a spurious mode. */
  inline constexpr double least_stable_ratio = 0.05;

  /**
   * How the collocated Laplacian acts on the waves of an infinite cubic lattice, against
   * the 3-, 5- or 7-point formula:
   *
   *   r = min over theta of -S(theta) h^2 / sum_i (2 - 2 cos theta_i),
   *   S(theta) = sum_I L_I cos(theta . x_I / h),
   *
   * with the Laplacian's weights L_I. Where r <= 0 a wave of the lattice is invisible to
   * the operator: its matrix is singular, or nearly so, for some numbers of particles,
   * and errors are erratic. Flat kernels of large support have such waves: fitting a
   * parabola to five equal weights gives (2, -1, -2, -1, 2)/7, blind at
   * cos theta = -3/4.
   *
   * @param settings variant (of the two families), kernel, dimension and order
   * @param alpha dilation over lattice spacing
   * @return r; NaN where the neighbours do not determine the polynomial
   */
  double stability_ratio(const MomentSettings &settings, double alpha);

  /**
   * The largest alpha, in steps from `first`, up to which r >= `least` without an
   * exception; values at which the neighbours do not determine the polynomial are passed
   * over. Zero if the first that does is unstable. The search ends at alpha = 8 (5 in
   * 3D).
   */
  double largest_stable_alpha(const MomentSettings &settings, double first, double step,
                              double least = least_stable_ratio);

  /** What the test says of one alpha. */
  struct StabilityVerdict
  {
    double ratio;
    bool safe;
    double largest_alpha; ///< the largest safe one in steps of 0.05
    std::string sentence;
  };

  StabilityVerdict judge_stability(const MomentSettings &settings, double alpha);

  /** @throws cases::Refusal with the ratio and the largest safe alpha if alpha is not
   * safe. */
  void require_stability(const MomentSettings &settings, double alpha);
} // namespace meltfront::particles::rkpm

#endif
