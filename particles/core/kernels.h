#ifndef meltfront_particles_core_kernels_h
#define meltfront_particles_core_kernels_h

#include <string>
#include <vector>

namespace meltfront::particles
{
  /** Shapes of smoothing kernels. */
  enum class KernelShape
  {
    cubic_spline,   ///< M4 spline, support 2 h (Monaghan and Lattanzio 1985)
    quintic_spline, ///< M6 spline, support 3 h (Schoenberg 1946)
    wendland_c2,    ///< support 2 h (Wendland 1995; norms: Dehnen and Aly 2012, table 1)
    wendland_c4,
    wendland_c6
  };

  /** The words for the shapes, in the order of the enumeration. */
  const std::vector<std::string> &kernel_names();

  /** The shape that a word names. @throws cases::InputError for an unknown word. */
  KernelShape kernel_shape(const std::string &name);

  /**
   * A smoothing kernel W(r, h) in 1, 2 or 3 dimensions, with unit integral.
   *
   * Evaluated when operators are built, not when they are applied.
   */
  class SmoothingKernel
  {
  public:
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
    KernelShape shape;
    int dim;
    double h;     ///< smoothing length
    double norm;  ///< W = norm * w(q)
    double scale; ///< q = r / scale: h for splines, the support for Wendland's
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
