#include <cases/exact/mapped_phase.h>
#include <cases/wall_law.h>

#include <algorithm>
#include <cmath>

namespace meltfront::cases::spectral
{
  namespace
  {
    bool holds_temperature(const PhaseEnd &end)
    {
      return end.kind == PhaseEnd::wall
             && end.law.kind == BoundaryKind::fixed_temperature;
    }

    bool passes_heat(const PhaseEnd &end)
    {
      return end.kind == PhaseEnd::wall
             && end.law.kind != BoundaryKind::fixed_temperature;
    }
  } // namespace

  PhaseEnd PhaseEnd::at_wall(const OracleWall &wall)
  {
    return {.kind = PhaseEnd::wall, .value = wall.value, .law = wall.law()};
  }

  int MappedPhase::unknowns() const
  {
    return solved ? basis.intervals + 1 - (low.kind != PhaseEnd::axis)
                        - (high.kind != PhaseEnd::axis)
                  : 0;
  }

  int MappedPhase::first_unknown() const
  {
    return low.kind == PhaseEnd::axis ? 0 : 1;
  }

  MappedPhase::Nodal
  MappedPhase::complete(double time, double length,
                        const Eigen::Ref<const Eigen::VectorXd> &unknown_values) const
  {
    Nodal nodal;
    nodal.excess = Eigen::VectorXd::Zero(basis.intervals + 1);
    if(!solved)
    {
      nodal.from_low = nodal.from_high = nodal.excess;
      return nodal;
    }
    nodal.excess.segment(first_unknown(), unknown_values.size()) = unknown_values;
    if(holds_temperature(low))
      nodal.excess[0] = low.value(time) - melting_temperature;
    if(holds_temperature(high))
      nodal.excess[basis.intervals] = high.value(time) - melting_temperature;
    // Of two such walls each sees the other's value by its last node only: the fourth
    // power of the number of nodes smaller.
    const bool both = passes_heat(low) && passes_heat(high);
    for(int sweep = 0; sweep < (both ? 4 : 1); ++sweep)
    {
      if(passes_heat(low))
        complete_wall(time, length, true, nodal);
      if(passes_heat(high))
        complete_wall(time, length, false, nodal);
    }
    if(!passes_heat(low))
      nodal.from_low = nodal.excess.array() - nodal.excess[0];
    if(!passes_heat(high))
      nodal.from_high = nodal.excess.array() - nodal.excess[basis.intervals];
    return nodal;
  }

  void MappedPhase::complete_wall(double time, double length, bool at_low,
                                  Nodal &nodal) const
  {
    const PhaseEnd &end = at_low ? low : high;
    const int wall_node = at_low ? 0 : basis.intervals;
    const int neighbour = at_low ? 1 : basis.intervals - 1;
    const double given = end.value ? end.value(time) : 0;

    // The row sums to zero: sum over j of D_j (u_j - u_neighbour) is the slope, whose k
    // times the outward derivative is the flux into the domain.
    Eigen::VectorXd &differences = at_low ? nodal.from_low : nodal.from_high;
    differences = nodal.excess.array() - nodal.excess[neighbour];
    differences[wall_node] = 0;
    const double others = basis.first.row(wall_node).dot(differences);
    const double own = basis.first(wall_node, wall_node);
    const auto slope = [&](double flux)
    { return (at_low ? -1 : 1) * flux * length / material.conductivity; };
    const auto through = [&](double at_wall)
    {
      return heat_through(end.law, given,
                          melting_temperature + nodal.excess[neighbour] + at_wall);
    };
    double at_wall = 0;
    HeatThroughWall heat = through(at_wall);
    if(!exchanges_heat(end.law.kind))
      at_wall = (slope(heat.flux) - others) / own;
    else
    {
      constexpr int most_iterations = 50;
      double last = std::numeric_limits<double>::infinity();
      for(int i = 0; i < most_iterations; ++i)
      {
        const double change
            = (slope(heat.flux) - others - own * at_wall) / (own - slope(heat.slope));
        at_wall += change;
        if(!(std::abs(change) < last))
          break; // round-off
        last = std::abs(change);
        heat = through(at_wall);
      }
    }
    nodal.excess[wall_node] = nodal.excess[neighbour] + at_wall;
    differences.array() -= at_wall;
    differences[wall_node] = 0;
  }

  MappedPhase::Derivatives MappedPhase::derivatives(const Nodal &nodal) const
  {
    const Eigen::Index nodes = basis.intervals + 1, half = nodes / 2;
    Derivatives result{Eigen::VectorXd(nodes), Eigen::VectorXd(nodes)};
    result.first.head(half) = basis.first.topRows(half) * nodal.from_low;
    result.first.tail(nodes - half)
        = basis.first.bottomRows(nodes - half) * nodal.from_high;
    result.second.head(half) = basis.second.topRows(half) * nodal.from_low;
    result.second.tail(nodes - half)
        = basis.second.bottomRows(nodes - half) * nodal.from_high;
    return result;
  }
} // namespace meltfront::cases::spectral
