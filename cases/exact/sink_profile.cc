#include <cases/error.h>
#include <cases/exact/check_material.h>
#include <cases/exact/sink_profile.h>

#include <fmt/format.h>

#include <cmath>

namespace meltfront::cases
{
  similarity::RadialProfile<double> sink_profile(int dimension, const Material &material,
                                                 double lambda, double far_temperature,
                                                 const std::string &solution)
  {
    check_material(material, solution);
    require_equal_densities(material, solution);
    if(!(lambda > 0) || !std::isfinite(lambda))
      throw InputError(
          fmt::format("{}: lambda must be positive, not {}", solution, lambda));
    if(!(far_temperature >= material.melting_temperature)
       || !std::isfinite(far_temperature))
      throw InputError(fmt::format(
          "{}: the far temperature ({}) must not lie below the melting temperature ({})",
          solution, far_temperature, material.melting_temperature));
    return similarity::RadialProfile<double>::sink(dimension, material, lambda,
                                                   far_temperature);
  }
} // namespace meltfront::cases
