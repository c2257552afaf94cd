#include <cases/error.h>
#include <cases/exact/check_material.h>
#include <cases/exact/heat_quadrature.h>
#include <cases/exact/manufactured/front_area.h>
#include <cases/exact/manufactured/manufactured_solution.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meltfront::cases
{
  namespace
  {
    using Vector = std::array<double, 3>;

    constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
    const char *const solution_name = "manufactured solution";

    /** Of D, which has no unit: as good as zero, where squares of its inverse overflow.
     */
    constexpr double vanishing = 1e-60;

    double product(const Vector &a, const Vector &b)
    {
      return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    }

    Vector product(const std::array<Vector, 3> &matrix, const Vector &a)
    {
      return {product(matrix[0], a), product(matrix[1], a), product(matrix[2], a)};
    }

    double square_norm(const std::array<Vector, 3> &matrix)
    {
      return product(matrix[0], matrix[0]) + product(matrix[1], matrix[1])
             + product(matrix[2], matrix[2]);
    }

    /** Fronts of uniform curvature are at one coordinate. */
    Symmetry symmetry_of(const FrontFamily &family)
    {
      const auto curvature = family.uniform_curvature(0);
      if(!curvature)
        return Symmetry::none;
      return curvature->value == 0     ? Symmetry::planar
             : family.dimension() == 2 ? Symmetry::cylindrical
                                       : Symmetry::spherical;
    }

    const Material &checked(const Material &material, const FrontFamily &family,
                            double base_flux, double rounding)
    {
      check_material(material, solution_name);
      const auto require_positive = [](double value, const char *what)
      {
        if(!(value > 0) || !std::isfinite(value))
          throw InputError(fmt::format("{}: the {} must be positive, not {}",
                                       solution_name, what, value));
      };
      require_positive(base_flux, "base flux");
      require_positive(rounding, "rounding of the flux");
      if(material.gibbs_thomson_coefficient != 0 && family.merges())
        throw InputError(
            fmt::format("{}: cannot have the Gibbs-Thomson effect with '{}', whose "
                        "curvature is unbounded where bodies merge or part",
                        solution_name, family.name()));
      return material;
    }
  } // namespace

  /** b_j of a phase and what its derivatives are made of; gradients with those of f. */
  struct ManufacturedSolution::Profile
  {
    double side;        ///< of f: -1 in the solid, 1 in the liquid
    double denominator; ///< D
    double capillary;   ///< of grad K . grad f in D J: Gamma (k_s - k_l)
    double latent_flux; ///< J
    double flux;        ///< b
    double slope;       ///< db/dJ
    double bend;        ///< d2b/dJ2
    Vector D_gradient;
    Vector J_gradient;
  };

  ManufacturedSolution::ManufacturedSolution(const Material &material,
                                             std::shared_ptr<const FrontFamily> family,
                                             double base_flux, double rounding)
    : material(checked(material, *family, base_flux, rounding))
    , the_family(std::move(family))
    , base_flux(base_flux)
    , rounding(rounding)
    , the_symmetry(symmetry_of(*the_family))
  {
  }

  ManufacturedSolution::ManufacturedSolution(const Material &material,
                                             std::shared_ptr<const FrontFamily> family,
                                             double base_flux)
    : ManufacturedSolution(material, std::move(family), base_flux, base_flux)
  {
  }

  const FrontFamily &ManufacturedSolution::family() const
  {
    return *the_family;
  }

  std::string ManufacturedSolution::description() const
  {
    return fmt::format("{}: {}, base flux {:.12g} W/m^2, rounding {:.12g} W/m^2",
                       solution_name, the_family->description(), base_flux, rounding);
  }

  Symmetry ManufacturedSolution::symmetry() const
  {
    return the_symmetry;
  }

  bool ManufacturedSolution::depends_on_one_coordinate() const
  {
    return the_symmetry != Symmetry::none;
  }

  const PhaseProperties &ManufacturedSolution::phase(const FrontDerivatives &f) const
  {
    return f.value < 0 ? material.solid : material.liquid;
  }

  ContinuedCurvature ManufacturedSolution::curvature_field(const Position &position,
                                                           double time) const
  {
    return material.gibbs_thomson_coefficient == 0
               ? ContinuedCurvature()
               : the_family->continued_curvature(position, time);
  }

  ManufacturedSolution::Profile
  ManufacturedSolution::profile(const FrontDerivatives &f,
                                const ContinuedCurvature &k) const
  {
    Profile p;
    p.side = f.value < 0 ? -1 : 1;
    const double kappa = p.side * the_family->kappa();
    const double latent_heat = material.solid.density * material.latent_heat;
    p.denominator = f.square_of_gradient() + kappa * f.value;
    p.capillary = material.gibbs_thomson_coefficient
                  * (material.solid.conductivity - material.liquid.conductivity);
    p.latent_flux
        = p.denominator > vanishing
              ? (p.capillary * k.slope.value - latent_heat * f.rate) / p.denominator
              : 0;
    const double root = std::hypot(p.latent_flux, rounding);
    p.flux = base_flux + (root - p.side * p.latent_flux) / 2;
    p.slope = (p.latent_flux / root - p.side) / 2;
    p.bend = rounding * rounding / (2 * root * root * root);
    const Vector turning = product(f.hessian, f.gradient);
    for(int d = 0; d < 3; ++d)
    {
      p.D_gradient[d] = 2 * turning[d] + kappa * f.gradient[d];
      p.J_gradient[d]
          = p.denominator > vanishing
                ? (p.capillary * k.slope.gradient[d]
                   - (latent_heat * f.gradient_rate[d] + p.latent_flux * p.D_gradient[d]))
                      / p.denominator
                : 0;
    }
    return p;
  }

  double ManufacturedSolution::temperature(const Position &position, double time) const
  {
    const FrontDerivatives f = the_family->derivatives(position, time);
    const ContinuedCurvature k = curvature_field(position, time);
    const double theta = -material.gibbs_thomson_coefficient * k.curvature.value;
    return material.melting_temperature + theta
           + profile(f, k).flux * f.value / phase(f).conductivity;
  }

  double ManufacturedSolution::volumetric_source(const Position &position,
                                                 double time) const
  {
    const FrontDerivatives f = the_family->derivatives(position, time);
    const ContinuedCurvature k = curvature_field(position, time);
    const Profile p = profile(f, k);
    if(p.denominator <= vanishing)
      return 0;
    const double kappa = p.side * the_family->kappa();
    const double latent_heat = material.solid.density * material.latent_heat;
    const double D_laplacian
        = 2 * (square_norm(f.hessian) + product(f.gradient, f.laplacian_gradient))
          + kappa * f.laplacian;
    const double D_rate = 2 * product(f.gradient, f.gradient_rate) + kappa * f.rate;
    const double J_laplacian
        = (p.capillary * k.slope.laplacian
           - (latent_heat * f.laplacian_rate + 2 * product(p.J_gradient, p.D_gradient)
              + p.latent_flux * D_laplacian))
          / p.denominator;
    const double J_rate = (p.capillary * k.slope.rate
                           - (latent_heat * f.acceleration + p.latent_flux * D_rate))
                          / p.denominator;

    const double heating = p.slope * J_rate * f.value + p.flux * f.rate;
    const double conduction
        = p.flux * f.laplacian + 2 * p.slope * product(p.J_gradient, f.gradient)
          + f.value
                * (p.slope * J_laplacian + p.bend * product(p.J_gradient, p.J_gradient));
    const double theta_rate = -material.gibbs_thomson_coefficient * k.curvature.rate,
                 theta_laplacian
                 = -material.gibbs_thomson_coefficient * k.curvature.laplacian;
    return phase(f).volumetric_heat_capacity()
               * (theta_rate + heating / phase(f).conductivity)
           - (conduction + phase(f).conductivity * theta_laplacian);
  }

  ManufacturedSolution::Vector ManufacturedSolution::heat_flux(const Position &position,
                                                               double time) const
  {
    const FrontDerivatives f = the_family->derivatives(position, time);
    const ContinuedCurvature k = curvature_field(position, time);
    const Profile p = profile(f, k);
    const double along_curvature
        = -phase(f).conductivity * material.gibbs_thomson_coefficient;
    Vector flux;
    for(int d = 0; d < 3; ++d)
      flux[d] = p.flux * f.gradient[d] + f.value * p.slope * p.J_gradient[d]
                + along_curvature * k.curvature.gradient[d];
    return flux;
  }

  double ManufacturedSolution::level_set(const Position &position, double time) const
  {
    return the_family->level_set(position, time);
  }

  double ManufacturedSolution::signed_distance(const Position &position,
                                               double time) const
  {
    return the_family->signed_distance(position, time);
  }

  double ManufacturedSolution::curvature(const Position &position, double time) const
  {
    return the_family->second_derivatives(position, time).curvature();
  }

  double ManufacturedSolution::solid_volume(double time) const
  {
    return the_family->solid_volume(time);
  }

  double ManufacturedSolution::solid_fraction(const Position &position, double time) const
  {
    return level_set(position, time) < 0;
  }

  double ManufacturedSolution::front_area(double time) const
  {
    return manufactured::front_area(*the_family, time);
  }

  double ManufacturedSolution::temperature(double coordinate, double time) const
  {
    return depends_on_one_coordinate() ? temperature(Position{coordinate, 0, 0}, time)
                                       : not_a_number;
  }

  double ManufacturedSolution::front(double time) const
  {
    return depends_on_one_coordinate() ? -signed_distance({}, time) : not_a_number;
  }

  double ManufacturedSolution::heat_content(double lower, double upper, double time) const
  {
    if(!depends_on_one_coordinate())
      return not_a_number;
    const double split = std::clamp(front(time), lower, upper);
    // Of a panel, its share of the length over which the temperature is smooth.
    const double panel = the_family->parameters().length_scale / 8;
    const auto sensible = [&](double from, double to)
    {
      return integrate_panels(
          the_symmetry, from, to,
          [&](double r) { return temperature(r, time) - material.melting_temperature; },
          [panel](double) { return panel; });
    };
    return material.solid.volumetric_heat_capacity() * sensible(lower, split)
           + material.liquid.volumetric_heat_capacity() * sensible(split, upper)
           + material.solid.density * material.latent_heat
                 * volume_between(the_symmetry, split, upper);
  }

  double ManufacturedSolution::solid_fraction(double coordinate, double time) const
  {
    return depends_on_one_coordinate() ? solid_fraction(Position{coordinate, 0, 0}, time)
                                       : not_a_number;
  }
} // namespace meltfront::cases
