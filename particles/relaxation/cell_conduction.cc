#include <particles/relaxation/cell_conduction.h>

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
    for(std::size_t i = 0; i < nodes.size(); ++i)
    {
      conductivity[i] = scene.conductivity_at(nodes.point(i));
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
    for(std::size_t i = 0; i < nodes.size(); ++i)
      if(fixed[i].fixed)
        source[i] = fixed_row * wall_temperature(static_cast<std::uint32_t>(i), step);
      else
        source[i] = scene.heat_release
                        ? given.release(release_point(i), step) * balanced[i]
                        : 0;
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
    if(scene.heat_release)
      for(std::size_t i = 0; i < nodes.size(); ++i)
        if(balanced[i] > 0)
          result.released += given.release(release_point(i), step) * balanced[i];
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
