#include <reference_fem/enthalpy/mesh.h>

#include <cases/error.h>
#include <reference_fem/enthalpy/row_builder.h>
#include <reference_fem/enthalpy/shaped_triangulation.h>

#include <deal.II/base/multithread_info.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/grid_tools_cache.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

namespace meltfront::reference_fem
{
  namespace
  {
    using cases::BoundaryKind;
    using cases::DomainShape;
    using cases::Position;
    using cases::Side;

    template <int dim>
    Position position(const dealii::Point<dim> &point)
    {
      Position result{};
      for(int d = 0; d < dim; ++d)
        result[d] = point[d];
      return result;
    }

    template <int dim>
    class DealMesh : public Mesh
    {
    public:
      DealMesh(const cases::Scene &scene, int n);

      Discretisation discretise() const override;
      Shares shares(const Position &point) const override;
      void expect_many_points() override
      {
        finder.emplace(shape.triangulation, mapping);
      }
      std::vector<double>
      node_averages(const std::function<double(const Position &)> &function,
                    const std::function<bool(const Position &)> &solid) const override;

    private:
      bool periodic(int direction) const;
      void number_nodes();
      void number_along_lattice();

      /** The measure of the scene at a point, per volume of the mesh. */
      double weight(const dealii::Point<dim> &point) const;

      std::vector<unsigned int>
      sites(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell) const;
      std::vector<unsigned int> neighbours_at_most() const;
      void integrate_cells(Discretisation &result) const;

      /** Conductivity of a cell over that outside of the inclusion. */
      double relative_conductivity(
          const typename dealii::DoFHandler<dim>::active_cell_iterator &cell) const;
      void integrate_walls(Discretisation &result) const;
      void place_sites(Discretisation &result) const;

      const cases::Scene &scene;
      ShapedTriangulation<dim> shape;
      dealii::FE_Q<dim> element{1};
      dealii::DoFHandler<dim> dof_handler;
      dealii::MappingQ<dim> mapping;
      std::optional<dealii::GridTools::Cache<dim>> finder;
      std::vector<unsigned int> node_of_site;
      unsigned int n_nodes = 0;
      std::optional<Lattice> lattice; ///< of the nodes, where cells are boxes
    };

    template <int dim>
    DealMesh<dim>::DealMesh(const cases::Scene &scene, int n)
      : scene(scene)
      , shape(scene, n)
      , dof_handler(shape.triangulation)
      , mapping(shape.curved ? 4 : 1)
    {
      dof_handler.distribute_dofs(element);
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
      const auto is_periodic = [&](Side side)
      { return scene.boundary(side).kind == BoundaryKind::periodic; };
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
    std::vector<unsigned int> DealMesh<dim>::sites(
        const typename dealii::DoFHandler<dim>::active_cell_iterator &cell) const
    {
      std::vector<dealii::types::global_dof_index> dofs(element.n_dofs_per_cell());
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
    double DealMesh<dim>::relative_conductivity(
        const typename dealii::DoFHandler<dim>::active_cell_iterator &cell) const
    {
      if(!scene.inclusion)
        return 1;
      const dealii::QIterated<dim> samples(dealii::QMidpoint<1>(), 8);
      double resistance = 0;
      for(unsigned int q = 0; q < samples.size(); ++q)
        resistance += samples.weight(q)
                      / scene.conductivity_at(position(
                          mapping.transform_unit_to_real_cell(cell, samples.point(q))));
      return 1 / (resistance * scene.material.solid.conductivity);
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
          result[node_of_site[site]] += element.n_dofs_per_cell() - 1;
      return result;
    }

    template <int dim>
    void DealMesh<dim>::integrate_cells(Discretisation &result) const
    {
      const dealii::Quadrature<dim> quadrature
          = shape.cartesian
                ? static_cast<dealii::Quadrature<dim>>(dealii::QTrapezoid<dim>())
                : static_cast<dealii::Quadrature<dim>>(dealii::QGauss<dim>(3));
      dealii::FEValues<dim> values(mapping, element, quadrature,
                                   dealii::update_values | dealii::update_gradients
                                       | dealii::update_JxW_values
                                       | dealii::update_quadrature_points);
      // About an axis a vertex stands for the integral of its shape function: what the
      // weight is at the vertex itself would leave the axis without volume.
      std::optional<dealii::FEValues<dim>> row_sums;
      if(scene.domain.shape == DomainShape::axisymmetric)
        row_sums.emplace(mapping, element, dealii::QGauss<dim>(2),
                         dealii::update_values | dealii::update_JxW_values
                             | dealii::update_quadrature_points);
      result.volume.assign(n_nodes, 0);
      result.conduction.diagonal.assign(n_nodes, 0);
      RowBuilder rows(neighbours_at_most());
      for(const auto &cell : dof_handler.active_cell_iterators())
      {
        values.reinit(cell);
        const auto corners = sites(cell);
        result.cells.insert(result.cells.end(), corners.begin(), corners.end());
        const double conductivity = relative_conductivity(cell);
        std::vector<double> measures(quadrature.size());
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
      const dealii::QGauss<dim - 1> quadrature(3);
      dealii::FEFaceValues<dim> values(mapping, element, quadrature,
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
            if(!element.has_support_on_face(a, face))
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

    template <int dim>
    Shares DealMesh<dim>::shares(const Position &point) const
    {
      dealii::Point<dim> p;
      for(int d = 0; d < dim; ++d)
        p[d] = point[d];
      const auto outside = [&point]
      {
        return cases::InputError(fmt::format(
            "the source at ({:.6g}, {:.6g}, {:.6g}) lies outside of the domain", point[0],
            point[1], point[2]));
      };
      using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;
      std::pair<Cell, dealii::Point<dim>> found;
      try
      {
        if(finder)
        {
          const auto [cell, unit]
              = dealii::GridTools::find_active_cell_around_point(*finder, p);
          if(cell.state() != dealii::IteratorState::valid)
            throw outside();
          found = {Cell(&shape.triangulation, cell->level(), cell->index(), &dof_handler),
                   unit};
        }
        else
          found
              = dealii::GridTools::find_active_cell_around_point(mapping, dof_handler, p);
      }
      catch(const dealii::ExceptionBase &)
      {
        throw outside();
      }
      if(found.first.state() != dealii::IteratorState::valid)
        throw outside();
      const auto unit = dealii::GeometryInfo<dim>::project_to_unit_cell(found.second);
      const auto corners = sites(found.first);
      Shares result;
      for(unsigned int a = 0; a < corners.size(); ++a)
      {
        double value = element.shape_value(a, unit);
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

    template <int dim>
    std::vector<double>
    DealMesh<dim>::node_averages(const std::function<double(const Position &)> &function,
                                 const std::function<bool(const Position &)> &solid) const
    {
      const dealii::QIterated<dim> few(dealii::QGauss<1>(2), 2),
          many(dealii::QMidpoint<1>(), 8);
      const auto flags = dealii::update_JxW_values | dealii::update_quadrature_points;
      dealii::FEValues<dim> in_phase(mapping, element, few, flags),
          at_front(mapping, element, many, flags);
      // The phases of the cells around a node: a front that cuts off a cell's corner is
      // seen in the cells beside it.
      constexpr char is_solid = 1, is_liquid = 2;
      std::vector<char> phases(n_nodes, 0);
      for(const auto &cell : dof_handler.active_cell_iterators())
      {
        in_phase.reinit(cell);
        char found = 0;
        for(const unsigned int q : in_phase.quadrature_point_indices())
          found |= solid(position<dim>(in_phase.quadrature_point(q))) ? is_solid
                                                                      : is_liquid;
        for(const unsigned int site : sites(cell))
          phases[node_of_site[site]] |= found;
      }
      std::vector<double> sum(n_nodes), measure_of(n_nodes);
      for(const auto &cell : dof_handler.active_cell_iterators())
      {
        const auto corners = sites(cell);
        char found = 0;
        for(const unsigned int site : corners)
          found |= phases[node_of_site[site]];
        dealii::FEValues<dim> &values
            = found == (is_solid | is_liquid) ? at_front : in_phase;
        values.reinit(cell);
        for(const unsigned int q : values.quadrature_point_indices())
        {
          unsigned int nearest = 0;
          for(int d = 0; d < dim; ++d)
            nearest |= (values.get_quadrature().point(q)[d] > 0.5 ? 1u : 0u) << d;
          const unsigned int i = node_of_site[corners[nearest]];
          const double measure = values.JxW(q) * weight(values.quadrature_point(q));
          sum[i] += measure * function(position<dim>(values.quadrature_point(q)));
          measure_of[i] += measure;
        }
      }
      for(unsigned int i = 0; i < n_nodes; ++i)
        sum[i] /= measure_of[i];
      return sum;
    }
  } // namespace

  std::vector<int> mesh_dimensions(const cases::Scene &scene)
  {
    switch(scene.domain.shape)
    {
    case DomainShape::slab:
      return {1, 2, 3};
    case DomainShape::box:
    case DomainShape::axisymmetric:
      return {scene.domain.dimension};
    default:
      if(scene.symmetry == cases::Symmetry::cylindrical
         || scene.symmetry == cases::Symmetry::spherical)
        return {1, scene.domain.dimension};
      return {scene.domain.dimension};
    }
  }

  std::unique_ptr<Mesh> make_mesh(const cases::Scene &scene, int dimension, int n)
  {
    // With threads, deal.II rounds its integrals over cells and its sums over vectors
    // differently.
    dealii::MultithreadInfo::set_thread_limit(1);
    switch(dimension)
    {
    case 1:
      return std::make_unique<DealMesh<1>>(scene, n);
    case 2:
      return std::make_unique<DealMesh<2>>(scene, n);
    default:
      return std::make_unique<DealMesh<3>>(scene, n);
    }
  }
} // namespace meltfront::reference_fem
