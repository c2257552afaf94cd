#include <reference_fem/fitted/fitted_problem.h>

#include <cases/stopwatch.h>

#include <cmath>
#include <utility>

namespace meltfront::reference_fem::fitted
{
  using cases::BoundaryKind;
  using dealii::Vector;

  namespace
  {
    cases::Effect effect_of(BoundaryKind wall)
    {
      return wall == BoundaryKind::flux        ? cases::Effect::wall_flux
             : wall == BoundaryKind::radiation ? cases::Effect::radiating_wall
                                               : cases::Effect::robin_wall;
    }
  } // namespace

  struct FittedProblem::Matrices
  {
    dealii::SparseMatrix<double> &mass, &flow, &rate;
  };

  /** Counts a call of an effect's code and adds its time. */
  struct FittedProblem::Metered
  {
    Metered(const FittedProblem &problem, cases::Effect effect)
      : meter(problem.meters[static_cast<std::size_t>(effect)])
      , timer(meter.seconds)
    {
      ++meter.calls;
    }

    Meter &meter;
    cases::ScopedTimer timer;
  };

  void FittedProblem::assemble(double clock, const Vector<double> &u,
                               const Vector<double> &rate, Vector<double> &mass,
                               Vector<double> &flow, Matrices *matrices) const
  {
    const double time = laws.clock.time(clock);
    assemblies_of_both_phases += rays.has_front();
    mass.reinit(n_unknowns);
    flow.reinit(n_unknowns);
    for(unsigned int l = 0; l < rays.layers.size(); ++l)
    {
      CellPhysics physics = cell_physics(l, time);
      physics.time_rate = laws.clock.rate(clock);
      for(unsigned int s = 0; s < rays.surface.cells.size(); ++s)
      {
        const CellState state = cell_state(s, l, time, u, rate);
        const CellIntegrals integrals(tables(l), s, rays.layers[l], rays.surface, physics,
                                      state);
        const CellVectors local = integrals.vectors();
        const std::vector<unsigned int> nodes = nodes_of(s, l);
        for(std::size_t i = 0; i < nodes.size(); ++i)
        {
          mass[nodes[i]] += local.mass[i];
          flow[nodes[i]] += local.flow[i];
        }
        if(matrices)
          scatter(s, l, time, u, integrals.matrices(), *matrices);
        if(volumetric_account != RayMesh::none)
          add_volumetric_source(s, l, time, integrals, flow, matrices);
      }
    }
    add_walls(clock, u, mass, flow, matrices);
    if(outflow_account != RayMesh::none)
    {
      mass[outflow_account] -= u[outflow_account];
      if(matrices)
        matrices->mass.add(outflow_account, outflow_account, -1);
      const Metered meter(*this, cases::Effect::liquid_motion);
      add_outflow(u, rate, flow, matrices);
    }
  }

  void FittedProblem::scatter(unsigned int surface_cell, unsigned int layer, double time,
                              const Vector<double> &u, const CellMatrices &local,
                              Matrices &matrices) const
  {
    const std::vector<unsigned int> &cell = rays.surface.cells[surface_cell];
    const std::vector<unsigned int> nodes = nodes_of(surface_cell, layer);
    const unsigned int per_ray = rays.surface.degree + 1;
    const unsigned int interval = rays.layers[layer].interval;
    const SourceField field = source(interval, time);
    for(std::size_t i = 0; i < nodes.size(); ++i)
      for(std::size_t j = 0; j < nodes.size(); ++j)
      {
        double mass = local.mass_temperature(i, j), flow = local.flow_temperature(i, j);
        const unsigned int level = layer * rays.surface.degree + j % per_ray;
        // On the front theta = -S(h).
        if(rays.front_at(level) != RayMesh::none)
        {
          const double factor = -field.slope(u[nodes[j]]);
          mass *= factor;
          flow *= factor;
        }
        matrices.mass.add(nodes[i], nodes[j], mass);
        matrices.flow.add(nodes[i], nodes[j], flow);
      }
    if(!rays.has_front())
      return;
    const Metered meter(*this, cases::Effect::phase_change);
    const std::vector<unsigned int> fronts = rays.fronts_of(interval);
    for(std::size_t k = 0; k < fronts.size(); ++k)
      for(std::size_t i = 0; i < nodes.size(); ++i)
        for(std::size_t a = 0; a < cell.size(); ++a)
        {
          const unsigned int column = rays.front_node(cell[a], fronts[k]);
          matrices.mass.add(nodes[i], column, local.fronts[k].mass(i, a));
          matrices.flow.add(nodes[i], column, local.fronts[k].flow(i, a));
          matrices.rate.add(nodes[i], column, local.fronts[k].flow_rate(i, a));
        }
  }

  void FittedProblem::add_walls(double clock, const Vector<double> &u,
                                Vector<double> &mass, Vector<double> &flow,
                                Matrices *matrices) const
  {
    for(const Wall &wall : walls)
    {
      if(wall.boundary && cases::prescribes_heat(wall.boundary->kind))
      {
        const Metered meter(*this, effect_of(wall.boundary->kind));
        add_flux(wall, clock, u, flow, matrices);
      }
      if(wall.first_account != RayMesh::none)
      {
        const Metered meter(*this, cases::Effect::wall_temperature);
        add_fixed_temperature(wall, laws.clock.time(clock), u, mass, flow, matrices);
      }
    }
    if(source_account != RayMesh::none)
    {
      const Metered meter(*this, cases::Effect::heat_sources);
      add_source(clock, flow);
    }
    for(const unsigned int account : {flux_account, source_account, volumetric_account})
      if(account != RayMesh::none)
      {
        mass[account] -= u[account];
        if(matrices)
          matrices->mass.add(account, account, -1);
      }
  }

  void FittedProblem::add_fixed_temperature(const Wall &wall, double time,
                                            const Vector<double> &u, Vector<double> &mass,
                                            Vector<double> &flow,
                                            Matrices *matrices) const
  {
    const double field = source(wall.interval, time).value(wall.r);
    for(unsigned int ray = 0; ray < rays.surface.n_rays(); ++ray)
    {
      const unsigned int node = rays.node(ray, wall.level);
      const unsigned int account = wall.first_account + ray;
      mass[node] -= u[account];
      flow[account] = wall.boundary->value(rays.position(ray, wall.r), time)
                      - laws.melting_temperature - field - u[node];
      if(matrices)
      {
        matrices->mass.add(node, account, -1);
        matrices->flow.add(account, node, -1);
      }
    }
  }

  void FittedProblem::add_source(double clock, Vector<double> &flow) const
  {
    const double heat = laws.clock.rate(clock) * laws.power(laws.clock.time(clock));
    flow[rays.node(0, 0)] += heat;
    flow[source_account] -= heat;
  }

  void FittedProblem::add_flux(const Wall &wall, double clock, const Vector<double> &u,
                               Vector<double> &flow, Matrices *matrices) const
  {
    const double time = laws.clock.time(clock);
    const double area = laws.clock.rate(clock) * std::pow(wall.r, rays.surface.exponent);
    const double field
        = laws.melting_temperature + source(wall.interval, time).value(wall.r);
    for(std::size_t s = 0; s < rays.surface.cells.size(); ++s)
    {
      const SurfaceRule::Cell &cell = surface_rule.cells[s];
      std::vector<unsigned int> nodes;
      for(const unsigned int ray : rays.surface.cells[s])
        nodes.push_back(rays.node(ray, wall.level));
      for(std::size_t q = 0; q < cell.points.size(); ++q)
      {
        cases::Position position{};
        for(int d = 0; d < 3; ++d)
          position[d] = cell.points[q].base[d] + wall.r * cell.points[q].direction[d];
        double temperature = field;
        for(std::size_t a = 0; a < nodes.size(); ++a)
          temperature += surface_rule.value(q, a) * u[nodes[a]];
        const cases::HeatThroughWall through
            = cases::heat_through(*wall.boundary, position, time, temperature);
        const double weight = cell.weight[q] * area;
        for(std::size_t a = 0; a < nodes.size(); ++a)
          flow[nodes[a]] += weight * through.flux * surface_rule.value(q, a);
        flow[flux_account] -= weight * through.flux;
        if(!matrices || through.slope == 0)
          continue;
        for(std::size_t b = 0; b < nodes.size(); ++b)
        {
          const double by_b = weight * through.slope * surface_rule.value(q, b);
          for(std::size_t a = 0; a < nodes.size(); ++a)
            matrices->flow.add(nodes[a], nodes[b], surface_rule.value(q, a) * by_b);
          matrices->flow.add(flux_account, nodes[b], -by_b);
        }
      }
    }
  }

  void FittedProblem::add_volumetric_source(unsigned int surface_cell, unsigned int layer,
                                            double time, const CellIntegrals &integrals,
                                            Vector<double> &flow,
                                            Matrices *matrices) const
  {
    const Metered meter(*this, cases::Effect::volumetric_source);
    const std::vector<SurfacePoint> &along = surface_points(surface_cell);
    const Eigen::Index across = tables(layer).line.points.size();
    // Of the derivative by the front, which Newton's method takes, six digits suffice.
    const double step = matrices ? 1e-6 * (rays.outer - rays.inner) : 0;
    Eigen::ArrayXd released(integrals.r.size()), slope(integrals.r.size());
    for(Eigen::Index q = 0; q < released.size(); ++q)
    {
      const SurfacePoint &point = along[q / across];
      const auto density = [&](double r)
      {
        cases::Position place{};
        for(int d = 0; d < 3; ++d)
          place[d] = point.base[d] + r * point.direction[d];
        return laws.volumetric_source(place, time);
      };
      released[q] = density(integrals.r[q]);
      if(matrices)
        slope[q] = (density(integrals.r[q] + step) - density(integrals.r[q] - step))
                   / (2 * step);
    }
    const Eigen::VectorXd local = integrals.source_flow(released);
    const std::vector<unsigned int> nodes = nodes_of(surface_cell, layer);
    for(std::size_t i = 0; i < nodes.size(); ++i)
      flow[nodes[i]] += local[i];
    flow[volumetric_account] -= local.sum();
    if(!matrices)
      return;
    const std::vector<unsigned int> &cell = rays.surface.cells[surface_cell];
    const std::vector<unsigned int> fronts = rays.fronts_of(rays.layers[layer].interval);
    for(std::size_t k = 0; k < fronts.size(); ++k)
    {
      const Eigen::MatrixXd by_front = integrals.source_flow_front(k, released, slope);
      for(std::size_t a = 0; a < cell.size(); ++a)
      {
        const unsigned int column = rays.front_node(cell[a], fronts[k]);
        for(std::size_t i = 0; i < nodes.size(); ++i)
          matrices->flow.add(nodes[i], column, by_front(i, a));
        matrices->flow.add(volumetric_account, column, -by_front.col(a).sum());
      }
    }
  }

  /** What liquid takes along through the outer wall; one ray only. */
  void FittedProblem::add_outflow(const Vector<double> &u, const Vector<double> &rate,
                                  Vector<double> &flow, Matrices *matrices) const
  {
    const unsigned int front = rays.front_node(0);
    const unsigned int node = rays.node(0, walls[1].level);
    const int exponent = rays.surface.exponent;
    const double volume_by_rate
        = total_measure * laws.displacement * std::pow(u[front], exponent);
    const double volume = volume_by_rate * rate[front];
    const double heat = laws.phases[1].latent + laws.phases[1].capacity * u[node];
    flow[node] -= heat * volume;
    flow[outflow_account] += heat * volume;
    if(!matrices)
      return;
    for(const auto &[row, sign] : {std::pair(node, -1.), std::pair(outflow_account, 1.)})
    {
      matrices->flow.add(row, node, sign * laws.phases[1].capacity * volume);
      if(exponent > 0)
        matrices->flow.add(row, front, sign * heat * volume * exponent / u[front]);
      matrices->rate.add(row, front, sign * heat * volume_by_rate);
    }
  }

  void FittedProblem::evaluate(double clock, const Vector<double> &u,
                               const Vector<double> &rate, Vector<double> &mass,
                               Vector<double> &flow) const
  {
    assemble(clock, u, rate, mass, flow, nullptr);
  }

  void FittedProblem::linearise(double clock, const Vector<double> &u,
                                const Vector<double> &rate, Vector<double> &mass,
                                Vector<double> &flow, dealii::SparseMatrix<double> &by_u,
                                dealii::SparseMatrix<double> &flow_by_u,
                                dealii::SparseMatrix<double> &flow_by_rate) const
  {
    by_u = 0;
    flow_by_u = 0;
    flow_by_rate = 0;
    Matrices matrices{by_u, flow_by_u, flow_by_rate};
    assemble(clock, u, rate, mass, flow, &matrices);
  }
} // namespace meltfront::reference_fem::fitted
