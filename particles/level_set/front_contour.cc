#include <cases/error.h>
#include <particles/level_set/front_contour.h>

#include <unordered_map>
#include <unordered_set>

namespace meltfront::particles::level_set
{
  namespace
  {
    /** An edge by its lower node and direction, as one number. */
    using Edge = std::size_t;

    Edge edge(std::size_t node, int direction)
    {
      return 3 * node + static_cast<std::size_t>(direction);
    }

    Position cut_point(const LevelSet &level_set, std::size_t node, int direction)
    {
      const Grid &grid = level_set.grid();
      const double below = level_set.values()[node];
      const double above = level_set.values()[node + grid.stride(direction)];
      Position point = grid.position(node);
      point[direction] += grid.spacing() * below / (below - above);
      return point;
    }

    /** From where to where the front crosses cells, the phase on the left: in each cell
     * from an edge to an edge, at most once per edge and side. */
    using Successors = std::unordered_map<Edge, Edge>;

    /** Link the cut edges of one cell, going round it counterclockwise: the front enters
     * where phi falls to zero or below and leaves where it rises. */
    void link_cell(const LevelSet &level_set, std::size_t node, Successors &successors,
                   std::vector<Edge> &order)
    {
      const std::ptrdiff_t up = level_set.grid().stride(1);
      const double *phi = level_set.values().data() + node;
      const std::array<double, 4> corner{phi[0], phi[1], phi[up + 1], phi[up]};
      const std::array<Edge, 4> side{edge(node, 0), edge(node + 1, 1), edge(node + up, 0),
                                     edge(node, 1)};
      std::array<int, 2> enters{}, leaves{};
      std::size_t entries = 0;
      for(int s = 0; s < 4; ++s)
        if(corner[s] > 0 && !(corner[(s + 1) % 4] > 0))
          enters[entries++] = s;
      for(std::size_t n = 0; n < entries; ++n)
      {
        // the next side counterclockwise where phi rises closes off a corner outside
        int s = enters[n];
        do
          s = (s + 1) % 4;
        while(!(!(corner[s] > 0) && corner[(s + 1) % 4] > 0));
        leaves[n] = s;
      }
      if(entries == 2 && corner[0] + corner[1] + corner[2] + corner[3] <= 0)
        std::swap(leaves[0], leaves[1]);
      for(std::size_t n = 0; n < entries; ++n)
      {
        successors[side[enters[n]]] = side[leaves[n]];
        order.push_back(side[enters[n]]);
      }
    }

    /** Take the line that starts at an edge out of the links. */
    FrontLine chain(const LevelSet &level_set, const Edge start, Successors &successors)
    {
      FrontLine line;
      for(Edge at = start;;)
      {
        line.points.push_back(cut_point(level_set, at / 3, static_cast<int>(at % 3)));
        const auto next = successors.find(at);
        if(next == successors.end())
          return line;
        at = next->second;
        successors.erase(next);
        if(at == start)
        {
          line.closed = true;
          return line;
        }
      }
    }

    void thin_out(FrontLine &line, double spacing)
    {
      const auto apart = [](const Position &a, const Position &b)
      { return std::hypot(a[0] - b[0], a[1] - b[1]); };
      std::vector<Position> kept;
      for(const Position &point : line.points)
        if(kept.empty() || apart(kept.back(), point) >= spacing)
          kept.push_back(point);
      if(line.closed)
        while(kept.size() > 3 && apart(kept.back(), kept.front()) < spacing)
          kept.pop_back();
      else if(kept.back() != line.points.back())
        kept.back() = line.points.back();
      line.points = std::move(kept);
    }
  } // namespace

  std::vector<Position> front_points(const LevelSet &level_set)
  {
    const Grid &grid = level_set.grid();
    const double *phi = level_set.values().data();
    std::vector<Position> points;
    for(const NodeRun &run : level_set.band().runs())
      for(int n = 0; n < run.length; ++n)
        for(int d = 0; d < grid.dimension(); ++d)
        {
          const std::size_t node = run.node + n;
          const int index = run.index[d] + (d == 0 ? n : 0);
          if(index < grid.nodes(d) - 1
             && (phi[node] > 0) != (phi[node + grid.stride(d)] > 0))
            points.push_back(cut_point(level_set, node, d));
        }
    return points;
  }

  std::vector<FrontLine> front_lines(const LevelSet &level_set, double spacing)
  {
    const Grid &grid = level_set.grid();
    if(grid.dimension() != 2)
      throw cases::InputError("a front in space is no line: ask for its points");
    Successors successors;
    std::vector<Edge> order;
    for(const NodeRun &run : level_set.band().runs())
      for(int n = 0; n < run.length; ++n)
        if(run.index[0] + n < grid.nodes(0) - 1 && run.index[1] < grid.nodes(1) - 1)
          link_cell(level_set, run.node + n, successors, order);

    // lines that start on the border first: no cell leads to their first edge
    std::unordered_set<Edge> led_to;
    for(const Edge from : order)
      led_to.insert(successors.at(from));
    std::vector<FrontLine> lines;
    for(const bool from_border : {true, false})
      for(const Edge from : order)
        if(successors.contains(from) && (!from_border || !led_to.contains(from)))
        {
          lines.push_back(chain(level_set, from, successors));
          if(spacing > 0)
            thin_out(lines.back(), spacing);
        }
    return lines;
  }
} // namespace meltfront::particles::level_set
