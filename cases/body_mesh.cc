#include <cases/body_mesh.h>
#include <cases/error.h>
#include <cases/hanging_vertices.h>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace meltfront::cases
{
  namespace
  {
    /** Of the body's size: vertices nearer to each other than this are at one place. */
    constexpr double same_place = 1e-9;

    /** Of the largest corner of a cell: a smaller one is flat. */
    constexpr double flat = 1e-9;

    using Corners = std::vector<unsigned int>;

    /** The faces of a cell by its corners, those of four vertices around. */
    const std::vector<Corners> &faces_of(CellKind kind)
    {
      static const std::vector<Corners> all[]
          = {{{0, 1}, {1, 2}, {2, 0}},
             {{0, 1}, {1, 3}, {3, 2}, {2, 0}},
             {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {0, 2, 3}},
             {{0, 1, 3, 2},
              {4, 5, 7, 6},
              {0, 1, 5, 4},
              {2, 3, 7, 6},
              {0, 2, 6, 4},
              {1, 3, 7, 5}}};
      return all[static_cast<std::size_t>(kind)];
    }

    Corners sorted(Corners vertices)
    {
      std::ranges::sort(vertices);
      return vertices;
    }

    double longest_side(const Position &lower, const Position &upper)
    {
      return std::max({upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]});
    }

    std::string place_of(const Position &p, int dimension)
    {
      return dimension == 2 ? fmt::format("({:.6g}, {:.6g})", p[0], p[1])
                            : fmt::format("({:.6g}, {:.6g}, {:.6g})", p[0], p[1], p[2]);
    }

    /** Sets of cells that are joined one by one. */
    class Parts
    {
    public:
      explicit Parts(std::size_t size)
        : parent(size)
      {
        std::iota(parent.begin(), parent.end(), std::size_t(0));
      }

      std::size_t of(std::size_t i)
      {
        while(parent[i] != i)
          i = parent[i] = parent[parent[i]];
        return i;
      }

      void join(std::size_t a, std::size_t b)
      {
        parent[of(a)] = of(b);
      }

    private:
      std::vector<std::size_t> parent;
    };
  } // namespace

  const char *to_string(CellKind kind)
  {
    constexpr const char *names[]
        = {"triangles", "quadrilaterals", "tetrahedra", "hexahedra"};
    return names[static_cast<std::size_t>(kind)];
  }

  int dimension_of(CellKind kind)
  {
    return kind == CellKind::triangle || kind == CellKind::quadrilateral ? 2 : 3;
  }

  unsigned int corners_of(CellKind kind)
  {
    constexpr unsigned int corners[] = {3, 4, 4, 8};
    return corners[static_cast<std::size_t>(kind)];
  }

  BodyMesh::BodyMesh(BodyMeshData given)
    : data(std::move(given))
  {
    if(data.cells.empty())
      throw InputError("holds no cells");
    drop_unused_vertices();
    find_box();
    require_separate_vertices();
    turn_cells();
    find_boundary();
    visit_volume(0, [this](const Position &, double part) { total_volume += part; });
    sort_cells_into_bins();
    const double size = longest_side(lower_corner, upper_corner);
    if(const auto vertex = hanging_vertex(*this, same_place * size))
      throw InputError(
          fmt::format("has a vertex on a face of a cell that lacks it, at {}: "
                      "cells of two sizes do not hold together",
                      place_of(*vertex, dimension())));
  }

  void BodyMesh::drop_unused_vertices()
  {
    constexpr auto unused = static_cast<unsigned int>(-1);
    std::vector<unsigned int> number(data.vertices.size(), unused);
    for(const unsigned int v : data.cells)
      number[v] = 0;
    unsigned int next = 0;
    for(std::size_t v = 0; v < number.size(); ++v)
      if(number[v] != unused)
      {
        number[v] = next;
        data.vertices[next++] = data.vertices[v];
      }
    data.vertices.resize(next);
    for(unsigned int &v : data.cells)
      v = number[v];
    for(BodyMeshData::NamedFace &face : data.faces)
      for(unsigned int &v : face.vertices)
      {
        if(number[v] == unused)
          throw InputError(
              fmt::format("has a face of '{}' that no cell has", data.walls[face.wall]));
        v = number[v];
      }
  }

  void BodyMesh::find_box()
  {
    lower_corner = upper_corner = data.vertices.front();
    for(const Position &p : data.vertices)
      for(int d = 0; d < 3; ++d)
      {
        lower_corner[d] = std::min(lower_corner[d], p[d]);
        upper_corner[d] = std::max(upper_corner[d], p[d]);
      }
  }

  /** Two of a place come of parts that were meshed one by one: heat would not pass. */
  void BodyMesh::require_separate_vertices() const
  {
    const double size = longest_side(lower_corner, upper_corner);
    std::vector<Position> ordered = data.vertices;
    std::ranges::sort(ordered);
    for(std::size_t i = 0; i < ordered.size(); ++i)
      for(std::size_t j = i + 1;
          j < ordered.size() && ordered[j][0] - ordered[i][0] <= same_place * size; ++j)
        if(std::abs(ordered[j][1] - ordered[i][1]) <= same_place * size
           && std::abs(ordered[j][2] - ordered[i][2]) <= same_place * size)
          throw InputError(fmt::format(
              "has two vertices at {}: parts that were meshed one by one do not hold "
              "together (gmsh's 'Coherence' joins them)",
              place_of(ordered[i], dimension())));
  }

  std::vector<unsigned int> BodyMesh::corners(std::size_t cell) const
  {
    const unsigned int n = corners_of(data.kind);
    const auto first = data.cells.begin() + static_cast<std::ptrdiff_t>(cell * n);
    return {first, first + n};
  }

  /** The corner of a quadrilateral or a hexahedron at a vertex is the simplex of it and
   * its neighbours: a cell all of whose corners have one sign is not folded. */
  void BodyMesh::turn_cells()
  {
    const unsigned int n = corners_of(data.kind);
    const bool simplices = n == static_cast<unsigned int>(dimension()) + 1;
    for(std::size_t cell = 0; cell < n_cells(); ++cell)
    {
      unsigned int *const c = &data.cells[cell * n];
      const auto at = [&](unsigned int a) { return data.vertices[c[a]]; };
      double least = std::numeric_limits<double>::infinity(), most = -least;
      for(unsigned int a = 0; a < (simplices ? 1 : n); ++a)
      {
        const double corner
            = (std::popcount(a) % 2 == 1 ? -1 : 1)
              * signed_measure(simplices && n == 3 ? Simplex{at(0), at(1), at(2)}
                               : simplices         ? Simplex{at(0), at(1), at(2), at(3)}
                               : n == 4
                                   ? Simplex{at(a), at(a ^ 1), at(a ^ 2)}
                                   : Simplex{at(a), at(a ^ 1), at(a ^ 2), at(a ^ 4)});
        least = std::min(least, corner);
        most = std::max(most, corner);
      }
      const double size = std::max(std::abs(least), std::abs(most));
      double longest = 0;
      for(unsigned int a = 1; a < n; ++a)
        longest = std::max(longest, measure_of({at(0), at(a)}));
      if(!(least * most > 0) || std::min(std::abs(least), std::abs(most)) <= flat * size
         || size <= flat * std::pow(longest, dimension()))
        throw InputError(fmt::format("has a cell that is folded or flat at {}",
                                     place_of(mean_of(corners(cell)), dimension())));
      if(most < 0)
      {
        std::swap(c[1], c[2]);
        if(n == 8)
          std::swap(c[5], c[6]);
      }
    }
  }

  /** Faces that one cell has; the cells on both sides of the others hold together. */
  void BodyMesh::find_boundary()
  {
    constexpr int no_wall = -1;
    struct Side
    {
      std::size_t cell;
      Corners vertices;
      int cells = 0;
      int wall = no_wall;
    };
    std::map<Corners, Side> sides;
    Parts parts(n_cells());
    for(std::size_t cell = 0; cell < n_cells(); ++cell)
    {
      const Corners c = corners(cell);
      for(Corners face : faces_of(data.kind))
      {
        for(unsigned int &corner : face)
          corner = c[corner];
        Side &side = sides.try_emplace(sorted(face), Side{cell, face}).first->second;
        if(++side.cells > 2)
          throw InputError(
              fmt::format("has more than two cells at one face, at {}: cells overlap, or "
                          "are written twice for two groups",
                          place_of(mean_of(face), dimension())));
        parts.join(cell, side.cell);
      }
    }
    for(const BodyMeshData::NamedFace &face : data.faces)
    {
      const auto found = sides.find(sorted(face.vertices));
      if(found == sides.end())
        throw InputError(fmt::format("has a face of '{}' that no cell has, at {}",
                                     data.walls[face.wall],
                                     place_of(mean_of(face.vertices), dimension())));
      Side &side = found->second;
      if(side.cells == 1 && side.wall != no_wall
         && side.wall != static_cast<int>(face.wall))
        throw InputError(fmt::format("has a face of both '{}' and '{}', at {}",
                                     data.walls[side.wall], data.walls[face.wall],
                                     place_of(mean_of(face.vertices), dimension())));
      side.wall = static_cast<int>(face.wall);
    }
    for(std::size_t cell = 1; cell < n_cells(); ++cell)
      if(parts.of(cell) != parts.of(0))
        throw InputError(
            fmt::format("falls apart: no face joins the cells at {} to those at {}",
                        place_of(mean_of(corners(cell)), dimension()),
                        place_of(mean_of(corners(0)), dimension())));
    for(const auto &[vertices, side] : sides)
      if(side.cells == 1)
        faces.push_back({side.vertices, side.wall});
  }

  Position BodyMesh::mean_of(const std::vector<unsigned int> &vertices) const
  {
    Position mean{};
    for(const unsigned int v : vertices)
      for(int d = 0; d < 3; ++d)
        mean[d] += data.vertices[v][d] / static_cast<double>(vertices.size());
    return mean;
  }

  /** A bilinear face as four triangles about its middle, which both of its cells share.
   */
  std::vector<Simplex>
  BodyMesh::simplices_of_face(const std::vector<unsigned int> &face) const
  {
    const auto at = [&](std::size_t a) { return data.vertices[face[a % face.size()]]; };
    if(face.size() == 2)
      return {{at(0), at(1)}};
    if(face.size() == 3)
      return {{at(0), at(1), at(2)}};
    std::vector<Simplex> result;
    const Position middle = mean_of(face);
    for(std::size_t a = 0; a < 4; ++a)
      result.push_back({middle, at(a), at(a + 1)});
    return result;
  }

  std::vector<Simplex> BodyMesh::simplices_of_cell(std::size_t cell) const
  {
    const Corners c = corners(cell);
    const auto at = [&](std::size_t a) { return data.vertices[c[a]]; };
    switch(data.kind)
    {
    case CellKind::triangle:
      return {{at(0), at(1), at(2)}};
    case CellKind::quadrilateral:
      return {{at(0), at(1), at(3)}, {at(0), at(3), at(2)}};
    case CellKind::tetrahedron:
      return {{at(0), at(1), at(2), at(3)}};
    default:
    {
      std::vector<Simplex> result;
      const Position middle = mean_of(c);
      for(Corners face : faces_of(data.kind))
      {
        for(unsigned int &corner : face)
          corner = c[corner];
        for(const Simplex &part : simplices_of_face(face))
          result.push_back({middle, part[0], part[1], part[2]});
      }
      return result;
    }
    }
  }

  double BodyMesh::area(int wall) const
  {
    double sum = 0;
    for(const Face &face : faces)
      if(face.wall == wall)
        for(const Simplex &part : simplices_of_face(face.vertices))
          sum += measure_of(part);
    return sum;
  }

  void BodyMesh::visit_volume(int levels, const WeightedPointVisitor &visit) const
  {
    for(std::size_t cell = 0; cell < n_cells(); ++cell)
      for(const Simplex &part : simplices_of_cell(cell))
        visit_parts(part, levels, visit);
  }

  void BodyMesh::visit_wall(unsigned int wall, int levels,
                            const WeightedPointVisitor &visit) const
  {
    for(const Face &face : faces)
      if(face.wall == static_cast<int>(wall))
        for(const Simplex &part : simplices_of_face(face.vertices))
          visit_parts(part, levels, visit);
  }

  double BodyMesh::distance_from_boundary(const Position &point) const
  {
    double least = std::numeric_limits<double>::infinity();
    for(const Face &face : faces)
      for(const Simplex &part : simplices_of_face(face.vertices))
        least = std::min(least, distance_from(part, point));
    return least;
  }

  std::array<std::size_t, 3> BodyMesh::index_at(const Position &point) const
  {
    std::array<std::size_t, 3> index{};
    for(int d = 0; d < dimension(); ++d)
    {
      const double share
          = (point[d] - lower_corner[d]) / (upper_corner[d] - lower_corner[d]);
      index[d]
          = static_cast<std::size_t>(std::clamp(share * static_cast<double>(n_bins[d]),
                                                0., static_cast<double>(n_bins[d] - 1)));
    }
    return index;
  }

  std::size_t BodyMesh::bin_of(const std::array<std::size_t, 3> &index) const
  {
    return (index[2] * n_bins[1] + index[1]) * n_bins[0] + index[0];
  }

  /** About as many bins as cells. */
  void BodyMesh::sort_cells_into_bins()
  {
    double box = 1;
    for(int d = 0; d < dimension(); ++d)
      box *= upper_corner[d] - lower_corner[d];
    const double width = std::pow(box / static_cast<double>(n_cells()), 1. / dimension());
    constexpr double most_along = 1000;
    for(int d = 0; d < dimension(); ++d)
      n_bins[d] = static_cast<std::size_t>(
          std::clamp((upper_corner[d] - lower_corner[d]) / width, 1., most_along));
    bins.resize(n_bins[0] * n_bins[1] * n_bins[2]);
    for(std::size_t cell = 0; cell < n_cells(); ++cell)
    {
      const Corners c = corners(cell);
      Position low = data.vertices[c[0]], high = low;
      for(const unsigned int v : c)
        for(int d = 0; d < 3; ++d)
        {
          low[d] = std::min(low[d], data.vertices[v][d]);
          high[d] = std::max(high[d], data.vertices[v][d]);
        }
      const auto first = index_at(low), last = index_at(high);
      for(std::size_t k = first[2]; k <= last[2]; ++k)
        for(std::size_t j = first[1]; j <= last[1]; ++j)
          for(std::size_t i = first[0]; i <= last[0]; ++i)
            bins[bin_of({i, j, k})].push_back(cell);
    }
  }

  std::optional<std::size_t> BodyMesh::cell_at(const Position &point) const
  {
    for(const std::size_t cell : bins[bin_of(index_at(point))])
      for(const Simplex &part : simplices_of_cell(cell))
        if(holds_point(part, point))
          return cell;
    return {};
  }
} // namespace meltfront::cases
