#include <cases/exact/heat_quadrature.h>
#include <cases/exact/radial_similarity.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meltfront::cases
{
  RadialSimilarity::RadialSimilarity(const Material &material,
                                     similarity::RadialProfile<double> profile)
    : material(material)
    , profile(profile)
  {
  }

  double RadialSimilarity::lambda() const
  {
    return profile.lambda;
  }

  Symmetry RadialSimilarity::symmetry() const
  {
    switch(profile.dimension)
    {
    case 1:
      return Symmetry::planar;
    case 2:
      return Symmetry::cylindrical;
    default:
      return Symmetry::spherical;
    }
  }

  double RadialSimilarity::front(double time) const
  {
    return profile.front(time);
  }

  double RadialSimilarity::temperature(double coordinate, double time) const
  {
    return profile.temperature(coordinate, time);
  }

  double RadialSimilarity::heat_content(double lower, double upper, double time) const
  {
    const double split = std::clamp(front(time), lower, upper);
    return solid_heat(lower, split, time) + liquid_heat(split, upper, time);
  }

  double RadialSimilarity::solid_heat(double lower, double upper, double time) const
  {
    if(upper <= lower || profile.amplitude == 0)
      return 0;
    const double capacity = material.solid.volumetric_heat_capacity();
    const double diffusivity = material.solid.diffusivity();
    if(profile.dimension == 2 && lower < upper / 2)
    {
      // With zeta = r^2/(4 a t), 2 pi r dr = 4 pi a t dzeta and the integral of
      // E1(zeta) is zeta E1(zeta) - e^-zeta.
      const double at_front = boost::math::expint(1u, profile.lambda * profile.lambda);
      const auto primitive = [&](double r)
      {
        const double zeta = r * r / (4 * diffusivity * time);
        return zeta > 0
                   ? zeta * (boost::math::expint(1u, zeta) - at_front) - std::expm1(-zeta)
                   : 0.;
      };
      return -capacity * profile.amplitude * 4 * std::numbers::pi * diffusivity * time
             * (primitive(upper) - primitive(lower));
    }
    const double length = 2 * std::sqrt(diffusivity * time);
    return capacity
           * integrate_panels(
               symmetry(), lower, upper,
               [&](double r) { return temperature(r, time) - profile.melting; },
               [&](double) { return length; });
  }

  double RadialSimilarity::liquid_heat(double lower, double upper, double time) const
  {
    const double capacity = material.liquid.volumetric_heat_capacity();
    double heat = (material.liquid.density * material.latent_heat
                   + capacity * (profile.distant - profile.melting))
                  * volume_between(symmetry(), lower, upper);
    if(time <= 0)
      return heat;
    // Beyond end the profile is the far temperature to less than e^-45.
    const double length = 2 * std::sqrt(material.liquid.diffusivity() * time);
    const double at_front = front(time) / length;
    const double end = std::min(upper, length * std::sqrt(at_front * at_front + 45));
    const double panel = length / std::max(1., at_front);
    heat += capacity
            * integrate_panels(
                symmetry(), lower, end,
                [&](double r) { return temperature(r, time) - profile.distant; },
                [&](double r) { return std::min(panel, r); });
    return heat;
  }
} // namespace meltfront::cases
