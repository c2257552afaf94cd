#include <cases/error.h>
#include <cases/exact/check_material.h>

#include <fmt/format.h>

#include <cmath>

namespace meltfront::cases
{
  void check_material(const Material &material, const std::string &solution)
  {
    const auto require_positive = [&](double value, const char *name)
    {
      if(!(value > 0) || !std::isfinite(value))
        throw InputError(
            fmt::format("{}: the {} must be positive, not {}", solution, name, value));
    };
    require_positive(material.solid.conductivity, "conductivity of the solid");
    require_positive(material.solid.specific_heat_capacity,
                     "specific heat capacity of the solid");
    require_positive(material.solid.density, "density of the solid");
    require_positive(material.liquid.conductivity, "conductivity of the liquid");
    require_positive(material.liquid.specific_heat_capacity,
                     "specific heat capacity of the liquid");
    require_positive(material.liquid.density, "density of the liquid");
    require_positive(material.latent_heat, "latent heat");
    if(material.curves)
      throw InputError(fmt::format("{}: holds for properties that do not depend on "
                                   "temperature, and for one melting temperature",
                                   solution));
    if(!std::isfinite(material.melting_temperature))
      throw InputError(
          fmt::format("{}: the melting temperature must be finite", solution));
  }

  void require_equal_densities(const Material &material, const std::string &solution)
  {
    if(material.solid.density != material.liquid.density)
      throw InputError(fmt::format(
          "{}: holds for equal densities only, not for {} (solid) and {} (liquid) kg/m^3",
          solution, material.solid.density, material.liquid.density));
  }
} // namespace meltfront::cases
