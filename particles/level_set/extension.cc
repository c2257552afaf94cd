#include <particles/level_set/extension.h>
#include <particles/level_set/front_geometry.h>

namespace meltfront::particles::level_set
{
  namespace
  {
    bool is_next_to_front(const LevelSet &level_set, const std::size_t node)
    {
      const Grid &grid = level_set.grid();
      const double *phi = level_set.values().data() + node;
      const std::array<int, 3> index = grid.indices(node);
      const bool inside = phi[0] > 0;
      for(int d = 0; d < grid.dimension(); ++d)
      {
        if(index[d] > 0 && (phi[-grid.stride(d)] > 0) != inside)
          return true;
        if(index[d] < grid.nodes(d) - 1 && (phi[grid.stride(d)] > 0) != inside)
          return true;
      }
      return false;
    }
  } // namespace

  void Extension::operator()(const LevelSet &level_set, const ScalarFunction &at_front,
                             std::span<double> result)
  {
    const Grid &grid = level_set.grid();
    values.resize(grid.size());
    done.resize(grid.size(), 0);
    order.clear();
    for(const NodeRun &run : level_set.band().runs())
      for(int n = 0; n < run.length; ++n)
      {
        const std::size_t node = run.node + n, number = run.first + n;
        if(is_next_to_front(level_set, node))
        {
          values[node] = at_front(closest_on_front(level_set, grid.position(node)));
          done[node] = 1;
          result[number] = values[node];
        }
        else
          order.push_back({std::abs(level_set.values()[node]), node, number});
      }
    std::ranges::sort(order);
    for(const Place &place : order)
    {
      const std::optional<double> mean = from_nearer(level_set, place.node);
      values[place.node]
          = mean ? *mean
                 : at_front(closest_on_front(level_set, grid.position(place.node)));
      done[place.node] = 1;
      result[place.number] = values[place.node];
    }
    for(const NodeRun &run : level_set.band().runs())
      std::fill_n(&done[run.node], run.length, std::uint8_t(0));
  }

  std::optional<double> Extension::from_nearer(const LevelSet &level_set,
                                               const std::size_t node) const
  {
    const Grid &grid = level_set.grid();
    const double own = std::abs(level_set.values()[node]);
    double sum = 0, weights = 0;
    for(int d = 0; d < grid.dimension(); ++d)
    {
      double fall = 0, value = 0;
      for(const std::ptrdiff_t step : {-grid.stride(d), grid.stride(d)})
      {
        const std::size_t neighbour = node + static_cast<std::size_t>(step);
        const double nearer = own - std::abs(level_set.values()[neighbour]);
        if(done[neighbour] && nearer > fall)
        {
          fall = nearer;
          value = values[neighbour];
        }
      }
      sum += fall * value;
      weights += fall;
    }
    if(!(weights > 0))
      return std::nullopt;
    return sum / weights;
  }

  void normal_velocities(const LevelSet &level_set, std::span<const double> speed,
                         const std::array<std::span<double>, 3> &velocity)
  {
    const Grid &grid = level_set.grid();
    for(const NodeRun &run : level_set.band().runs())
      for(int n = 0; n < run.length; ++n)
      {
        const double *phi = level_set.values().data() + run.node + n;
        Position slope{};
        double squares = 0;
        for(int d = 0; d < grid.dimension(); ++d)
        {
          slope[d] = phi[grid.stride(d)] - phi[-grid.stride(d)];
          squares += slope[d] * slope[d];
        }
        const double factor
            = squares > 0 ? -speed[run.first + n] / std::sqrt(squares) : 0;
        for(int d = 0; d < grid.dimension(); ++d)
          velocity[d][run.first + n] = factor * slope[d];
      }
  }
} // namespace meltfront::particles::level_set
