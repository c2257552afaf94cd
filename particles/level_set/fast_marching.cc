#include <cases/numbers.h>
#include <particles/level_set/fast_marching.h>

#include <algorithm>
#include <functional>

namespace meltfront::particles::level_set
{
  namespace
  {
    using cases::infinity;

    /** The grid as the marching sees it. */
    struct Field
    {
      const Grid &grid;
      double *values;
      std::uint8_t *states;

      /** Solution d of sum over directions of ((d - a_i)/h)^2 = 1, a_i the distance of
       * the nearer known neighbour; infinite without one. */
      double distance(std::size_t node) const
      {
        const bool inside = values[node] > 0;
        std::array<double, 3> nearest{infinity, infinity, infinity};
        for(int d = 0; d < grid.dimension(); ++d)
          for(const std::ptrdiff_t step : {-grid.stride(d), grid.stride(d)})
          {
            const std::size_t neighbour = node + static_cast<std::size_t>(step);
            if((states[neighbour] & node_state::known)
               && (values[neighbour] > 0) == inside)
              nearest[d] = std::min(nearest[d], std::abs(values[neighbour]));
          }
        for(const auto &[a, b] : {std::pair{0, 1}, {1, 2}, {0, 1}})
        {
          const double lower = std::min(nearest[a], nearest[b]);
          nearest[b] = std::max(nearest[a], nearest[b]);
          nearest[a] = lower;
        }
        if(nearest[0] == infinity)
          return infinity;
        double result = nearest[0] + grid.spacing();
        double sum = nearest[0], squares = nearest[0] * nearest[0];
        for(int used = 1; used < grid.dimension() && result > nearest[used]; ++used)
        {
          sum += nearest[used];
          squares += nearest[used] * nearest[used];
          const int terms = used + 1;
          const double root
              = sum * sum - terms * (squares - grid.spacing() * grid.spacing());
          result = (sum + std::sqrt(std::max(root, 0.))) / terms;
        }
        return result;
      }
    };
  } // namespace

  void FastMarching::fill(const Grid &grid, std::span<double> values,
                          std::span<std::uint8_t> states, const Band &region)
  {
    const Field field{grid, values.data(), states.data()};
    heap.clear();
    for(const NodeRun &run : region.runs())
      for(std::size_t node = run.node; node < run.node + run.length; ++node)
        if(states[node] == node_state::wanted)
          if(const double distance = field.distance(node); distance < infinity)
            heap.emplace_back(distance, node);
    std::ranges::make_heap(heap, std::greater{});
    while(!heap.empty())
    {
      std::ranges::pop_heap(heap, std::greater{});
      const auto [distance, node] = heap.back();
      heap.pop_back();
      if(states[node] != node_state::wanted)
        continue;
      states[node] |= node_state::known;
      values[node] = values[node] > 0 ? distance : -distance;
      for(int d = 0; d < grid.dimension(); ++d)
        for(const std::ptrdiff_t step : {-grid.stride(d), grid.stride(d)})
        {
          const std::size_t neighbour = node + static_cast<std::size_t>(step);
          if(states[neighbour] != node_state::wanted
             || (values[neighbour] > 0) != (values[node] > 0))
            continue;
          heap.emplace_back(field.distance(neighbour), neighbour);
          std::ranges::push_heap(heap, std::greater{});
        }
    }
  }
} // namespace meltfront::particles::level_set
