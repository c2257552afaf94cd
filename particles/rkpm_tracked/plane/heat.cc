#include <particles/rkpm_tracked/plane/heat.h>

#include <particles/scattered/linear_solver.h>

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    /** Front particles so much beyond a wall, in spacings, take no part. */
    constexpr double beyond_wall = 0.05;

    /** A node that counted as on the front goes on doing so within this many times the
     * distance, so that none goes to and fro beside a front at rest. */
    constexpr double kept_longer = 1.3;

    /** Curvature of the circle through three points (1/m), positive if it is gone round
     * counter-clockwise. */
    double curvature_of_three(const PlanePoint &a, const PlanePoint &b,
                              const PlanePoint &c)
    {
      const PlanePoint first = b - a, second = c - b;
      const double product = first.norm() * second.norm() * (c - a).norm();
      return product > 0 ? 2 * (first.x() * second.y() - first.y() * second.x()) / product
                         : 0;
    }

  } // namespace

  PlaneStep::PlaneStep(const PlaneState &last, const PlaneState *older, double time)
    : last(last)
    , older(older)
    , time(time)
    , step(time - last.time)
    , span{last.time, last.time, time, 0, time}
  {
    if(!older)
      return;
    const double ratio = step / (last.time - older->time);
    a = (1 + 2 * ratio) / (1 + ratio);
    b = 1 + ratio;
    c = ratio * ratio / (1 + ratio);
    span.before = older->time;
    span.share_before = ratio / (1 + ratio);
  }

  PlaneHeat::PlaneHeat(const cases::Scene &scene, const PlaneNodes &nodes,
                       const PlaneHeatSettings &settings)
    : sinks(scene, nodes.spacing)
    , settings(settings)
    , scene(scene)
    , given(scene)
    , nodes(nodes)
    , makers(settings.threads, StencilMaker(nodes, settings.order))
    , rows(nodes.size())
    , holds_walls(std::ranges::any_of(nodes.walls,
                                      [](const WallNode &w) { return w.dirichlet(); }))
  {
  }

  const cases::PhaseProperties &PlaneHeat::properties(NodePhase phase) const
  {
    return phase == NodePhase::solid ? scene.material.solid : scene.material.liquid;
  }

  double PlaneHeat::front_temperature(double curvature) const
  {
    return scene.material.melting_temperature - settings.capillarity * curvature;
  }

  double PlaneHeat::front_temperature_near(std::size_t node) const
  {
    const long nearest = front_bins.nearest(nodes.position[node]);
    return front_temperature(nearest < 0 ? 0 : bend[nearest]);
  }

  double PlaneHeat::temperature(const PlaneState &state, std::size_t node) const
  {
    return state.unknown[node]
           + (state.phase[node] == NodePhase::solid ? singular_part(node, state.time)
                                                    : 0);
  }

  double PlaneHeat::singular_part(std::size_t node, double time) const
  {
    return sinks.at_node([&](const PlanePoint &point)
                         { return sinks.value(point, time); },
                         nodes.position[node], nodes.samples_of(node));
  }

  void PlaneHeat::nodes_moved(std::span<const PlanePoint> before)
  {
    std::vector<PlanePoint> moved;
    for(std::size_t i = 0; i < nodes.size(); ++i)
      if(nodes.position[i] != before[i])
        moved.push_back(nodes.position[i]);
    const PlaneBins bins(moved, nodes.spacing);
    // A row's reach goes a spacing beyond its points, and no node moves farther.
    for(std::size_t i = 0; i < nodes.size(); ++i)
      if(rows[i].reach > 0)
        bins.visit(nodes.position[i], rows[i].reach,
                   [&](std::uint32_t, double) { rows[i].reach = 0; });
    for(StencilMaker &maker : makers)
      maker.nodes_moved();
  }

  void PlaneHeat::mark_active(PlaneFront &front) const
  {
    for(std::size_t p = 0; p < front.size(); ++p)
      front.active[p]
          = nodes.wall_distance(front.position[p]) >= -beyond_wall * nodes.spacing;
  }

  void PlaneHeat::set_front(PlaneState &state, bool keep_phases)
  {
    PlaneFront &front = state.front;
    mark_active(front);
    index = std::make_unique<FrontIndex>(front, settings.solid_beyond, nodes.spacing);
    front_bins = PlaneBins(front.position, nodes.spacing);
    const double absorbed = settings.interpolation_distance * nodes.spacing;
    state.phase.resize(nodes.size());
    for(std::size_t i = 0; i < nodes.size() && !keep_phases; ++i)
    {
      const double distance = index->signed_distance(
          nodes.position[i], std::max(kept_longer * absorbed, 1e-9 * nodes.spacing));
      const double limit
          = state.phase[i] == NodePhase::front ? kept_longer * absorbed : absorbed;
      state.phase[i] = std::abs(distance) < limit ? NodePhase::front
                       : distance < 0             ? NodePhase::solid
                                                  : NodePhase::liquid;
    }
    wall_areas.resize(nodes.walls.size());
    beside_films.resize(nodes.walls.size());
    for(std::size_t w = 0; w < nodes.walls.size(); ++w)
    {
      const WallNode &wall = nodes.walls[w];
      const double distance
          = std::abs(index->signed_distance(nodes.position[wall.node], nodes.spacing));
      wall_areas[w] = nodes.weight[wall.node]
                      * std::clamp(2 * distance / nodes.spacing - 1, 0., 1.);
      beside_films[w] = distance <= nodes.spacing / 2 && runs_along(front, wall);
    }
    before.resize(front.size());
    after.resize(front.size());
    bend.resize(front.size());
    for(std::size_t c = 0; c < front.curves(); ++c)
      for(std::size_t p = front.offsets[c]; p < front.offsets[c + 1]; ++p)
      {
        before[p] = front.previous(c, p);
        after[p] = front.next(c, p);
        bend[p] = curvature_of_three(front.position[before[p]], front.position[p],
                                     front.position[after[p]]);
      }
    for(StencilMaker &maker : makers)
      maker.set_front(front, *index, state.phase);
  }

  /** Whether the front runs along a wall at a node rather than meets it there, by its
   * particle nearest to the node. What is left in a corner it runs along. */
  bool PlaneHeat::runs_along(const PlaneFront &front, const WallNode &wall) const
  {
    constexpr double steepest = 0.5; // cosine between the normals: 60 degrees
    const long nearest = front_bins.nearest(nodes.position[wall.node]);
    return wall.n_pieces > 1 || nearest < 0
           || std::abs(wall.pieces[0].normal.dot(front.normal[nearest])) >= steepest;
  }

  void PlaneHeat::make_row(StencilMaker &maker, PlaneStencil &stencil, NodePhase phase,
                           std::size_t node)
  {
    Row &row = rows[node];
    maker.make(nodes.position[node], phase, stencil);
    row.columns = stencil.columns;
    row.weights.resize(stencil.columns.size());
    row.reach = stencil.pure ? stencil.dilation + nodes.spacing : 0;
    const std::int32_t wall = nodes.wall_of_node[node];
    PlanePoint outwards(0, 0);
    double area = -1; // of the Laplacian
    if(wall >= 0)
    {
      const WallNode &on_wall = nodes.walls[wall];
      for(int i = 0; i < on_wall.n_pieces; ++i)
        outwards += on_wall.pieces[i].length * on_wall.pieces[i].normal;
      area = wall_areas[wall];
    }
    for(std::size_t e = 0; e < row.columns.size(); ++e)
      row.weights[e] = outwards.x() * stencil.weights[d_x][e]
                       + outwards.y() * stencil.weights[d_y][e]
                       - area * (stencil.weights[d_xx][e] + stencil.weights[d_yy][e]);
  }

  /** Rows that the front does not touch are kept from pass to pass. */
  void PlaneHeat::make_rows(const PlaneState &state)
  {
    std::vector<std::uint32_t> wanted;
    for(std::size_t i = 0; i < nodes.size(); ++i)
    {
      if(state.phase[i] == NodePhase::front)
        continue;
      bool touched = rows[i].reach == 0;
      if(!touched)
        front_bins.visit(nodes.position[i], rows[i].reach,
                         [&](std::uint32_t, double) { touched = true; });
      if(touched)
        wanted.push_back(static_cast<std::uint32_t>(i));
    }
#pragma omp parallel num_threads(settings.threads) if(settings.threads > 1)
    {
      PlaneStencil stencil;
#pragma omp for schedule(static)
      for(std::size_t k = 0; k < wanted.size(); ++k)
        make_row(makers[omp_get_thread_num()], stencil, state.phase[wanted[k]],
                 wanted[k]);
    }
  }

  void PlaneHeat::make_front_stencils(const PlaneState &state)
  {
    const PlaneFront &front = state.front;
    for(auto &stencils : front_stencils)
      stencils.resize(front.size());
#pragma omp parallel num_threads(settings.threads) if(settings.threads > 1)
#pragma omp for schedule(static)
    for(std::size_t p = 0; p < front.size(); ++p)
      if(front.active[p])
        for(const NodePhase phase : phases)
          makers[omp_get_thread_num()].make(front.position[p], phase,
                                            front_stencils[index_of(phase)][p]);
  }

  /** The phases' values at the front particles as they depend on the displacements. */
  void PlaneHeat::find_front_values(const PlaneState &state)
  {
    const PlaneFront &front = state.front;
    for(const NodePhase phase : phases)
    {
      std::vector<FrontValue> &values = front_values[index_of(phase)];
      values.resize(front.size());
      const FrontExpansion &expansion = state.expansion[index_of(phase)];
      for(std::size_t p = 0; p < front.size(); ++p)
      {
        double slope = expansion.gradient.empty()
                           ? 0.
                           : expansion.gradient[p].dot(front.normal[p]);
        FrontValue &value = values[p];
        value.constant = front_temperature(bend[p]);
        if(phase == NodePhase::solid && !sinks.empty())
          meters.sinks.measure(
              [&]
              {
                value.constant -= sinks.value(front.position[p], state.time);
                slope
                    += sinks.gradient(front.position[p], state.time).dot(front.normal[p]);
              });
        value.own = -slope;
        value.before = value.after = 0;
      }
    }
    if(settings.capillarity != 0)
      meters.capillarity.measure([&] { add_capillarity(front); });
  }

  /** Moving along n changes the curvature by kappa^2 d + d'' along the curve. */
  void PlaneHeat::add_capillarity(const PlaneFront &front)
  {
    for(const NodePhase phase : phases)
      for(std::size_t p = 0; p < front.size(); ++p)
      {
        FrontValue &value = front_values[index_of(phase)][p];
        const double left = (front.position[p] - front.position[before[p]]).norm(),
                     right = (front.position[after[p]] - front.position[p]).norm();
        const double stiffness = 2 * settings.capillarity / (left + right);
        value.own -= settings.capillarity * bend[p] * bend[p]
                     - stiffness * (1 / left + 1 / right);
        value.before = -stiffness / left;
        value.after = -stiffness / right;
      }
  }

  std::size_t PlaneHeat::front_bytes() const
  {
    std::size_t bytes = 0;
    for(const NodePhase phase : phases)
    {
      bytes += front_values[index_of(phase)].size() * sizeof(FrontValue);
      for(const PlaneStencil &stencil : front_stencils[index_of(phase)])
        bytes
            += sizeof(PlaneStencil)
               + stencil.columns.size()
                     * (sizeof(std::uint32_t) + stencil.weights.size() * sizeof(double));
    }
    return bytes;
  }

  std::size_t PlaneHeat::wall_bytes(cases::BoundaryKind kind) const
  {
    std::size_t pieces = 0;
    for(const WallNode &wall : nodes.walls)
      for(int i = 0; i < wall.n_pieces; ++i)
        pieces += wall.pieces[i].boundary->kind == kind;
    return pieces * sizeof(WallPiece);
  }

  cases::EffectCost PlaneHeat::cost(cases::Effect effect) const
  {
    using cases::BoundaryKind, cases::Effect;
    const auto of_wall = [&](BoundaryKind kind) {
      return meters.walls[static_cast<std::size_t>(kind)].cost(effect, wall_bytes(kind));
    };
    switch(effect)
    {
    case Effect::phase_change:
      return meters.front.cost(effect, front_bytes());
    case Effect::gibbs_thomson:
      return meters.capillarity.cost(
          effect, bend.size() * sizeof(double) + before.size() * 2 * sizeof(std::size_t));
    case Effect::heat_sources:
      return meters.sinks.cost(effect, scene.sources.size() * sizeof(PlanePoint));
    case Effect::volumetric_source:
      return meters.release.cost(effect, 0);
    case Effect::wall_temperature:
      return of_wall(BoundaryKind::fixed_temperature);
    case Effect::wall_flux:
      return of_wall(BoundaryKind::flux);
    case Effect::robin_wall:
      return of_wall(BoundaryKind::heat_transfer);
    case Effect::radiating_wall:
      return of_wall(BoundaryKind::radiation);
    default:
      return {effect, solves, 0, 0};
    }
  }

  double PlaneHeat::front_value(NodePhase phase, std::size_t particle,
                                std::span<const double> solution) const
  {
    const FrontValue &value = front_values[index_of(phase)][particle];
    const auto moved = [&](std::size_t p) { return solution[nodes.size() + p]; };
    return value.constant
           + nodes.spacing
                 * (value.own * moved(particle) + value.before * moved(before[particle])
                    + value.after * moved(after[particle]));
  }

  double PlaneHeat::worst_condition(const PlaneState &state)
  {
    double worst = 0;
    PlaneStencil stencil;
    for(std::size_t p = 0; p < state.front.size(); ++p)
      if(state.front.active[p])
        for(const NodePhase phase : phases)
        {
          makers[0].make(state.front.position[p], phase, stencil);
          worst = std::max(worst, makers[0].condition_number());
        }
    return worst;
  }
} // namespace meltfront::particles::rkpm_tracked
