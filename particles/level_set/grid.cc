#include <cases/error.h>
#include <particles/level_set/grid.h>

#include <fmt/format.h>

namespace meltfront::particles::level_set
{
  namespace
  {
    constexpr double most_nodes = 2e9;

    void require_grid(const int dimension, const Position &origin, const double spacing,
                      const std::array<int, 3> &cells)
    {
      if(dimension != 2 && dimension != 3)
        throw cases::InputError(fmt::format(
            "a level set's grid has {} dimensions: it must have 2 or 3", dimension));
      if(!(spacing > 0) || !std::isfinite(spacing))
        throw cases::InputError(fmt::format(
            "a level set's grid has a spacing of {:.6g} m: it must be above zero",
            spacing));
      double nodes = 1;
      for(int d = 0; d < dimension; ++d)
      {
        if(!std::isfinite(origin[d]))
          throw cases::InputError(
              fmt::format("a level set's grid starts at {} = {}: it must be a number",
                          "xyz"[d], origin[d]));
        if(cells[d] < 4)
          throw cases::InputError(
              fmt::format("a level set's grid has {} cells along {}: at least 4 are "
                          "needed",
                          cells[d], "xyz"[d]));
        nodes *= cells[d] + 1. + 2 * Grid::ghost_layers;
      }
      if(nodes > most_nodes)
        throw cases::InputError(fmt::format(
            "a level set's grid has {:.3g} nodes: at most {:.3g} are possible", nodes,
            most_nodes));
    }
  } // namespace

  Grid::Grid(const int dimension, const Position &origin, const double spacing,
             const std::array<int, 3> &cells)
    : dimensions(dimension)
    , lowest{origin[0], origin[1], dimension == 3 ? origin[2] : 0.}
    , distance(spacing)
  {
    require_grid(dimension, origin, spacing, cells);
    std::ptrdiff_t stride = 1;
    for(int d = 0; d < 3; ++d)
    {
      strides[d] = stride;
      if(d >= dimension)
        continue;
      counts[d] = cells[d] + 1;
      first += ghost_layers * stride;
      stride *= counts[d] + 2 * ghost_layers;
    }
    total = static_cast<std::size_t>(stride);
  }

  bool Grid::contains(const Position &point) const
  {
    for(int d = 0; d < dimensions; ++d)
      if(!(point[d] >= lowest[d] && point[d] <= coordinate(d, counts[d] - 1)))
        return false;
    return true;
  }
} // namespace meltfront::particles::level_set
