#include <cases/error.h>
#include <particles/level_set/markers/marker_reseeding.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meltfront::particles::level_set
{
  namespace
  {
    double dot(const Position &a, const Position &b)
    {
      return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    }

    Position scaled(const Position &a, double factor)
    {
      return {factor * a[0], factor * a[1], factor * a[2]};
    }

    Position unit(const Position &a)
    {
      return scaled(a, 1 / std::sqrt(dot(a, a)));
    }

    /** A marker to be born. */
    struct Birth
    {
      std::size_t cell; ///< number of the parent's cell
      Position place, normal;
      double distance;
    };

    /** Looks for gaps between the markers of a sheet; lengths in spacings. */
    class GapSearch
    {
    public:
      GapSearch(const Grid &grid, const Markers &markers, const MarkerCells &cells,
                int per_cell)
        : grid(grid)
        , markers(markers)
        , cells(cells)
        , per_cell(static_cast<std::size_t>(per_cell))
      {
      }

      std::vector<Birth> births()
      {
        std::vector<Birth> result;
        for(std::size_t cell = 0; cell < cells.size(); ++cell)
        {
          std::size_t count = cells.first(cell + 1) - cells.first(cell);
          for(std::size_t p = cells.first(cell);
              p < cells.first(cell + 1) && count < per_cell; ++p)
            if(std::abs(markers.distance[p]) < grid.spacing())
              count += look_along_tangents(cell, p, result);
        }
        return result;
      }

    private:
      Position normal(std::size_t p) const
      {
        Position result{};
        for(int d = 0; d < grid.dimension(); ++d)
          result[d] = markers.normal[d][p];
        return result;
      }

      /** Returns how many were born. */
      std::size_t look_along_tangents(std::size_t cell, std::size_t p,
                                      std::vector<Birth> &result) const
      {
        const Position n = normal(p);
        if(grid.dimension() == 2)
          return look_along(cell, p, n, {-n[1], n[0], 0}, 0, result);
        // the axis most across the normal gives the first tangent
        std::size_t axis = 0;
        for(std::size_t d = 1; d < 3; ++d)
          if(std::abs(n[d]) < std::abs(n[axis]))
            axis = d;
        Position first = scaled(n, -n[axis]);
        first[axis] += 1;
        first = unit(first);
        const Position second{n[1] * first[2] - n[2] * first[1],
                              n[2] * first[0] - n[0] * first[2],
                              n[0] * first[1] - n[1] * first[0]};
        const double opening = std::sqrt(0.5);
        return look_along(cell, p, n, first, opening, result)
               + look_along(cell, p, n, second, opening, result);
      }

      std::size_t look_along(std::size_t cell, std::size_t p, const Position &n,
                             const Position &tangent, double least_cosine,
                             std::vector<Birth> &result) const
      {
        constexpr double least_gap = 0.5, most_gap = 1.2;
        const auto [q, gap]
            = nearest_in_sheet(cells.key(cell), p, n, tangent, least_cosine);
        if(!(gap > least_gap && gap < most_gap))
          return 0;
        const Position a = markers.point(p), b = markers.point(q), m = normal(q);
        Birth birth{cell, {}, {}, 0};
        Position turn{}, way{};
        for(int d = 0; d < 3; ++d)
        {
          birth.place[d] = (a[d] + b[d]) / 2;
          birth.normal[d] = n[d] + m[d];
          turn[d] = n[d] - m[d];
          way[d] = b[d] - a[d];
        }
        birth.normal = unit(birth.normal);
        birth.distance
            = (markers.distance[p] + markers.distance[q]) / 2 + dot(turn, way) / 8;
        result.push_back(birth);
        return 1;
      }

      /** The nearest marker of p's sheet along a tangent, and its distance along it. */
      std::pair<std::size_t, double> nearest_in_sheet(std::size_t key, std::size_t p,
                                                      const Position &n,
                                                      const Position &tangent,
                                                      double least_cosine) const
      {
        constexpr double alignment = 0.85, plane = 0.25, off = 0.5;
        constexpr int reach = 2; // cells, for gaps of up to 1.2 spacings
        const Position here = markers.point(p);
        const double scale = 1 / grid.spacing();
        std::pair<std::size_t, double> best{p, std::numeric_limits<double>::infinity()};
        const auto look = [&](std::size_t q)
        {
          Position way = markers.point(q);
          for(int d = 0; d < 3; ++d)
            way[d] = scale * (way[d] - here[d]);
          const double along = dot(way, tangent), across = dot(way, n);
          const double expected = scale * markers.distance[p] + across;
          if(along > 0 && along < best.second && std::abs(across) < off
             && along * along
                    >= least_cosine * least_cosine * (dot(way, way) - across * across)
             && dot(n, normal(q)) > alignment
             && std::abs(scale * markers.distance[q] - expected) < plane)
            best = {q, along};
        };
        const std::array<int, 3> centre = grid.indices(key);
        const bool solid = grid.dimension() == 3;
        for(int k = solid ? -reach : 0; k <= (solid ? reach : 0); ++k)
          for(int j = -reach; j <= reach; ++j)
            for(int i = -reach; i <= reach; ++i)
            {
              const std::array<int, 3> cell{centre[0] + i, centre[1] + j, centre[2] + k};
              bool inside = true;
              for(int d = 0; d < grid.dimension(); ++d)
                inside = inside && cell[d] >= -1 && cell[d] <= grid.cells(d);
              if(!inside)
                continue;
              const auto [begin, end]
                  = cells.markers_of(static_cast<std::uint32_t>(grid.node(cell)));
              for(std::size_t q = begin; q < end; ++q)
                look(q);
            }
        return best;
      }

      const Grid &grid;
      const Markers &markers;
      const MarkerCells &cells;
      const std::size_t per_cell;
    };
  } // namespace

  MarkerReseeding::MarkerReseeding(const Grid &grid,
                                   const ReseedingParameters &parameters)
    : grid(grid)
    , parameters(parameters)
  {
    if(parameters.seeding.per_cell < 1 || parameters.most < parameters.seeding.per_cell)
      throw cases::InputError(fmt::format(
          "cells are filled up to {} markers and thinned out to {}: both must be above "
          "zero, the second no less than the first",
          parameters.seeding.per_cell, parameters.most));
  }

  void MarkerReseeding::apply(Markers &markers, MarkerCells &cells,
                              const std::span<const double> phi)
  {
    for(const std::uint32_t birth : markers.birth)
      next_birth = std::max(next_birth, birth + 1);
    cells.sort(markers);
    thin_out(markers, cells, phi);
    const std::size_t before = markers.size();
    if(parameters.rule == ReseedingRule::grid)
      add_from_grid(markers, cells, phi);
    else if(parameters.rule == ReseedingRule::midpoint)
    {
      if(!markers.with_normals() && markers.size() > 0)
        throw cases::InputError("reseeding at midpoints needs markers with normals");
      GapSearch search(grid, markers, cells, parameters.seeding.per_cell);
      for(const Birth &birth : search.births())
        markers.add(birth.place, birth.distance, birth.normal, true, next_birth++);
    }
    total_born += markers.size() - before;
    cells.sort(markers);
  }

  void MarkerReseeding::thin_out(Markers &markers, MarkerCells &cells,
                                 const std::span<const double> phi)
  {
    const double far = 3 * grid.spacing(), near = grid.spacing();
    const auto most = static_cast<std::size_t>(parameters.most);
    const bool knows_distance = markers.with_normals(); // or else a radius
    std::vector<std::uint32_t> kept, of_cell;
    for(std::size_t cell = 0; cell < cells.size(); ++cell)
    {
      of_cell.clear();
      for(std::size_t p = cells.first(cell); p < cells.first(cell + 1); ++p)
      {
        const double distance = markers.distance[p];
        const double value = interpolate(grid, phi.data(), grid.locate(markers.point(p)));
        const bool trusted
            = knows_distance ? std::abs(distance) <= near : value * distance < 0;
        if(std::abs(distance) <= far && (trusted || std::abs(value) <= far))
          of_cell.push_back(static_cast<std::uint32_t>(p));
      }
      if(of_cell.size() > most)
      {
        std::ranges::sort(of_cell, {}, [&](std::uint32_t p) { return markers.birth[p]; });
        of_cell.resize(most);
        std::ranges::sort(of_cell);
      }
      kept.insert(kept.end(), of_cell.begin(), of_cell.end());
    }
    if(kept.size() == markers.size())
      return;
    markers.reorder(kept);
    cells.sort(markers);
  }

  void MarkerReseeding::add_from_grid(Markers &markers, MarkerCells &cells,
                                      const std::span<const double> phi)
  {
    const SeedingParameters &seeding = parameters.seeding;
    std::vector<std::uint32_t> keys, how_many;
    for(const std::uint32_t key : cells.nodes())
    {
      const auto [begin, end] = cells.markers_of(key);
      const auto count = static_cast<int>(end - begin);
      if(count >= seeding.per_cell)
        continue;
      keys.push_back(key);
      how_many.push_back(static_cast<std::uint32_t>(seeding.per_cell - count));
    }
    const auto distance = [&](const Position &at)
    { return interpolate(grid, phi.data(), grid.locate(at)); };
    seed_in_cells(grid, distance, seeding, keys, how_many, ++rounds, markers, next_birth);
  }
} // namespace meltfront::particles::level_set
