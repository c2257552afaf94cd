#include <particles/level_set/markers/marker_storage.h>

#include <algorithm>
#include <numeric>

namespace meltfront::particles::level_set
{
  namespace
  {
    template <class T>
    void gather(std::vector<T> &values, std::span<const std::uint32_t> order)
    {
      if(values.empty())
        return;
      std::vector<T> result(order.size());
      for(std::size_t i = 0; i < order.size(); ++i)
        result[i] = values[order[i]];
      values.swap(result);
    }

    /** One pass of a radix sort by 11 bits; equal keys keep their order. */
    void radix_pass(const std::vector<std::uint32_t> &keys,
                    const std::vector<std::uint32_t> &order, int shift,
                    std::vector<std::uint32_t> &new_keys,
                    std::vector<std::uint32_t> &new_order)
    {
      constexpr std::uint32_t buckets = 2048;
      std::array<std::uint32_t, buckets + 1> start{};
      for(const std::uint32_t key : keys)
        ++start[((key >> shift) & (buckets - 1)) + 1];
      std::partial_sum(start.begin(), start.end(), start.begin());
      new_keys.resize(keys.size());
      new_order.resize(keys.size());
      for(std::size_t i = 0; i < keys.size(); ++i)
      {
        const std::uint32_t place = start[(keys[i] >> shift) & (buckets - 1)]++;
        new_keys[place] = keys[i];
        new_order[place] = order[i];
      }
    }
  } // namespace

  void Markers::add(const Position &point, const double its_distance,
                    const Position &its_normal, const bool keep_normal,
                    const std::uint32_t born)
  {
    for(int i = 0; i < dimension; ++i)
    {
      position[i].push_back(point[i]);
      if(keep_normal)
        normal[i].push_back(its_normal[i]);
    }
    distance.push_back(its_distance);
    birth.push_back(born);
  }

  void Markers::reorder(const std::span<const std::uint32_t> order)
  {
    for(int i = 0; i < dimension; ++i)
    {
      gather(position[i], order);
      gather(normal[i], order);
    }
    gather(distance, order);
    gather(birth, order);
  }

  MarkerCells::MarkerCells(const Grid &grid)
    : grid(grid)
    , number_of(grid.size(), 0)
    , listed(grid.size(), 0)
    , begin{0}
  {
  }

  void MarkerCells::sort(Markers &markers)
  {
    marker_keys.clear();
    order.clear();
    for(std::size_t p = 0; p < markers.size(); ++p)
    {
      std::array<int, 3> cell{};
      bool near = true;
      for(int d = 0; d < grid.dimension(); ++d)
      {
        const double along
            = std::floor((markers.position[d][p] - grid.origin()[d]) / grid.spacing());
        near = near && along >= -1 && along <= grid.cells(d);
        cell[d] = near ? static_cast<int>(along) : 0;
      }
      if(near)
      {
        marker_keys.push_back(static_cast<std::uint32_t>(grid.node(cell)));
        order.push_back(static_cast<std::uint32_t>(p));
      }
    }
    for(int shift = 0; grid.size() >> shift != 0; shift += 11)
    {
      radix_pass(marker_keys, order, shift, other_keys, other_order);
      marker_keys.swap(other_keys);
      order.swap(other_order);
    }
    markers.reorder(order);
    find_runs();
    list_nodes();
  }

  void MarkerCells::find_runs()
  {
    for(const std::uint32_t key : keys)
      number_of[key] = 0;
    keys.clear();
    begin.clear();
    for(std::size_t p = 0; p < marker_keys.size(); ++p)
      if(p == 0 || marker_keys[p] != marker_keys[p - 1])
      {
        keys.push_back(marker_keys[p]);
        begin.push_back(static_cast<std::uint32_t>(p));
        number_of[marker_keys[p]] = static_cast<std::uint32_t>(keys.size());
      }
    begin.push_back(static_cast<std::uint32_t>(marker_keys.size()));
    most = 0;
    for(std::size_t cell = 0; cell < keys.size(); ++cell)
      most = std::max<std::size_t>(most, begin[cell + 1] - begin[cell]);
  }

  void MarkerCells::list_nodes()
  {
    node_list.clear();
    for(const std::uint32_t key : keys)
      for(int corner = 0; corner < 1 << grid.dimension(); ++corner)
      {
        const std::size_t node = corner_node(grid, key, corner);
        if(listed[node] != 0)
          continue;
        listed[node] = 1;
        const std::array<int, 3> index = grid.indices(node);
        bool inside = true;
        for(int d = 0; d < grid.dimension(); ++d)
          inside = inside && index[d] >= 0 && index[d] < grid.nodes(d);
        if(inside)
          node_list.push_back(static_cast<std::uint32_t>(node));
      }
    for(const std::uint32_t key : keys)
      for(int corner = 0; corner < 1 << grid.dimension(); ++corner)
        listed[corner_node(grid, key, corner)] = 0;
  }
} // namespace meltfront::particles::level_set
