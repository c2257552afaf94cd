#include <reference_fem/cut/heat_problem.h>

#include <reference_fem/cut/quadrature.h>
#include <reference_fem/cut/transfer.h>

#include <algorithm>

namespace meltfront::reference_fem::cut
{
  namespace
  {
    /** Of the spacing: no quadrature point lies nearer to a source than this. */
    constexpr double smallest_sink_distance = 0.02;

    /** Of the spacing: by which a temperature is differentiated. */
    constexpr double difference = 1e-4;

    /** Of the spacing: below it the projection of the start is Ritz's, which gives the
     * heat flow, above it that in L2, which keeps the heat. */
    constexpr double projection_length = 1;

    /** Of the spacing: beside the front, where a temperature given is not trusted to have
     * the front's phases. */
    constexpr double kink_layer = 0.05;
  } // namespace

  TimeDerivative time_derivative(double step, double step_before)
  {
    if(step_before == 0)
      return {1 / step, -1 / step, 0};
    const double ratio = step / step_before;
    return {(1 + 2 * ratio) / (1 + ratio) / step, -(1 + ratio) / step,
            ratio * ratio / (1 + ratio) / step};
  }

  HeatProblem::HeatProblem(const cases::Scene &scene, double spacing,
                           const Stabilisation &stabilisation, double smoothing)
    : sinks(scene, smallest_sink_distance * spacing)
    , scene(scene)
    , spacing(spacing)
    , stabilisation(stabilisation)
    , smoothing(smoothing)
  {
    for(const cases::Side side : scene.sides())
      if(scene.boundary(side).kind == cases::BoundaryKind::flux)
      {
        const auto &flux
            = fluxes[static_cast<std::size_t>(side)].emplace(scene.boundary(side).value);
        fluxes_vary = fluxes_vary || !flux.steady();
      }
    if(scene.volumetric_source)
      released.emplace(*scene.volumetric_source);
  }

  const cases::PhaseProperties &HeatProblem::properties(Phase phase) const
  {
    return phase == Phase::solid ? scene.material.solid : scene.material.liquid;
  }

  void HeatProblem::set_front(State &state, Values level_set) const
  {
    meters.front.measure(
        [&]
        {
          keep_off_nodes(*state.mesh, level_set);
          state.geometry = std::make_shared<CutGeometry>(*state.mesh, level_set);
          redistance(*state.mesh, *state.geometry, level_set);
          state.level_set = std::move(level_set);
        });
  }

  namespace
  {
    /** What is prescribed brings in its integral over time: the rate of it is the time
     * scheme's own derivative of the integral, over whole steps. */
    template <typename Mean>
    double rate_of(Mean &mean, const cases::Position &position, const State &state,
                   const State *before, const State *older)
    {
      if(!before || mean.steady())
        return mean(position, state.time, state.time);
      const double step = state.time - before->time;
      const double now = mean(position, before->time, state.time);
      if(!older)
        return now;
      const double step_before = before->time - older->time;
      const TimeDerivative derivative = time_derivative(step, step_before);
      return derivative.now * step * now
             - derivative.older * step_before * mean(position, older->time, before->time);
    }
  } // namespace

  double HeatProblem::flux_in(cases::Side side, const cases::Position &position,
                              const State &state, const State *before,
                              const State *older) const
  {
    return rate_of(*fluxes[static_cast<std::size_t>(side)], position, state, before,
                   older);
  }

  /** Of the walls' fluxes (W/m), as flux_in() has it. */
  double HeatProblem::flux_power(const State &state, const State &before,
                                 const State *older) const
  {
    double sum = 0;
    for(const WallPoint &wall : state.geometry->walls)
      if(fluxes[static_cast<std::size_t>(wall.side)])
        sum += wall.point.weight
               * flux_in(wall.side, position(wall.position), state, &before, older);
    return sum;
  }

  PhaseEquation HeatProblem::conditions(Phase phase, const State &state,
                                        const State *before, const State *older) const
  {
    const double time = state.time;
    const bool solid = phase == Phase::solid;
    const double melting = scene.material.melting_temperature;
    const double conductivity = properties(phase).conductivity;
    PhaseEquation result;
    result.front_value = [this, solid, melting, time](const Point &point)
    { return solid ? melting - sink_value(point, time) : melting; };
    result.wall = [this, phase, solid, conductivity, time, &state, before,
                   older](const WallPoint &wall) -> WallCondition
    {
      const cases::Boundary &boundary = scene.boundary(wall.side);
      const cases::Position place = position(wall.position);
      cases::EffectMeter &meter = meters.walls[static_cast<std::size_t>(boundary.kind)];
      if(boundary.kind == cases::BoundaryKind::fixed_temperature)
        return {true, meter.measure(
                          [&]
                          {
                            return before ? cases::value_at_end(boundary.value, place,
                                                                before->time, time)
                                          : boundary.value(place, time);
                          })
                          - (solid ? sink_value(wall.position, time) : 0)};
      const double singular
          = solid && !sinks.places.empty()
                ? conductivity * (sinks.gradient(wall.position, time) * wall.point.normal)
                : 0;
      if(cases::exchanges_heat(boundary.kind))
      {
        const cases::HeatThroughWall through
            = meter.measure([&] { return exchange(wall, phase, state, before); });
        return {false, through.flux - singular, through.slope};
      }
      const double flux
          = boundary.kind == cases::BoundaryKind::flux ? meter.measure(
                [&] { return flux_in(wall.side, place, state, before, older); })
                                                       : 0;
      return {false, flux - singular};
    };
    return result;
  }

  /** What a wall exchanges with its surroundings, as a linear law of the unknown: its
   * tangent at the temperature before. Of a linear law that is the law itself. */
  cases::HeatThroughWall HeatProblem::exchange(const WallPoint &wall, Phase phase,
                                               const State &state,
                                               const State *before) const
  {
    const cases::Boundary &boundary = scene.boundary(wall.side);
    const cases::Position place = position(wall.position);
    const double given
        = before ? cases::value_at_end(boundary.value, place, before->time, state.time)
                 : boundary.value(place, state.time);
    const double about = before ? temperature(*before, phase, wall.cell, wall.point.unit)
                                : scene.initial.temperature(place, scene.start_time);
    const cases::HeatThroughWall through = cases::heat_through(boundary, given, about);
    const double singular
        = phase == Phase::solid ? sink_value(wall.position, state.time) : 0;
    return {through.flux + through.slope * (singular - about), through.slope};
  }

  double HeatProblem::sink_value(const Point &point, double time) const
  {
    return sinks.places.empty()
               ? 0
               : meters.sinks.measure([&] { return sinks.value(point, time); });
  }

  cases::EffectCost HeatProblem::cost(cases::Effect effect, const State &state) const
  {
    using cases::BoundaryKind, cases::Effect;
    const auto of_wall = [&](BoundaryKind kind)
    {
      std::size_t points = 0;
      for(const WallPoint &wall : state.geometry->walls)
        points += scene.boundary(wall.side).kind == kind;
      return meters.walls[static_cast<std::size_t>(kind)].cost(
          effect, points * sizeof(WallPoint));
    };
    switch(effect)
    {
    case Effect::phase_change:
      return meters.front.cost(
          effect, (state.level_set.size() + state.speed.values.size()) * sizeof(double)
                      + state.speed.band.size()
                      + state.geometry->cut_cells.size() * sizeof(CutCell));
    case Effect::heat_sources:
      return meters.sinks.cost(effect, sinks.places.size() * sizeof(Point));
    case Effect::volumetric_source:
      return meters.released.cost(effect, released->bytes());
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

  State HeatProblem::transferred(const State &state,
                                 std::shared_ptr<const BackgroundMesh> mesh) const
  {
    const Transfer transfer(*state.mesh, *mesh);
    State result{state.time, std::move(mesh), {}, {}, {}, {}, state.wall_power};
    set_front(result, transfer.level_set(state.level_set));
    for(const Phase phase : phases)
      result.unknown[index(phase)]
          = transfer.temperature(state.unknown[index(phase)], *result.geometry, phase);
    result.speed = transfer.speed(state.speed);
    return result;
  }

  /** What stands for a phase that is absent. */
  Values HeatProblem::values_on_front(const BackgroundMesh &mesh,
                                      const PhaseEquation &equation) const
  {
    Values result;
    for(const Point &point : mesh.positions)
      result.push_back(equation.front_value(point));
    return result;
  }

  /**
   * Gradient of a function with a kink on the front, by differences. Near the front, and
   * beyond it, it is continued linearly from the inside of the phase: the discrete front
   * is not exactly where the kink is.
   */
  Gradient HeatProblem::gradient_beside_front(const PointFunction &function, Phase phase,
                                              const State &state, const Cell &cell,
                                              const Point &unit) const
  {
    const double shift = difference * spacing, layer = kink_layer * spacing;
    const Point here = cell.real(unit);
    const auto gradient = [&](const Point &point)
    {
      Gradient result;
      for(int d = 0; d < dim; ++d)
      {
        Gradient step;
        step[d] = shift;
        result[d] = (function(point + step) - function(point - step)) / (2 * shift);
      }
      return result;
    };
    const ValueAndGradient front = evaluate(*state.mesh, cell, state.level_set, unit);
    const double slope = front.gradient.norm();
    if(!(slope > 0))
      return gradient(here);
    const double inward = phase == Phase::solid ? -1 : 1;
    const double depth = inward * front.value / slope;
    if(depth >= layer)
      return gradient(here);
    const Gradient into = inward / slope * front.gradient;
    const Gradient near = gradient(here + (layer - depth) * into);
    const Gradient far = gradient(here + (2 * layer - depth) * into);
    return near + (depth - layer) / layer * (far - near);
  }

  PhaseEquation HeatProblem::projection(Phase phase, const State &state,
                                        const PointFunction &temperature) const
  {
    const double conductivity = properties(phase).conductivity;
    const double length = projection_length * spacing;
    const auto smooth_part = [this, phase, time = state.time,
                              &temperature](const Point &point) {
      return temperature(point) - (phase == Phase::solid ? sinks.value(point, time) : 0);
    };
    PhaseEquation result = conditions(phase, state, nullptr, nullptr);
    result.wall = {};
    result.conductivity = conductivity;
    result.mass = conductivity / (length * length);
    result.source = [smooth_part, mass = result.mass](const Point &point)
    { return mass * smooth_part(point); };
    result.divergence_source = [this, smooth_part, conductivity, phase,
                                &state](const Cell &cell, const Point &unit) {
      return conductivity * gradient_beside_front(smooth_part, phase, state, cell, unit);
    };
    return result;
  }

  void HeatProblem::project(State &state, const PointFunction &temperature)
  {
    std::array<std::vector<double>, 2> flux;
    for(const Phase phase : phases)
    {
      const PhaseEquation equation = projection(phase, state, temperature);
      Values &unknown = state.unknown[index(phase)];
      unknown = values_on_front(*state.mesh, equation);
      if(!state.geometry->has(phase))
        continue;
      PhaseProblem problem(*state.mesh, *state.geometry, state.level_set, phase,
                           stabilisation);
      unknown = problem.solve(equation);
      flux[index(phase)] = problem.front_flux(equation, unknown);
      unknowns += problem.unknowns;
    }
    find_speed(state, flux);
  }

  /** Stefan's condition, rho L V = heat flux out of the front into both phases. */
  void HeatProblem::find_speed(State &state,
                               const std::array<std::vector<double>, 2> &flux) const
  {
    const double latent = scene.material.solid.density * scene.material.latent_heat;
    std::vector<double> speed;
    for(const CutCell &cut : state.geometry->cut_cells)
      for(const SurfacePoint &point : cut.front)
      {
        const Gradient singular
            = sinks.gradient(state.mesh->cells[cut.cell].real(point.unit), state.time);
        double heat = scene.material.solid.conductivity * (singular * point.normal);
        for(const std::vector<double> &phase_flux : flux)
          if(!phase_flux.empty())
            heat += phase_flux[speed.size()];
        speed.push_back(heat / latent);
      }
    state.speed = meters.front.measure(
        [&]
        {
          return extend_speed(*state.mesh, *state.geometry, state.level_set, speed,
                              smoothing);
        });
  }

  PointFunction HeatProblem::change_of_sinks(const TimeDerivative &derivative,
                                             const State &state, const State &before,
                                             const State *older) const
  {
    const double capacity = scene.material.solid.volumetric_heat_capacity();
    const double now = state.time, then = before.time, first = older ? older->time : 0;
    return [this, capacity, derivative, now, then, first](const Point &point)
    {
      return -capacity
             * (derivative.now * sink_value(point, now)
                + derivative.before * sink_value(point, then)
                + (derivative.older != 0 ? derivative.older * sink_value(point, first)
                                         : 0));
    };
  }

  PhaseEquation HeatProblem::equation(Phase phase, const State &state,
                                      const State &before, const State *older) const
  {
    const TimeDerivative derivative = time_derivative(
        state.time - before.time, older ? before.time - older->time : 0);
    const double capacity = properties(phase).volumetric_heat_capacity();
    PhaseEquation result = conditions(phase, state, &before, older);
    result.mass = capacity * derivative.now;
    result.conductivity = properties(phase).conductivity;
    result.load = before.unknown[index(phase)];
    for(std::size_t i = 0; i < result.load.size(); ++i)
      result.load[i]
          = -capacity
            * (derivative.before * result.load[i]
               + (older ? derivative.older * older->unknown[index(phase)][i] : 0));
    result.source = source(phase, state, before, older);
    return result;
  }

  /** What is not proportional to an unknown: empty if there is nothing. */
  PointFunction HeatProblem::source(Phase phase, const State &state, const State &before,
                                    const State *older) const
  {
    PointFunction of_sinks;
    if(phase == Phase::solid && sinks.varies())
      of_sinks = change_of_sinks(time_derivative(state.time - before.time,
                                                 older ? before.time - older->time : 0),
                                 state, before, older);
    if(!released)
      return of_sinks;
    return [this, of_sinks, &state, &before, older](const Point &point)
    {
      return meters.released.measure(
                 [&]
                 { return rate_of(*released, position(point), state, &before, older); })
             + (of_sinks ? of_sinks(point) : 0);
    };
  }

  void HeatProblem::solve(State &state, const State &before, const State *older)
  {
    const CutGeometry &geometry = *state.geometry;
    state.wall_power = sink_wall_power(state);
    unknowns = 0;
    std::array<std::vector<double>, 2> flux;
    for(const Phase phase : phases)
    {
      const PhaseEquation equation = this->equation(phase, state, before, older);
      Values &unknown = state.unknown[index(phase)];
      unknown = values_on_front(*state.mesh, equation);
      if(!geometry.has(phase))
        continue;
      PhaseProblem problem(*state.mesh, geometry, state.level_set, phase, stabilisation);
      unknown = problem.solve(equation);
      flux[index(phase)] = problem.front_flux(equation, unknown);
      state.wall_power += problem.wall_heat(equation, unknown);
      unknowns += problem.unknowns;
      entries += problem.entries;
    }
    if(fluxes_vary)
    {
      state.wall_power -= flux_power(state, before, older);
      state.flux_heat = (state.time - before.time) * flux_power(state, before, nullptr);
    }
    if(released)
      state.released_heat = heat_released(state, before);
    find_speed(state, flux);
    most_unknowns = std::max(most_unknowns, unknowns);
    ++solves;
  }
} // namespace meltfront::reference_fem::cut
