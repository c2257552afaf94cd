#include <cases/exact/mapped_phase.h>

namespace meltfront::cases::spectral
{
  int MappedPhase::unknowns() const
  {
    return solved ? basis.intervals - (axis ? 0 : 1) : 0;
  }

  int MappedPhase::first_unknown() const
  {
    return axis ? 0 : 1;
  }

  MappedPhase::Nodal
  MappedPhase::complete(double time, double length,
                        const Eigen::Ref<const Eigen::VectorXd> &unknown_values) const
  {
    Nodal nodal;
    nodal.from_front = Eigen::VectorXd::Zero(basis.intervals + 1);
    nodal.from_front.segment(first_unknown(), unknown_values.size()) = unknown_values;
    const int wall_node = wall_is_first ? 0 : basis.intervals;
    if(solved && !axis && wall.kind != BoundaryKind::fixed_temperature)
      complete_flux_wall(time, length, nodal);
    else
    {
      if(solved && !axis)
        nodal.from_front[wall_node] = wall.value(time) - melting_temperature;
      nodal.from_wall = nodal.from_front.array() - nodal.from_front[wall_node];
    }
    return nodal;
  }

  void MappedPhase::complete_flux_wall(double time, double length, Nodal &nodal) const
  {
    const int wall_node = wall_is_first ? 0 : basis.intervals;
    const int neighbour = wall_is_first ? 1 : basis.intervals - 1;
    // Flux into the domain: k times the outward derivative.
    const double flux = wall.kind == BoundaryKind::flux ? wall.value(time) : 0;
    const double slope = (wall_is_first ? -1 : 1) * flux * length / material.conductivity;

    // The row sums to zero: sum over j of D_j (u_j - u_neighbour) = slope.
    Eigen::VectorXd &differences = nodal.from_wall;
    differences = nodal.from_front.array() - nodal.from_front[neighbour];
    differences[wall_node] = 0;
    const double at_wall = (slope - basis.first.row(wall_node).dot(differences))
                           / basis.first(wall_node, wall_node);
    nodal.from_front[wall_node] = nodal.from_front[neighbour] + at_wall;
    differences.array() -= at_wall;
    differences[wall_node] = 0;
  }

  MappedPhase::Derivatives MappedPhase::derivatives(const Nodal &nodal) const
  {
    const Eigen::Index nodes = basis.intervals + 1, half = nodes / 2;
    const Eigen::VectorXd &low = wall_is_first ? nodal.from_wall : nodal.from_front;
    const Eigen::VectorXd &high = wall_is_first ? nodal.from_front : nodal.from_wall;
    Derivatives result{Eigen::VectorXd(nodes), Eigen::VectorXd(nodes)};
    result.first.head(half) = basis.first.topRows(half) * low;
    result.first.tail(nodes - half) = basis.first.bottomRows(nodes - half) * high;
    result.second.head(half) = basis.second.topRows(half) * low;
    result.second.tail(nodes - half) = basis.second.bottomRows(nodes - half) * high;
    return result;
  }
} // namespace meltfront::cases::spectral
