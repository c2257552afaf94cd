#include <reference_fem/enthalpy/refinable_mesh.h>

#include <cases/error.h>
#include <reference_fem/enthalpy/local_triangulation.h>
#include <reference_fem/enthalpy/row_builder.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/grid/grid_generator.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <numeric>

namespace meltfront::reference_fem
{
  namespace
  {
    using cases::Position;
    using cases::Side;

    constexpr unsigned int nowhere = static_cast<unsigned int>(-1);

    template <int dim>
    class RefinableBox : public RefinableMesh
    {
    public:
      RefinableBox(const cases::Scene &scene, int n);

      Discretisation discretise() const override;
      Shares shares(const Position &point) const override;
      void expect_many_points() override
      {
      }
      std::vector<double>
      node_averages(const std::function<double(const Position &)> &function,
                    const std::function<bool(const Position &)> &solid) const override;

      std::vector<int> halvings_left() const override;
      std::vector<double> jumps(const std::vector<double> &values) const override;
      std::size_t cell_at(const Position &point) const override;
      bool adapt(const std::vector<Wish> &wishes,
                 const std::vector<std::vector<double> *> &fields) override;

    private:
      using Cell = typename LocalTriangulation<dim>::Cell;
      static constexpr unsigned int n_corners = LocalTriangulation<dim>::n_corners;

      void number();
      std::uint64_t place(const dealii::Point<dim> &point) const;
      Cell find(const Position &point) const;

      /** What a corner stands for in its cell, in the measure of the scene; on the face
       * across a direction, where one is given. */
      double part_of_corner(const Cell &cell, unsigned int corner, int across = -1) const;

      template <typename Visit>
      void visit_nodes(unsigned int vertex, double weight, const Visit &visit) const
      {
        LocalTriangulation<dim>::visit_masters(masters, vertex, weight,
                                               [&](unsigned int free, double share)
                                               { visit(node_of_vertex[free], share); });
      }

      std::vector<double> volumes() const;
      std::vector<double> by_vertex(const std::vector<double> &by_node) const;
      void place_sites(Discretisation &result) const;
      void conduct(Discretisation &result) const;
      void conduct_between(RowBuilder &rows, unsigned int a, unsigned int b,
                           double conductance) const;
      void find_walls(Discretisation &result) const;
      template <typename Visit>
      void visit_points(const Cell &cell, const dealii::Quadrature<dim> &points,
                        const Visit &visit) const;

      const cases::Scene &scene;
      double spacing;               ///< of the smallest cells, along the domain's side
      int most_halvings;            ///< of a cell
      dealii::Point<dim> lower;     ///< corner of the domain
      dealii::Tensor<1, dim> sizes; ///< of the smallest cells
      LocalTriangulation<dim> local;
      std::vector<Shares> masters;              ///< by vertex; of one that hangs
      std::vector<unsigned int> vertex_of_site; ///< sites along x first
      std::vector<unsigned int> site_of_vertex;
      std::vector<unsigned int> node_of_vertex; ///< of one that is free
      unsigned int n_nodes = 0;
    };

    /** The coarsest cells: see make_refinable_mesh. */
    int halvings_of(const std::vector<unsigned int> &cells, int n)
    {
      int halvings = static_cast<int>(std::log2(std::sqrt(n) / 2));
      for(const unsigned int along : cells)
        while(halvings > 0 && along % (1u << halvings) != 0)
          --halvings;
      if(halvings < 1)
        throw cases::Refusal(fmt::format(
            "fem-enthalpy refines at the front (refinement = front) from cells twice as "
            "large at least: n is to be 16 or more, and the cells along every side an "
            "even number, not {}",
            n < 16 ? static_cast<unsigned int>(n)
                   : *std::ranges::find_if(cells, [](unsigned int along)
                                           { return along % 2 != 0; })));
      return halvings;
    }

    template <int dim>
    RefinableBox<dim>::RefinableBox(const cases::Scene &scene, int n)
      : scene(scene)
      , spacing(scene.domain.side() / n)
    {
      const cases::Domain &domain = scene.domain;
      std::vector<unsigned int> cells(dim, n);
      dealii::Point<dim> upper;
      for(int d = 0; d < dim; ++d)
      {
        lower[d] = domain.lower[d];
        upper[d] = domain.upper[d];
        if(d > 0)
          cells[d] = std::max(
              1, static_cast<int>(std::lround((upper[d] - lower[d]) / spacing)));
        sizes[d] = (upper[d] - lower[d]) / cells[d];
      }
      most_halvings = halvings_of(cells, n);
      for(unsigned int &along : cells)
        along >>= most_halvings;
      // deal.II numbers the sides of a block in the order of cases::Side.
      dealii::GridGenerator::subdivided_hyper_rectangle(local.triangulation, cells, lower,
                                                        upper, true);
      number();
    }

    /** Where a vertex lies among those of the smallest cells, along x first. */
    template <int dim>
    std::uint64_t RefinableBox<dim>::place(const dealii::Point<dim> &point) const
    {
      constexpr int bits = 21;
      std::uint64_t result = 0;
      for(int d = dim; d-- > 0;)
        result
            = (result << bits)
              | static_cast<std::uint64_t>(std::lround((point[d] - lower[d]) / sizes[d]));
      return result;
    }

    /** Sites and nodes by their places, whatever way the mesh came about. */
    template <int dim>
    void RefinableBox<dim>::number()
    {
      const dealii::Triangulation<dim> &cells = local.triangulation;
      masters = local.hanging();
      std::vector<std::pair<std::uint64_t, unsigned int>> order;
      order.reserve(cells.n_used_vertices());
      for(unsigned int v = 0; v < cells.n_vertices(); ++v)
        if(cells.vertex_used(v))
          order.emplace_back(place(cells.get_vertices()[v]), v);
      std::ranges::sort(order);
      vertex_of_site.clear();
      site_of_vertex.assign(cells.n_vertices(), nowhere);
      node_of_vertex.assign(cells.n_vertices(), nowhere);
      n_nodes = 0;
      for(const auto &[where, vertex] : order)
      {
        site_of_vertex[vertex] = static_cast<unsigned int>(vertex_of_site.size());
        vertex_of_site.push_back(vertex);
        if(masters[vertex].empty())
          node_of_vertex[vertex] = n_nodes++;
      }
    }

    template <int dim>
    double RefinableBox<dim>::part_of_corner(const Cell &cell, unsigned int corner,
                                             int across) const
    {
      double part = 1;
      for(int d = 0; d < dim; ++d)
        if(d != across)
          part *= std::ldexp(sizes[d], most_halvings - cell->level() - 1);
      if(scene.domain.shape != cases::DomainShape::axisymmetric)
        return part;
      // The integral of the shape function times 2 pi r.
      const double own = cell->vertex(corner)[0], other = cell->vertex(corner ^ 1u)[0];
      return 2 * std::numbers::pi * part * (across == 0 ? own : (2 * own + other) / 3);
    }

    template <int dim>
    std::vector<double> RefinableBox<dim>::volumes() const
    {
      std::vector<double> result(n_nodes);
      for(const auto &cell : local.triangulation.active_cell_iterators())
        for(unsigned int a = 0; a < n_corners; ++a)
          visit_nodes(cell->vertex_index(a), part_of_corner(cell, a),
                      [&result](unsigned int node, double part)
                      { result[node] += part; });
      return result;
    }

    template <int dim>
    std::vector<double>
    RefinableBox<dim>::by_vertex(const std::vector<double> &by_node) const
    {
      std::vector<double> result(masters.size());
      for(const unsigned int vertex : vertex_of_site)
        visit_nodes(vertex, 1,
                    [&](unsigned int node, double share)
                    { result[vertex] += share * by_node[node]; });
      return result;
    }

    template <int dim>
    Discretisation RefinableBox<dim>::discretise() const
    {
      Discretisation result;
      result.dimension = dim;
      result.spacing = spacing;
      result.volume = volumes();
      place_sites(result);
      conduct(result);
      find_walls(result);
      return result;
    }

    template <int dim>
    void RefinableBox<dim>::place_sites(Discretisation &result) const
    {
      for(int d = 0; d < dim; ++d)
        result.site_positions[d].reserve(vertex_of_site.size());
      result.site_weights.reserve(vertex_of_site.size());
      result.node_of_site.reserve(vertex_of_site.size());
      for(const unsigned int vertex : vertex_of_site)
      {
        const auto site = static_cast<unsigned int>(result.node_of_site.size());
        Position position{};
        for(int d = 0; d < dim; ++d)
        {
          position[d] = local.triangulation.get_vertices()[vertex][d];
          result.site_positions[d].push_back(position[d]);
        }
        if(const unsigned int node = node_of_vertex[vertex]; node != nowhere)
        {
          result.node_of_site.push_back(node);
          result.site_weights.push_back(result.volume[node]);
          result.positions.push_back(position);
          continue;
        }
        HangingSite hangs{site, {}};
        visit_nodes(vertex, 1,
                    [&hangs](unsigned int node, double share)
                    { hangs.nodes.emplace_back(node, share); });
        result.node_of_site.push_back(hangs.nodes.front().first);
        result.site_weights.push_back(0);
        result.hanging.push_back(std::move(hangs));
      }
      result.cells.reserve(local.triangulation.n_active_cells() * n_corners);
      for(const auto &cell : local.triangulation.active_cell_iterators())
        for(unsigned int a = 0; a < n_corners; ++a)
          result.cells.push_back(site_of_vertex[cell->vertex_index(a)]);
    }

    /** Between two vertices, each of which may be the mean of nodes: energy is g/2 times
     * the square of a sum of shares of nodes that sum up to zero. */
    template <int dim>
    void RefinableBox<dim>::conduct_between(RowBuilder &rows, unsigned int a,
                                            unsigned int b, double conductance) const
    {
      if(masters[a].empty() && masters[b].empty())
      {
        rows.add(node_of_vertex[a], node_of_vertex[b], conductance);
        rows.add(node_of_vertex[b], node_of_vertex[a], conductance);
        return;
      }
      std::map<unsigned int, double> difference;
      visit_nodes(a, 1,
                  [&](unsigned int node, double share) { difference[node] += share; });
      visit_nodes(b, 1,
                  [&](unsigned int node, double share) { difference[node] -= share; });
      for(auto i = difference.begin(); i != difference.end(); ++i)
        for(auto j = std::next(i); j != difference.end(); ++j)
          if(const double part = -conductance * i->second * j->second; part != 0)
          {
            rows.add(i->first, j->first, part);
            rows.add(j->first, i->first, part);
          }
    }

    /** By the trapezoidal rule only the edges of a cell conduct. */
    template <int dim>
    void RefinableBox<dim>::conduct(Discretisation &result) const
    {
      std::vector<unsigned int> room(n_nodes);
      for(const auto &cell : local.triangulation.active_cell_iterators())
      {
        std::vector<unsigned int> around;
        bool hangs = false;
        for(unsigned int a = 0; a < n_corners; ++a)
        {
          hangs |= !masters[cell->vertex_index(a)].empty();
          visit_nodes(cell->vertex_index(a), 1,
                      [&around](unsigned int node, double) { around.push_back(node); });
        }
        std::ranges::sort(around);
        around.erase(std::unique(around.begin(), around.end()), around.end());
        for(const unsigned int node : around)
          room[node] += hangs ? static_cast<unsigned int>(around.size()) : dim;
      }
      RowBuilder rows(room);
      result.conduction.diagonal.assign(n_nodes, 0);
      for(const auto &cell : local.triangulation.active_cell_iterators())
        for(unsigned int a = 0; a < n_corners; ++a)
          for(int d = 0; d < dim; ++d)
            if(const unsigned int b = a | 1u << d; b != a)
            {
              const double length = std::ldexp(sizes[d], most_halvings - cell->level());
              conduct_between(rows, cell->vertex_index(a), cell->vertex_index(b),
                              (part_of_corner(cell, a) + part_of_corner(cell, b))
                                  / (length * length));
            }
      rows.move_to(result.conduction);
    }

    template <int dim>
    void RefinableBox<dim>::find_walls(Discretisation &result) const
    {
      const std::vector<Side> sides = scene.sides();
      std::array<std::map<unsigned int, double>, cases::n_sides> areas;
      for(const auto &cell : local.triangulation.active_cell_iterators())
        for(const auto face : cell->face_indices())
        {
          const auto side = static_cast<Side>(cell->face(face)->boundary_id());
          if(!cell->at_boundary(face) || std::ranges::find(sides, side) == sides.end())
            continue;
          const int across = static_cast<int>(face / 2);
          for(unsigned int a = 0; a < n_corners; ++a)
            if((a >> across & 1u) == face % 2)
              visit_nodes(cell->vertex_index(a), part_of_corner(cell, a, across),
                          [&](unsigned int node, double part)
                          { areas[static_cast<std::size_t>(side)][node] += part; });
        }
      for(std::size_t side = 0; side < cases::n_sides; ++side)
        for(const auto &[node, area] : areas[side])
          result.walls[side].push_back({node, area, result.positions[node]});
    }

    template <int dim>
    typename RefinableBox<dim>::Cell RefinableBox<dim>::find(const Position &point) const
    {
      const double tolerance = 1e-12 * scene.domain.side();
      for(const auto &cell : local.triangulation.active_cell_iterators())
      {
        const auto &least = cell->vertex(0), &greatest = cell->vertex(n_corners - 1);
        bool inside = true;
        for(int d = 0; d < dim; ++d)
          inside
              &= point[d] >= least[d] - tolerance && point[d] <= greatest[d] + tolerance;
        if(inside)
          return cell;
      }
      throw cases::InputError(
          fmt::format("the source at ({:.6g}, {:.6g}, {:.6g}) lies outside of the domain",
                      point[0], point[1], point[2]));
    }

    template <int dim>
    std::size_t RefinableBox<dim>::cell_at(const Position &point) const
    {
      return find(point)->active_cell_index();
    }

    template <int dim>
    Shares RefinableBox<dim>::shares(const Position &point) const
    {
      const Cell cell = find(point);
      const auto &least = cell->vertex(0), &greatest = cell->vertex(n_corners - 1);
      Shares result;
      double sum = 0;
      for(unsigned int a = 0; a < n_corners; ++a)
      {
        double value = 1;
        for(int d = 0; d < dim; ++d)
        {
          const double x
              = std::clamp((point[d] - least[d]) / (greatest[d] - least[d]), 0., 1.);
          value *= a >> d & 1 ? x : 1 - x;
        }
        // A source on a vertex is found there up to round-off only.
        if(value > 1e-12)
          visit_nodes(cell->vertex_index(a), value,
                      [&](unsigned int node, double share)
                      {
                        result.emplace_back(node, share);
                        sum += share;
                      });
      }
      for(auto &share : result)
        share.second /= sum;
      return result;
    }

    /** Visit points of a cell, with their measures and the corners nearest to them. */
    template <int dim>
    template <typename Visit>
    void RefinableBox<dim>::visit_points(const Cell &cell,
                                         const dealii::Quadrature<dim> &points,
                                         const Visit &visit) const
    {
      const auto &least = cell->vertex(0), &greatest = cell->vertex(n_corners - 1);
      double volume = 1;
      for(int d = 0; d < dim; ++d)
        volume *= greatest[d] - least[d];
      for(unsigned int q = 0; q < points.size(); ++q)
      {
        Position position{};
        unsigned int nearest = 0;
        for(int d = 0; d < dim; ++d)
        {
          const double x = points.point(q)[d];
          position[d] = least[d] + x * (greatest[d] - least[d]);
          nearest |= (x > 0.5 ? 1u : 0u) << d;
        }
        double measure = points.weight(q) * volume;
        if(scene.domain.shape == cases::DomainShape::axisymmetric)
          measure *= 2 * std::numbers::pi * position[0];
        visit(position, measure, nearest);
      }
    }

    template <int dim>
    std::vector<double> RefinableBox<dim>::node_averages(
        const std::function<double(const Position &)> &function,
        const std::function<bool(const Position &)> &solid) const
    {
      const dealii::QIterated<dim> few(dealii::QGauss<1>(2), 2),
          many(dealii::QMidpoint<1>(), 8);
      constexpr char is_solid = 1, is_liquid = 2, both = 3;
      std::vector<char> phases(masters.size());
      for(const auto &cell : local.triangulation.active_cell_iterators())
      {
        char found = 0;
        visit_points(cell, few,
                     [&](const Position &p, double, unsigned int)
                     { found |= solid(p) ? is_solid : is_liquid; });
        for(unsigned int a = 0; a < n_corners; ++a)
          phases[cell->vertex_index(a)] |= found;
      }
      std::vector<double> sum(n_nodes), measure_of(n_nodes);
      for(const auto &cell : local.triangulation.active_cell_iterators())
      {
        char found = 0;
        for(unsigned int a = 0; a < n_corners; ++a)
          found |= phases[cell->vertex_index(a)];
        visit_points(cell, found == both ? many : few,
                     [&](const Position &p, double measure, unsigned int nearest)
                     {
                       const double value = function(p);
                       visit_nodes(cell->vertex_index(nearest), measure,
                                   [&](unsigned int node, double part)
                                   {
                                     sum[node] += part * value;
                                     measure_of[node] += part;
                                   });
                     });
      }
      for(unsigned int i = 0; i < n_nodes; ++i)
        sum[i] /= measure_of[i];
      return sum;
    }

    template <int dim>
    std::vector<int> RefinableBox<dim>::halvings_left() const
    {
      std::vector<int> result;
      for(const auto &cell : local.triangulation.active_cell_iterators())
        result.push_back(most_halvings - cell->level());
      return result;
    }

    template <int dim>
    std::vector<double> RefinableBox<dim>::jumps(const std::vector<double> &values) const
    {
      const auto &cells = local.triangulation;
      const auto size = [this](const auto &cell, int d)
      { return std::ldexp(sizes[d], most_halvings - cell->level()); };
      std::vector<std::array<double, dim>> gradient(cells.n_active_cells());
      for(const auto &cell : cells.active_cell_iterators())
        for(int d = 0; d < dim; ++d)
        {
          double sum = 0;
          for(unsigned int a = 0; a < n_corners; ++a)
            sum += (a >> d & 1u ? 1 : -1) * values[site_of_vertex[cell->vertex_index(a)]];
          gradient[cell->active_cell_index()][d] = sum / (n_corners / 2) / size(cell, d);
        }
      std::vector<double> result(cells.n_active_cells());
      for(const auto &cell : cells.active_cell_iterators())
        for(const auto face : cell->face_indices())
        {
          if(cell->at_boundary(face) || cell->neighbor(face)->has_children())
            continue;
          const auto neighbour = cell->neighbor(face);
          const int d = static_cast<int>(face / 2);
          const auto here = cell->active_cell_index(),
                     there = neighbour->active_cell_index();
          const double jump = std::abs(gradient[here][d] - gradient[there][d]);
          result[here] = std::max(result[here], size(cell, d) * jump);
          result[there] = std::max(result[there], size(neighbour, d) * jump);
        }
      return result;
    }

    template <int dim>
    bool RefinableBox<dim>::adapt(const std::vector<Wish> &wishes,
                                  const std::vector<std::vector<double> *> &fields)
    {
      std::vector<Wish> possible = wishes;
      const std::vector<int> left = halvings_left();
      for(std::size_t c = 0; c < possible.size(); ++c)
        if(possible[c] == Wish::halve && left[c] == 0)
          possible[c] = Wish::keep;
      std::vector<double> volume(masters.size());
      {
        const std::vector<double> by_node = volumes();
        for(unsigned int v = 0; v < volume.size(); ++v)
          if(node_of_vertex[v] != nowhere)
            volume[v] = by_node[node_of_vertex[v]];
      }
      std::vector<std::vector<double>> values;
      for(const std::vector<double> *field : fields)
        values.push_back(by_vertex(*field));
      if(!local.adapt(possible, volume, values))
        return false;
      number();
      for(std::size_t f = 0; f < fields.size(); ++f)
      {
        fields[f]->resize(n_nodes);
        for(unsigned int v = 0; v < values[f].size(); ++v)
          if(node_of_vertex[v] != nowhere)
            (*fields[f])[node_of_vertex[v]] = values[f][v];
      }
      return true;
    }
  } // namespace

  std::unique_ptr<RefinableMesh> make_refinable_mesh(const cases::Scene &scene,
                                                     int dimension, int n)
  {
    const bool of_boxes = scene.domain.shape == cases::DomainShape::box
                          || scene.domain.shape == cases::DomainShape::axisymmetric;
    if(!of_boxes || dimension < 2 || scene.domain.outline)
      throw cases::Refusal(fmt::format(
          "fem-enthalpy refines at the front (refinement = front) in boxes and half "
          "sections of axisymmetric bodies, not in a domain of the shape {}",
          cases::to_string(scene.domain.shape)));
    for(const Side side : scene.sides())
      if(scene.boundary(side).kind == cases::BoundaryKind::periodic)
        throw cases::Refusal(
            fmt::format("fem-enthalpy refines at the front (refinement = front) where no "
                        "side is periodic only, and {} is",
                        cases::to_string(side)));
    if(dimension == 2)
      return std::make_unique<RefinableBox<2>>(scene, n);
    return std::make_unique<RefinableBox<3>>(scene, n);
  }
} // namespace meltfront::reference_fem
