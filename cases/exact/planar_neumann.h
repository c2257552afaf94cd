#ifndef meltfront_cases_exact_planar_neumann_h
#define meltfront_cases_exact_planar_neumann_h

#include <cases/exact/profiles.h>
#include <cases/exact_solution.h>

namespace meltfront::cases
{
  /**
   * Freezing (or melting) of a half space x > 0 from a wall held at a temperature:
   * Neumann's two-phase solution with unequal properties, one phase where the far
   * temperature is the melting temperature. Front s = 2 lambda sqrt(a t) with the
   * diffusivity a of the phase at the wall; see similarity::PlanarProfile for the
   * equations.
   *
   * Where the densities differ, the phase at the wall is at rest and the other one is
   * displaced; x is measured from the wall. Liquid then counts rho_l (L + c_l (T - T_m))
   * per volume: latent heat with the liquid's own density.
   */
  class PlanarNeumann : public ExactSolution
  {
  public:
    /**
     * @param wall_temperature  below the melting temperature to freeze, above it to melt
     * @param far_temperature   at t = 0 everywhere and at all times far from the wall
     * @throws InputError unless wall and far temperature lie on different sides of the
     * melting temperature, or where a property or the driving temperature is not
     * positive.
     */
    PlanarNeumann(const Material &material, double wall_temperature,
                  double far_temperature);

    /** The front constant. */
    double lambda() const;

    std::string description() const override;
    Symmetry symmetry() const override;
    double front(double time) const override;
    bool solid_at_origin() const override;

    using ExactSolution::temperature;
    double temperature(double coordinate, double time) const override;

    /** By Gauss quadrature over panels that resolve the profile, to about 1e-14. */
    double heat_content(double lower, double upper, double time) const override;

  private:
    Material material;
    similarity::PlanarProfile<double> profile;
  };
} // namespace meltfront::cases

#endif
