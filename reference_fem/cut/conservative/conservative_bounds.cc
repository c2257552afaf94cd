#include <reference_fem/cut/conservative/conservative_run.h>

#include <cases/error.h>
#include <cases/overshoot.h>
#include <reference_fem/cut/run.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace meltfront::reference_fem::cut::conservative
{
  /** @throws cases::Refusal if what the cells do not resolve explains @p error */
  void ConservativeRun::refuse_if_unresolved(const cases::NumericalError &error) const
  {
    for(const std::string &reason :
        {why_last_body_is_lost(), why_layer_is_lost(), why_jump_overshoots()})
      if(!reason.empty())
        throw cases::Refusal(fmt::format("{}; {}", error.what(), reason));
  }

  /** Whether some body is too small for the cells, in words; else empty. */
  std::string ConservativeRun::why_last_body_is_lost() const
  {
    constexpr double least_depth = 2.5; ///< spacings
    const Front front(mesh, state.level_set);
    for(const Body &body : bodies(mesh, front, state.level_set))
    {
      double depth = 0;
      for(const unsigned int node : body.nodes)
        depth = std::max(depth, std::abs(state.level_set[node]));
      if(depth < least_depth * mesh.spacing)
        return fmt::format("a body of {} is {:.2g} cells deep, and what is left of a "
                           "phase is not resolved below {:.2g}",
                           body.phase == Phase::solid ? "solid" : "liquid",
                           depth / mesh.spacing, least_depth);
    }
    return {};
  }

  /** Heat diffuses ahead of a front that moves with V over diffusivity / V; whether that
   * is less than a cell, in words, else empty. Before the first step V is the mean since
   * the start. */
  std::string ConservativeRun::why_layer_is_lost() const
  {
    double speed = front_speed;
    if(speed == 0 && before && time > scene.start_time)
      speed = before->most_depth * mesh.spacing / (time - scene.start_time);
    const double solid = scene.material.solid.diffusivity(),
                 liquid = scene.material.liquid.diffusivity();
    const double layer = std::min(solid, liquid) / speed;
    if(!(layer < mesh.spacing))
      return {};
    return fmt::format("the front moves at {:.2g} m/s, and beside it temperatures of the "
                       "{} change within {:.2g} m, less than a cell of {:.2g} m: take "
                       "more cells",
                       speed, solid < liquid ? "solid" : "liquid", layer, mesh.spacing);
  }

  /** Lowest and highest temperature at nodes of the phases (K). */
  std::pair<double, double> ConservativeRun::extremes() const
  {
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for(unsigned int t = 0; t < mesh.triangles.size(); ++t)
      if(mesh.triangles[t].whole && !mesh.triangles[t].part.empty())
        for(const unsigned int node : mesh.triangles[t].nodes)
        {
          const Phase phase = state.level_set[node] < 0 ? Phase::solid : Phase::liquid;
          const double value
              = scene.material.melting_temperature
                + assembly.temperature(phase, t, mesh.nodes[node], temperatures, powers);
          // A comparison passes over what is not a number.
          if(!std::isfinite(value))
            lowest = highest = value;
          lowest = std::min(lowest, value);
          highest = std::max(highest, value);
        }
    return {lowest, highest};
  }

  /** As long as the layer of a jump at a wall is thinner than a cell: this, in words. */
  std::string ConservativeRun::why_jump_overshoots() const
  {
    if(!(time <= layer_resolved))
      return {};
    return fmt::format("what a wall gives jumped, and until t = {:.6g} its layer is "
                       "thinner than a cell, in which temperatures overshoot: let it "
                       "change in some time, or take other cells",
                       layer_resolved);
  }

  void ConservativeRun::check()
  {
    auto [lowest, highest] = extremes();
    // The judge of snapshots sees the rim, too, and does not know of the jump.
    if(time <= layer_resolved)
    {
      collect_sites();
      for(const double value : sites.temperatures)
      {
        lowest = std::min(lowest, value);
        highest = std::max(highest, value);
      }
    }
    cases::require_sinks(scene, time, method_name);
    try
    {
      cases::check_temperature(
          bounds, lowest, highest, method_name, step_number, time,
          cases::allowed_overshoot(cut::overshoot, mesh.spacing, scene.domain));
    }
    catch(const cases::NumericalError &error)
    {
      if(std::isfinite(lowest))
        refuse_if_unresolved(error);
      throw;
    }
    for(const Point &place : sources.places)
    {
      const Triangle &triangle = mesh.triangles[mesh.triangle_at(place)];
      if(!(triangle.value(state.level_set, place) <= -mesh.spacing))
        throw cases::Refusal(fmt::format(
            "fem-cut: the source at ({:.6g}, {:.6g}) does not lie in the solid, at least "
            "a cell from the front, at time {:.6g}",
            place[0], place[1], time));
    }
  }
} // namespace meltfront::reference_fem::cut::conservative
