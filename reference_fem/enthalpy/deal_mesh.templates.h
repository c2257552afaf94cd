#ifndef meltfront_reference_fem_enthalpy_deal_mesh_templates_h
#define meltfront_reference_fem_enthalpy_deal_mesh_templates_h

#include <cases/error.h>
#include <reference_fem/enthalpy/deal_mesh.h>
#include <reference_fem/enthalpy/integrals_about_corners.h>

#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_tools.h>

#include <fmt/format.h>

#include <limits>

namespace meltfront::reference_fem
{
  template <int dim>
  std::optional<typename DealMesh<dim>::Place>
  DealMesh<dim>::find(const dealii::Point<dim> &point) const
  {
    try
    {
      if(!finder)
        return dealii::GridTools::find_active_cell_around_point(*rules.mapping,
                                                                dof_handler, point);
      const auto [cell, unit]
          = dealii::GridTools::find_active_cell_around_point(*finder, point);
      if(cell.state() != dealii::IteratorState::valid)
        return {};
      return Place{Cell(&shape.triangulation, cell->level(), cell->index(), &dof_handler),
                   unit};
    }
    catch(const dealii::ExceptionBase &)
    {
      return {};
    }
  }

  /** deal.II 9.4 finds points in quadrilaterals and hexahedra only. The cell of the file
   * is known; of its halves that one holds the point in which the least shape function is
   * the largest. */
  template <int dim>
  std::optional<typename DealMesh<dim>::Place>
  DealMesh<dim>::find_in_file(const dealii::Point<dim> &point) const
  {
    const auto of_file = scene.domain.mesh->cell_at(position(point));
    if(!of_file)
      return {};
    using AnyCell = typename dealii::DoFHandler<dim>::cell_iterator;
    const auto least_share = [&](const AnyCell &cell)
    {
      double least = std::numeric_limits<double>::infinity();
      try
      {
        const auto unit = rules.mapping->transform_real_to_unit_cell(cell, point);
        for(unsigned int a = 0; a < rules.corners(); ++a)
          least = std::min(least, rules.element->shape_value(a, unit));
      }
      catch(const typename dealii::Mapping<dim>::ExcTransformationFailed &)
      {
        return -least; // so far away that it is no point of the cell's
      }
      return least;
    };
    AnyCell cell(&shape.triangulation, 0, static_cast<int>(*of_file), &dof_handler);
    while(cell->has_children())
    {
      AnyCell holds = cell->child(0);
      double best = least_share(holds);
      for(unsigned int child = 1; child < cell->n_children(); ++child)
        if(const double least = least_share(cell->child(child)); least > best)
        {
          best = least;
          holds = cell->child(child);
        }
      cell = holds;
    }
    return Place{Cell(cell), rules.mapping->transform_real_to_unit_cell(cell, point)};
  }

  template <int dim>
  Shares DealMesh<dim>::shares(const cases::Position &point) const
  {
    dealii::Point<dim> p;
    for(int d = 0; d < dim; ++d)
      p[d] = point[d];
    const auto outside = [&point]
    {
      return cases::InputError(
          fmt::format("the source at ({:.6g}, {:.6g}, {:.6g}) lies outside of the domain",
                      point[0], point[1], point[2]));
    };
    const std::optional<Place> found = scene.domain.mesh ? find_in_file(p) : find(p);
    if(!found || found->first.state() != dealii::IteratorState::valid)
      throw outside();
    const auto unit
        = rules.simplices
              ? found->second
              : dealii::GeometryInfo<dim>::project_to_unit_cell(found->second);
    const auto corners = sites(found->first);
    Shares result;
    for(unsigned int a = 0; a < corners.size(); ++a)
    {
      double value = rules.element->shape_value(a, unit);
      // A source on a vertex is found there up to round-off only.
      if(value > 1e-12)
        result.emplace_back(node_of_site[corners[a]], value);
    }
    double sum = 0;
    for(const auto &share : result)
      sum += share.second;
    for(auto &share : result)
      share.second /= sum;
    return result;
  }

  /** Whether cells, by their active index, hold both phases or are beside such: a front
   * that cuts off a cell's corner is seen in the cells beside it. */
  template <int dim>
  std::vector<char> DealMesh<dim>::cells_about_fronts(
      dealii::FEValues<dim> &values,
      const std::function<bool(const cases::Position &)> &solid) const
  {
    constexpr char is_solid = 1, is_liquid = 2, both = is_solid | is_liquid;
    std::vector<char> phases(n_nodes, 0);
    for(const auto &cell : dof_handler.active_cell_iterators())
    {
      values.reinit(cell);
      char found = 0;
      for(const unsigned int q : values.quadrature_point_indices())
        found |= solid(position<dim>(values.quadrature_point(q))) ? is_solid : is_liquid;
      for(const unsigned int site : sites(cell))
        phases[node_of_site[site]] |= found;
    }
    std::vector<char> result;
    for(const auto &cell : dof_handler.active_cell_iterators())
    {
      char found = 0;
      for(const unsigned int site : sites(cell))
        found |= phases[node_of_site[site]];
      result.push_back(found == both);
    }
    return result;
  }

  /** Integrals of what a function is more than `usual` over the parts of a cell nearest
   * to its corners. */
  template <int dim>
  std::vector<double> DealMesh<dim>::excess_about_corners(
      const CellGeometry<dim> &geometry,
      const std::function<double(const cases::Position &)> &function, double usual) const
  {
    const auto excess_at = [&](const cases::Position &in_unit)
    {
      dealii::Point<dim> unit;
      for(unsigned int d = 0; d < dim; ++d)
        unit[d] = in_unit[d];
      const auto place = geometry(unit);
      return place.volume * weight(place.point)
             * (function(position<dim>(place.point)) - usual);
    };
    return integrals_about_corners(excess_at, dim);
  }

  template <int dim>
  std::vector<double> DealMesh<dim>::node_averages(
      const std::function<double(const cases::Position &)> &function,
      const std::function<bool(const cases::Position &)> &solid, bool jumps) const
  {
    const auto flags = dealii::update_JxW_values | dealii::update_quadrature_points;
    dealii::FEValues<dim> smooth(*rules.mapping, *rules.element, rules.smooth, flags),
        many(*rules.mapping, *rules.element, rules.jumps, flags);
    const std::vector<unsigned int> nearest_of_smooth
        = rules.nearest_corners(rules.smooth),
        nearest_of_many = rules.nearest_corners(rules.jumps);
    const std::vector<char> about_fronts = cells_about_fronts(smooth, solid);
    std::optional<CellGeometry<dim>> geometry;
    if(!rules.simplices)
      geometry.emplace(*rules.mapping, *rules.element);
    std::vector<double> sum(n_nodes), measure_of(n_nodes);
    for(const auto &cell : dof_handler.active_cell_iterators())
    {
      const auto corners = sites(cell);
      const bool may_jump = jumps || about_fronts[cell->active_cell_index()];
      const bool by_parts = may_jump && geometry, by_many = may_jump && !geometry;
      dealii::FEValues<dim> &values = by_many ? many : smooth;
      values.reinit(cell);
      const double usual = by_parts ? function(position<dim>(cell->center())) : 0;
      for(const unsigned int q : values.quadrature_point_indices())
      {
        const unsigned int nearest = (by_many ? nearest_of_many : nearest_of_smooth)[q];
        const unsigned int i = node_of_site[corners[nearest]];
        const double measure = values.JxW(q) * weight(values.quadrature_point(q));
        sum[i]
            += measure
               * (by_parts ? usual : function(position<dim>(values.quadrature_point(q))));
        measure_of[i] += measure;
      }
      if(!by_parts)
        continue;
      geometry->reinit(cell);
      const std::vector<double> excess = excess_about_corners(*geometry, function, usual);
      for(unsigned int a = 0; a < corners.size(); ++a)
        sum[node_of_site[corners[a]]] += excess[a];
    }
    for(unsigned int i = 0; i < n_nodes; ++i)
      sum[i] /= measure_of[i];
    return sum;
  }
} // namespace meltfront::reference_fem

#endif
