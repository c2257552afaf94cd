#include <particles/rkpm_tracked/plane/heat_correction.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    constexpr double share_of_way = 0.5;
  }

  bool wall_heat_is_given(const cases::Scene &scene)
  {
    return std::ranges::all_of(scene.sides(),
                               [&](cases::Side side)
                               {
                                 const auto kind = scene.boundary(side).kind;
                                 return kind == cases::BoundaryKind::insulated
                                        || kind == cases::BoundaryKind::flux;
                               });
  }

  double close_budget(const cases::Scene &scene, const PlaneSinks &sinks,
                      const PlaneFront &before, PlaneState &state, double missing,
                      double farthest)
  {
    const cases::Material &material = scene.material;
    PlaneFront &front = state.front;
    std::vector<double> flow(front.size(), 0.), length(front.size(), 0.);
    double sum = 0;
    for(std::size_t c = 0; c < front.curves(); ++c)
      for(std::size_t p = front.offsets[c]; p < front.offsets[c + 1]; ++p)
      {
        if(!front.active[p])
          continue;
        const PlanePoint &place = front.position[p], &normal = front.normal[p];
        const PlanePoint solid
            = state.expansion[1].gradient[p] + sinks.gradient(place, state.time);
        flow[p] = material.solid.conductivity * std::abs(solid.dot(normal))
                  + material.liquid.conductivity
                        * std::abs(state.expansion[0].gradient[p].dot(normal));
        length[p] = ((front.position[front.next(c, p)] - place).norm()
                     + (front.position[front.previous(c, p)] - place).norm())
                    / 2;
        sum += flow[p] * length[p];
      }
    if(!(sum > 0))
      return 0;
    const double latent = material.solid.density * material.latent_heat;
    double made_up = 0;
    for(std::size_t p = 0; p < front.size(); ++p)
    {
      const double limit = std::min(
          farthest, share_of_way * (front.position[p] - before.position[p]).norm());
      const double way = std::clamp(missing * flow[p] / (latent * sum), -limit, limit);
      front.position[p] += way * front.normal[p];
      made_up += latent * way * length[p];
    }
    update_geometry(front);
    return made_up;
  }

  double warm_nodes(const cases::Scene &scene, const PlaneNodes &nodes, PlaneState &state,
                    double missing)
  {
    double capacity = 0;
    for(std::size_t i = 0; i < nodes.size(); ++i)
      capacity += nodes.weight[i]
                  * (state.phase[i] == NodePhase::solid ? scene.material.solid
                                                        : scene.material.liquid)
                        .volumetric_heat_capacity();
    for(double &unknown : state.unknown)
      unknown += missing / capacity;
    return missing;
  }
} // namespace meltfront::particles::rkpm_tracked
