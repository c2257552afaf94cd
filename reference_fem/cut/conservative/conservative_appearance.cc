#include <reference_fem/cut/conservative/conservative_run.h>

#include <cases/overshoot.h>
#include <reference_fem/cut/run.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meltfront::reference_fem::cut::conservative
{
  void ConservativeRun::let_phases_appear()
  {
    for(const Appearance &body :
        conservative::let_phases_appear(appearance, tolerated_heat(), state))
    {
      ++appeared_bodies;
      begin_anew();
      note(time, fmt::format("{:.3g} m^2 of {} appeared about ({:.4g}, {:.4g})",
                             body.area, body.phase == Phase::solid ? "solid" : "liquid",
                             body.place[0], body.place[1]));
    }
  }

  /** Half of the overshoot that is allowed (K); infinite as long as all is of one
   * temperature. */
  double ConservativeRun::tolerated_excess() const
  {
    double lowest = 0, highest = 0;
    for(const Values &values : temperatures)
      for(const double value : values)
      {
        lowest = std::min(lowest, value);
        highest = std::max(highest, value);
      }
    const double melting = scene.material.melting_temperature,
                 span = (std::isfinite(bounds.upper) ? bounds.upper - melting : highest)
                        - (std::isfinite(bounds.lower) ? bounds.lower - melting : lowest),
                 share
                 = cases::allowed_overshoot(cut::overshoot, mesh.spacing, scene.domain);
    return span > 0 ? share * span / 2 : std::numeric_limits<double>::infinity();
  }

  /** The same as heat over the melting temperature by phase (J/m^3). */
  std::array<double, 2> ConservativeRun::tolerated_heat() const
  {
    const double excess = tolerated_excess();
    return {excess * scene.material.solid.volumetric_heat_capacity(),
            excess * scene.material.liquid.volumetric_heat_capacity()};
  }

  /** What has appeared is at the melting temperature, and so is what the triangles about
   * it hold of the phase. */
  void ConservativeRun::melt_what_appeared(const Values &before)
  {
    const auto appeared
        = [&](unsigned int node) { return before[node] * state.level_set[node] < 0; };
    for(const Triangle &triangle : mesh.triangles)
      for(const unsigned int node : triangle.nodes)
        if(appeared(node))
          for(const unsigned int other : triangle.nodes)
          {
            const bool solid = state.level_set[node] < 0;
            if(appeared(other) || (state.level_set[other] < 0) != solid)
              temperatures[solid ? 0 : 1][other]
                  = solid && !powers.empty() ? -sources.value(mesh.nodes[other], powers)
                                             : 0;
          }
  }
} // namespace meltfront::reference_fem::cut::conservative
