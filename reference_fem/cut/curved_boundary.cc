#include <reference_fem/cut/background_mesh.h>
#include <reference_fem/cut/quadrature.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem::cut
{
  namespace
  {
    /** Positive beyond the rim: distance to it (m). */
    double beyond_rim(const cases::Domain &domain, const Point &point)
    {
      const double outer = point.norm() - domain.radius;
      return domain.shape == cases::DomainShape::shell
                 ? std::max(outer, domain.inner_radius - point.norm())
                 : outer;
    }

    /** Move points of a cell to a larger one that holds it. */
    template <typename CellPoint>
    void add_points(const Cell &cell, const std::vector<CellPoint> &points,
                    const Cell &larger, std::vector<CellPoint> &result)
    {
      for(CellPoint point : points)
      {
        point.unit = larger.unit(cell.real(point.unit));
        result.push_back(point);
      }
    }
  } // namespace

  RefinementCriterion divided_at_rim(const cases::Domain &domain)
  {
    return [domain](const Point &lower, const Gradient &size)
    {
      // Half a cell is added on each side: the level set of a cell beside the rim is not
      // to be in doubt.
      Point nearest, farthest;
      for(int d = 0; d < dim; ++d)
      {
        const double first = lower[d] - size[d] / 2, last = lower[d] + 1.5 * size[d];
        nearest[d] = std::clamp(0., first, last);
        farthest[d] = std::max(std::abs(first), std::abs(last));
      }
      const auto cut = [&](double radius)
      { return nearest.norm() <= radius && radius <= farthest.norm(); };
      return cut(domain.radius)
             || (domain.shape == cases::DomainShape::shell && cut(domain.inner_radius));
    };
  }

  void BackgroundMesh::cut_rim()
  {
    Values beyond(level_set_dofs.n_dofs());
    for(std::size_t i = 0; i < beyond.size(); ++i)
      beyond[i] = beyond_rim(domain, level_set_positions[i]);
    distribute_level_set(beyond);
    CutIntegrator integrator(*this, beyond);
    const double middle = (domain.inner_radius + domain.radius) / 2;
    for(unsigned int cell = 0; cell < cells.size(); ++cell)
      switch(integrator.sides()[cell])
      {
      case CutIntegrator::Side::inside:
        break;
      case CutIntegrator::Side::outside:
        place[cell] = Place::outside;
        break;
      case CutIntegrator::Side::cut:
        CutQuadrature quadrature = integrator.integrate(cell);
        if(quadrature.inside.empty())
        {
          place[cell] = Place::outside;
          break;
        }
        place[cell] = Place::on_rim;
        const bool outer = cells[cell].real({0.5, 0.5}).norm() > middle;
        curved_boundary_cells.push_back(
            {cell, outer ? cases::Side::outer : cases::Side::inner,
             std::move(quadrature.inside), std::move(quadrature.surface)});
      }
  }

  void BackgroundMesh::take_rim(const BackgroundMesh &finest_rim)
  {
    std::vector<const CurvedBoundaryCell *> cut(finest_rim.cells.size());
    for(const CurvedBoundaryCell &rim : finest_rim.curved_boundary_cells)
      cut[rim.cell] = &rim;
    // Of each cell, those of the other mesh that lie in it or hold it.
    std::vector<std::vector<unsigned int>> others(cells.size());
    for(unsigned int other = 0; other < finest_rim.cells.size(); ++other)
    {
      const Cell &cell = finest_rim.cells[other];
      const unsigned int here = cell_at(cell.real({0.5, 0.5}));
      if(cells[here].width() > 0.75 * cell.width())
        others[here].push_back(other);
    }
    for(unsigned int here = 0; here < cells.size(); ++here)
    {
      if(others[here].empty())
        others[here].push_back(finest_rim.cell_at(cells[here].real({0.5, 0.5})));
      const auto all = [&](Place wanted)
      {
        return std::ranges::all_of(others[here], [&](unsigned int other)
                                   { return finest_rim.place[other] == wanted; });
      };
      place[here] = all(Place::inside)    ? Place::inside
                    : all(Place::outside) ? Place::outside
                                          : Place::on_rim;
      if(place[here] != Place::on_rim)
        continue;
      CurvedBoundaryCell rim{here, cases::Side::outer, {}, {}};
      for(const unsigned int other : others[here])
      {
        const Cell &cell = finest_rim.cells[other];
        if(finest_rim.place[other] == Place::inside)
          add_points(cell, whole_cell(cell, element.degree + 1), cells[here], rim.volume);
        if(!cut[other])
          continue;
        rim.side = cut[other]->side;
        add_points(cell, cut[other]->volume, cells[here], rim.volume);
        add_points(cell, cut[other]->rim, cells[here], rim.rim);
      }
      curved_boundary_cells.push_back(std::move(rim));
    }
  }
} // namespace meltfront::reference_fem::cut
