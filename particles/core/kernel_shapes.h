#ifndef meltfront_particles_core_kernel_shapes_h
#define meltfront_particles_core_kernel_shapes_h

#include <array>
#include <span>
#include <string>
#include <vector>

namespace meltfront::particles
{
  /**
   * Shapes psi(q) of kernels, q = distance / support, with psi(q) = 0 for q >= 1.
   *
   * Sources: Monaghan and Lattanzio 1985 (cubic spline), Schoenberg 1946 (quartic and
   * quintic spline), Lucy 1977 and Belytschko, Lu and Gu 1994 (efg_quartic), Wendland
   * 1995 with the norms of Dehnen and Aly 2012, table 1.
   */
  enum class KernelShape
  {
    hat,              ///< 1 - q
    epanechnikov,     ///< 1 - q^2
    biweight,         ///< (1 - q^2)^2
    triweight,        ///< (1 - q^2)^3
    cubic_spline,     ///< M4, knots at 0, 1/2, 1
    efg_quartic,      ///< (1 - q)^3 (1 + 3 q): Lucy's kernel, Wendland C2 on a line
    quartic_spline,   ///< M5, knots at 1/5, 3/5, 1
    quintic_spline,   ///< M6, knots at 0, 1/3, 2/3, 1
    wendland_c2,      ///< (1 - q)^4 (1 + 4 q)
    wendland_c4,      ///< (1 - q)^6 (1 + 6 q + 35/3 q^2)
    wendland_c6,      ///< (1 - q)^8 (1 + 8 q + 25 q^2 + 32 q^3)
    cosine,           ///< (1 + cos(pi q)) / 2
    half_cosine,      ///< cos(pi q / 2)
    gaussian_3,       ///< exp(-9 q^2), lowered and scaled to run from 1 to 0
    gaussian_2,       ///< exp(-4 q^2), likewise
    bump,             ///< exp(1 - 1 / (1 - q^2))
    wendland_c4_line, ///< (1 - q)^5 (1 + 5 q + 8 q^2): Wendland C4 on a line
    wendland_c6_line  ///< (1 - q)^7 (1 + 7 q + 19 q^2 + 21 q^3): Wendland C6 on a line
  };

  /** The words for the shapes, in the order of the enumeration. */
  const std::vector<std::string> &kernel_names();

  /** The word for a shape. */
  const std::string &kernel_name(KernelShape shape);

  /** The shape that a word names. @throws cases::InputError for an unknown word. */
  KernelShape kernel_shape(const std::string &name);

  /** The k of the C^k that psi(|x|) is everywhere, its centre, knots and edge included;
   * the largest int for the bump. */
  int kernel_smoothness(KernelShape shape);

  /** The factor c of the dimension for which c psi(|x|) has a unit integral. */
  double kernel_norm(KernelShape shape, int dimension);

  /** A kernel's value and derivatives at one distance. */
  struct KernelProfile
  {
    double value;               ///< W, 1/m^dim
    double slope_over_distance; ///< W'(r) / r, 1/m^(dim+2); W''(0) at r = 0
    double second;              ///< W''(r), 1/m^(dim+2)
  };

  /**
   * A kernel of unit integral, W(r) = c psi(r/d) / d^dim with the dilation d, its radius
   * of support. All shapes are evaluated in factored form, which stays positive and
   * falling up to the edge, where expanded polynomials lose both to rounding.
   */
  class Kernel
  {
  public:
    /** @throws cases::InputError for a dimension other than 1, 2, 3 or a dilation that is
     * not positive. */
    Kernel(KernelShape shape, int dimension, double dilation);

    /** W(r), 1/m^dim. */
    double value(double distance) const;

    /** W'(r), 1/m^(dim+1). */
    double derivative(double distance) const;

    /** W''(r), 1/m^(dim+2). */
    double second_derivative(double distance) const;

    /**
     * W'(r)/r, 1/m^(dim+2), with its limit W''(0) at r = 0.
     * @throws cases::Refusal at r = 0 for the hat, which has no limit there.
     */
    double derivative_over_distance(double distance) const;

    /** Gradient of W(|x|) with respect to x, 1/m^(dim+1). */
    std::array<double, 3> gradient(const std::array<double, 3> &x) const;

    /**
     * Second derivatives of W(|x|) with respect to x, 1/m^(dim+2).
     * @throws cases::Refusal at x = 0 for the hat.
     */
    std::array<std::array<double, 3>, 3> hessian(const std::array<double, 3> &x) const;

    KernelShape shape() const
    {
      return kernel_shape;
    }

    int dimension() const
    {
      return dim;
    }

    /** Distance from which on W = 0 (m). */
    double dilation() const
    {
      return support;
    }

  private:
    KernelShape kernel_shape;
    int dim;
    double support;
    double norm; ///< W(r) = norm * psi(r / support)
  };

  /** psi(q) of many q >= 0 at once. */
  void evaluate_shape(KernelShape shape, std::span<const double> q,
                      std::span<double> value);

  /** psi(q), psi'(q)/q and psi''(q) of many q >= 0 at once; not finite for the hat at 0.
   */
  void evaluate_shape(KernelShape shape, std::span<const double> q,
                      std::span<KernelProfile> profile);
} // namespace meltfront::particles

#endif
