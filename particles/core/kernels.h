#ifndef meltfront_particles_core_kernels_h
#define meltfront_particles_core_kernels_h

#include <particles/core/kernel_shapes.h>

#include <string>
#include <vector>

namespace meltfront::particles
{
  /** The shapes that a smoothing kernel can take: those whose smoothing length has a
   * settled relation to the support. */
  const std::vector<std::string> &smoothing_kernel_names();

  /**
   * A smoothing kernel W(r, h) in 1, 2 or 3 dimensions, with unit integral. The support
   * is 2 h, that of the quintic spline 3 h. On a line Wendland's functions are those of
   * lowest degree there (Dehnen and Aly 2012, table 1): efg_quartic, wendland_c4_line and
   * wendland_c6_line.
   *
   * Evaluated when operators are built, not when they are applied.
   */
  class SmoothingKernel
  {
  public:
    /** @throws cases::Refusal for a shape that is not among smoothing_kernel_names(). */
    SmoothingKernel(KernelShape shape, int dimension, double smoothing_length);

    /** W(r), 1/m^d. */
    double value(double distance) const;

    /**
     * F(r) = W'(r)/r <= 0, 1/m^(d+2): the gradient of W is r F. Finite at r = 0, never
     * divides by r there.
     */
    double radial_derivative_over_distance(double distance) const;

    /** Distance beyond which W = 0 (m). */
    double support() const;

    double smoothing_length() const;
    int dimension() const;

  private:
    double h; ///< smoothing length
    Kernel kernel;
  };

  /**
   * Second moment of F on an infinite cubic lattice,
   * mu = -(1/d) sum_b dp^d F(r_b) r_b^2.
   *
   * One in the limit of many neighbours; on a lattice the SPH Laplacian is too large by
   * this constant factor (1.0105 for the cubic spline at h = 1.3 dp in 2D), so that
   * dividing by it makes the Laplacian of a quadratic exact.
   */
  double lattice_second_moment(const SmoothingKernel &kernel, double spacing);
} // namespace meltfront::particles

#endif
