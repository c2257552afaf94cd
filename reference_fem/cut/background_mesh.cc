#include <reference_fem/cut/background_mesh.h>

#include <cases/error.h>
#include <reference_fem/cut/quadrature.h>

#include <deal.II/base/multithread_info.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/grid/grid_generator.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meltfront::reference_fem::cut
{
  using cases::DomainShape;

  cases::Position position(const Point &point)
  {
    return {point[0], point[1], 0};
  }

  Point Cell::real(const Point &unit) const
  {
    return {lower[0] + unit[0] * size[0], lower[1] + unit[1] * size[1]};
  }

  Point Cell::unit(const Point &real) const
  {
    return {(real[0] - lower[0]) / size[0], (real[1] - lower[1]) / size[1]};
  }

  double Cell::volume() const
  {
    return size[0] * size[1];
  }

  double Cell::width() const
  {
    return std::min(size[0], size[1]);
  }

  namespace
  {
    /** Positive beyond the rim: distance to it (m). */
    double beyond_rim(const cases::Domain &domain, const Point &point)
    {
      const double outer = point.norm() - domain.radius;
      return domain.shape == DomainShape::shell
                 ? std::max(outer, domain.inner_radius - point.norm())
                 : outer;
    }

    void make_cartesian_mesh(const cases::Domain &domain, int n,
                             dealii::Triangulation<dim> &triangulation)
    {
      if(domain.dimension != dim)
        throw cases::Refusal("fem-cut simulates boxes, disks and annuli in two "
                             "dimensions: no slabs, and not in three dimensions");
      Point lower{-domain.radius, -domain.radius}, upper{domain.radius, domain.radius};
      if(!domain.round())
        for(int d = 0; d < dim; ++d)
        {
          lower[d] = domain.lower[d];
          upper[d] = domain.upper[d];
        }
      std::vector<unsigned int> repetitions(dim);
      const double cell = (upper[0] - lower[0]) / n;
      for(int d = 0; d < dim; ++d)
        repetitions[d] = static_cast<unsigned int>(
            std::max(1L, std::lround((upper[d] - lower[d]) / cell)));
      dealii::GridGenerator::subdivided_hyper_rectangle(triangulation, repetitions, lower,
                                                        upper, true);
    }

    std::vector<unsigned int>
    dof_indices(const dealii::DoFHandler<dim>::active_cell_iterator &cell)
    {
      std::vector<dealii::types::global_dof_index> dofs(cell->get_fe().n_dofs_per_cell());
      cell->get_dof_indices(dofs);
      return {dofs.begin(), dofs.end()};
    }

    void distribute_dofs(dealii::DoFHandler<dim> &dofs, const dealii::FE_Q<dim> &element,
                         dealii::AffineConstraints<double> &constraints)
    {
      dofs.distribute_dofs(element);
      constraints.clear();
      dealii::DoFTools::make_hanging_node_constraints(dofs, constraints);
      constraints.close();
    }

    void apply(const dealii::AffineConstraints<double> &constraints, Values &field)
    {
      for(const auto &line : constraints.get_lines())
      {
        double sum = 0;
        for(const auto &[dof, weight] : line.entries)
          sum += weight * field[dof];
        field[line.index] = sum;
      }
    }
  } // namespace

  BackgroundMesh::BackgroundMesh(const cases::Scene &scene, int n, int degree,
                                 int level_set_degree)
    : element(degree)
    , level_set_element(level_set_degree)
    , domain(scene.domain)
    , dofs(triangulation)
    , level_set_dofs(triangulation)
  {
    // Sums over threads would round differently from run to run.
    dealii::MultithreadInfo::set_thread_limit(1);
    make_cartesian_mesh(domain, n, triangulation);
    number();
  }

  void BackgroundMesh::number()
  {
    distribute_dofs(dofs, element, constraints);
    distribute_dofs(level_set_dofs, level_set_element, level_set_constraints);
    expansions.assign(dofs.n_dofs(), {});
    for(unsigned int dof = 0; dof < dofs.n_dofs(); ++dof)
      if(constraints.is_constrained(dof))
        for(const auto &[other, weight] : *constraints.get_constraint_entries(dof))
          expansions[dof].emplace_back(static_cast<unsigned int>(other), weight);
      else
        expansions[dof].emplace_back(dof, 1.);
    read_cells();
    read_faces();
    place.assign(cells.size(), Place::inside);
    rim_cells.clear();
    if(domain.round())
      cut_rim();
  }

  void BackgroundMesh::read_cells()
  {
    cells.clear();
    triangulation_cells.clear();
    spacing = std::numeric_limits<double>::infinity();
    positions.resize(dofs.n_dofs());
    level_set_positions.resize(level_set_dofs.n_dofs());
    for(const auto &cell : dofs.active_cell_iterators())
    {
      const dealii::DoFHandler<dim>::active_cell_iterator level_set_cell(
          &triangulation, cell->level(), cell->index(), &level_set_dofs);
      triangulation_cells.emplace_back(cell);
      const Point lower = cell->vertex(0);
      cells.push_back(
          {lower, cell->vertex(dealii::GeometryInfo<dim>::vertices_per_cell - 1) - lower,
           dof_indices(cell), dof_indices(level_set_cell)});
      const Cell &added = cells.back();
      spacing = std::min(spacing, added.width());
      for(unsigned int i = 0; i < added.dofs.size(); ++i)
        positions[added.dofs[i]] = added.real(element.unit_support_point(i));
      for(unsigned int i = 0; i < added.level_set_dofs.size(); ++i)
        level_set_positions[added.level_set_dofs[i]]
            = added.real(level_set_element.unit_support_point(i));
    }
  }

  void BackgroundMesh::read_faces()
  {
    inner_faces.clear();
    wall_faces.clear();
    for(const auto &cell : triangulation.active_cell_iterators())
      for(const unsigned int face : cell->face_indices())
      {
        const unsigned int here = cell->active_cell_index();
        const int direction = static_cast<int>(face) / 2;
        const bool upper = face % 2 == 1;
        if(cell->at_boundary(face))
        {
          if(!domain.round())
            wall_faces.push_back(
                {here, direction, upper, static_cast<cases::Side>(face)});
          continue;
        }
        const auto neighbor = cell->neighbor(face);
        if(!neighbor->is_active())
          continue;
        const bool coarser = cell->neighbor_is_coarser(face);
        if(coarser || here < neighbor->active_cell_index())
          inner_faces.push_back({here, neighbor->active_cell_index(), direction, upper});
      }
  }

  void BackgroundMesh::cut_rim()
  {
    Values beyond(level_set_dofs.n_dofs());
    for(std::size_t i = 0; i < beyond.size(); ++i)
      beyond[i] = beyond_rim(domain, level_set_positions[i]);
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
        rim_cells.push_back({cell, outer ? cases::Side::outer : cases::Side::inner,
                             std::move(quadrature.inside),
                             std::move(quadrature.surface)});
      }
  }

  Values BackgroundMesh::to_level_set_dofs(const Values &field) const
  {
    Values result(level_set_positions.size());
    for(const Cell &cell : cells)
      for(unsigned int i = 0; i < cell.level_set_dofs.size(); ++i)
      {
        double sum = 0;
        for(unsigned int j = 0; j < cell.dofs.size(); ++j)
          sum += field[cell.dofs[j]]
                 * element.shape_value(j, level_set_element.unit_support_point(i));
        result[cell.level_set_dofs[i]] = sum;
      }
    return result;
  }

  void BackgroundMesh::distribute(Values &field) const
  {
    apply(constraints, field);
  }

  void BackgroundMesh::distribute_level_set(Values &level_set) const
  {
    apply(level_set_constraints, level_set);
  }
} // namespace meltfront::reference_fem::cut
