#include <reference_fem/enthalpy/distributed/box_hierarchy.h>

#include <cases/error.h>
#include <reference_fem/enthalpy/row_builder.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/multithread_info.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/multigrid/mg_transfer_global_coarsening.h>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <map>

namespace meltfront::reference_fem
{
  namespace
  {
    using cases::BoundaryKind, cases::Position, cases::Side;

    /** Between the linear elements of two meshes, by deal.II. */
    template <int dim>
    class NestedTransfer : public LevelTransfer
    {
    public:
      NestedTransfer(const dealii::DoFHandler<dim> &fine,
                     const dealii::DoFHandler<dim> &coarse)
      {
        transfer.reinit_geometric_transfer(fine, coarse);
      }

      void interpolate(const RankVector &coarse, RankVector &fine) const override
      {
        transfer.prolongate_and_add(fine, coarse);
      }

      void restrict_to(const RankVector &fine, RankVector &coarse) const override
      {
        transfer.restrict_and_add(coarse, fine);
      }

    private:
      dealii::MGTwoLevelTransfer<dim, RankVector> transfer;
    };

    /** One mesh of the hierarchy while the problem is set up. */
    template <int dim>
    struct MeshOfCells
    {
      MeshOfCells(MPI_Comm communicator, const std::vector<unsigned int> &coarse_cells,
                  const dealii::Point<dim> &lower, const dealii::Point<dim> &upper,
                  int halvings)
        : triangulation(communicator)
        , dof_handler(triangulation)
      {
        dealii::GridGenerator::subdivided_hyper_rectangle(triangulation, coarse_cells,
                                                          lower, upper, true);
        triangulation.refine_global(halvings);
        dof_handler.distribute_dofs(dealii::FE_Q<dim>(1));
        for(int d = 0; d < dim; ++d)
          size[d] = (upper[d] - lower[d]) / (coarse_cells[d] << halvings);
        dealii::IndexSet relevant;
        dealii::DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
        nodes = std::make_shared<dealii::Utilities::MPI::Partitioner>(
            dof_handler.locally_owned_dofs(), relevant, communicator);
      }

      using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;
      static constexpr unsigned int n_corners = 1u << dim;
      using Corners = std::array<unsigned int, n_corners>;

      /** Visit the cells that the rank knows: cell, local numbers of its corners. */
      template <typename Visit>
      void visit_cells(const Visit &visit) const
      {
        std::vector<dealii::types::global_dof_index> dofs(n_corners);
        for(const auto &cell : dof_handler.active_cell_iterators())
        {
          if(cell->is_artificial())
            continue;
          cell->get_dof_indices(dofs);
          Corners corners;
          for(unsigned int a = 0; a < n_corners; ++a)
            corners[a] = nodes->global_to_local(dofs[a]);
          visit(cell, corners);
        }
      }

      double volume() const
      {
        double result = 1;
        for(int d = 0; d < dim; ++d)
          result *= size[d];
        return result;
      }

      bool owns(unsigned int node) const
      {
        return node < nodes->locally_owned_size();
      }

      dealii::parallel::distributed::Triangulation<dim> triangulation;
      dealii::DoFHandler<dim> dof_handler;
      dealii::Tensor<1, dim> size; ///< of a cell
      std::shared_ptr<const dealii::Utilities::MPI::Partitioner> nodes;
    };

    template <int dim>
    class BoxHierarchy : public RankMesh
    {
    public:
      BoxHierarchy(const cases::Scene &scene, int n, MPI_Comm communicator);

      Discretisation discretise() const override;
      Shares shares(const Position &point) const override;
      void expect_many_points() override
      {
      }
      bool anywhere(bool here) const override
      {
        return dealii::Utilities::MPI::max(here ? 1 : 0, communicator) > 0;
      }
      std::vector<double>
      node_averages(const std::function<double(const Position &)> &function,
                    const std::function<bool(const Position &)> &solid) const override;

      std::vector<RankLevel> take_levels() override
      {
        return std::move(levels);
      }
      std::uint64_t number_at(const Position &node) const override;
      std::uint64_t n_nodes() const override
      {
        return finest->dof_handler.n_dofs();
      }

    private:
      using Mesh = MeshOfCells<dim>;
      using Corners = typename Mesh::Corners;

      RankLevel make_level(const Mesh &mesh) const;
      void find_walls(Discretisation &result) const;
      void place_sites(Discretisation &result) const;
      std::uint64_t number_of(const std::array<std::uint64_t, dim> &place) const;

      Position point_in(const typename Mesh::Cell &cell,
                        const dealii::Point<dim> &unit) const
      {
        Position result{};
        for(int d = 0; d < dim; ++d)
          result[d] = cell->vertex(0)[d] + unit[d] * finest->size[d];
        return result;
      }

      static dealii::Point<dim> unit_corner(unsigned int corner)
      {
        return dealii::GeometryInfo<dim>::unit_cell_vertex(corner);
      }

      const cases::Scene &scene;
      MPI_Comm communicator;
      std::vector<unsigned int> n_cells; ///< by direction
      std::unique_ptr<Mesh> finest;
      std::vector<RankLevel> levels; ///< finest first
    };

    /** How often all numbers of cells are halved, so that the coarse mesh is small, but
     * for a direct solver, where it is easily done. */
    int halvings_of(const std::vector<unsigned int> &cells)
    {
      constexpr double few_cells = 64, most_coarse_cells = 4096;
      const auto count = [&](int halvings)
      {
        double product = 1;
        for(const unsigned int n : cells)
          product *= n >> halvings;
        return product;
      };
      int possible = 31;
      for(const unsigned int n : cells)
        possible = std::min(possible, std::countr_zero(n));
      int halvings = 0;
      while(halvings < possible && count(halvings + 1) >= few_cells)
        ++halvings;
      if(count(halvings) > most_coarse_cells)
        throw cases::Refusal(fmt::format(
            "fem-enthalpy on several ranks joins cells to a coarse mesh of at most {:g}, "
            "and from {} cells along the side that is not possible: take an n such as {}",
            most_coarse_cells, cells[0], std::max(64u, (cells[0] + 32) / 64 * 64)));
      return halvings;
    }

    template <int dim>
    BoxHierarchy<dim>::BoxHierarchy(const cases::Scene &scene, int n,
                                    MPI_Comm communicator)
      : scene(scene)
      , communicator(communicator)
    {
      const cases::Domain &domain = scene.domain;
      const double spacing = domain.side() / n;
      dealii::Point<dim> lower, upper;
      for(int d = 0; d < dim; ++d)
      {
        lower[d] = domain.lower[d];
        upper[d] = domain.upper[d];
        n_cells.push_back(static_cast<unsigned int>(
            std::max(1L, std::lround((upper[d] - lower[d]) / spacing))));
      }
      n_cells[0] = static_cast<unsigned int>(n);
      const int halvings = halvings_of(n_cells);
      std::vector<unsigned int> coarse_cells;
      for(const unsigned int cells : n_cells)
        coarse_cells.push_back(cells >> halvings);
      for(int l = 0; l <= halvings; ++l)
      {
        auto mesh = std::make_unique<Mesh>(communicator, coarse_cells, lower, upper, l);
        levels.insert(levels.begin(), make_level(*mesh));
        if(finest)
          levels.front().coarser = std::make_unique<NestedTransfer<dim>>(
              mesh->dof_handler, finest->dof_handler);
        finest = std::move(mesh);
      }
    }

    /** By the trapezoidal rule: edges conduct. All cells are alike, so both rows of a
     * pair hold the same bits on whatever ranks they are. */
    template <int dim>
    RankLevel BoxHierarchy<dim>::make_level(const Mesh &mesh) const
    {
      RankLevel level;
      level.nodes = mesh.nodes;
      const std::size_t n_own = level.n_own();
      level.free.assign(n_own, 1);
      level.conduction.diagonal.assign(n_own, 0);
      RowBuilder rows(std::vector<unsigned int>(n_own, 2 * dim));
      mesh.visit_cells(
          [&](const auto &cell, const Corners &corners)
          {
            for(unsigned int a = 0; a < Mesh::n_corners; ++a)
              if(mesh.owns(corners[a]))
                for(int d = 0; d < dim; ++d)
                  rows.add(corners[a], corners[a ^ (1u << d)],
                           mesh.volume() * 2 / Mesh::n_corners
                               / (mesh.size[d] * mesh.size[d]));
            for(const auto face : cell->face_indices())
              if(cell->at_boundary(face)
                 && scene.boundary(static_cast<Side>(cell->face(face)->boundary_id()))
                            .kind
                        == BoundaryKind::fixed_temperature)
                for(unsigned int a = 0; a < Mesh::n_corners; ++a)
                  if(mesh.owns(corners[a]) && (a >> (face / 2) & 1) == face % 2)
                    level.free[corners[a]] = 0;
          });
      rows.move_to(level.conduction);
      return level;
    }

    template <int dim>
    Discretisation BoxHierarchy<dim>::discretise() const
    {
      Discretisation result;
      result.dimension = dim;
      result.spacing = scene.domain.side() / n_cells[0];
      const std::size_t n_own = finest->nodes->locally_owned_size();
      result.volume.assign(n_own, 0);
      result.positions.resize(n_own);
      finest->visit_cells(
          [&](const auto &cell, const Corners &corners)
          {
            for(unsigned int a = 0; a < Mesh::n_corners; ++a)
              if(finest->owns(corners[a]))
              {
                result.volume[corners[a]] += finest->volume() / Mesh::n_corners;
                for(int d = 0; d < dim; ++d)
                  result.positions[corners[a]][d] = cell->vertex(a)[d];
              }
          });
      find_walls(result);
      place_sites(result);
      return result;
    }

    template <int dim>
    void BoxHierarchy<dim>::find_walls(Discretisation &result) const
    {
      std::array<std::map<unsigned int, WallNode>, cases::n_sides> walls;
      finest->visit_cells(
          [&](const auto &cell, const Corners &corners)
          {
            for(const auto face : cell->face_indices())
            {
              if(!cell->at_boundary(face))
                continue;
              const unsigned int across = face / 2;
              const double area
                  = finest->volume() / finest->size[across] * 2 / Mesh::n_corners;
              for(unsigned int a = 0; a < Mesh::n_corners; ++a)
                if(finest->owns(corners[a]) && (a >> across & 1) == face % 2)
                  walls[cell->face(face)->boundary_id()]
                      .try_emplace(corners[a],
                                   WallNode{corners[a], 0., result.positions[corners[a]]})
                      .first->second.area
                      += area;
            }
          });
      for(std::size_t side = 0; side < cases::n_sides; ++side)
        for(const auto &[i, node] : walls[side])
          result.walls[side].push_back(node);
    }

    /** Own nodes, then the others of own cells. */
    template <int dim>
    void BoxHierarchy<dim>::place_sites(Discretisation &result) const
    {
      const auto n_own = static_cast<unsigned int>(result.volume.size());
      for(int d = 0; d < dim; ++d)
        for(const Position &position : result.positions)
          result.site_positions[d].push_back(position[d]);
      result.site_weights = result.volume;
      for(unsigned int i = 0; i < n_own; ++i)
        result.node_of_site.push_back(i);
      std::map<unsigned int, unsigned int> site_of_ghost;
      finest->visit_cells(
          [&](const auto &cell, const Corners &corners)
          {
            if(!cell->is_locally_owned())
              return;
            for(unsigned int a = 0; a < Mesh::n_corners; ++a)
            {
              unsigned int site = corners[a];
              if(!finest->owns(corners[a]))
              {
                const auto next = static_cast<unsigned int>(result.node_of_site.size());
                const auto [found, added] = site_of_ghost.try_emplace(corners[a], next);
                site = found->second;
                if(added)
                {
                  result.node_of_site.push_back(corners[a]);
                  result.site_weights.push_back(0);
                  for(int d = 0; d < dim; ++d)
                    result.site_positions[d].push_back(cell->vertex(a)[d]);
                }
              }
              result.cells.push_back(site);
            }
          });
    }

    template <int dim>
    std::uint64_t
    BoxHierarchy<dim>::number_of(const std::array<std::uint64_t, dim> &place) const
    {
      std::uint64_t number = 0;
      for(int d = dim; d-- > 0;)
        number = number * (n_cells[d] + 1) + place[d];
      return number;
    }

    template <int dim>
    std::uint64_t BoxHierarchy<dim>::number_at(const Position &node) const
    {
      std::array<std::uint64_t, dim> place;
      for(int d = 0; d < dim; ++d)
        place[d] = static_cast<std::uint64_t>(
            std::lround((node[d] - scene.domain.lower[d]) / finest->size[d]));
      return number_of(place);
    }

    /** Those of the own nodes. */
    template <int dim>
    Shares BoxHierarchy<dim>::shares(const Position &point) const
    {
      std::array<std::uint64_t, dim> cell;
      std::array<double, dim> unit;
      for(int d = 0; d < dim; ++d)
      {
        constexpr double round_off = 1e-10;
        const double place = (point[d] - scene.domain.lower[d]) / finest->size[d];
        if(!(place >= -round_off && place <= n_cells[d] + round_off))
          throw cases::InputError(fmt::format(
              "the source at ({:.6g}, {:.6g}, {:.6g}) lies outside of the domain",
              point[0], point[1], point[2]));
        const double inside = std::clamp(place, 0., double(n_cells[d]));
        cell[d]
            = std::min<std::uint64_t>(static_cast<std::uint64_t>(inside), n_cells[d] - 1);
        unit[d] = inside - static_cast<double>(cell[d]);
      }
      std::map<std::uint64_t, double> values;
      double sum = 0;
      for(unsigned int a = 0; a < Mesh::n_corners; ++a)
      {
        double value = 1;
        std::array<std::uint64_t, dim> corner = cell;
        for(int d = 0; d < dim; ++d)
        {
          const unsigned int upper = a >> d & 1;
          corner[d] += upper;
          value *= upper ? unit[d] : 1 - unit[d];
        }
        // A source on a vertex is found there up to round-off only.
        if(value > 1e-12)
        {
          values[number_of(corner)] = value;
          sum += value;
        }
      }
      std::map<unsigned int, double> own;
      finest->visit_cells(
          [&](const auto &cell, const Corners &corners)
          {
            for(unsigned int a = 0; a < Mesh::n_corners; ++a)
              if(finest->owns(corners[a]))
                if(const auto found
                   = values.find(number_at(point_in(cell, unit_corner(a))));
                   found != values.end())
                  own[corners[a]] = found->second / sum;
          });
      return {own.begin(), own.end()};
    }

    template <int dim>
    std::vector<double> BoxHierarchy<dim>::node_averages(
        const std::function<double(const Position &)> &function,
        const std::function<bool(const Position &)> &solid) const
    {
      const dealii::QIterated<dim> few(dealii::QGauss<1>(2), 2),
          many(dealii::QMidpoint<1>(), 8);
      constexpr unsigned int is_solid = 1, is_liquid = 2;
      RankVector phases(finest->nodes);
      const auto found_at = [&](unsigned int node)
      { return static_cast<unsigned int>(phases.local_element(node)); };
      finest->visit_cells(
          [&](const auto &cell, const Corners &corners)
          {
            unsigned int found = 0;
            for(const auto &unit : few.get_points())
              found |= solid(point_in(cell, unit)) ? is_solid : is_liquid;
            for(const unsigned int node : corners)
              phases.local_element(node) = found_at(node) | found;
          });
      // Of a ghost only the rank that has it knows all cells.
      phases.update_ghost_values();
      const std::size_t n_own = finest->nodes->locally_owned_size();
      std::vector<double> sum(n_own), measure(n_own);
      finest->visit_cells(
          [&](const auto &cell, const Corners &corners)
          {
            unsigned int found = 0;
            for(const unsigned int node : corners)
              found |= found_at(node);
            const auto &points = found == (is_solid | is_liquid) ? many : few;
            for(unsigned int q = 0; q < points.size(); ++q)
            {
              unsigned int nearest = 0;
              for(int d = 0; d < dim; ++d)
                nearest |= (points.point(q)[d] > 0.5 ? 1u : 0u) << d;
              if(const unsigned int i = corners[nearest]; finest->owns(i))
              {
                sum[i] += points.weight(q) * function(point_in(cell, points.point(q)));
                measure[i] += points.weight(q);
              }
            }
          });
      for(std::size_t i = 0; i < n_own; ++i)
        sum[i] /= measure[i];
      return sum;
    }
  } // namespace

  std::unique_ptr<RankMesh> make_rank_mesh(const cases::Scene &scene, int n,
                                           MPI_Comm communicator)
  {
    dealii::MultithreadInfo::set_thread_limit(1);
    if(scene.domain.shape != cases::DomainShape::box)
      throw cases::Refusal("fem-enthalpy meshes boxes only on several ranks");
    for(const Side side : scene.sides())
      if(scene.boundary(side).kind == BoundaryKind::periodic)
        throw cases::Refusal("fem-enthalpy joins no periodic sides on several ranks");
    if(scene.domain.dimension == 2)
      return std::make_unique<BoxHierarchy<2>>(scene, n, communicator);
    return std::make_unique<BoxHierarchy<3>>(scene, n, communicator);
  }
} // namespace meltfront::reference_fem
