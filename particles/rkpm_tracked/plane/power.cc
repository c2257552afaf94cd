#include <cases/wall_law.h>
#include <particles/rkpm_tracked/plane/heat.h>

namespace meltfront::particles::rkpm_tracked
{
  /** Where the temperature is held the power is what the balance of the wall node's area
   * asks for: with the conduction away from the wall, what heats that area. A node on the
   * front has no balance: what fluxes and ambients give it melts the front there. */
  double PlaneHeat::wall_power(const PlaneStep &step, const PlaneState &state,
                               std::span<const double> solution) const
  {
    double power = 0;
    for(const WallNode &wall : nodes.walls)
    {
      const NodePhase phase = state.phase[wall.node];
      const bool at_front = phase == NodePhase::front;
      if(at_front && wall.dirichlet())
        continue;
      const PlanePoint &place = nodes.position[wall.node];
      if(!wall.dirichlet())
      {
        const double own = at_front ? front_temperature_near(wall.node)
                                    : temperature(state, wall.node);
        for(int i = 0; i < wall.n_pieces; ++i)
        {
          const WallPiece &piece = wall.pieces[i];
          const bool transfers = cases::exchanges_heat(piece.boundary->kind);
          if(piece.boundary->kind == cases::BoundaryKind::insulated
             || (!transfers && !given.mean_of(*piece.boundary).steady()))
            continue;
          const double value = given.wall(*piece.boundary, position_of(place), step.span);
          // What the node's row has of the law, so that the book has the same heat.
          const bool radiates = piece.boundary->kind == cases::BoundaryKind::radiation;
          const double guess
              = !radiates || at_front ? own : wall_guesses[nodes.wall_of_node[wall.node]];
          const cases::HeatTransfer near
              = transfers ? cases::heat_transfer_near(*piece.boundary, value, guess)
                          : cases::HeatTransfer();
          power += piece.length
                   * (transfers ? near.coefficient * (near.ambient - own) : value);
        }
        continue;
      }
      const cases::PhaseProperties &material = properties(phase);
      const Row &row = rows[wall.node];
      double sum = 0;
      for(std::size_t e = 0; e < row.columns.size(); ++e)
        sum += row.weights[e]
               * (row.columns[e] < nodes.size()
                      ? solution[row.columns[e]]
                      : front_value(phase, row.columns[e] - nodes.size(), solution));
      if(phase == NodePhase::solid && !sinks.empty())
        for(int i = 0; i < wall.n_pieces; ++i)
          sum += wall.pieces[i].length
                 * sinks.gradient(place, step.time).dot(wall.pieces[i].normal);
      power += material.conductivity * sum
               + wall_areas[nodes.wall_of_node[wall.node]]
                     * (material.volumetric_heat_capacity() / step.step * step.a
                            * solution[wall.node]
                        - known_rate(step, phase, wall.node));
    }
    return power;
  }

  double PlaneHeat::flux_heat(const PlaneStep &step) const
  {
    double heat = 0;
    for(const WallNode &wall : nodes.walls)
    {
      if(wall.dirichlet())
        continue;
      const PlanePoint &place = nodes.position[wall.node];
      for(int i = 0; i < wall.n_pieces; ++i)
      {
        const WallPiece &piece = wall.pieces[i];
        if(piece.boundary->kind != cases::BoundaryKind::flux)
          continue;
        const cases::TimeMean &mean = given.mean_of(*piece.boundary);
        if(!mean.steady())
          heat += piece.length * step.step
                  * mean(position_of(place), step.span.begin, step.time);
      }
    }
    return heat;
  }

  double PlaneHeat::released_heat(const PlaneStep &step) const
  {
    if(!scene.volumetric_source)
      return 0;
    LinearStep span = step.span;
    span.share_before = 0;
    double heat = 0;
    for(std::size_t i = 0; i < nodes.size(); ++i)
      heat += nodes.weight[i] * step.step
              * given.release(position_of(nodes.position[i]), span);
    return heat;
  }
} // namespace meltfront::particles::rkpm_tracked
