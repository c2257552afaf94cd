#include <particles/level_set/front_contour.h>
#include <particles/level_set/front_geometry.h>
#include <particles/level_set/front_measures.h>

#include <exception>
#include <numbers>

namespace meltfront::particles::level_set
{
  namespace
  {
    /** Cells, numbered by their node of lowest coordinates. */
    using CellFlags = std::vector<std::uint8_t>;

    std::vector<Interval> whole_rows_of_cells(const Grid &grid)
    {
      std::vector<Interval> rows;
      for(int k = 0; k < grid.cells(2); ++k)
        for(int j = 0; j < grid.cells(1); ++j)
          rows.push_back({k, j, 0, grid.cells(0)});
      return rows;
    }

    /** Whether the cell's corners lie on either side of the front. */
    bool is_cut(const LevelSet &level_set, std::size_t node)
    {
      const Grid &grid = level_set.grid();
      const double *phi = level_set.values().data() + node;
      const bool inside = phi[0] > 0;
      for(int corner = 1; corner < 1 << grid.dimension(); ++corner)
      {
        std::ptrdiff_t offset = 0;
        for(int d = 0; d < grid.dimension(); ++d)
          offset += (corner >> d & 1) * grid.stride(d);
        if((phi[offset] > 0) != inside)
          return true;
      }
      return false;
    }

    /** Flag the cells that hold a point of the shape's front and those about them. */
    void flag_front(const Grid &grid, const ReferenceShape &shape, CellFlags &flags)
    {
      for(const Position &point : shape.front(grid.spacing() / 2))
      {
        if(!grid.contains(point))
          continue;
        const std::array<int, 3> cell = grid.indices(grid.locate(point).node);
        const int depth = grid.dimension() == 3 ? 1 : 0;
        for(int k = -depth; k <= depth; ++k)
          for(int j = -1; j <= 1; ++j)
            for(int i = -1; i <= 1; ++i)
              flags[grid.node(cell[0] + i, cell[1] + j, cell[2] + k)] = 1;
      }
    }

    /** Samples inside of the level set, of the shape, of one but not of the other. */
    struct Counts
    {
      long both = 0, missing = 0, extra = 0;
    };

    /** One sample of each of samples^dimension equal parts of a cell. */
    template <typename Inside>
    Counts count_in_cell(const LevelSet &level_set, const Inside &inside,
                         std::size_t node, int samples)
    {
      const Grid &grid = level_set.grid();
      const Position corner = grid.position(node);
      const int depth = grid.dimension() == 3 ? samples : 1;
      Counts counts;
      for(int k = 0; k < depth; ++k)
        for(int j = 0; j < samples; ++j)
          for(int i = 0; i < samples; ++i)
          {
            const CellPlace place{node,
                                  {(i + 0.5) / samples, (j + 0.5) / samples,
                                   grid.dimension() == 3 ? (k + 0.5) / samples : 0}};
            Position point = corner;
            for(int d = 0; d < grid.dimension(); ++d)
              point[d] += place.local[d] * grid.spacing();
            const bool in_phase = interpolate(grid, level_set.values().data(), place) > 0;
            const bool in_shape = inside(point, in_phase);
            counts.both += in_phase && in_shape;
            counts.missing += !in_phase && in_shape;
            counts.extra += in_phase && !in_shape;
          }
      return counts;
    }

    /** Add up over all cells; `inside(point, in_phase)` is the shape. */
    template <typename Inside>
    ShapeDifference add_up(const LevelSet &level_set, CellFlags flags,
                           const Inside &inside, const int samples)
    {
      const Grid &grid = level_set.grid();
      const Band cells(grid, whole_rows_of_cells(grid));
      const auto rows = cells.runs();
      const int fine = samples * samples * (grid.dimension() == 3 ? samples : 1);
      long both = 0, missing = 0, extra = 0;
      std::exception_ptr failure;
#pragma omp parallel for num_threads(level_set.parameters().threads) schedule(dynamic)   \
    reduction(+ : both, missing, extra)
      for(std::size_t r = 0; r < rows.size(); ++r)
        try
        {
          for(int n = 0; n < rows[r].length; ++n)
          {
            const std::size_t node = rows[r].node + n;
            const bool near = flags[node] || is_cut(level_set, node);
            const Counts counts
                = count_in_cell(level_set, inside, node, near ? samples : 1);
            const long weight = near ? 1 : fine;
            both += weight * counts.both;
            missing += weight * counts.missing;
            extra += weight * counts.extra;
          }
        }
        catch(...)
        {
#pragma omp critical
          failure = std::current_exception();
        }
      if(failure)
        std::rethrow_exception(failure);
      double part = 1;
      for(int d = 0; d < grid.dimension(); ++d)
        part *= grid.spacing() / samples;
      return {part * double(both + extra), part * double(both + missing),
              part * double(missing), part * double(extra)};
    }
  } // namespace

  ShapeDifference shape_difference(const LevelSet &level_set, const ReferenceShape &shape,
                                   const int samples)
  {
    CellFlags flags(level_set.grid().size(), 0);
    flag_front(level_set.grid(), shape, flags);
    return add_up(
        level_set, std::move(flags),
        [&](const Position &point, bool) { return shape.inside(point); }, samples);
  }

  double front_error(const ShapeDifference &difference, const ReferenceShape &shape,
                     const Grid &grid)
  {
    return (difference.missing + difference.extra) / shape.border / grid.spacing();
  }

  double content_error(const ShapeDifference &difference, const ReferenceShape &shape)
  {
    return difference.content / shape.content - 1;
  }

  double content(const LevelSet &level_set, const int samples)
  {
    return add_up(
               level_set, CellFlags(level_set.grid().size(), 0),
               [](const Position &, bool in_phase) { return in_phase; }, samples)
        .content;
  }

  FrontNoise front_noise(const LevelSet &level_set, const ExactFrontFunction &exact)
  {
    FrontNoise noise;
    double angles = 0, curvatures = 0;
    for(const Position &point : front_points(level_set))
    {
      const std::optional<ExactFront> front = exact(point);
      if(!front)
        continue;
      const Position normal = outward_normal(level_set, point);
      const double cosine = normal[0] * front->normal[0] + normal[1] * front->normal[1]
                            + normal[2] * front->normal[2];
      const Position across{normal[1] * front->normal[2] - normal[2] * front->normal[1],
                            normal[2] * front->normal[0] - normal[0] * front->normal[2],
                            normal[0] * front->normal[1] - normal[1] * front->normal[0]};
      const double angle
          = std::atan2(std::hypot(across[0], across[1], across[2]), cosine);
      const double bend = curvature(level_set, point) / front->curvature - 1;
      angles += angle * angle;
      curvatures += bend * bend;
      ++noise.points;
    }
    if(noise.points > 0)
    {
      const double count = double(noise.points);
      noise.normal = std::sqrt(angles / count) * 180 / std::numbers::pi;
      noise.curvature = std::sqrt(curvatures / count);
    }
    return noise;
  }
} // namespace meltfront::particles::level_set
