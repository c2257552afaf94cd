#include <particles/rkpm_tracked/plane/contour.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    constexpr int most_bisections = 60;

    /** Spacings of nodes by which a grid goes beyond a domain. */
    constexpr double beyond_box = 4;

    /** Passes of placing particles evenly and moving them onto the zeros. */
    constexpr int placements = 3;

    /** A grid edge by its first node and direction. */
    using EdgeNumber = long;

    PlanePoint zero_between(const PlaneLevelSet &level_set, PlanePoint solid,
                            PlanePoint liquid)
    {
      for(int i = 0; i < most_bisections; ++i)
      {
        const PlanePoint middle = (solid + liquid) / 2;
        (level_set(middle) <= 0 ? solid : liquid) = middle;
      }
      return (solid + liquid) / 2;
    }

    /** Finds edges that are crossed and links them cell by cell. */
    class Walker
    {
    public:
      Walker(const ContourGrid &grid, const std::vector<double> &values,
             const PlaneLevelSet &level_set)
        : grid(grid)
        , values(values)
        , level_set(level_set)
      {
        for(long j = 0; j + 1 < grid.rows; ++j)
          for(long i = 0; i + 1 < grid.columns; ++i)
            link_cell(i, j);
      }

      std::vector<std::vector<PlanePoint>> curves()
      {
        std::vector<std::vector<PlanePoint>> result;
        while(!following.empty())
        {
          std::vector<PlanePoint> curve;
          const EdgeNumber first = following.begin()->first;
          for(EdgeNumber edge = first;;)
          {
            curve.push_back(crossing(edge));
            const auto link = following.find(edge);
            const EdgeNumber next = link->second;
            following.erase(link);
            if(next == first)
              break;
            edge = next;
          }
          result.push_back(std::move(curve));
        }
        return result;
      }

    private:
      bool solid(long i, long j) const
      {
        return values[j * grid.columns + i] <= 0;
      }

      EdgeNumber along_x(long i, long j) const
      {
        return 2 * (j * grid.columns + i);
      }
      EdgeNumber along_y(long i, long j) const
      {
        return along_x(i, j) + 1;
      }

      /** Edges of a cell counter-clockwise from below; a curve with the solid on its left
       * enters where, going round counter-clockwise, liquid follows on solid. */
      void link_cell(long i, long j)
      {
        const std::array<EdgeNumber, 4> edges{along_x(i, j), along_y(i + 1, j),
                                              along_x(i, j + 1), along_y(i, j)};
        const std::array<bool, 4> corner{solid(i, j), solid(i + 1, j),
                                         solid(i + 1, j + 1), solid(i, j + 1)};
        std::array<int, 2> entries{}, exits{};
        int count = 0, leaving = 0;
        for(int e = 0; e < 4; ++e)
        {
          const bool here = corner[e], there = corner[(e + 1) % 4];
          if(here && !there)
            entries[count++] = e;
          if(!here && there)
            exits[leaving++] = e;
        }
        if(count == 0)
          return;
        if(count == 1)
        {
          following[edges[entries[0]]] = edges[exits[0]];
          return;
        }
        // Solid corners are joined, or apart, as the middle says. Apart: a curve round
        // each solid corner, which lies after the exit edge.
        const PlanePoint middle = (grid.node(i, j) + grid.node(i + 1, j + 1)) / 2;
        const bool joined = level_set(middle) <= 0;
        for(int k = 0; k < 2; ++k)
        {
          const int exit = joined ? (entries[k] + 1) % 4 : (entries[k] + 3) % 4;
          following[edges[entries[k]]] = edges[exit];
        }
      }

      PlanePoint crossing(EdgeNumber edge) const
      {
        const long node = edge / 2, i = node % grid.columns, j = node / grid.columns;
        const bool vertical = edge % 2 == 1;
        const long i2 = vertical ? i : i + 1, j2 = vertical ? j + 1 : j;
        const PlanePoint here = grid.node(i, j), there = grid.node(i2, j2);
        const bool first_solid = solid(i, j);
        const PlanePoint &inside = first_solid ? here : there;
        const PlanePoint &outside = first_solid ? there : here;
        // Along the rim values may have been replaced: then the middle will do.
        if((level_set(inside) <= 0) != (level_set(outside) <= 0))
          return zero_between(level_set, inside, outside);
        return (here + there) / 2;
      }

      const ContourGrid &grid;
      const std::vector<double> &values;
      const PlaneLevelSet &level_set;
      std::map<EdgeNumber, EdgeNumber> following;
    };

    /** Move a point along a direction onto the nearest zero within a reach; it stays
     * where there is none. */
    PlanePoint onto_zero(const PlaneLevelSet &level_set, const PlanePoint &point,
                         const PlanePoint &into_solid, double reach)
    {
      const bool solid = level_set(point) <= 0;
      const PlanePoint way = solid ? PlanePoint(-into_solid) : into_solid;
      for(double step = reach / 64; step <= reach; step *= 2)
        if((level_set(point + step * way) <= 0) != solid)
        {
          const PlanePoint other = point + step * way;
          return solid ? zero_between(level_set, point, other)
                       : zero_between(level_set, other, point);
        }
      return point;
    }
  } // namespace

  ContourGrid contour_grid(const PlanePoint &lower, const PlanePoint &upper,
                           double margin, double spacing)
  {
    ContourGrid grid;
    grid.spacing = spacing;
    const PlanePoint centre = (lower + upper) / 2,
                     half = (upper - lower) / 2 + PlanePoint(margin, margin);
    // Nodes off the middle, where fronts of symmetric scenes like to lie.
    grid.columns = 2 * static_cast<long>(std::ceil(half.x() / spacing)) + 2;
    grid.rows = 2 * static_cast<long>(std::ceil(half.y() / spacing)) + 2;
    grid.lower = centre - spacing / 2 * PlanePoint(grid.columns - 1, grid.rows - 1);
    return grid;
  }

  Contours find_contours(const ContourGrid &grid, std::vector<double> values,
                         const PlaneLevelSet &level_set)
  {
    const auto rim = [&](auto &&use)
    {
      for(long i = 0; i < grid.columns; ++i)
      {
        use(values[i]);
        use(values[(grid.rows - 1) * grid.columns + i]);
      }
      for(long j = 0; j < grid.rows; ++j)
      {
        use(values[j * grid.columns]);
        use(values[j * grid.columns + grid.columns - 1]);
      }
    };
    Contours result;
    result.solid_beyond = true;
    rim([&](double value) { result.solid_beyond = result.solid_beyond && value <= 0; });
    if(!result.solid_beyond)
      rim([&](double &value) { value = std::abs(value) + grid.spacing; });
    result.curves = Walker(grid, values, level_set).curves();
    return result;
  }

  Contours find_contours(const PlanePoint &lower, const PlanePoint &upper, double spacing,
                         const PlaneLevelSet &level_set)
  {
    const ContourGrid grid
        = contour_grid(lower, upper, beyond_box * spacing, spacing / 2);
    std::vector<double> values;
    for(long j = 0; j < grid.rows; ++j)
      for(long i = 0; i < grid.columns; ++i)
        values.push_back(level_set(grid.node(i, j)));
    return find_contours(grid, std::move(values), level_set);
  }

  PlaneFront front_on_zeros(const Contours &contours, const PlaneLevelSet &level_set,
                            double spacing, double least_length)
  {
    PlaneFront front;
    for(const std::vector<PlanePoint> &curve : contours.curves)
    {
      double length = 0;
      std::vector<PlanePoint> points;
      for(std::size_t i = 0; i < curve.size(); ++i)
      {
        length += (curve[(i + 1) % curve.size()] - curve[i]).norm();
        // Crossings of neighbouring edges may lie together.
        if(points.empty() || (curve[i] - points.back()).norm() > 0.1 * spacing)
          points.push_back(curve[i]);
      }
      if(length < least_length || points.size() < 3)
        continue;
      front.add_curve(points);
      const std::size_t last = front.curves() - 1;
      for(int i = 0; i < placements; ++i)
      {
        redistribute(front, last, spacing);
        for(std::size_t p = front.offsets[last]; p < front.offsets[last + 1]; ++p)
          front.position[p]
              = onto_zero(level_set, front.position[p], front.normal[p], spacing / 2);
      }
      update_geometry(front);
    }
    return front;
  }
} // namespace meltfront::particles::rkpm_tracked
