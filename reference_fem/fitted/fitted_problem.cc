#include <reference_fem/fitted/fitted_problem.h>
#include <reference_fem/fitted/time/coefficients.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace meltfront::reference_fem::fitted
{
  using cases::BoundaryKind;
  using dealii::Vector;

  namespace
  {
    /** Beyond the degree of the elements: areas and the slopes of levels. */
    constexpr int extra_points = 2;

    /** Makes r ln r times polynomials exact to 1e-13. */
    constexpr int points_at_centre = 16;

    /** A front closer to a wall than this share of a ray has reached it. */
    constexpr double closest = 1e-12;
  } // namespace

  FittedProblem::FittedProblem(RayMesh mesh, Physics physics)
    : rays(std::move(mesh))
    , laws(std::move(physics))
    , surface_rule(rays.surface.rule(rays.surface.degree + extra_points))
    , regular(rays.surface, surface_rule,
              LineRule::gauss(rays.surface.degree + extra_points))
  {
    if(laws.power)
      at_centre.emplace(rays.surface, surface_rule,
                        LineRule::towards_centre(points_at_centre));
    for(unsigned int level = 0; level < rays.n_levels(); ++level)
      places.push_back(rays.place(level));
    for(const SurfaceRule::Cell &cell : surface_rule.cells)
      total_measure += cell.weight.sum();
    walls[0] = {0, rays.has_centre() ? nullptr : &laws.inner_wall, rays.inner, 0};
    walls[1] = {rays.n_fronts(), &laws.outer_wall, rays.outer, rays.n_levels() - 1};
    number_accounts();
    make_sparsity();
  }

  void FittedProblem::number_accounts()
  {
    n_unknowns = rays.n_nodes();
    bool flux = false;
    for(Wall &wall : walls)
    {
      if(!wall.boundary)
        continue;
      flux = flux || cases::prescribes_heat(wall.boundary->kind);
      if(wall.boundary->kind == BoundaryKind::fixed_temperature)
      {
        wall.first_account = n_unknowns;
        n_unknowns += rays.surface.n_rays();
      }
    }
    if(flux)
      flux_account = n_unknowns++;
    if(laws.power)
      source_account = n_unknowns++;
    if(laws.volumetric_source.value)
      volumetric_account = n_unknowns++;
    if(laws.displacement != 0)
      outflow_account = n_unknowns++;
  }

  void FittedProblem::make_sparsity()
  {
    dealii::DynamicSparsityPattern dynamic(n_unknowns, n_unknowns);
    for(unsigned int s = 0; s < rays.surface.cells.size(); ++s)
      for(unsigned int l = 0; l < rays.layers.size(); ++l)
      {
        std::vector<unsigned int> columns = nodes_of(s, l);
        const std::vector<unsigned int> rows = columns;
        for(const unsigned int front : rays.fronts_of(rays.layers[l].interval))
          for(const unsigned int ray : rays.surface.cells[s])
            columns.push_back(rays.front_node(ray, front));
        for(const unsigned int row : rows)
          for(const unsigned int column : columns)
            dynamic.add(row, column);
      }
    for(const Wall &wall : walls)
      for(unsigned int ray = 0;
          wall.first_account != RayMesh::none && ray < rays.surface.n_rays(); ++ray)
      {
        dynamic.add(rays.node(ray, wall.level), wall.first_account + ray);
        dynamic.add(wall.first_account + ray, rays.node(ray, wall.level));
      }
    for(const Wall &wall : walls)
      if(wall.boundary && cases::exchanges_heat(wall.boundary->kind))
        for(unsigned int ray = 0; ray < rays.surface.n_rays(); ++ray)
          dynamic.add(flux_account, rays.node(ray, wall.level));
    if(volumetric_account != RayMesh::none)
      for(unsigned int front = 0; front < rays.n_fronts(); ++front)
        for(unsigned int ray = 0; ray < rays.surface.n_rays(); ++ray)
          dynamic.add(volumetric_account, rays.front_node(ray, front));
    if(outflow_account != RayMesh::none)
      for(unsigned int ray = 0; ray < rays.surface.n_rays(); ++ray)
      {
        dynamic.add(outflow_account, rays.node(ray, walls[1].level));
        dynamic.add(outflow_account, rays.front_node(ray));
      }
    pattern.copy_from(dynamic);
  }

  unsigned int FittedProblem::size() const
  {
    return n_unknowns;
  }

  const dealii::SparsityPattern &FittedProblem::sparsity() const
  {
    return pattern;
  }

  const CellTables &FittedProblem::tables(unsigned int layer) const
  {
    return at_centre && layer == 0 ? *at_centre : regular;
  }

  SourceField FittedProblem::source(unsigned int interval, double time) const
  {
    if(interval != 0 || !laws.power)
      return {};
    return SourceField::of(rays.surface.exponent, laws.power(time),
                           laws.phases[0].conductivity, rays.outer);
  }

  CellPhysics FittedProblem::cell_physics(unsigned int layer, double time) const
  {
    const unsigned int interval = rays.layers[layer].interval;
    CellPhysics result;
    result.phase = phase(interval);
    result.source = source(interval, time);
    result.displacement = interval == 1 ? laws.displacement : 0;
    result.time_rate = laws.clock.rate(laws.clock.clock(time));
    return result;
  }

  std::vector<unsigned int> FittedProblem::nodes_of(unsigned int surface_cell,
                                                    unsigned int layer) const
  {
    std::vector<unsigned int> nodes;
    const unsigned int degree = rays.surface.degree;
    for(const unsigned int ray : rays.surface.cells[surface_cell])
      for(unsigned int b = 0; b <= degree; ++b)
        nodes.push_back(rays.node(ray, layer * degree + b));
    return nodes;
  }

  double FittedProblem::coordinate(unsigned int ray, unsigned int level,
                                   const Vector<double> &u) const
  {
    double r = places[level].fixed;
    for(const auto &[front, carried] : places[level].carried)
      r += carried * u[rays.front_node(ray, front)];
    return r;
  }

  double FittedProblem::theta(unsigned int interval, unsigned int ray, unsigned int level,
                              double time, const Vector<double> &u) const
  {
    const unsigned int node = rays.node(ray, level);
    return rays.front_at(level) == RayMesh::none ? u[node]
                                                 : -source(interval, time).value(u[node]);
  }

  CellState FittedProblem::cell_state(unsigned int surface_cell, unsigned int layer,
                                      double time, const Vector<double> &u,
                                      const Vector<double> &rate) const
  {
    const std::vector<unsigned int> &cell = rays.surface.cells[surface_cell];
    const unsigned int degree = rays.surface.degree;
    const unsigned int interval = rays.layers[layer].interval;
    CellState state;
    for(const unsigned int front : rays.fronts_of(interval))
    {
      state.front.emplace_back(cell.size());
      state.front_rate.emplace_back(cell.size());
      for(std::size_t a = 0; a < cell.size(); ++a)
      {
        state.front.back()[a] = u[rays.front_node(cell[a], front)];
        state.front_rate.back()[a] = rate[rays.front_node(cell[a], front)];
      }
    }
    state.temperature.resize(cell.size() * (degree + 1));
    for(std::size_t a = 0; a < cell.size(); ++a)
      for(unsigned int b = 0; b <= degree; ++b)
        state.temperature[a * (degree + 1) + b]
            = theta(interval, cell[a], layer * degree + b, time, u);
    return state;
  }

  double FittedProblem::wall_excess(bool inner, unsigned int ray, double time,
                                    const Vector<double> &u) const
  {
    const Wall &wall = walls[inner ? 0 : 1];
    return u[rays.node(ray, wall.level)] + source(wall.interval, time).value(wall.r);
  }

  cases::EffectCost FittedProblem::effect_cost(cases::Effect effect) const
  {
    const Meter &meter = meters[static_cast<std::size_t>(effect)];
    long calls = meter.calls;
    std::vector<unsigned int> rows;
    std::size_t bytes = 0;
    switch(effect)
    {
    case cases::Effect::wall_temperature:
      for(const Wall &wall : walls)
        for(unsigned int ray = 0;
            wall.first_account != RayMesh::none && ray < rays.surface.n_rays(); ++ray)
          rows.push_back(wall.first_account + ray);
      break;
    case cases::Effect::wall_flux:
    case cases::Effect::robin_wall:
    case cases::Effect::radiating_wall:
      rows.push_back(flux_account);
      break;
    case cases::Effect::heat_sources:
      rows.push_back(source_account);
      if(at_centre)
        bytes += sizeof(double)
                 * (at_centre->value.size() + at_centre->across.size()
                    + at_centre->rays.size());
      break;
    case cases::Effect::volumetric_source:
      rows.push_back(volumetric_account);
      break;
    case cases::Effect::liquid_motion:
      rows.push_back(outflow_account);
      break;
    case cases::Effect::phase_change:
      for(unsigned int front = 0; front < rays.n_fronts(); ++front)
        for(unsigned int ray = 0; ray < rays.surface.n_rays(); ++ray)
          rows.push_back(rays.front_node(ray, front));
      break;
    case cases::Effect::phase_conductivity:
    case cases::Effect::phase_heat_capacity:
    case cases::Effect::metastable_phase:
      // Values in the same integrals: no memory and no time of their own.
      calls = assemblies_of_both_phases;
      break;
    default:
      break;
    }
    // Of an unknown of its own: its value and its row in the pattern and three Jacobians.
    for(const unsigned int row : rows)
      if(row != RayMesh::none)
        bytes += sizeof(double)
                 + pattern.row_length(row) * (sizeof(unsigned int) + 3 * sizeof(double));
    return {effect, calls, static_cast<long>(bytes), meter.seconds};
  }

  Vector<double> FittedProblem::scale(const Vector<double> &) const
  {
    Vector<double> result(n_unknowns);
    const int m = rays.surface.exponent;
    const double volume = total_measure
                          * (std::pow(rays.outer, m + 1) - std::pow(rays.inner, m + 1))
                          / (m + 1);
    double density = 0;
    for(const Phase &phase : laws.phases)
      density = std::max(density, phase.latent + phase.capacity * laws.temperature_scale);
    for(unsigned int i = 0; i < n_unknowns; ++i)
      result[i] = i < rays.n_nodes() ? laws.temperature_scale : density * volume;
    for(unsigned int front = 0; front < rays.n_fronts(); ++front)
      for(unsigned int ray = 0; ray < rays.surface.n_rays(); ++ray)
        result[rays.front_node(ray, front)] = rays.outer - rays.inner;
    return result;
  }

  std::string FittedProblem::reason_invalid(const Vector<double> &u) const
  {
    for(const double value : u)
      if(!std::isfinite(value))
        return "a value is not finite";
    const double margin = closest * (rays.outer - rays.inner);
    const unsigned int n = rays.n_fronts();
    // Each interval that a front begins, or the outer wall.
    for(unsigned int ray = 0; n > 0 && ray < rays.surface.n_rays(); ++ray)
    {
      double before = rays.inner;
      for(unsigned int front = 0; front <= n; ++front)
      {
        const double h = front < n ? u[rays.front_node(ray, front)] : rays.outer;
        if(h > before + margin)
        {
          before = h;
          continue;
        }
        if(front > 0 && front < n)
          return fmt::format("the fronts at r = {:.6g} and {:.6g} have met", before, h);
        return fmt::format("the front at r = {:.6g} has reached the wall at {:g}",
                           front == 0 ? h : before, front == 0 ? rays.inner : rays.outer);
      }
    }
    return reason_inverted(u);
  }

  /** Between the rays a front is a polynomial, which may pass a wall or another front. */
  std::string FittedProblem::reason_inverted(const Vector<double> &u) const
  {
    for(const auto &cell : rays.surface.cells)
      for(Eigen::Index q = 0; q < surface_rule.value.rows(); ++q)
      {
        double before = rays.inner;
        for(unsigned int front = 0; front < rays.n_fronts(); ++front)
        {
          double h = 0;
          for(std::size_t a = 0; a < cell.size(); ++a)
            h += surface_rule.value(q, a) * u[rays.front_node(cell[a], front)];
          if(!(h > before && h < rays.outer))
            return "an element is inverted";
          before = h;
        }
      }
    return {};
  }

  /**
   * By the polynomial in r through values next to the source, at Chebyshev points, from
   * which rounding of the values grows by a factor of 2 on the way to r = 0.
   */
  double FittedProblem::theta_at_centre(
      double time, double nearest,
      const std::function<double(const cases::Position &)> &temperature) const
  {
    constexpr int points = 6;
    const SourceField field = source(0, time);
    std::vector<double> places;
    for(int k = 0; k < points; ++k)
      places.push_back(
          nearest * std::pow(std::sin((2 * k + 1) * std::numbers::pi / (4 * points)), 2));
    const std::vector<double> weights = lagrange_weights(places, 0);
    double sum = 0;
    for(int k = 0; k < points; ++k)
      sum += weights[k]
             * (temperature(rays.position(0, places[k])) - laws.melting_temperature
                - field.value(places[k]));
    return sum;
  }

  Vector<double> FittedProblem::state(
      double time, const std::vector<double> &fronts,
      const std::function<double(const cases::Position &)> &temperature) const
  {
    Vector<double> u(n_unknowns);
    const unsigned int n_rays = rays.surface.n_rays();
    for(unsigned int front = 0; front < rays.n_fronts(); ++front)
      for(unsigned int ray = 0; ray < n_rays; ++ray)
        u[rays.front_node(ray, front)] = fronts[front * n_rays + ray];
    for(unsigned int ray = 0; ray < n_rays; ++ray)
      for(unsigned int level = 0; level < rays.n_levels(); ++level)
      {
        if(rays.front_at(level) != RayMesh::none)
          continue;
        const double r = coordinate(ray, level, u);
        const SourceField field = source(rays.interval_of(level), time);
        // The temperature is singular at a source, the rest of it is not.
        if(field.strength != 0 && r == 0)
          continue;
        u[rays.node(ray, level)] = temperature(rays.position(ray, r))
                                   - laws.melting_temperature - field.value(r);
      }
    if(laws.power)
      u[rays.node(0, 0)] = theta_at_centre(time, coordinate(0, 1, u), temperature);
    return u;
  }

  HeatContent FittedProblem::heat(double time, const Vector<double> &u) const
  {
    HeatContent result;
    const Vector<double> rate(n_unknowns);
    for(unsigned int l = 0; l < rays.layers.size(); ++l)
    {
      const CellPhysics physics = cell_physics(l, time);
      for(unsigned int s = 0; s < rays.surface.cells.size(); ++s)
      {
        const CellState state = cell_state(s, l, time, u, rate);
        const CellIntegrals integrals(tables(l), s, rays.layers[l], rays.surface, physics,
                                      state);
        result.sensible += integrals.sensible_heat();
        result.latent += physics.phase.latent * integrals.volume();
      }
    }
    for(const Wall &wall : walls)
      for(unsigned int ray = 0;
          wall.first_account != RayMesh::none && ray < rays.surface.n_rays(); ++ray)
        result.walls += u[wall.first_account + ray];
    for(const unsigned int account : {flux_account, outflow_account})
      if(account != RayMesh::none)
        result.walls += u[account];
    for(const unsigned int account : {source_account, volumetric_account})
      if(account != RayMesh::none)
        result.sources += u[account];
    return result;
  }
} // namespace meltfront::reference_fem::fitted
