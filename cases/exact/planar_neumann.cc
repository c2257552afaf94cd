#include <cases/error.h>
#include <cases/exact/check_material.h>
#include <cases/exact/heat_quadrature.h>
#include <cases/exact/planar_neumann.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::cases
{
  namespace
  {
    const Material &checked(const Material &material, double wall, double far)
    {
      check_material(material, "planar Neumann solution");
      const double melting = material.melting_temperature;
      const bool freezes = wall < melting && far >= melting;
      const bool melts = wall > melting && far <= melting;
      if((!freezes && !melts) || !std::isfinite(wall) || !std::isfinite(far))
        throw InputError(fmt::format(
            "planar Neumann solution: the wall ({}) must be on one side of the melting "
            "temperature ({}) and the far field ({}) on the other or at it",
            wall, melting, far));
      return material;
    }
  } // namespace

  PlanarNeumann::PlanarNeumann(const Material &material, double wall_temperature,
                               double far_temperature)
    : material(checked(material, wall_temperature, far_temperature))
    , profile(material, wall_temperature, far_temperature)
  {
  }

  double PlanarNeumann::lambda() const
  {
    return profile.lambda;
  }

  std::string PlanarNeumann::description() const
  {
    return fmt::format("planar {}-phase Neumann solution, {}, wall {:.12g}, far {:.12g}, "
                       "lambda = {:.16g}",
                       profile.distant == profile.melting ? "one" : "two",
                       profile.solid_is_near ? "freezing" : "melting", profile.wall,
                       profile.distant, profile.lambda);
  }

  Symmetry PlanarNeumann::symmetry() const
  {
    return Symmetry::planar;
  }

  double PlanarNeumann::front(double time) const
  {
    return profile.front(time);
  }

  bool PlanarNeumann::solid_at_origin() const
  {
    return profile.solid_is_near;
  }

  double PlanarNeumann::temperature(double coordinate, double time) const
  {
    return profile.temperature(coordinate, time);
  }

  double PlanarNeumann::heat_content(double lower, double upper, double time) const
  {
    const PhaseProperties &near
        = profile.solid_is_near ? material.solid : material.liquid;
    const PhaseProperties &far = profile.solid_is_near ? material.liquid : material.solid;
    const double near_latent = profile.solid_is_near ? 0 : material.latent_heat;
    const double far_latent = profile.solid_is_near ? material.latent_heat : 0;
    const double split = std::clamp(front(time), lower, upper);

    const double far_excess = profile.distant - profile.melting;
    double heat = near.density * near_latent * (split - lower)
                  + far.density * (far_latent + far.specific_heat_capacity * far_excess)
                        * (upper - split);
    if(time <= 0)
      return heat;

    const double near_length = 2 * std::sqrt(near.diffusivity() * time);
    heat += near.volumetric_heat_capacity()
            * integrate_panels(
                Symmetry::planar, lower, split,
                [&](double x) { return temperature(x, time) - profile.melting; },
                [&](double) { return near_length; });

    // Beyond end the profile is the far temperature to less than e^-45.
    const double far_length = 2 * std::sqrt(far.diffusivity() * time);
    const double at_front
        = profile.density_ratio * profile.lambda * profile.diffusivity_root;
    const double reach = 45 / (at_front + std::sqrt(at_front * at_front + 45));
    const double end = std::min(upper, front(time) + far_length * reach);
    const double panel = far_length / std::max(1., at_front);
    heat += far.volumetric_heat_capacity()
            * integrate_panels(
                Symmetry::planar, split, end,
                [&](double x) { return temperature(x, time) - profile.distant; },
                [&](double) { return panel; });
    return heat;
  }
} // namespace meltfront::cases
