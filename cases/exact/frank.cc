#include <cases/error.h>
#include <cases/exact/check_material.h>
#include <cases/exact/frank.h>

#include <fmt/format.h>

#include <cmath>

namespace meltfront::cases
{
  namespace
  {
    similarity::RadialProfile<double>
    growth_profile(const Material &material, Symmetry symmetry, double far_temperature)
    {
      const std::string solution = "Frank's solution";
      check_material(material, solution);
      require_equal_densities(material, solution);
      if(symmetry == Symmetry::none)
        throw InputError(solution
                         + ": needs a planar, cylindrical or spherical symmetry");
      const double undercooling = material.liquid.specific_heat_capacity
                                  * (material.melting_temperature - far_temperature)
                                  / material.latent_heat;
      if(!(undercooling > 0 && undercooling < 1))
        throw InputError(fmt::format(
            "{}: the undercooling c (T_m - T_far)/L must lie between 0 and 1, not be {}",
            solution, undercooling));
      const int dimension = symmetry == Symmetry::planar        ? 1
                            : symmetry == Symmetry::cylindrical ? 2
                                                                : 3;
      return similarity::RadialProfile<double>::growth(dimension, material,
                                                       far_temperature);
    }
  } // namespace

  FrankGrowth::FrankGrowth(const Material &material, Symmetry symmetry,
                           double far_temperature)
    : RadialSimilarity(material, growth_profile(material, symmetry, far_temperature))
  {
  }

  double FrankGrowth::growth_constant() const
  {
    return 2 * std::sqrt(profile.front_in_liquid());
  }

  std::string FrankGrowth::description() const
  {
    return fmt::format(
        "growth into undercooled melt (Frank), {} dimension(s), far {:.12g}, "
        "S = {:.16g}",
        profile.dimension, profile.distant, growth_constant());
  }
} // namespace meltfront::cases
