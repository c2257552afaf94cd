#include <reference_fem/cut/transfer.h>

#include <reference_fem/cut/level_set.h>
#include <reference_fem/cut/phase_problem.h>
#include <reference_fem/cut/quadrature.h>

#include <cmath>

namespace meltfront::reference_fem::cut
{
  namespace
  {
    /** Nodes of one mesh lie at dyadic fractions of the other's cells: rounded to such,
     * shape functions are exactly one and zero where nodes coincide. */
    constexpr double fractions = 1 << 16;
  } // namespace

  Transfer::OldPoint Transfer::old_point(const Point &point) const
  {
    OldPoint result{from.cell_at(point), {}};
    result.unit = from.cells[result.cell].unit(point);
    for(int d = 0; d < dim; ++d)
      result.unit[d] = std::round(result.unit[d] * fractions) / fractions;
    return result;
  }

  Values Transfer::level_set(const Values &field) const
  {
    Values result;
    for(const Point &point : to.level_set_positions)
    {
      const OldPoint at = old_point(point);
      result.push_back(evaluate(from, from.cells[at.cell], field, at.unit).value);
    }
    to.distribute_level_set(result);
    return result;
  }

  SpeedField Transfer::speed(const SpeedField &field) const
  {
    SpeedField result{level_set(field.values),
                      std::vector<char>(to.level_set_positions.size()), field.largest};
    for(std::size_t dof = 0; dof < result.band.size(); ++dof)
    {
      const OldPoint at = old_point(to.level_set_positions[dof]);
      const std::vector<unsigned int> &dofs = from.cells[at.cell].level_set_dofs;
      for(unsigned int i = 0; i < dofs.size(); ++i)
        if(from.level_set_element.unit_support_point(i) == at.unit)
          result.band[dof] = field.band[dofs[i]];
    }
    return result;
  }

  Values Transfer::temperature(const Values &field, const CutGeometry &geometry,
                               Phase phase) const
  {
    Values result;
    for(const Point &point : to.positions)
    {
      const OldPoint at = old_point(point);
      result.push_back(field_value(from, from.cells[at.cell], field, at.unit));
    }
    to.distribute(result);
    const Values lost = this->lost(field, result, geometry, phase);
    const Values integrals = integrals_of_shapes(geometry, phase);
    for(std::size_t dof = 0; dof < result.size(); ++dof)
      if(lost[dof] != 0)
        result[dof] += lost[dof] / integrals[dof];
    to.distribute(result);
    return result;
  }

  void Transfer::add_by_shape(const Cell &cell, const Point &unit, double amount,
                              Values &result) const
  {
    for(unsigned int i = 0; i < cell.dofs.size(); ++i)
    {
      const double part = amount * to.element.shape_value(i, unit);
      for(const auto &[dof, weight] : to.expansion(cell.dofs[i]))
        result[dof] += weight * part;
    }
  }

  /** The integral over a part of a cell of the old mesh. */
  void Transfer::add_change(const Values &before, const Values &after,
                            unsigned int cell_before, unsigned int cell_after,
                            const std::vector<VolumePoint> &points, Values &result) const
  {
    const Cell &old = from.cells[cell_before], &now = to.cells[cell_after];
    const bool same = now.width() < 1.5 * old.width();
    for(const VolumePoint &point : points)
    {
      const Point unit = same ? point.unit : now.unit(old.real(point.unit));
      const double change = field_value(from, old, before, point.unit)
                            - field_value(to, now, after, unit);
      add_by_shape(now, unit, point.weight * change, result);
    }
  }

  /** By degree of freedom, the integral of the field's change with its shape function.
   * A cell that did not become larger may still have a node on the side of one that did.
   */
  Values Transfer::lost(const Values &before, const Values &after,
                        const CutGeometry &geometry, Phase phase) const
  {
    const auto middle = [](const Cell &cell) { return cell.real({0.5, 0.5}); };
    Values result(to.positions.size());
    for(unsigned int cell = 0; cell < from.cells.size(); ++cell)
    {
      const unsigned int target = to.cell_at(middle(from.cells[cell]));
      if(CutGeometry::is(geometry.location[target], phase)
         && to.cells[target].width() > 0.75 * from.cells[cell].width()
         && to.place[target] == Place::inside)
        add_change(before, after, cell, target, whole_cell(from.cells[cell]), result);
    }
    for(const CurvedBoundaryCell &rim : to.curved_boundary_cells)
    {
      const unsigned int old = from.cell_at(middle(to.cells[rim.cell]));
      if(CutGeometry::is(geometry.location[rim.cell], phase)
         && to.cells[rim.cell].width() > 0.75 * from.cells[old].width())
        add_change(before, after, old, rim.cell, rim.volume, result);
    }
    return result;
  }

  Values Transfer::integrals_of_shapes(const CutGeometry &geometry, Phase phase) const
  {
    Values result(to.positions.size());
    const auto add = [&](unsigned int cell, const std::vector<VolumePoint> &points)
    {
      for(const VolumePoint &point : points)
        add_by_shape(to.cells[cell], point.unit, point.weight, result);
    };
    for(unsigned int cell = 0; cell < to.cells.size(); ++cell)
      if(CutGeometry::is(geometry.location[cell], phase)
         && to.place[cell] == Place::inside)
        add(cell, whole_cell(to.cells[cell]));
    geometry.visit_parts(to, phase, add);
    return result;
  }
} // namespace meltfront::reference_fem::cut
