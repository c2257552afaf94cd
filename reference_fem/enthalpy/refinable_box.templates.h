#ifndef meltfront_reference_fem_enthalpy_refinable_box_templates_h
#define meltfront_reference_fem_enthalpy_refinable_box_templates_h

#include <reference_fem/enthalpy/refinable_box.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

namespace meltfront::reference_fem
{
  inline constexpr unsigned int nowhere = static_cast<unsigned int>(-1);

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
                    [&result](unsigned int node, double part) { result[node] += part; });
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
      cases::Position position{};
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
    const std::vector<cases::Side> sides = scene.sides();
    std::array<std::map<unsigned int, double>, cases::n_sides> areas;
    for(const auto &cell : local.triangulation.active_cell_iterators())
      for(const auto face : cell->face_indices())
      {
        const auto side = static_cast<cases::Side>(cell->face(face)->boundary_id());
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

} // namespace meltfront::reference_fem

#endif
