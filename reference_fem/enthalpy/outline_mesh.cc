#include <reference_fem/enthalpy/outline_mesh.h>

#include <cases/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <map>
#include <numeric>
#include <set>

namespace meltfront::reference_fem
{
  namespace
  {
    using cases::Outline;
    using Point = Outline::Point;
    using Index = std::array<int, 2>; ///< of a vertex, or of a cell by its lowest vertex

    /** In spacings: squares nearer to the outline than this make room for the layer. */
    constexpr double least_depth = 0.45;

    /** Layers of vertices behind the outline that are moved, and how often. */
    constexpr int moved_layers = 4, sweeps = 40;

    /** Sine of the worst corner that a mesh may have. */
    constexpr double acceptable_corner = 0.1;

    /** In spacings: how far along the outline the nearest partner of a corner may be. */
    constexpr double farthest_corner = 6;

    /** Least distance between neighbours on the outline, over their mean one. */
    constexpr double least_gap = 0.35;

    Index operator+(const Index &a, const Index &b)
    {
      return {a[0] + b[0], a[1] + b[1]};
    }

    /** Sine of the worst corner of a cell. */
    double worst_corner(const std::vector<Point> &vertices,
                        const std::array<unsigned int, 4> &cell)
    {
      constexpr std::array<unsigned int, 4> counter_clockwise{0, 1, 3, 2};
      double worst = 1;
      for(unsigned int i = 0; i < 4; ++i)
      {
        const Point &here = vertices[cell[counter_clockwise[i]]];
        const Point &next = vertices[cell[counter_clockwise[(i + 1) % 4]]];
        const Point &last = vertices[cell[counter_clockwise[(i + 3) % 4]]];
        const Point a{next[0] - here[0], next[1] - here[1]};
        const Point b{last[0] - here[0], last[1] - here[1]};
        worst = std::min(worst, (a[0] * b[1] - a[1] * b[0])
                                    / (std::hypot(a[0], a[1]) * std::hypot(b[0], b[1])));
      }
      return worst;
    }

    class OutlineMesher
    {
    public:
      /** @param origin a vertex of the lattice (m) */
      OutlineMesher(const Outline &outline, double spacing, const Point &origin)
        : outline(outline)
        , spacing(spacing)
        , origin(origin)
      {
      }

      QuadrilateralMesh mesh()
      {
        find_core();
        remove_pinches();
        follow_rim();
        number_vertices();
        place_on_outline();
        add_layer();
        smooth();
        if(result.worst_corner() < acceptable_corner)
          refuse(fmt::format("a cell would have a corner of sine {:.2g}",
                             result.worst_corner()));
        return std::move(result);
      }

    private:
      [[noreturn]] void refuse(const std::string &reason) const
      {
        throw cases::Refusal(
            fmt::format("fem-enthalpy needs more cells for this outline than those of "
                        "{:.4g} m: {}",
                        spacing, reason));
      }

      Point place(const Index &vertex) const
      {
        return {origin[0] + vertex[0] * spacing, origin[1] + vertex[1] * spacing};
      }

      Index nearest_vertex(const cases::Position &p) const
      {
        return {static_cast<int>(std::lround((p[0] - origin[0]) / spacing)),
                static_cast<int>(std::lround((p[1] - origin[1]) / spacing))};
      }

      /** Vertices that the outline comes near to: the others are far from it. */
      std::set<Index> vertices_near_outline() const
      {
        std::set<Index> near;
        const int steps = static_cast<int>(std::ceil(4 * outline.perimeter() / spacing));
        for(const cases::Position &p : outline.points(steps))
        {
          const Index middle = nearest_vertex(p);
          for(int j = -1; j <= 1; ++j)
            for(int i = -1; i <= 1; ++i)
              near.insert(middle + Index{i, j});
        }
        return near;
      }

      /** Squares whose vertices are all deep inside, one connected set of them. */
      void find_core()
      {
        const std::set<Index> near = vertices_near_outline();
        const Index lowest = nearest_vertex({outline.lower()[0], outline.lower()[1], 0});
        const Index highest = nearest_vertex({outline.upper()[0], outline.upper()[1], 0});
        std::set<Index> deep;
        for(int j = lowest[1]; j <= highest[1]; ++j)
          for(int i = lowest[0]; i <= highest[0]; ++i)
          {
            const Point p = place({i, j});
            const cases::Position position{p[0], p[1], 0};
            if(outline.inside(position)
               && (!near.contains({i, j})
                   || outline.distance(position) >= least_depth * spacing))
              deep.insert({i, j});
          }
        for(const Index &cell : deep)
          if(deep.contains(cell + Index{1, 0}) && deep.contains(cell + Index{0, 1})
             && deep.contains(cell + Index{1, 1}))
            core.insert(cell);
      }

      bool in_core(const Index &cell) const
      {
        return core.contains(cell);
      }

      /** Where squares meet at a corner only, both go. */
      void remove_pinches()
      {
        for(bool changed = true; changed;)
        {
          std::set<Index> removed;
          for(const Index &cell : core)
            for(const int side : {-1, 1})
              if(in_core(cell + Index{side, 1}) && !in_core(cell + Index{side, 0})
                 && !in_core(cell + Index{0, 1}))
              {
                removed.insert(cell);
                removed.insert(cell + Index{side, 1});
              }
          for(const Index &cell : removed)
            core.erase(cell);
          changed = !removed.empty();
        }
        if(core.empty())
          refuse("no square of that size fits into it");
      }

      /** The vertices along the core's boundary, counter-clockwise. */
      void follow_rim()
      {
        std::map<Index, Index> next;
        for(const Index &cell : core)
        {
          const std::array<Index, 4> corner{cell, cell + Index{1, 0}, cell + Index{1, 1},
                                            cell + Index{0, 1}};
          constexpr std::array<Index, 4> beyond{{{0, -1}, {1, 0}, {0, 1}, {-1, 0}}};
          for(int side = 0; side < 4; ++side)
            if(!in_core(cell + beyond[side]))
              next[corner[side]] = corner[(side + 1) % 4];
        }
        const Index first = next.begin()->first;
        Index here = first;
        do
        {
          rim.push_back(here);
          here = next.at(here);
        } while(here != first);
        if(rim.size() != next.size())
          refuse("squares of that size fall apart within it");
      }

      void number_vertices()
      {
        const auto number = [this](const Index &vertex)
        {
          const auto [found, is_new] = numbers.try_emplace(
              vertex, static_cast<unsigned int>(result.vertices.size()));
          if(is_new)
            result.vertices.push_back(place(vertex));
          return found->second;
        };
        for(const Index &cell : core)
        {
          const unsigned int a = number(cell), b = number(cell + Index{1, 0});
          const unsigned int c = number(cell + Index{0, 1});
          result.cells.push_back({a, b, c, number(cell + Index{1, 1})});
        }
      }

      /** How far along the outline each vertex of the rim has its partner. */
      void place_on_outline()
      {
        const std::size_t n = rim.size();
        const double whole = outline.perimeter();
        along.resize(n);
        for(std::size_t i = 0; i < n; ++i)
        {
          const Point p = place(rim[i]);
          along[i] = outline.arc_length_at({p[0], p[1], 0});
          if(i > 0) // without jumps where the outline begins
            along[i] = along[i - 1] + std::remainder(along[i] - along[i - 1], whole);
        }
        const double closing
            = along[n - 1] + std::remainder(along[0] - along[n - 1], whole) - along[0];
        if(std::abs(closing - whole) > 1e-6 * whole)
          refuse("the squares within it do not go once round");
        hold_corners();
        spread();
      }

      /** How far along the outline a partner is from a length along it. */
      double distance_along(std::size_t i, double length) const
      {
        return std::abs(std::remainder(along[i] - length, outline.perimeter()));
      }

      /** The partner that is nearest to each corner of the outline is put there: the one
       * in the middle of those nearest to a corner that points inwards. */
      void hold_corners()
      {
        const std::size_t n = along.size();
        held.assign(n, 0);
        for(const double corner : outline.corner_arc_lengths())
        {
          std::size_t first = 0;
          for(std::size_t i = 1; i < n; ++i)
            if(distance_along(i, corner) < distance_along(first, corner))
              first = i;
          const double reach = distance_along(first, corner) + 1e-6 * spacing;
          std::size_t last = first;
          while(distance_along((first + n - 1) % n, corner) <= reach)
            first = (first + n - 1) % n;
          while(distance_along((last + 1) % n, corner) <= reach)
            last = (last + 1) % n;
          const std::size_t best = (first + (last + n - first) % n / 2) % n;
          if(held[best] || reach > farthest_corner * spacing)
            refuse("its corners are too sharp or too near to each other");
          along[best] += std::remainder(corner - along[best], outline.perimeter());
          held[best] = 1;
        }
      }

      /** The length along the outline of the vertex before or after, without jumps. */
      double neighbour(std::size_t i, int step) const
      {
        const std::size_t n = along.size();
        if(step > 0)
          return i + 1 < n ? along[i + 1] : along[0] + outline.perimeter();
        return i > 0 ? along[i - 1] : along[n - 1] - outline.perimeter();
      }

      /** Between partners of which one at least may give way. */
      double narrowest_gap() const
      {
        double least = std::numeric_limits<double>::infinity();
        for(std::size_t i = 0; i < along.size(); ++i)
          if(!held[i] || !held[(i + 1) % along.size()])
            least = std::min(least, neighbour(i, 1) - along[i]);
        return least;
      }

      /** Even out the distances along the outline, as little as need be. */
      void spread()
      {
        const double wanted = least_gap * outline.perimeter() / along.size();
        constexpr int fewest = 3, most = 500;
        for(int sweep = 0; sweep < most; ++sweep)
        {
          if(sweep >= fewest && narrowest_gap() >= wanted)
            return;
          std::vector<double> evened = along;
          for(std::size_t i = 0; i < along.size(); ++i)
            if(!held[i])
              evened[i] = along[i] / 2 + (neighbour(i, -1) + neighbour(i, 1)) / 4;
          along = std::move(evened);
        }
        refuse("its corners leave no room for the cells between them");
      }

      void add_layer()
      {
        const std::size_t n = rim.size();
        const auto first = static_cast<unsigned int>(result.vertices.size());
        for(std::size_t i = 0; i < n; ++i)
        {
          const cases::Position p = outline.at(along[i]);
          result.vertices.push_back({p[0], p[1]});
        }
        for(std::size_t i = 0; i < n; ++i)
        {
          const std::size_t j = (i + 1) % n;
          result.cells.push_back({first + static_cast<unsigned int>(i),
                                  first + static_cast<unsigned int>(j),
                                  numbers.at(rim[i]), numbers.at(rim[j])});
        }
        on_outline = first;
      }

      /** Cells around each vertex, and the vertices that it shares an edge with. */
      void find_neighbours(std::vector<std::vector<unsigned int>> &cells,
                           std::vector<std::vector<unsigned int>> &vertices) const
      {
        constexpr std::array<std::array<unsigned int, 2>, 4> edges{
            {{0, 1}, {2, 3}, {0, 2}, {1, 3}}};
        cells.resize(result.vertices.size());
        vertices.resize(result.vertices.size());
        for(unsigned int c = 0; c < result.cells.size(); ++c)
        {
          for(const unsigned int v : result.cells[c])
            cells[v].push_back(c);
          for(const auto &[a, b] : edges)
          {
            vertices[result.cells[c][a]].push_back(result.cells[c][b]);
            vertices[result.cells[c][b]].push_back(result.cells[c][a]);
          }
        }
      }

      /** The vertices of the squares next to the layer, some layers deep. */
      std::vector<unsigned int>
      movable(const std::vector<std::vector<unsigned int>> &neighbours) const
      {
        std::set<unsigned int> found;
        for(const Index &vertex : rim)
          found.insert(numbers.at(vertex));
        for(int layer = 1; layer < moved_layers; ++layer)
        {
          const std::set<unsigned int> before = found;
          for(const unsigned int v : before)
            for(const unsigned int other : neighbours[v])
              if(other < on_outline)
                found.insert(other);
        }
        return {found.begin(), found.end()};
      }

      void smooth()
      {
        std::vector<std::vector<unsigned int>> cells, neighbours;
        find_neighbours(cells, neighbours);
        const std::vector<unsigned int> moved = movable(neighbours);
        const auto worst_around = [&](unsigned int v)
        {
          double worst = 1;
          for(const unsigned int c : cells[v])
            worst = std::min(
                worst, reference_fem::worst_corner(result.vertices, result.cells[c]));
          return worst;
        };
        for(int sweep = 0; sweep < sweeps; ++sweep)
          for(const unsigned int v : moved)
          {
            const Point old = result.vertices[v];
            const double before = worst_around(v);
            Point middle{};
            for(const unsigned int other : neighbours[v])
              for(int d = 0; d < 2; ++d)
                middle[d] += result.vertices[other][d] / neighbours[v].size();
            result.vertices[v] = middle;
            if(worst_around(v) < before)
              result.vertices[v] = old;
          }
      }

      const Outline &outline;
      double spacing;
      Point origin;
      std::set<Index> core;
      std::vector<Index> rim; ///< the core's boundary
      std::map<Index, unsigned int> numbers;
      std::vector<double>
          along;              ///< the outline, of the partner of each vertex of the rim
      std::vector<char> held; ///< partners that sit on corners
      unsigned int on_outline = 0; ///< the first vertex there
      QuadrilateralMesh result;
    };
  } // namespace

  double QuadrilateralMesh::worst_corner() const
  {
    double worst = 1;
    for(const auto &cell : cells)
      worst = std::min(worst, reference_fem::worst_corner(vertices, cell));
    return worst;
  }

  QuadrilateralMesh mesh_outline(const cases::Outline &outline, double spacing)
  {
    // Whether corners find room is an accident of where the lattice lies. Shifts that
    // fill a cell evenly, however many there are: Roberts' sequence.
    constexpr int shifts = 24;
    constexpr Point step{0.7548776662466927, 0.5698402909980532};
    std::exception_ptr refused;
    for(int i = 0; i < shifts; ++i)
      try
      {
        Point origin = outline.centre();
        for(int d = 0; d < 2; ++d)
          origin[d] += std::fmod(i * step[d], 1.) * spacing;
        return OutlineMesher(outline, spacing, origin).mesh();
      }
      catch(const cases::Refusal &)
      {
        if(!refused)
          refused = std::current_exception();
      }
    std::rethrow_exception(refused);
  }
} // namespace meltfront::reference_fem
