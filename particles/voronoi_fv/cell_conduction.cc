#include <cases/stopwatch.h>
#include <particles/voronoi_fv/cell_conduction.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace meltfront::particles
{
  using cases::BoundaryKind;

  CellConduction::CellConduction(const cases::Scene &scene, const NodeSet &nodes,
                                 VoronoiCells found, SourcePoint source_point)
    : scene(scene)
    , given(scene)
    , nodes(nodes)
    , cells(std::move(found))
    , source_point(source_point)
    , fixed(nodes.size())
    , balanced(cells.volumes)
  {
    std::vector<double> conductivity(nodes.size());
    {
      const cases::ScopedTimer timer(inclusion_seconds);
      for(std::size_t i = 0; i < nodes.size(); ++i)
        conductivity[i] = scene.conductivity_at(nodes.point(i));
    }
    for(std::size_t i = 0; i < nodes.size(); ++i)
    {
      if(nodes.sides[i] != 0)
        fixed[i] = wall_condition(scene, nodes, i);
      if(fixed[i].fixed)
        balanced[i] = 0;
    }
    // As large as the other rows of a lattice.
    fixed_row = scene.material.solid.conductivity;
    for(int d = 2; d < nodes.positions.dimension; ++d)
      fixed_row *= nodes.spacing;
    if(nodes.positions.dimension == 1)
      fixed_row /= nodes.spacing;
    find_contacts(conductivity);
    find_wall_faces();
  }

  void CellConduction::find_contacts(const std::vector<double> &conductivity)
  {
    for(const CellFace &face : cells.faces)
    {
      const cases::Position a = nodes.point(face.first), b = nodes.point(face.second);
      const double distance = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
      const double ka = conductivity[face.first], kb = conductivity[face.second];
      const double mean = ka == kb ? ka : 2 * ka * kb / (ka + kb);
      conductance.push_back(mean * face.area / distance);
      if(fixed[face.first].fixed != fixed[face.second].fixed)
      {
        const bool first_is_free = fixed[face.second].fixed;
        contacts.push_back({first_is_free ? face.first : face.second,
                            first_is_free ? face.second : face.first,
                            conductance.back()});
      }
    }
  }

  void CellConduction::find_wall_faces()
  {
    for(const CellWall &wall : cells.walls)
    {
      const cases::Boundary &boundary
          = scene.boundary(static_cast<cases::Side>(wall.side));
      const bool open = boundary.kind == BoundaryKind::flux
                        || boundary.kind == BoundaryKind::heat_transfer;
      if(open && !fixed[wall.cell].fixed)
        wall_faces.push_back({wall.cell, &boundary, wall.area});
    }
  }

  CompressedRows CellConduction::operator_rows() const
  {
    const std::size_t n = nodes.size();
    std::vector<std::vector<std::uint32_t>> columns(n);
    std::vector<std::vector<double>> values(n);
    std::vector<double> diagonal(n, 0.);
    for(std::size_t f = 0; f < cells.faces.size(); ++f)
    {
      const std::uint32_t a = cells.faces[f].first, b = cells.faces[f].second;
      diagonal[a] -= conductance[f];
      diagonal[b] -= conductance[f];
      if(fixed[a].fixed || fixed[b].fixed)
        continue;
      columns[a].push_back(b);
      values[a].push_back(conductance[f]);
      columns[b].push_back(a);
      values[b].push_back(conductance[f]);
    }
    for(const WallFace &face : wall_faces)
      diagonal[face.cell] -= face.boundary->heat_transfer_coefficient * face.area;
    CompressedRows rows;
    std::vector<std::uint32_t> scratch;
    for(std::size_t i = 0; i < n; ++i)
    {
      columns[i].push_back(static_cast<std::uint32_t>(i));
      values[i].push_back(fixed[i].fixed ? -fixed_row : diagonal[i]);
      rows.add_row(columns[i], values[i], scratch);
    }
    return rows;
  }

  CompressedRows CellConduction::mass() const
  {
    const double capacity = scene.material.solid.volumetric_heat_capacity();
    CompressedRows rows;
    for(std::size_t i = 0; i < nodes.size(); ++i)
    {
      if(!fixed[i].fixed)
      {
        rows.columns.push_back(static_cast<std::uint32_t>(i));
        rows.coefficients.push_back(capacity * balanced[i]);
      }
      rows.offsets.push_back(rows.columns.size());
    }
    return rows;
  }

  double CellConduction::wall_temperature(std::uint32_t node,
                                          const LinearStep &step) const
  {
    return fixed[node].value(nodes.point(node), step, given);
  }

  cases::Position CellConduction::release_point(std::size_t cell) const
  {
    return source_point == SourcePoint::particle ? nodes.point(cell)
                                                 : cells.centroids.point(cell);
  }

  void CellConduction::set_source(const LinearStep &step, std::span<double> source) const
  {
    ++evaluations;
    std::ranges::fill(source, 0.);
    if(scene.volumetric_source)
      set_release(step, source);
    set_walls(step, source);
  }

  void CellConduction::set_release(const LinearStep &step, std::span<double> source) const
  {
    const cases::ScopedTimer timer(release_seconds);
    for(std::size_t i = 0; i < nodes.size(); ++i)
      source[i] = given.release(release_point(i), step) * balanced[i];
  }

  void CellConduction::set_walls(const LinearStep &step, std::span<double> source) const
  {
    const cases::ScopedTimer timer(wall_seconds);
    for(std::size_t i = 0; i < nodes.size(); ++i)
      if(fixed[i].fixed)
        source[i] = fixed_row * wall_temperature(static_cast<std::uint32_t>(i), step);
    for(const Contact &contact : contacts)
      source[contact.free] += contact.conductance * source[contact.fixed] / fixed_row;
    for(const WallFace &face : wall_faces)
    {
      const double value = given.wall(*face.boundary, nodes.point(face.cell), step);
      source[face.cell] += face.area * value
                           * (face.boundary->kind == BoundaryKind::flux
                                  ? 1
                                  : face.boundary->heat_transfer_coefficient);
    }
  }

  HeatInflow CellConduction::inflow(const LinearStep &step,
                                    std::span<const double> temperature) const
  {
    HeatInflow result;
    if(scene.volumetric_source)
      for(std::size_t i = 0; i < nodes.size(); ++i)
      {
        const double heat = given.release(release_point(i), step) * cells.volumes[i];
        result.released += heat;
        // What a cell of fixed temperature releases leaves through its wall.
        result.through_walls -= fixed[i].fixed ? heat : 0;
      }
    for(const Contact &contact : contacts)
      result.through_walls
          += contact.conductance
             * (wall_temperature(contact.fixed, step) - temperature[contact.free]);
    for(const WallFace &face : wall_faces)
    {
      const double value = given.wall(*face.boundary, nodes.point(face.cell), step);
      result.through_walls += face.area
                              * (face.boundary->kind == BoundaryKind::flux
                                     ? value
                                     : face.boundary->heat_transfer_coefficient
                                           * (value - temperature[face.cell]));
    }
    return result;
  }

  std::vector<cases::EffectCost>
  CellConduction::effect_costs(const cases::EffectSet &effects) const
  {
    using cases::Effect;
    std::vector<cases::EffectCost> costs;
    if(effects.contains(Effect::volumetric_source))
      costs.push_back({Effect::volumetric_source, evaluations, 0, release_seconds});
    if(effects.contains(Effect::inclusion))
      costs.push_back({Effect::inclusion, 1, 0, inclusion_seconds});
    // One pass serves all walls: its time and memory are shared evenly.
    std::vector<Effect> walls;
    for(const Effect effect :
        {Effect::wall_temperature, Effect::wall_flux, Effect::robin_wall})
      if(effects.contains(effect))
        walls.push_back(effect);
    const std::size_t bytes = fixed.size() * sizeof(WallCondition)
                              + contacts.size() * sizeof(Contact)
                              + wall_faces.size() * sizeof(WallFace);
    for(const Effect effect : walls)
      costs.push_back({effect, evaluations, static_cast<long>(bytes / walls.size()),
                       wall_seconds / static_cast<double>(walls.size())});
    return costs;
  }

  LinearProblem CellConduction::problem() const
  {
    LinearProblem result;
    result.operator_rows = operator_rows();
    result.mass = mass();
    result.symmetric = true;
    result.source = [this](const LinearStep &step, std::span<double> source)
    { set_source(step, source); };
    result.inflow = [this](const LinearStep &step, std::span<const double> temperature)
    { return inflow(step, temperature); };
    return result;
  }
} // namespace meltfront::particles
