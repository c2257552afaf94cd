#include <particles/rkpm_tracked/plane/heat.h>

#include <particles/scattered/linear_solver.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    /** Spacings beyond a wall from which on particles of melting fronts stay where they
     * are: the curve goes round the solid there and is no front. */
    constexpr double stays_beyond = 2;
  } // namespace

  /** A phase's value enters the row in progress. */
  void PlaneHeat::add(NodePhase phase, std::uint32_t column, double weight)
  {
    if(column < nodes.size())
    {
      row_columns.push_back(column);
      row_values.push_back(weight);
      return;
    }
    const std::size_t particle = column - nodes.size();
    const FrontValue &value = front_values[index_of(phase)][particle];
    row_right_side -= weight * value.constant;
    const auto depend = [&](std::size_t p, double slope)
    {
      row_columns.push_back(static_cast<std::uint32_t>(nodes.size() + p));
      row_values.push_back(weight * slope * nodes.spacing);
    };
    depend(particle, value.own);
    if(settings.capillarity != 0)
    {
      depend(before[particle], value.before);
      depend(after[particle], value.after);
    }
  }

  void PlaneHeat::finish_row(double right_hand_side)
  {
    matrix.add_row(row_columns, row_values, scratch);
    right_side.push_back(row_right_side + right_hand_side);
    row_columns.clear();
    row_values.clear();
    row_right_side = 0;
  }

  void PlaneHeat::add_node(const PlaneStep &step, const PlaneState &next,
                           std::size_t node)
  {
    const auto column = static_cast<std::uint32_t>(node);
    const NodePhase phase = next.phase[node];
    if(phase == NodePhase::front)
    {
      add(phase, column, 1);
      finish_row(front_temperature_near(node));
      return;
    }
    if(nodes.wall_of_node[node] >= 0)
    {
      add_wall(step, next, nodes.walls[nodes.wall_of_node[node]]);
      return;
    }
    const cases::PhaseProperties &material = properties(phase);
    add(phase, column, material.volumetric_heat_capacity() / step.step * step.a);
    const Row &row = rows[node];
    for(std::size_t e = 0; e < row.columns.size(); ++e)
      add(phase, row.columns[e], -material.conductivity * row.weights[e]);
    finish_row(known_rate(step, phase, node));
  }

  /** Heat per volume and time that a node's balance knows: of states before the step, of
   * what the sinks take off the unknown, and released. */
  double PlaneHeat::known_rate(const PlaneStep &step, NodePhase phase,
                               std::size_t node) const
  {
    const PlanePoint &place = nodes.position[node];
    const double capacity = properties(phase).volumetric_heat_capacity() / step.step;
    double known = capacity * step.b * step.last.extended(phase, node, place);
    if(step.older)
      known -= capacity * step.c * step.older->extended(phase, node, place);
    if(phase == NodePhase::solid && !sinks.empty())
      meters.sinks.measure(
          [&]
          {
            known -= capacity
                     * (step.a * singular_part(node, step.time)
                        - step.b * singular_part(node, step.last.time));
            if(step.older)
              known -= capacity * step.c * singular_part(node, step.older->time);
          });
    if(scene.volumetric_source)
      known += meters.release.measure(
          [&] { return given.release(position_of(place), step.span); });
    return known;
  }

  /** Where the temperature is not held, the balance of the node's area: what flows in
   * through the wall heats it or is conducted on. To the condition at the wall it adds
   * the heat equation times half a spacing, and so keeps the heat. */
  void PlaneHeat::add_wall(const PlaneStep &step, const PlaneState &next,
                           const WallNode &wall)
  {
    const NodePhase phase = next.phase[wall.node];
    const PlanePoint &place = nodes.position[wall.node];
    const cases::Position position = position_of(place);
    const bool singular = phase == NodePhase::solid && !sinks.empty();
    const double shift = singular ? sinks.value(place, step.time) : 0;
    if(const WallPiece *piece = wall.dirichlet())
    {
      add(phase, wall.node, 1);
      finish_row(wall_meter(*piece).measure(
                     [&]
                     {
                       return cases::value_at_end(piece->boundary->value, position,
                                                  step.last.time, step.time);
                     })
                 - shift);
      return;
    }
    const cases::PhaseProperties &material = properties(phase);
    const double area = wall_areas[nodes.wall_of_node[wall.node]];
    const bool insulated
        = std::all_of(wall.pieces.begin(), wall.pieces.begin() + wall.n_pieces,
                      [](const WallPiece &piece)
                      { return piece.boundary->kind == cases::BoundaryKind::insulated; });
    if(beside_films[nodes.wall_of_node[wall.node]] && insulated)
    {
      // Across a film at an insulated wall the temperature is that of the front but for
      // the square of the film's width; a fit to the film's few points may tell anything.
      add(phase, wall.node, 1);
      finish_row(front_temperature_near(wall.node) - shift);
      return;
    }
    add(phase, wall.node,
        area * material.volumetric_heat_capacity() / step.step * step.a);
    double inflow = area * known_rate(step, phase, wall.node);
    for(int i = 0; i < wall.n_pieces; ++i)
    {
      const WallPiece &piece = wall.pieces[i];
      if(singular)
        inflow -= piece.length * material.conductivity
                  * sinks.gradient(place, step.time).dot(piece.normal);
      if(piece.boundary->kind == cases::BoundaryKind::insulated)
        continue;
      const double value = wall_meter(piece).measure(
          [&] { return given.wall(*piece.boundary, position, step.span); });
      if(cases::exchanges_heat(piece.boundary->kind))
      {
        const cases::HeatTransfer near = transfer_through(
            piece, value, next.unknown.empty() ? step.last : next, wall.node);
        const double transfer = piece.length * near.coefficient;
        add(phase, wall.node, transfer);
        inflow += transfer * (near.ambient - shift);
      }
      else
        inflow += piece.length * value;
    }
    const Row &row = rows[wall.node];
    for(std::size_t e = 0; e < row.columns.size(); ++e)
      add(phase, row.columns[e], material.conductivity * row.weights[e]);
    finish_row(inflow);
  }

  /** The law of a wall's piece, linearised about the temperature of the last pass, or of
   * the last state. */
  cases::HeatTransfer PlaneHeat::transfer_through(const WallPiece &piece, double value,
                                                  const PlaneState &latest,
                                                  std::uint32_t node)
  {
    double guess = 0;
    if(piece.boundary->kind == cases::BoundaryKind::radiation)
    {
      wall_guesses.resize(nodes.walls.size());
      guess = wall_guesses[nodes.wall_of_node[node]] = temperature(latest, node);
    }
    return cases::heat_transfer_near(*piece.boundary, value, guess);
  }

  void PlaneHeat::add_front(const PlaneStep &step, const PlaneState &next,
                            std::size_t particle)
  {
    const PlaneFront &front = next.front;
    const PlanePoint &normal = front.normal[particle], &place = front.position[particle];
    const auto own = static_cast<std::uint32_t>(nodes.size() + particle);
    // The particle's way so far, of which BDF2 knows a share already.
    const PlanePoint past = step.older ? (step.c / step.a) * front.displacement[particle]
                                       : PlanePoint(0, 0);
    const double way = (place - step.last.front.position[particle] - past).dot(normal);
    const double rate
        = scene.material.solid.density * scene.material.latent_heat * step.a / step.step;
    if(!front.active[particle])
    {
      row_columns.push_back(own);
      row_values.push_back(nodes.spacing * step.a / step.step);
      finish_row(front.speed[particle] - step.a / step.step * way);
      return;
    }
    double known = -rate * way + wall_inflow[particle] / particle_length(front, particle);
    double slope = rate;
    for(const NodePhase phase : phases)
    {
      const double conductivity
          = (phase == NodePhase::solid ? 1 : -1) * properties(phase).conductivity;
      const PlaneStencil &stencil = front_stencils[index_of(phase)][particle];
      for(std::size_t e = 0; e < stencil.columns.size(); ++e)
        add(phase, stencil.columns[e],
            -conductivity
                * (normal.x() * stencil.weights[d_x][e]
                   + normal.y() * stencil.weights[d_y][e]));
      slope -= conductivity
               * next.expansion[index_of(phase)].second_along(particle, normal);
      if(phase == NodePhase::solid && !sinks.empty())
      {
        known += conductivity * sinks.gradient(place, step.time).dot(normal);
        const Eigen::Vector3d second = sinks.second_derivatives(place, step.time);
        slope -= conductivity
                 * (second[0] * normal.x() * normal.x()
                    + 2 * second[1] * normal.x() * normal.y()
                    + second[2] * normal.y() * normal.y());
      }
    }
    row_columns.push_back(own);
    row_values.push_back(nodes.spacing * slope);
    finish_row(known);
  }

  std::optional<PlaneSolution> PlaneHeat::solve(const PlaneStep &step, PlaneState &next)
  {
    next.time = step.time;
    make_rows(next);
    meters.front.measure(
        [&]
        {
          make_front_stencils(next);
          find_front_values(next);
        });
    matrix = CompressedRows();
    right_side.clear();
    for(std::size_t i = 0; i < nodes.size(); ++i)
      add_node(step, next, i);
    meters.front.measure(
        [&]
        {
          find_wall_inflow(step, next);
          for(std::size_t p = 0; p < next.front.size(); ++p)
            add_front(step, next, p);
        });
    LinearSolverParameters parameters;
    parameters.method = LinearMethod::direct;
    LinearSolver solver(matrix, parameters);
    PlaneSolution solution;
    solution.constant.resize(matrix.rows());
    bool solved = solver.solve(right_side, solution.constant).converged;
    if(!walls_hold_temperature())
    {
      spread_multiplier(step, next, solution);
      solution.slope.resize(matrix.rows());
      solved = solved && solver.solve(spread, solution.slope).converged;
    }
    ++solves;
    entries += static_cast<long>(matrix.size());
    most_unknowns = std::max(most_unknowns, matrix.rows());
    if(!solved)
    {
      ++singular;
      return std::nullopt;
    }
    return solution;
  }

  std::vector<double> PlaneHeat::apply(const PlaneStep &step, const PlaneSolution &found,
                                       double multiplier, PlaneState &next)
  {
    const std::vector<double> solution = found.at(multiplier);
    next.multiplier = multiplier;
    next.unknown.assign(solution.begin(), solution.begin() + nodes.size());
    std::vector<double> displacement(next.front.size());
    for(std::size_t p = 0; p < displacement.size(); ++p)
      displacement[p] = nodes.spacing * solution[nodes.size() + p];
    meters.front.measure([&] { update_expansions(next, solution); });
    add_heat(step, wall_power(step, next, solution), next);
    return displacement;
  }

  void PlaneHeat::expand(PlaneState &state)
  {
    make_rows(state);
    make_front_stencils(state);
    for(FrontExpansion &expansion : state.expansion)
      expansion.gradient.clear();
    find_front_values(state);
    std::vector<double> solution(state.unknown);
    solution.resize(nodes.size() + state.front.size(), 0.);
    update_expansions(state, solution);
  }

  /** Derivatives at the front particles from a solution, taken along to where they move;
   * speeds from these. */
  void PlaneHeat::update_expansions(PlaneState &state, std::span<const double> solution)
  {
    PlaneFront &front = state.front;
    state.expanded_about.resize(front.size());
    std::array<FrontExpansion, n_phases> found;
    for(const NodePhase phase : phases)
    {
      FrontExpansion &expansion = found[index_of(phase)];
      expansion.value.resize(front.size());
      expansion.gradient.assign(front.size(), PlanePoint(0, 0));
      expansion.second.assign(front.size(), Eigen::Vector3d(0, 0, 0));
      for(std::size_t p = 0; p < front.size(); ++p)
      {
        if(!front.active[p])
          continue;
        const PlaneStencil &stencil = front_stencils[index_of(phase)][p];
        for(std::size_t e = 0; e < stencil.columns.size(); ++e)
        {
          const std::uint32_t column = stencil.columns[e];
          const double value = column < nodes.size()
                                   ? solution[column]
                                   : front_value(phase, column - nodes.size(), solution);
          expansion.gradient[p]
              += value * PlanePoint(stencil.weights[d_x][e], stencil.weights[d_y][e]);
          expansion.second[p]
              += value
                 * Eigen::Vector3d(stencil.weights[d_xx][e], stencil.weights[d_xy][e],
                                   stencil.weights[d_yy][e]);
        }
        const PlanePoint move
            = nodes.spacing * solution[nodes.size() + p] * front.normal[p];
        expansion.gradient[p] = expansion.gradient_at(p, move);
      }
    }
    const double latent = scene.material.solid.density * scene.material.latent_heat;
    for(std::size_t p = 0; p < front.size(); ++p)
    {
      const PlanePoint place
          = front.position[p]
            + nodes.spacing * solution[nodes.size() + p] * front.normal[p];
      state.expanded_about[p] = place;
      for(const NodePhase phase : phases)
        found[index_of(phase)].value[p]
            = front_temperature(bend[p])
              - (phase == NodePhase::solid ? sinks.value(place, state.time) : 0);
      if(!front.active[p])
        continue;
      const PlanePoint solid = found[1].gradient[p] + sinks.gradient(place, state.time);
      front.speed[p] = (scene.material.solid.conductivity * solid
                        - scene.material.liquid.conductivity * found[0].gradient[p])
                           .dot(front.normal[p])
                       / latent;
    }
    state.expansion = std::move(found);
    extrapolate_inactive(state);
    state.expansion_bins = PlaneBins(state.expanded_about, nodes.spacing);
  }

  /** Particles beyond the walls follow the nearest ones within; where solid melts, those
   * that go round it stay, as they would come into the domain. */
  void PlaneHeat::extrapolate_inactive(PlaneState &state) const
  {
    PlaneFront &front = state.front;
    for(std::size_t p = 0; p < front.size(); ++p)
    {
      if(front.active[p])
        continue;
      double least = std::numeric_limits<double>::infinity();
      std::size_t nearest = p;
      for(std::size_t q = 0; q < front.size(); ++q)
      {
        const double square = (front.position[q] - front.position[p]).squaredNorm();
        if(front.active[q] && square < least)
        {
          least = square;
          nearest = q;
        }
      }
      if(nearest == p)
        continue;
      const double speed = front.speed[nearest],
                   beyond = -nodes.wall_distance(front.position[p]) / nodes.spacing;
      front.speed[p]
          = speed > 0 ? std::clamp(stays_beyond - beyond, 0., 1.) * speed : speed;
      for(FrontExpansion &expansion : state.expansion)
      {
        const PlanePoint way = state.expanded_about[p] - state.expanded_about[nearest];
        expansion.gradient[p] = expansion.gradient_at(nearest, way);
        expansion.second[p] = expansion.second[nearest];
        expansion.value[p] = expansion.at(nearest, way);
      }
    }
  }
} // namespace meltfront::particles::rkpm_tracked
