#include <reference_fem/cut/background_mesh.h>

#include <cases/error.h>
#include <deal.II/base/multithread_info.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/grid/grid_generator.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem::cut
{
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
    /** A box that holds the domain, in cells of equal size. */
    struct Box
    {
      Point lower, upper;
      std::array<unsigned int, dim> cells;
    };

    Box divided_box(const cases::Domain &domain, int n)
    {
      if(domain.dimension != dim)
        throw cases::Refusal("fem-cut simulates boxes, disks and annuli in two "
                             "dimensions: no slabs, and not in three dimensions");
      Box box{{-domain.radius, -domain.radius}, {domain.radius, domain.radius}, {}};
      if(!domain.round())
        for(int d = 0; d < dim; ++d)
        {
          box.lower[d] = domain.lower[d];
          box.upper[d] = domain.upper[d];
        }
      const double cell = (box.upper[0] - box.lower[0]) / n;
      for(int d = 0; d < dim; ++d)
        box.cells[d] = static_cast<unsigned int>(
            std::max(1L, std::lround((box.upper[d] - box.lower[d]) / cell)));
      return box;
    }

    std::array<unsigned int, dim>
    make_cartesian_mesh(const cases::Domain &domain, int n, int refinement,
                        dealii::Triangulation<dim> &triangulation)
    {
      Box box = divided_box(domain, n);
      for(unsigned int &cells : box.cells)
      {
        if(cells % (1u << refinement) != 0)
          throw cases::Refusal(fmt::format(
              "fem-cut: {} cells along a side cannot be made by dividing larger ones {} "
              "times in two (option `refinement`): a multiple of {} or refinement = 0 "
              "would be right",
              cells, refinement, 1u << refinement));
        cells >>= refinement;
      }
      dealii::GridGenerator::subdivided_hyper_rectangle(
          triangulation, std::vector<unsigned int>(box.cells.begin(), box.cells.end()),
          box.lower, box.upper, true);
      return box.cells;
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
                                 int level_set_degree, int refinement,
                                 const RefinementCriterion &divided,
                                 const BackgroundMesh *finest_rim)
    : element(degree)
    , level_set_element(level_set_degree)
    , domain(scene.domain)
    , refinement(refinement)
    , triangulation(dealii::Triangulation<dim>::limit_level_difference_at_vertices)
    , dofs(triangulation)
    , level_set_dofs(triangulation)
  {
    // Sums over threads would round differently from run to run.
    dealii::MultithreadInfo::set_thread_limit(1);
    base_cells = make_cartesian_mesh(domain, n, refinement, triangulation);
    const auto base = triangulation.begin_active();
    spacing = Cell{{}, base->vertex(3) - base->vertex(0), {}, {}}.width();
    spacing /= 1 << refinement;
    if(divided)
      divide(divided);
    number();
    read_cells();
    read_faces();
    place.assign(cells.size(), Place::inside);
    if(!domain.round())
      return;
    if(finest_rim)
      take_rim(*finest_rim);
    else
      cut_rim();
  }

  void BackgroundMesh::divide(const RefinementCriterion &divided)
  {
    for(int level = 0; level < refinement; ++level)
    {
      for(const auto &cell : triangulation.active_cell_iterators_on_level(level))
        if(divided(cell->vertex(0), cell->vertex(3) - cell->vertex(0)))
          cell->set_refine_flag();
      triangulation.execute_coarsening_and_refinement();
    }
  }

  unsigned int BackgroundMesh::cell_at(const Point &point) const
  {
    const auto first = triangulation.begin(0);
    const Gradient size = first->vertex(3) - first->vertex(0);
    unsigned int base = 0;
    for(int d = dim - 1; d >= 0; --d)
      base = base * base_cells[d]
             + static_cast<unsigned int>(
                 std::clamp(std::floor((point[d] - first->vertex(0)[d]) / size[d]), 0.,
                            base_cells[d] - 1.));
    dealii::Triangulation<dim>::cell_iterator cell(&triangulation, 0,
                                                   static_cast<int>(base));
    while(cell->has_children())
    {
      const Point middle = cell->child(0)->vertex(3);
      cell = cell->child((point[0] >= middle[0] ? 1 : 0)
                         + (point[1] >= middle[1] ? 2 : 0));
    }
    return cell->active_cell_index();
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
  }

  void BackgroundMesh::read_cells()
  {
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
      for(unsigned int i = 0; i < added.dofs.size(); ++i)
        positions[added.dofs[i]] = added.real(element.unit_support_point(i));
      for(unsigned int i = 0; i < added.level_set_dofs.size(); ++i)
        level_set_positions[added.level_set_dofs[i]]
            = added.real(level_set_element.unit_support_point(i));
    }
  }

  void BackgroundMesh::read_faces()
  {
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
