#include <cases/dense_sampling.h>
#include <cases/error.h>
#include <cases/scene.h>
#include <cases/undisturbed.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::cases
{
  namespace
  {
    /** Held walls may differ from the far temperature by this part of what matters,
     * integrals of a power from those of a steady one by this part. */
    constexpr double same_temperature = 1e-4, same_energy = 1e-6;

    /** What gives heat beside constant sinks, empty if nothing does. */
    std::string disturbance(const Scene &scene, double far, double until)
    {
      for(const PointSource &source : scene.sources)
      {
        const double steady = source.power(scene.start_time) * (until - scene.start_time);
        const double energy = source.energy(until) - source.energy(scene.start_time);
        if(!(std::abs(energy - steady) <= same_energy * std::abs(steady)))
          return "the power of a source changes";
      }
      if(scene.volumetric_source)
        return "heat is released in the domain";
      const Material &material = scene.material;
      const double scale
          = std::max(std::abs(far - material.melting_temperature),
                     material.latent_heat / material.liquid.specific_heat_capacity);
      for(const Side side : scene.sides())
      {
        const Boundary &wall = scene.boundary(side);
        if(wall.exact || wall.kind == BoundaryKind::insulated
           || wall.kind == BoundaryKind::periodic)
          continue;
        const double rest = wall.kind == BoundaryKind::flux ? 0 : far;
        const double allowed
            = wall.kind == BoundaryKind::flux ? 0 : same_temperature * scale;
        bool disturbs = false;
        visit_wall_values(scene, side, wall.value,
                          [&](double value) {
                            disturbs = disturbs || !(std::abs(value - rest) <= allowed);
                          });
        if(disturbs)
          return fmt::format("the wall {} gives or takes heat",
                             name_of(scene.domain, side));
      }
      return {};
    }
  } // namespace

  void require_undisturbed(const Scene &scene, double far, double until,
                           const std::string &method)
  {
    Scene until_then = scene;
    until_then.end_time = until;
    const std::string reason = disturbance(until_then, far, until);
    if(!reason.empty())
      throw Refusal(fmt::format(
          "{} seeds the front around a sink as it is at t = {:.6g} in liquid that "
          "nothing else changes, and {} before; take more nodes or give the initial "
          "front",
          method, until, reason));
  }
} // namespace meltfront::cases
