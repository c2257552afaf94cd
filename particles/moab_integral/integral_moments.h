#ifndef meltfront_particles_moab_integral_integral_moments_h
#define meltfront_particles_moab_integral_integral_moments_h

#include <particles/core/kernel_shapes.h>

#include <array>
#include <span>
#include <vector>

namespace meltfront::particles
{
  /** Exponents of a monomial z_1^a z_2^b. */
  using Exponents = std::array<int, 2>;

  /** Exponents of all monomials up to a degree in 1 or 2 dimensions, those of low degree
   * first. */
  std::vector<Exponents> monomials(int dimension, int degree);

  /** z^a of all exponents. */
  void evaluate_monomials(std::span<const Exponents> exponents,
                          const std::array<double, 2> &z, std::span<double> result);

  /** A line or a rectangle around the origin that holds it, in units of the dilation. */
  struct ScaledBox
  {
    std::array<double, 2> lower{-1, -1}, upper{1, 1};
  };

  /**
   * Moments of a kernel's shape that walls cut off,
   *
   *   mu_a = integral over {|z| < 1} and the box of psi(|z|) z^a dz.
   *
   * On a line by Gauss's rule between the knots of the shape; in the plane in polar
   * coordinates, where the radial integral ends at the edge of the support or at a wall,
   * by Gauss's rule between the angles at which that end passes a corner, a knot or twice
   * its distance. Relative to the largest moment good to 1e-13.
   */
  class KernelMoments
  {
  public:
    /** @throws cases::InputError for a dimension other than 1 and 2. */
    KernelMoments(KernelShape shape, int dimension, int degree);

    std::span<const Exponents> exponents() const
    {
      return powers;
    }

    /** One moment per exponents. Allocates nothing where no wall cuts. */
    void evaluate(const ScaledBox &box, std::span<double> moments) const;

  private:
    void on_line(const ScaledBox &box, std::span<double> moments) const;
    void in_plane(const ScaledBox &box, std::span<double> moments) const;
    /** Adds what a range of angles contributes in which one wall, or none, ends rays. */
    void add_sector(double from, double to, double wall_angle, double wall_distance,
                    std::span<double> moments) const;
    /** Integrals of psi(r) r^power over 0 <= r <= end, power = first .. first + degree.
     */
    std::array<double, 5> radial_integrals(int first, double end) const;

    KernelShape shape;
    int dim;
    int degree;
    std::vector<Exponents> powers;
    std::vector<double> knots;                   ///< ascending from 0 to 1
    std::vector<std::array<double, 5>> at_knots; ///< radial integrals up to each knot
    std::vector<double> whole;                   ///< moments of the whole support
  };
} // namespace meltfront::particles

#endif
