#include <cases/error.h>
#include <particles/level_set/markers/marker_seeding.h>

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace meltfront::particles::level_set
{
  namespace
  {
    /** Numbers in [0, 1) that depend on a seed only (Steele, Lea, Flood 2014: SplitMix).
     */
    class CellNumbers
    {
    public:
      explicit CellNumbers(std::uint64_t seed)
        : state(seed)
      {
      }

      std::uint64_t bits()
      {
        std::uint64_t z = state += 0x9e3779b97f4a7c15;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
        z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
        return z ^ (z >> 31);
      }

      double uniform()
      {
        return static_cast<double>(bits() >> 11) * 0x1p-53;
      }

    private:
      std::uint64_t state;
    };

    CellNumbers numbers_of_cell(std::uint64_t seed, std::uint64_t round,
                                std::uint32_t key)
    {
      return CellNumbers(CellNumbers(CellNumbers(seed).bits() + round).bits() + key);
    }

    void check(const Grid &grid, const SeedingParameters &parameters)
    {
      if(parameters.per_cell < 1 || parameters.per_cell > 10000)
        throw cases::InputError(fmt::format(
            "{} markers per cell: they must be from 1 to 10000", parameters.per_cell));
      if(!(parameters.nearest >= 0) || !(parameters.furthest > parameters.nearest)
         || parameters.furthest > 4)
        throw cases::InputError(fmt::format(
            "markers from {} to {} spacings from the front: the first must be from zero, "
            "the second above it and at most 4",
            parameters.nearest, parameters.furthest));
      if(!(grid.spacing() > 0) || !std::isfinite(grid.spacing()))
        throw cases::InputError(fmt::format(
            "markers on a grid of spacing {} m: it must be above zero", grid.spacing()));
    }

    double finite_distance(const DistanceFunction &distance, const Position &at)
    {
      const double value = distance(at);
      if(!std::isfinite(value))
        throw cases::InputError(
            fmt::format("the distance from the front at ({}, {}, {}) m is {}: it must be "
                        "finite",
                        at[0], at[1], at[2], value));
      return value;
    }

    /** Unit vector along the gradient, by central differences. */
    Position normal_at(const DistanceFunction &distance, const Position &at,
                       int dimension, double step)
    {
      Position normal{};
      double square = 0;
      for(int i = 0; i < dimension; ++i)
      {
        Position low = at, high = at;
        low[i] -= step;
        high[i] += step;
        normal[i] = distance(high) - distance(low);
        square += normal[i] * normal[i];
      }
      // where the distance has no gradient, on a ridge, any direction is as good
      if(square == 0)
        return {1, 0, 0};
      for(double &component : normal)
        component /= std::sqrt(square);
      return normal;
    }

    /** Markers believe what the function says: it must rise by a metre per metre. */
    void require_distance(const Grid &grid, const DistanceFunction &distance,
                          const Markers &markers)
    {
      constexpr double tolerance = 0.1;
      const double step = 1e-4 * grid.spacing();
      std::size_t wrong = 0;
      double slope = 1;
      for(std::size_t p = 0; p < markers.size(); ++p)
      {
        Position low = markers.point(p), high = low;
        for(int d = 0; d < grid.dimension(); ++d)
        {
          low[d] -= step * markers.normal[d][p];
          high[d] += step * markers.normal[d][p];
        }
        const double here = (distance(high) - distance(low)) / (2 * step);
        if(std::abs(here - 1) <= tolerance)
          continue;
        ++wrong;
        slope = here;
      }
      // a few lie on ridges, as next to corners
      if(wrong > markers.size() / 2)
        throw cases::InputError(fmt::format(
            "markers need the distance from the front, whose slope is 1: the function "
            "given has slopes like {:.3g} next to it",
            slope));
    }

    /** Cells of the grid and the layer around it, by key. */
    template <class Function>
    void for_each_cell(const Grid &grid, int beyond, const Function &function)
    {
      const bool solid = grid.dimension() == 3;
      for(int k = solid ? -1 : 0; k <= (solid ? grid.cells(2) + beyond : 0); ++k)
        for(int j = -1; j <= grid.cells(1) + beyond; ++j)
          for(int i = -1; i <= grid.cells(0) + beyond; ++i)
            function(grid.node(i, j, k));
    }

    /** Cells that a front may be near enough to: by the distance at their corners. */
    std::vector<std::uint32_t> cells_near(const Grid &grid,
                                          const DistanceFunction &distance, double band)
    {
      std::vector<double> at_node(grid.size());
      for_each_cell(grid, 1,
                    [&](std::size_t node)
                    { at_node[node] = finite_distance(distance, grid.position(node)); });
      std::vector<std::uint32_t> result;
      for_each_cell(grid, 0,
                    [&](std::size_t key)
                    {
                      double low = std::numeric_limits<double>::infinity(), high = -low,
                             least = low;
                      for(int corner = 0; corner < 1 << grid.dimension(); ++corner)
                      {
                        const double value = at_node[corner_node(grid, key, corner)];
                        low = std::min(low, value);
                        high = std::max(high, value);
                        least = std::min(least, std::abs(value));
                      }
                      if(least <= band * grid.spacing() || (low <= 0 && high > 0))
                        result.push_back(static_cast<std::uint32_t>(key));
                    });
      return result;
    }
  } // namespace

  double signed_radius(const double distance, const double spacing)
  {
    return std::copysign(std::clamp(std::abs(distance), 0.1 * spacing, 0.5 * spacing),
                         distance);
  }

  void seed_in_cells(const Grid &grid, const DistanceFunction &distance,
                     const SeedingParameters &parameters,
                     const std::span<const std::uint32_t> keys,
                     const std::span<const std::uint32_t> how_many,
                     const std::uint64_t round, Markers &markers, std::uint32_t &births)
  {
    const double near = parameters.nearest * grid.spacing(),
                 far = parameters.furthest * grid.spacing();
    for(std::size_t k = 0; k < keys.size(); ++k)
    {
      CellNumbers numbers = numbers_of_cell(parameters.seed, round, keys[k]);
      const Position low = grid.position(keys[k]);
      for(std::uint32_t number = 0; number < how_many[k]; ++number)
      {
        Position at{};
        for(int i = 0; i < grid.dimension(); ++i)
          at[i] = low[i] + grid.spacing() * numbers.uniform();
        const double value = finite_distance(distance, at);
        if(std::abs(value) < near || std::abs(value) > far)
          continue;
        const Position normal
            = parameters.normals
                  ? normal_at(distance, at, grid.dimension(), 1e-4 * grid.spacing())
                  : Position{};
        markers.add(at, value, normal, parameters.normals, births++);
      }
    }
  }

  Markers seed_markers(const Grid &grid, const DistanceFunction &distance,
                       const SeedingParameters &parameters)
  {
    check(grid, parameters);
    Markers markers;
    markers.dimension = grid.dimension();
    std::uint32_t births = 0;
    const std::vector<std::uint32_t> keys = cells_near(grid, distance, parameters.band);
    const std::vector<std::uint32_t> how_many(
        keys.size(), static_cast<std::uint32_t>(parameters.per_cell));
    seed_in_cells(grid, distance, parameters, keys, how_many, 0, markers, births);
    if(markers.with_normals())
      require_distance(grid, distance, markers);
    return markers;
  }
} // namespace meltfront::particles::level_set
