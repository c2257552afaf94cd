#ifndef meltfront_reference_fem_enthalpy_local_triangulation_h
#define meltfront_reference_fem_enthalpy_local_triangulation_h

#include <reference_fem/enthalpy/refinable_mesh.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/grid/tria.h>

#include <array>
#include <utility>
#include <vector>

namespace meltfront::reference_fem
{
  /**
   * Boxes that are halved here and there, and what nodal values become when they are
   * halved or joined. Values are by vertex, as deal.II numbers them (a vertex keeps its
   * number as long as it is used); a vertex in the middle of an edge or face of a larger
   * cell hangs: it has the mean of that edge's or face's vertices.
   *
   * Linear functions on the mesh before lie among those on the mesh after halving, and
   * those after joining among those before. So halving interpolates, and joining takes
   * the adjoint, Q_c = sum_f phi_c(x_f) Q_f of the heats Q = volume times value: both
   * keep the sum of all heats, constants, and the bounds of the values.
   */
  template <int dim>
  class LocalTriangulation
  {
  public:
    using Cell = typename dealii::Triangulation<dim>::active_cell_iterator;

    static constexpr unsigned int n_corners = 1u << dim;

    LocalTriangulation()
      : triangulation(dealii::Triangulation<dim>::limit_level_difference_at_vertices)
    {
    }

    /** By vertex; empty where a vertex is free. */
    std::vector<Shares> hanging() const;

    /** Visit the free vertices that a vertex's value is the mean of, with weights. */
    template <typename Visit>
    static void visit_masters(const std::vector<Shares> &masters, unsigned int vertex,
                              double weight, const Visit &visit)
    {
      if(masters[vertex].empty())
        visit(vertex, weight);
      else
        for(const auto &[master, share] : masters[vertex])
          visit_masters(masters, master, weight * share, visit);
    }

    /**
     * Join and halve cells.
     * @param wishes by active cell; cells are halved too, or not joined, so that
     * neighbours differ by a factor of two at most
     * @param volume by vertex, zero where it hangs
     * @param fields values by vertex, carried over
     * @return whether a cell has changed
     */
    bool adapt(const std::vector<Wish> &wishes, const std::vector<double> &volume,
               std::vector<std::vector<double>> &fields);

    dealii::Triangulation<dim> triangulation;

  private:
    /** A vertex of cells that are joined, with its shares of the joined cell's corners.
     */
    using Leaving = std::pair<unsigned int, Shares>;

    static std::array<double, n_corners> shares_of_corner(unsigned int child,
                                                          unsigned int corner);
    void add_leaving(const Cell &first_child, std::vector<Leaving> &leaving) const;
    void join(std::vector<Leaving> &leaving, const std::vector<double> &volume,
              std::vector<std::vector<double>> &fields);
    void halve(const std::vector<Cell> &cells, std::vector<std::vector<double>> &fields);
  };

  template <int dim>
  std::vector<Shares> LocalTriangulation<dim>::hanging() const
  {
    std::vector<Shares> result(triangulation.n_vertices());
    const auto hang = [&result](const auto &edge_or_face, unsigned int corners)
    {
      // The first child's corner opposite to that which it shares with its parent.
      const unsigned int middle = edge_or_face->child(0)->vertex_index(corners - 1);
      if(result[middle].empty())
        for(unsigned int v = 0; v < corners; ++v)
          result[middle].emplace_back(edge_or_face->vertex_index(v), 1. / corners);
    };
    for(const auto &cell : triangulation.active_cell_iterators())
    {
      for(unsigned int l = 0; l < dealii::GeometryInfo<dim>::lines_per_cell; ++l)
        if(cell->line(l)->has_children())
          hang(cell->line(l), 2);
      if constexpr(dim == 3)
        for(const auto f : cell->face_indices())
          if(cell->face(f)->has_children())
            hang(cell->face(f), 4);
    }
    return result;
  }

  /** Values of a cell's shape functions at a corner of one of its children. */
  template <int dim>
  std::array<double, LocalTriangulation<dim>::n_corners>
  LocalTriangulation<dim>::shares_of_corner(unsigned int child, unsigned int corner)
  {
    std::array<double, n_corners> result;
    for(unsigned int a = 0; a < n_corners; ++a)
    {
      result[a] = 1;
      for(int d = 0; d < dim; ++d)
      {
        const double x = ((child >> d & 1) + (corner >> d & 1)) / 2.;
        result[a] *= a >> d & 1 ? x : 1 - x;
      }
    }
    return result;
  }

  template <int dim>
  void LocalTriangulation<dim>::add_leaving(const Cell &first_child,
                                            std::vector<Leaving> &leaving) const
  {
    const auto parent = first_child->parent();
    for(unsigned int child = 0; child < n_corners; ++child)
      for(unsigned int corner = 0; corner < n_corners; ++corner)
      {
        if(corner == child) // the parent's own
          continue;
        const auto shares = shares_of_corner(child, corner);
        Leaving vertex{parent->child(child)->vertex_index(corner), {}};
        for(unsigned int a = 0; a < n_corners; ++a)
          if(shares[a] > 0)
            vertex.second.emplace_back(parent->vertex_index(a), shares[a]);
        leaving.push_back(std::move(vertex));
      }
  }

  /** As differences from what the remaining vertices have: where nothing leaves, nothing
   * changes. */
  template <int dim>
  void LocalTriangulation<dim>::join(std::vector<Leaving> &leaving,
                                     const std::vector<double> &volume,
                                     std::vector<std::vector<double>> &fields)
  {
    triangulation.execute_coarsening_and_refinement();
    std::vector<Shares> masters = hanging();
    for(auto &[vertex, shares] : leaving)
      if(!triangulation.vertex_used(vertex))
        masters[vertex] = std::move(shares);
    std::vector<double> gained(volume.size());
    std::vector<std::vector<double>> change(fields.size(),
                                            std::vector<double>(volume.size()));
    for(unsigned int v = 0; v < volume.size(); ++v)
      if(volume[v] > 0 && !masters[v].empty())
        visit_masters(masters, v, 1,
                      [&](unsigned int master, double weight)
                      {
                        gained[master] += weight * volume[v];
                        for(std::size_t f = 0; f < fields.size(); ++f)
                          change[f][master]
                              += weight * volume[v] * (fields[f][v] - fields[f][master]);
                      });
    for(std::size_t f = 0; f < fields.size(); ++f)
    {
      for(unsigned int v = 0; v < volume.size(); ++v)
        if(gained[v] > 0)
          fields[f][v] += change[f][v] / (volume[v] + gained[v]);
      for(unsigned int v = 0; v < volume.size(); ++v)
        if(!masters[v].empty())
        {
          double mean = 0;
          visit_masters(masters, v, 1,
                        [&](unsigned int master, double weight)
                        { mean += weight * fields[f][master]; });
          fields[f][v] = mean;
        }
    }
  }

  template <int dim>
  void LocalTriangulation<dim>::halve(const std::vector<Cell> &cells,
                                      std::vector<std::vector<double>> &fields)
  {
    for(const Cell &cell : cells)
      cell->set_refine_flag();
    triangulation.prepare_coarsening_and_refinement();
    std::vector<typename dealii::Triangulation<dim>::cell_iterator> parents;
    for(const auto &cell : triangulation.active_cell_iterators())
      if(cell->refine_flag_set())
        parents.push_back(cell);
    const std::vector<bool> used_before = triangulation.get_used_vertices();
    triangulation.execute_coarsening_and_refinement();
    for(std::vector<double> &field : fields)
      field.resize(triangulation.n_vertices());
    for(const auto &parent : parents)
      for(unsigned int child = 0; child < n_corners; ++child)
        for(unsigned int corner = 0; corner < n_corners; ++corner)
        {
          const unsigned int vertex = parent->child(child)->vertex_index(corner);
          if(vertex < used_before.size() && used_before[vertex])
            continue;
          const auto shares = shares_of_corner(child, corner);
          for(std::vector<double> &field : fields)
          {
            field[vertex] = 0;
            for(unsigned int a = 0; a < n_corners; ++a)
              field[vertex] += shares[a] * field[parent->vertex_index(a)];
          }
        }
  }

  template <int dim>
  bool LocalTriangulation<dim>::adapt(const std::vector<Wish> &wishes,
                                      const std::vector<double> &volume,
                                      std::vector<std::vector<double>> &fields)
  {
    for(const auto &cell : triangulation.active_cell_iterators())
      switch(wishes[cell->active_cell_index()])
      {
      case Wish::halve:
        cell->set_refine_flag();
        break;
      case Wish::join:
        if(cell->level() > 0)
          cell->set_coarsen_flag();
        break;
      case Wish::keep:
        break;
      }
    triangulation.prepare_coarsening_and_refinement();
    std::vector<Cell> to_halve;
    std::vector<Leaving> leaving;
    for(const auto &cell : triangulation.active_cell_iterators())
      if(cell->refine_flag_set())
      {
        to_halve.push_back(cell);
        cell->clear_refine_flag();
      }
      else if(cell->coarsen_flag_set() && cell == cell->parent()->child(0))
        add_leaving(cell, leaving);
    if(!leaving.empty())
      join(leaving, volume, fields);
    if(!to_halve.empty())
      halve(to_halve, fields);
    return !leaving.empty() || !to_halve.empty();
  }
} // namespace meltfront::reference_fem

#endif
