#include <cases/wall_law.h>
#include <particles/rkpm_tracked/plane/heat.h>

#include <array>
#include <cmath>
#include <limits>

namespace meltfront::particles::rkpm_tracked
{
  /** Where the temperature is held the power is what fits tell, by the balance of the
   * wall node's area: with the conduction away from the wall, what heats that area. A
   * node on the front has no balance: what fluxes and ambients give it melts the front
   * there. */
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
          // What the node's row has of the law, so that the book has the same heat.
          const bool radiates = piece.boundary->kind == cases::BoundaryKind::radiation;
          const double guess
              = !radiates || at_front ? own : wall_guesses[nodes.wall_of_node[wall.node]];
          if(cases::exchanges_heat(piece.boundary->kind)
             || (piece.boundary->kind == cases::BoundaryKind::flux
                 && given.mean_of(*piece.boundary).steady()))
            power += power_through(step, piece, place, own, guess);
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

  /** Heat that has come in up to the end of a step. A power that the rows have comes in
   * by the formula of their derivative in time, so that what they conserve adds up. */
  void PlaneHeat::add_heat(const PlaneStep &step, double power, PlaneState &next)
  {
    const auto advanced = [&](double PlaneState::*heat)
    {
      const double before = step.older ? step.c * step.older->*heat : 0;
      return (step.b * step.last.*heat - before + step.step * power) / step.a;
    };
    next.wall_heat = advanced(&PlaneState::wall_heat);
    next.flux_heat = step.last.flux_heat + flux_heat(step);
    next.released_heat = step.last.released_heat + released_heat(step);
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

  /** What is released in a step: in cells that the front cuts, where it may jump, by
   * their samples, in others inside by four points of Gauss. */
  double PlaneHeat::released_heat(const PlaneStep &step)
  {
    if(!scene.volumetric_source)
      return 0;
    if(step.span.begin == release_begin && step.time == release_end)
      return released;
    LinearStep span = step.span;
    span.share_before = 0;
    release_begin = span.begin;
    release_end = step.time;
    released = 0;
    std::array<PlanePoint, 4> gauss;
    for(std::size_t i = 0; i < nodes.size(); ++i)
    {
      const PlanePoint &centre = nodes.centroid[i];
      const double reach = nodes.spacing;
      std::span<const PlanePoint> points(&centre, 1);
      if(std::abs(index->signed_distance(nodes.position[i], reach)) < reach)
        points = nodes.samples_of(i);
      else if(nodes.wall_of_node[i] < 0)
      {
        const double offset = std::sqrt(nodes.weight[i] / 12);
        for(std::size_t g = 0; g < gauss.size(); ++g)
          gauss[g] = centre + offset * PlanePoint(g % 2 ? 1 : -1, g / 2 ? 1 : -1);
        points = gauss;
      }
      for(const PlanePoint &point : points)
        released += nodes.weight[i] * step.step * given.release(position_of(point), span)
                    / static_cast<double>(points.size());
    }
    return released;
  }

  /** What a piece of a wall brings to a node at a temperature, by the law linearised
   * about a guess (W/m). */
  double PlaneHeat::power_through(const PlaneStep &step, const WallPiece &piece,
                                  const PlanePoint &place, double own, double guess) const
  {
    if(piece.boundary->kind == cases::BoundaryKind::insulated)
      return 0;
    const double value = given.wall(*piece.boundary, position_of(place), step.span);
    if(!cases::exchanges_heat(piece.boundary->kind))
      return piece.length * value;
    const cases::HeatTransfer near
        = cases::heat_transfer_near(*piece.boundary, value, guess);
    return piece.length * near.coefficient * (near.ambient - own);
  }

  /** A wall's node on the front has no balance: what comes in there goes to the nearest
   * particle. */
  void PlaneHeat::find_wall_inflow(const PlaneStep &step, const PlaneState &next)
  {
    wall_inflow.assign(next.front.size(), 0.);
    for(const WallNode &wall : nodes.walls)
    {
      if(next.phase[wall.node] != NodePhase::front || wall.dirichlet())
        continue;
      const PlanePoint &place = nodes.position[wall.node];
      const double own = front_temperature_near(wall.node);
      double least = std::numeric_limits<double>::infinity();
      std::size_t nearest = 0;
      front_bins.visit(place, 2 * nodes.spacing,
                       [&](std::uint32_t p, double square)
                       {
                         if(!next.front.active[p] || square >= least)
                           return;
                         least = square;
                         nearest = p;
                       });
      if(std::isfinite(least))
        for(int i = 0; i < wall.n_pieces; ++i)
          wall_inflow[nearest] += power_through(step, wall.pieces[i], place, own, own);
    }
  }

  /** Half the way to either neighbour along the curve (m). */
  double PlaneHeat::particle_length(const PlaneFront &front, std::size_t particle) const
  {
    const PlanePoint &place = front.position[particle];
    return ((front.position[after[particle]] - place).norm()
            + (place - front.position[before[particle]]).norm())
           / 2;
  }
} // namespace meltfront::particles::rkpm_tracked
