#include <particles/rkpm_tracked/plane/heat.h>

#include <cmath>

namespace meltfront::particles::rkpm_tracked
{
  std::vector<double> PlaneSolution::at(double multiplier) const
  {
    std::vector<double> result(constant);
    for(std::size_t i = 0; i < slope.size(); ++i)
      result[i] += multiplier * slope[i];
    return result;
  }

  /**
   * What a unit of the multiplier adds at the front: what flows to it from either side,
   * as fits of one order are all off by about the same share. Where nothing flows all
   * nodes are warmed alike.
   */
  void PlaneHeat::spread_multiplier(const PlaneStep &step, const PlaneState &next,
                                    PlaneSolution &solution)
  {
    spread.assign(nodes.size() + next.front.size(), 0.);
    double power = 0;
    for(std::size_t p = 0; p < next.front.size(); ++p)
      if(next.front.active[p])
      {
        const double flow = flow_to_front(step, next, p);
        spread[nodes.size() + p] = flow;
        power += flow * particle_length(next.front, p);
      }
    if(!(power > 0))
      for(std::size_t i = 0; i < nodes.size(); ++i)
        if(next.phase[i] != NodePhase::front)
        {
          const std::int32_t wall = nodes.wall_of_node[i];
          const double capacity = properties(next.phase[i]).volumetric_heat_capacity();
          spread[i] = capacity * (wall >= 0 ? wall_areas[wall] : 1);
          power += capacity * nodes.weight[i];
        }
    solution.heat = power * step.step / step.a;
  }

  /** What flows to a front particle from either side (W/m^2). */
  double PlaneHeat::flow_to_front(const PlaneStep &step, const PlaneState &next,
                                  std::size_t particle) const
  {
    double flow = 0;
    for(const NodePhase phase : phases)
    {
      PlanePoint gradient = next.expansion[index_of(phase)].gradient[particle];
      if(phase == NodePhase::solid)
        gradient += sinks.gradient(next.front.position[particle], step.time);
      flow += properties(phase).conductivity
              * std::abs(gradient.dot(next.front.normal[particle]));
    }
    return flow;
  }
} // namespace meltfront::particles::rkpm_tracked
