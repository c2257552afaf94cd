#ifndef meltfront_cases_exact_manufactured_manufactured_solution_h
#define meltfront_cases_exact_manufactured_manufactured_solution_h

#include <cases/exact/manufactured/front_family.h>
#include <cases/exact_solution.h>
#include <cases/material.h>

#include <array>
#include <memory>
#include <string>

namespace meltfront::cases
{
  /**
   * An exact solution of the two-phase Stefan problem with heat sources, for any front
   * f(x, t) = 0 of a FrontFamily: method of manufactured solutions, derived in this
   * folder's README.
   *
   *   T = T_m + theta + b_j f/k_j
   *
   * in phase j, with D = |grad f|^2 + kappa |f|, the latent heat flux J = -rho_s L f_t/D
   * and
   *
   *   b_s = g + (J + sqrt(J^2 + d^2))/2,   b_l = g + (-J + sqrt(J^2 + d^2))/2,
   *
   * so that b_s - b_l = J and the front condition k_s dT_s/dn - k_l dT_l/dn = rho_s L V
   * holds identically, with both b > g whatever the speed and the properties. theta is
   * the front's temperature by Gibbs and Thomson, -Gamma times the continued curvature,
   * and zero without it; J gains -(k_s - k_l) grad theta . grad f/D, and T may be on
   * either side of T_m in both phases. The source q = rho_j c_j T_t - div(k_j grad T) is
   * in closed form.
   *
   * The latent heat per volume is rho_s L everywhere (nothing flows); each phase has its
   * own rho_j c_j. The source jumps at the front and is taken by the sign of f.
   *
   * Plane, disk and ball are solutions of one coordinate; of the others what takes a
   * coordinate instead of a position is not a number.
   */
  class ManufacturedSolution : public ExactSolution
  {
  public:
    using Vector = std::array<double, 3>;

    /**
     * @param base_flux heat flux g for each unit of the level set's slope, W/m^2; the
     * temperature falls away from the melting temperature at more than g/k_j times it
     * @param rounding d of the switch between the phase that freezing and the one that
     * melting takes its latent heat from, W/m^2; negative slopes are impossible for
     * every d, but small ones make the source vary within short times
     * @throws InputError where g, d or a property is not positive, or the material has a
     * Gibbs-Thomson coefficient and the family's bodies merge or part
     */
    ManufacturedSolution(const Material &material,
                         std::shared_ptr<const FrontFamily> family, double base_flux,
                         double rounding);

    /** With the rounding d = g. */
    ManufacturedSolution(const Material &material,
                         std::shared_ptr<const FrontFamily> family, double base_flux);

    const FrontFamily &family() const;
    std::string description() const override;

    /** That of plane, disk and ball; of the others Symmetry::none, whose measure is that
     * of the family's dimension. */
    Symmetry symmetry() const override;
    bool depends_on_one_coordinate() const override;

    double temperature(const Position &position, double time) const override;

    /** q (W/m^3), of the phase that f tells; zero at a saddle at the moment of contact,
     * about which it is unbounded. */
    double volumetric_source(const Position &position, double time) const override;

    /** k grad T (W/m^2), of the phase that f tells: minus the heat flux, so that its
     * product with an outward normal is the heat that enters through a wall. */
    Vector heat_flux(const Position &position, double time) const;

    /** f (m): negative in the solid, but no distance. */
    double level_set(const Position &position, double time) const;

    /** See FrontFamily::signed_distance(). */
    double signed_distance(const Position &position, double time) const override;

    /** See FrontDerivatives::curvature(). */
    double curvature(const Position &position, double time) const;

    using ExactSolution::solid_volume;

    /** Within the family's domain. */
    double solid_volume(double time) const override;

    /** The share of phases by the sign of f: 0 or 1. */
    double solid_fraction(const Position &position, double time) const override;

    /** By distances to the front at the nodes of a grid of the family's domain: its area,
     * or its length in the plane, to about 1e-3 (m^(d-1)). */
    double front_area(double time) const override;

    // Of plane, disk and ball; else not a number.
    double temperature(double coordinate, double time) const override;
    double front(double time) const override;
    double heat_content(double lower, double upper, double time) const override;
    double solid_fraction(double coordinate, double time) const override;

  private:
    struct Profile;

    Material material;
    std::shared_ptr<const FrontFamily> the_family;
    double base_flux;
    double rounding;
    Symmetry the_symmetry;

    /** Of the front; zero, and not asked for, without the Gibbs-Thomson effect. */
    ContinuedCurvature curvature_field(const Position &position, double time) const;
    Profile profile(const FrontDerivatives &f, const ContinuedCurvature &k) const;
    const PhaseProperties &phase(const FrontDerivatives &f) const;
  };
} // namespace meltfront::cases

#endif
