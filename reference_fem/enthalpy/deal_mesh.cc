#include <reference_fem/enthalpy/deal_mesh.templates.h>

#include <cases/error.h>
#include <reference_fem/enthalpy/row_builder.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace meltfront::reference_fem
{
  using cases::BoundaryKind;
  using cases::DomainShape;
  using cases::Position;
  using cases::Side;

  namespace
  {
    /** As snapshots have cells: a simplex is a quadrilateral or a hexahedron of which
     * several corners are one. */
    void add_cell(const std::vector<unsigned int> &corners, bool tetrahedron,
                  std::vector<unsigned int> &cells)
    {
      if(corners.size() == 3)
        cells.insert(cells.end(), {corners[0], corners[1], corners[2], corners[2]});
      else if(tetrahedron)
        cells.insert(cells.end(), {corners[0], corners[1], corners[2], corners[2],
                                   corners[3], corners[3], corners[3], corners[3]});
      else
        cells.insert(cells.end(), corners.begin(), corners.end());
    }
  } // namespace

  template <int dim>
  DealMesh<dim>::DealMesh(const cases::Scene &scene, int n)
    : scene(scene)
    , shape(scene, n)
    , rules(shape.simplices, shape.cartesian, shape.curved)
    , dof_handler(shape.triangulation)
  {
    dof_handler.distribute_dofs(*rules.element);
    number_nodes();
  }

  /** Whether the ends of a direction are joined. */
  template <int dim>
  bool DealMesh<dim>::periodic(int direction) const
  {
    if(!shape.cartesian)
      return false;
    if(scene.domain.shape == DomainShape::slab && direction > 0)
      return true;
    const auto lower = static_cast<Side>(2 * direction),
               upper = static_cast<Side>(2 * direction + 1);
    const auto is_periodic
        = [&](Side side) { return scene.boundary(side).kind == BoundaryKind::periodic; };
    if(is_periodic(lower) != is_periodic(upper))
      throw cases::InputError(fmt::format("of the sides {} and {} only one is periodic",
                                          cases::to_string(lower),
                                          cases::to_string(upper)));
    if(dim == 1 && is_periodic(lower))
      throw cases::Refusal(
          "fem-enthalpy does not simulate a periodic interval in one dimension");
    return is_periodic(lower);
  }

  template <int dim>
  void DealMesh<dim>::number_nodes()
  {
    const auto n_sites = static_cast<unsigned int>(dof_handler.n_dofs());
    node_of_site.resize(n_sites);
    if(shape.n_cells[0] > 0)
    {
      number_along_lattice();
      return;
    }
    for(unsigned int site = 0; site < n_sites; ++site)
      node_of_site[site] = n_nodes++;
  }

  /** Along x first: what multigrid on lattices counts on. */
  template <int dim>
  void DealMesh<dim>::number_along_lattice()
  {
    lattice.emplace();
    const auto &[lower, upper] = shape.corners;
    for(int d = 0; d < dim; ++d)
    {
      lattice->periodic[d] = periodic(d);
      lattice->nodes[d] = shape.n_cells[d] + (lattice->periodic[d] ? 0 : 1);
    }
    n_nodes = static_cast<unsigned int>(lattice->size());
    for(const auto &cell : dof_handler.active_cell_iterators())
    {
      const auto corners = sites(cell);
      for(std::size_t a = 0; a < corners.size(); ++a)
      {
        unsigned int node = 0;
        for(int d = dim; d-- > 0;)
        {
          const double cells = (cell->vertex(a)[d] - lower[d]) / (upper[d] - lower[d])
                               * shape.n_cells[d];
          node = node * lattice->nodes[d]
                 + static_cast<unsigned int>(std::lround(cells)) % lattice->nodes[d];
        }
        node_of_site[corners[a]] = node;
      }
    }
  }

  template <int dim>
  double DealMesh<dim>::weight(const dealii::Point<dim> &point) const
  {
    if(shape.measure == cases::Symmetry::cylindrical
       || scene.domain.shape == DomainShape::axisymmetric)
      return 2 * std::numbers::pi * point[0];
    if(shape.measure == cases::Symmetry::spherical)
      return 4 * std::numbers::pi * point[0] * point[0];
    return 1 / shape.strip_section;
  }

  template <int dim>
  std::vector<unsigned int> DealMesh<dim>::sites(const Cell &cell) const
  {
    std::vector<dealii::types::global_dof_index> dofs(rules.corners());
    cell->get_dof_indices(dofs);
    return {dofs.begin(), dofs.end()};
  }

  template <int dim>
  Discretisation DealMesh<dim>::discretise() const
  {
    Discretisation result;
    result.dimension = dim;
    result.spacing = shape.spacing;
    result.measure = shape.measure;
    result.node_of_site = node_of_site;
    result.lattice = lattice;
    integrate_cells(result);
    integrate_walls(result);
    place_sites(result);
    return result;
  }

  template <int dim>
  double DealMesh<dim>::relative_conductivity(const Cell &cell) const
  {
    if(!scene.inclusion)
      return 1;
    if(scene.inclusion->material)
      return cell->material_id() == *scene.inclusion->material
                 ? scene.inclusion->conductivity / scene.material.solid.conductivity
                 : 1;
    double resistance = 0, all = 0;
    for(unsigned int q = 0; q < rules.jumps.size(); ++q)
    {
      all += rules.jumps.weight(q);
      resistance
          += rules.jumps.weight(q)
             / scene.conductivity_at(position(
                 rules.mapping->transform_unit_to_real_cell(cell, rules.jumps.point(q))));
    }
    return all / (resistance * scene.material.solid.conductivity);
  }

  /** How many neighbours each node may have. */
  template <int dim>
  std::vector<unsigned int> DealMesh<dim>::neighbours_at_most() const
  {
    if(lattice)
      return std::vector<unsigned int>(n_nodes, 2 * dim);
    std::vector<unsigned int> result(n_nodes, 0);
    for(const auto &cell : dof_handler.active_cell_iterators())
      for(const unsigned int site : sites(cell))
        result[node_of_site[site]] += rules.corners() - 1;
    return result;
  }

  template <int dim>
  void DealMesh<dim>::integrate_cells(Discretisation &result) const
  {
    dealii::FEValues<dim> values(*rules.mapping, *rules.element, rules.cell,
                                 dealii::update_values | dealii::update_gradients
                                     | dealii::update_JxW_values
                                     | dealii::update_quadrature_points);
    // About an axis a vertex stands for the integral of its shape function: what the
    // weight is at the vertex itself would leave the axis without volume.
    std::optional<dealii::FEValues<dim>> row_sums;
    if(scene.domain.shape == DomainShape::axisymmetric)
      row_sums.emplace(*rules.mapping, *rules.element, dealii::QGauss<dim>(2),
                       dealii::update_values | dealii::update_JxW_values
                           | dealii::update_quadrature_points);
    result.volume.assign(n_nodes, 0);
    result.conduction.diagonal.assign(n_nodes, 0);
    RowBuilder rows(neighbours_at_most());
    for(const auto &cell : dof_handler.active_cell_iterators())
    {
      values.reinit(cell);
      const auto corners = sites(cell);
      add_cell(corners, rules.simplices && dim == 3, result.cells);
      const double conductivity = relative_conductivity(cell);
      std::vector<double> measures(rules.cell.size());
      for(const unsigned int q : values.quadrature_point_indices())
        measures[q] = values.JxW(q) * weight(values.quadrature_point(q));
      if(row_sums)
      {
        row_sums->reinit(cell);
        for(const unsigned int vertex : values.quadrature_point_indices())
        {
          measures[vertex] = 0;
          for(const unsigned int q : row_sums->quadrature_point_indices())
            measures[vertex] += row_sums->shape_value(vertex, q) * row_sums->JxW(q)
                                * weight(row_sums->quadrature_point(q));
        }
      }
      const auto couple = [&](unsigned int a, unsigned int b)
      {
        double entry = 0;
        for(const unsigned int q : values.quadrature_point_indices())
          entry += values.shape_grad(a, q) * values.shape_grad(b, q) * measures[q];
        return conductivity * entry;
      };
      for(const unsigned int a : values.dof_indices())
      {
        const unsigned int i = node_of_site[corners[a]];
        for(const unsigned int q : values.quadrature_point_indices())
          result.volume[i] += values.shape_value(a, q) * measures[q];
        for(const unsigned int b : values.dof_indices())
        {
          const unsigned int j = node_of_site[corners[b]];
          const double entry = couple(a, b);
          // Diagonally opposite vertices couple by round-off only on Cartesian meshes.
          if(i != j && std::abs(entry) > 1e-13 * couple(0, 0))
            rows.add(i, j, -entry);
        }
      }
    }
    rows.move_to(result.conduction);
  }

  template <int dim>
  void DealMesh<dim>::integrate_walls(Discretisation &result) const
  {
    dealii::FEFaceValues<dim> values(*rules.mapping, *rules.element, rules.face,
                                     dealii::update_values | dealii::update_JxW_values
                                         | dealii::update_quadrature_points);
    std::array<std::map<unsigned int, WallNode>, cases::n_sides> walls;
    for(const auto &cell : dof_handler.active_cell_iterators())
      for(const auto face : cell->face_indices())
      {
        const unsigned int side = cell->face(face)->boundary_id();
        if(!cell->at_boundary(face)
           || std::find(shape.sides.begin(), shape.sides.end(), static_cast<Side>(side))
                  == shape.sides.end())
          continue;
        values.reinit(cell, face);
        const auto corners = sites(cell);
        for(const unsigned int a : values.dof_indices())
        {
          if(!rules.supports_on_face(a, face))
            continue;
          const unsigned int i = node_of_site[corners[a]];
          WallNode &node
              = walls[side]
                    .try_emplace(i, WallNode{i, 0., position<dim>(cell->vertex(a))})
                    .first->second;
          for(const unsigned int q : values.quadrature_point_indices())
            node.area += values.shape_value(a, q) * values.JxW(q)
                         * weight(values.quadrature_point(q));
        }
      }
    for(std::size_t side = 0; side < cases::n_sides; ++side)
      for(const auto &[i, node] : walls[side])
        result.walls[side].push_back(node);
  }

  template <int dim>
  void DealMesh<dim>::place_sites(Discretisation &result) const
  {
    const std::size_t n_sites = node_of_site.size();
    for(int d = 0; d < dim; ++d)
      result.site_positions[d].resize(n_sites);
    for(const auto &cell : dof_handler.active_cell_iterators())
    {
      const auto corners = sites(cell);
      for(std::size_t a = 0; a < corners.size(); ++a)
        for(int d = 0; d < dim; ++d)
          result.site_positions[d][corners[a]] = cell->vertex(a)[d];
    }
    result.site_weights.assign(n_sites, 0);
    result.positions.resize(n_nodes);
    std::vector<char> placed(n_nodes, 0);
    for(std::size_t site = 0; site < n_sites; ++site)
      if(const unsigned int node = node_of_site[site]; !placed[node])
      {
        placed[node] = 1;
        result.site_weights[site] = result.volume[node];
        for(int d = 0; d < dim; ++d)
          result.positions[node][d] = result.site_positions[d][site];
      }
  }

  template class DealMesh<1>;
  template class DealMesh<2>;
  template class DealMesh<3>;
} // namespace meltfront::reference_fem
