#include <particles/rkpm_tracked/plane/heat.h>

#include <algorithm>
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
   * What a unit of the multiplier adds to the heat that fits tell: at the front and in
   * the nodes beside it. Of all changes that close the balance these are the least, each
   * measured by what may be off there: the largest |change|/e is least
   * where all are alike, changes in proportion to e. They are scaled to sum up to what
   * flows to the front; where nothing flows all nodes are warmed alike.
   */
  void PlaneHeat::spread_multiplier(const PlaneStep &step, const PlaneState &next,
                                    PlaneSolution &solution)
  {
    spread.assign(nodes.size() + next.front.size(), 0.);
    const double flow = flow_to_front(step, next);
    double sum = 0;
    for(const double error : node_errors)
      sum += error;
    for(const double error : front_errors)
      sum += error;
    if(flow > 0 && sum > 0)
    {
      for(std::size_t i = 0; i < nodes.size(); ++i)
        if(node_errors[i] > 0 && next.phase[i] != NodePhase::front)
          spread[i] = flow / sum * node_errors[i] / nodes.weight[i];
      for(std::size_t p = 0; p < next.front.size(); ++p)
        if(next.front.active[p])
          spread[nodes.size() + p]
              = flow / sum * front_errors[p] / particle_length(next.front, p);
      solution.heat = flow * step.step / step.a;
      return;
    }
    double power = 0;
    for(std::size_t i = 0; i < nodes.size(); ++i)
    {
      const std::int32_t wall = nodes.wall_of_node[i];
      if(next.phase[i] == NodePhase::front)
        continue;
      const double capacity = properties(next.phase[i]).volumetric_heat_capacity();
      spread[i] = capacity * (wall >= 0 ? wall_areas[wall] : 1);
      power += capacity * nodes.weight[i];
    }
    solution.heat = power * step.step / step.a;
  }

  /** Sum of what flows to the front from either side (W/m). */
  double PlaneHeat::flow_to_front(const PlaneStep &step, const PlaneState &next)
  {
    double flow = 0;
    for(std::size_t p = 0; p < next.front.size(); ++p)
      if(next.front.active[p])
        for(const NodePhase phase : phases)
        {
          PlanePoint gradient = next.expansion[index_of(phase)].gradient[p];
          if(phase == NodePhase::solid)
            gradient += sinks.gradient(next.front.position[p], step.time);
          flow += properties(phase).conductivity
                  * std::abs(gradient.dot(next.front.normal[p]))
                  * particle_length(next.front, p);
        }
    return flow;
  }

  /** Value of a column in a phase at the last state. */
  double PlaneHeat::last_value(const PlaneStep &step, const PlaneState &next,
                               NodePhase phase, std::uint32_t column) const
  {
    if(column >= nodes.size())
      return front_values[index_of(phase)][column - nodes.size()].constant;
    if(next.phase[column] == NodePhase::front)
      return front_temperature_near(column);
    return step.last.extended(phase, column, nodes.position[column]);
  }

  /** Of a sum of weights times values of the last state. */
  double PlaneHeat::applied(const PlaneStep &step, const PlaneState &next,
                            NodePhase phase, std::span<const std::uint32_t> columns,
                            std::span<const double> weights) const
  {
    double sum = 0;
    for(std::size_t e = 0; e < columns.size(); ++e)
      sum += weights[e] * last_value(step, next, phase, columns[e]);
    return sum;
  }

  /**
   * Once in a step: what the heat through the front may be off by, as fits of two orders
   * to the last state differ; no less than of a profile that bends over the
   * domain's size D, (h/D)^2 of itself, and no more than itself.
   */
  void PlaneHeat::find_flux_errors(const PlaneStep &step, const PlaneState &next)
  {
    const double least = nodes.spacing * nodes.spacing / nodes.area;
    const auto error = [&](NodePhase phase, double size, double one, double other)
    {
      const double difference = std::min(std::abs(one - other), std::abs(one));
      return size * properties(phase).conductivity * (difference + least * std::abs(one));
    };
    PlaneStencil other;
    front_errors.assign(next.front.size(), 0.);
    for(std::size_t p = 0; p < next.front.size(); ++p)
      if(next.front.active[p])
        for(const NodePhase phase : phases)
        {
          other_maker.make(next.front.position[p], phase, other);
          const auto slope = [&](const PlaneStencil &stencil)
          {
            const PlanePoint gradient(
                applied(step, next, phase, stencil.columns, stencil.weights[d_x]),
                applied(step, next, phase, stencil.columns, stencil.weights[d_y]));
            return gradient.dot(next.front.normal[p]);
          };
          front_errors[p]
              += error(phase, particle_length(next.front, p),
                       slope(front_stencils[index_of(phase)][p]), slope(other));
        }
    node_errors.assign(nodes.size(), 0.);
    for(std::size_t i = 0; i < nodes.size(); ++i)
    {
      const NodePhase phase = next.phase[i];
      if(phase == NodePhase::front || nodes.wall_of_node[i] >= 0 || rows[i].reach > 0)
        continue;
      other_maker.make(nodes.position[i], phase, other);
      node_errors[i]
          = error(phase, nodes.weight[i],
                  applied(step, next, phase, rows[i].columns, rows[i].weights),
                  applied(step, next, phase, other.columns, collocated(other, i)));
    }
  }
} // namespace meltfront::particles::rkpm_tracked
