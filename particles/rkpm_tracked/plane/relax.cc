#include <particles/rkpm_tracked/plane/relax.h>
#include <particles/rkpm_tracked/plane/run.h>

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    // All lengths are in spacings.
    /** Nodes that would move by less stay. */
    constexpr double least_node_move = 1e-3;
    /** A node that would move farther stays. */
    constexpr double farthest_move = 0.9;
    /** From the front, beyond which nodes are at rest. */
    constexpr double moving_layer = 4;
    /** Where nodes that are nearer to the front set out from. */
    constexpr double first_distance = 0.3;
    /** From walls, where nodes were not laid nearer. */
    constexpr double wall_clearance = 0.5;
    /** No node comes nearer to another one. */
    constexpr double least_node_distance = 0.3;

    constexpr double on_a_particle = 1e-9;

    /** A phase's unknown at its nodes, then at the front's particles, and its range: a
     * polynomial through the few points of a thin body may overshoot. */
    struct PhaseValues
    {
      std::vector<double> values;
      double lowest, highest;
    };

    PhaseValues phase_values(const PlaneState &state, const PlaneHeat &heat,
                             NodePhase phase)
    {
      PhaseValues result{state.unknown, std::numeric_limits<double>::infinity(),
                         -std::numeric_limits<double>::infinity()};
      const auto include = [&](double value)
      {
        result.lowest = std::min(result.lowest, value);
        result.highest = std::max(result.highest, value);
      };
      for(std::size_t i = 0; i < state.phase.size(); ++i)
        if(state.phase[i] == phase)
          include(state.unknown[i]);
      for(std::size_t p = 0; p < state.front.size(); ++p)
      {
        double value = heat.front_temperature(state.front.curvature[p]);
        if(phase == NodePhase::solid)
          value -= heat.sinks.value(state.front.position[p], state.time);
        include(value);
        result.values.push_back(value);
      }
      return result;
    }
  } // namespace

  /** The nodes of a phase that move, and what they move among. */
  struct PlaneRelaxation::Phase
  {
    Phase()
    {
      moving.dimension = homes.dimension = fixed.dimension = 2;
    }

    std::vector<std::uint32_t> node;
    ParticleStorage moving, homes, fixed;
  };

  PlaneRelaxation::PlaneRelaxation(const PlaneNodes &nodes, RelaxRule rule, int threads)
    : nodes(nodes)
    , rule(rule)
    , threads(threads)
    , homes(nodes.position)
  {
  }

  bool PlaneRelaxation::let_go(const PlaneState &state, const FrontIndex &index,
                               double time, std::size_t node, PlanePoint &place) const
  {
    const double h = nodes.spacing;
    const PlanePoint &here = nodes.position[node];
    const PlaneFront &front = state.front;
    double least = moving_layer * moving_layer * h * h;
    std::size_t nearest = front.size();
    front_bins.visit(here, moving_layer * h,
                     [&](std::uint32_t p, double square)
                     {
                       if(front.active[p] && square < least)
                       {
                         least = square;
                         nearest = p;
                       }
                     });
    if(nearest == front.size())
      return false;
    // The solid is where the distance is negative, and melting makes it grow.
    const double way = std::clamp(front.speed[nearest] * time, -h, h);
    const double distance = index.signed_distance(here, moving_layer * h);
    const double at_home = index.signed_distance(homes[node], moving_layer * h);
    if(!(way * distance < 0) || !((at_home + way) * distance < 0))
      return false;
    if(std::abs(distance) > std::abs(way) / 2)
    {
      const PlanePoint moved = here + (distance + way / 2) * front.normal[nearest];
      if(index.solid(moved) == (distance < 0))
        place = moved;
    }
    return true;
  }

  void PlaneRelaxation::gather(const PlaneState &state, const FrontIndex &index,
                               double time, bool solid, Phase &phase,
                               std::vector<PlanePoint> &places) const
  {
    const double h = nodes.spacing;
    const bool springs = rule == RelaxRule::springs;
    const auto add = [](ParticleStorage &storage, const PlanePoint &place) {
      storage.add({place.x(), place.y(), 0});
    };
    for(std::size_t i = 0; i < nodes.size(); ++i)
    {
      const PlanePoint &place = nodes.position[i];
      const double distance = index.signed_distance(place, moving_layer * h);
      if((distance < 0) != solid)
        continue;
      const bool near = std::abs(distance) < moving_layer * h;
      const bool moves = nodes.wall_of_node[i] < 0 && (near || !settled || !springs);
      if(!moves)
      {
        add(phase.fixed, place);
        continue;
      }
      if(std::abs(distance) < on_a_particle * h
         || (springs && near && let_go(state, index, time, i, places[i])))
        continue;
      PlanePoint start = place;
      if(std::abs(distance) < first_distance * h)
      {
        const long p = front_bins.nearest(place);
        start += (distance - (solid ? -1 : 1) * first_distance * h)
                 * state.front.normal[static_cast<std::size_t>(p)];
      }
      phase.node.push_back(static_cast<std::uint32_t>(i));
      add(phase.moving, start);
      add(phase.homes, homes[i]);
    }
    for(std::size_t p = 0; p < state.front.size(); ++p)
      add(phase.fixed, state.front.position[p]);
  }

  /** Nodes go back to where they were if they would leave their phase, come too near to a
   * wall or to each other, or go too far. */
  void PlaneRelaxation::keep_apart(const FrontIndex &index,
                                   std::vector<PlanePoint> &places) const
  {
    const double h = nodes.spacing;
    for(std::size_t i = 0; i < nodes.size(); ++i)
    {
      const PlanePoint &from = nodes.position[i];
      const double way = (places[i] - from).norm();
      if(way == 0)
        continue;
      const double wall = std::min(wall_clearance * h, nodes.wall_distance(from));
      const bool allowed = way > least_node_move * h && way < farthest_move * h
                           && nodes.wall_distance(places[i]) >= wall
                           && index.solid(places[i]) == index.solid(from);
      if(!allowed)
        places[i] = from;
    }
    bool again = true;
    while(again)
    {
      again = false;
      const PlaneBins bins(places, h);
      std::vector<char> back(nodes.size(), 0);
      for(std::size_t i = 0; i < nodes.size(); ++i)
        if(places[i] != nodes.position[i])
          bins.visit(places[i], least_node_distance * h,
                     [&](std::uint32_t j, double) { back[i] |= j != i; });
      for(std::size_t i = 0; i < nodes.size(); ++i)
        if(back[i])
        {
          places[i] = nodes.position[i];
          again = true;
        }
    }
  }

  std::vector<PlanePoint> PlaneRelaxation::places(const PlaneState &state,
                                                  bool solid_beyond, double time)
  {
    std::vector<PlanePoint> result = nodes.position;
    const FrontIndex index(state.front, solid_beyond, nodes.spacing);
    front_bins = PlaneBins(state.front.position, nodes.spacing);
    CoordinateBox box;
    box.dimension = 2;
    for(int d = 0; d < 2; ++d)
    {
      box.lower[d] = nodes.lower[d];
      box.upper[d] = nodes.upper[d];
    }
    for(const bool solid : {false, true})
    {
      Phase phase;
      gather(state, index, time, solid, phase, result);
      relax_phase(phase.moving, phase.homes, phase.fixed, box,
                  {rule, nodes.spacing, threads});
      for(std::size_t k = 0; k < phase.node.size(); ++k)
        for(int d = 0; d < 2; ++d)
          result[phase.node[k]][d] = phase.moving.position[d][k];
    }
    keep_apart(index, result);
    settled = true;
    return result;
  }

  void PlaneRelaxation::resample(const std::vector<PlanePoint> &places,
                                 const PlaneHeat &heat, PlaneState &state) const
  {
    const double h = nodes.spacing;
    const FrontIndex index(state.front, heat.settings.solid_beyond, h);
    const std::vector<NodePhase> phase_before = state.phase;
    const std::array<PhaseValues, n_phases> known{
        phase_values(state, heat, NodePhase::liquid),
        phase_values(state, heat, NodePhase::solid)};
    std::vector<StencilMaker> makers(threads,
                                     StencilMaker(nodes, heat.settings.order + 1));
    for(StencilMaker &maker : makers)
      maker.set_front(state.front, index, phase_before);
    const PlaneBins bins(state.front.position, h);
    const double absorbed = heat.settings.interpolation_distance * h;
#pragma omp parallel num_threads(threads) if(threads > 1)
    {
      PlaneStencil stencil;
#pragma omp for schedule(static)
      for(std::size_t i = 0; i < nodes.size(); ++i)
      {
        if(places[i] == nodes.position[i])
          continue;
        const double distance
            = index.signed_distance(places[i], std::max(absorbed, on_a_particle * h));
        if(std::abs(distance) < absorbed)
        {
          state.phase[i] = NodePhase::front;
          state.unknown[i]
              = heat.front_temperature(state.front.curvature[bins.nearest(places[i])]);
          continue;
        }
        const NodePhase phase = distance < 0 ? NodePhase::solid : NodePhase::liquid;
        const PhaseValues &own = known[index_of(phase)];
        StencilMaker &maker = makers[omp_get_thread_num()];
        const PlanePoint way = places[i] - nodes.position[i];
        const bool stayed = phase == phase_before[i];
        maker.make(stayed ? PlanePoint(places[i] - way / 2) : places[i], phase, stencil);
        const double found = stayed ? own.values[i]
                                          + way.x() * stencil.apply(d_x, own.values)
                                          + way.y() * stencil.apply(d_y, own.values)
                                    : stencil.apply(value_of, own.values);
        state.phase[i] = phase;
        state.unknown[i] = std::clamp(found, own.lowest, own.highest);
      }
    }
  }

  void PlaneRun::relax_nodes()
  {
    const std::vector<PlanePoint> places = relaxation.places(
        state, heat.settings.solid_beyond, parameters.relax * last_step);
    relaxation.resample(places, heat, state);
    if(older)
      relaxation.resample(places, heat, *older);
    const std::vector<PlanePoint> before = nodes.position;
    nodes.move(places);
    heat.nodes_moved(before);
  }
} // namespace meltfront::particles::rkpm_tracked
