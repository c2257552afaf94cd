#include <reference_fem/enthalpy/box_tree.h>
#include <reference_fem/enthalpy/lattice.h>

#include <algorithm>
#include <stdexcept>

namespace meltfront::reference_fem
{
  namespace
  {
    constexpr int bits = 21; ///< of a coordinate
  }

  BoxTree::BoxTree(int dimension, std::uint32_t largest, std::vector<Cell> of_mesh)
    : dimension(dimension)
    , largest(largest)
    , cells(std::move(of_mesh))
  {
    std::ranges::sort(cells, {},
                      [this](const Cell &cell) { return along_curve(cell.corner); });
    firsts.reserve(cells.size());
    std::vector<std::uint64_t> vertices;
    vertices.reserve(cells.size() << dimension);
    for(const Cell &cell : cells)
    {
      firsts.push_back(along_curve(cell.corner));
      for(unsigned int a = 0; a < 1u << dimension; ++a)
      {
        Place vertex = cell.corner;
        for(int d = 0; d < dimension; ++d)
          vertex[d] += (a >> d & 1u) * cell.size;
        vertices.push_back(number(vertex));
      }
    }
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for(const std::uint64_t vertex : vertices)
      if(is_corner(place(vertex), *largest_around(place(vertex))))
        nodes.push_back(vertex);
  }

  std::uint64_t BoxTree::number(const Place &place)
  {
    return place[0] | std::uint64_t(place[1]) << bits
           | std::uint64_t(place[2]) << 2 * bits;
  }

  BoxTree::Place BoxTree::place(std::uint64_t number)
  {
    constexpr std::uint64_t coordinate = (1u << bits) - 1;
    return {static_cast<std::uint32_t>(number & coordinate),
            static_cast<std::uint32_t>(number >> bits & coordinate),
            static_cast<std::uint32_t>(number >> 2 * bits)};
  }

  /** Morton's: the bits of the coordinates in turn. */
  std::uint64_t BoxTree::along_curve(const Place &place) const
  {
    std::uint64_t result = 0;
    for(int bit = 0; bit < bits; ++bit)
      for(int d = 0; d < dimension; ++d)
        result |= std::uint64_t(place[d] >> bit & 1u) << (bit * dimension + d);
    return result;
  }

  /** The cell that holds a smallest cell; null outside of the mesh. */
  const BoxTree::Cell *BoxTree::cell_around(const Place &smallest) const
  {
    const auto next = std::ranges::upper_bound(firsts, along_curve(smallest));
    if(next == firsts.begin())
      return nullptr;
    const Cell &cell = cells[static_cast<std::size_t>(next - firsts.begin() - 1)];
    for(int d = 0; d < dimension; ++d)
      if(smallest[d] < cell.corner[d] || smallest[d] - cell.corner[d] >= cell.size)
        return nullptr;
    return &cell;
  }

  const BoxTree::Cell *BoxTree::largest_around(const Place &vertex) const
  {
    const Cell *result = nullptr;
    for(unsigned int a = 0; a < 1u << dimension; ++a)
    {
      Place smallest = vertex;
      bool inside = true;
      for(int d = 0; d < dimension; ++d)
        if(a >> d & 1u)
        {
          inside &= smallest[d] > 0;
          --smallest[d];
        }
      if(!inside)
        continue;
      const Cell *cell = cell_around(smallest);
      if(cell && (!result || cell->size > result->size))
        result = cell;
    }
    return result;
  }

  bool BoxTree::is_corner(const Place &vertex, const Cell &cell) const
  {
    for(int d = 0; d < dimension; ++d)
      if(vertex[d] != cell.corner[d] && vertex[d] != cell.corner[d] + cell.size)
        return false;
    return true;
  }

  bool BoxTree::is_coarsest() const
  {
    return std::ranges::all_of(cells,
                               [this](const Cell &cell) { return cell.size == largest; });
  }

  /** Siblings follow each other along the curve. */
  BoxTree BoxTree::coarser() const
  {
    const std::size_t siblings = std::size_t(1) << dimension;
    std::vector<Cell> joined;
    for(std::size_t c = 0; c < cells.size();)
    {
      const Cell &first = cells[c];
      bool all = first.size < largest && c + siblings <= cells.size();
      for(int d = 0; d < dimension; ++d)
        all = all && first.corner[d] % (2 * first.size) == 0;
      for(std::size_t k = 1; all && k < siblings; ++k)
        all = cells[c + k].size == first.size;
      joined.push_back({first.corner, all ? 2 * first.size : first.size});
      c += all ? siblings : 1;
    }
    return {dimension, largest, std::move(joined)};
  }

  /** In the largest cell around a vertex, so that all cells there agree. */
  void BoxTree::add_shares(const Place &vertex, double weight,
                           std::vector<std::pair<unsigned int, double>> &found) const
  {
    const Cell &cell = *largest_around(vertex);
    if(is_corner(vertex, cell))
    {
      const auto node = std::ranges::lower_bound(nodes, number(vertex));
      const auto i = static_cast<unsigned int>(node - nodes.begin());
      const auto known
          = std::ranges::find(found, i, [](const auto &f) { return f.first; });
      if(known == found.end())
        found.emplace_back(i, weight);
      else
        known->second += weight;
      return;
    }
    for(unsigned int a = 0; a < 1u << dimension; ++a)
    {
      double share = weight;
      Place corner = cell.corner;
      for(int d = 0; d < dimension; ++d)
      {
        const double x = double(vertex[d] - cell.corner[d]) / cell.size;
        share *= a >> d & 1u ? x : 1 - x;
        corner[d] += (a >> d & 1u) * cell.size;
      }
      if(share > 0)
        add_shares(corner, share, found);
    }
  }

  SparseRows BoxTree::shares_of(const BoxTree &coarser) const
  {
    SparseRows result;
    std::vector<std::pair<unsigned int, double>> found;
    for(const std::uint64_t node : nodes)
    {
      found.clear();
      coarser.add_shares(place(node), 1, found);
      for(const auto &[i, share] : found)
      {
        result.column.push_back(i);
        result.value.push_back(share);
      }
      result.start.push_back(result.column.size());
    }
    return result;
  }

  std::array<unsigned int, 3> BoxTree::nodes_along() const
  {
    std::array<unsigned int, 3> result{1, 1, 1};
    const Place last = place(nodes.back());
    for(int d = 0; d < dimension; ++d)
      result[d] = last[d] / largest + 1;
    return result;
  }

  namespace
  {
    SparseRows shares_of(const LatticeLevel &level)
    {
      SparseRows result;
      const std::array<LatticeLine, 3> &line = level.line;
      for(int z = 0; z < line[2].nodes(); ++z)
        for(int y = 0; y < line[1].nodes(); ++y)
          for(int x = 0; x < line[0].nodes(); ++x)
          {
            const std::array<LatticeLine::Place, 3> at{line[0].place(x), line[1].place(y),
                                                       line[2].place(z)};
            for(unsigned int a = 0; a < 8; ++a)
            {
              double share = 1;
              std::array<int, 3> to;
              for(std::size_t d = 0; d < 3; ++d)
              {
                to[d] = at[d].lower + static_cast<int>(a >> d & 1u);
                share *= a >> d & 1u ? at[d].share : 1 - at[d].share;
              }
              if(share == 0)
                continue;
              result.column.push_back(static_cast<unsigned int>(
                  to[0]
                  + line[0].coarse_nodes() * (to[1] + line[1].coarse_nodes() * to[2])));
              result.value.push_back(share);
            }
            result.start.push_back(result.column.size());
          }
      return result;
    }
  } // namespace

  std::vector<NestedLevel> nested_levels(BoxTree mesh, int dimension,
                                         const ConductionMatrix &network)
  {
    if(mesh.n_nodes() != network.size())
      throw std::logic_error("a tree of boxes has the nodes of its mesh");
    std::vector<NestedLevel> result{NestedLevel(network, dimension)};
    const auto add = [&result](SparseRows shares, std::size_t nodes_of_coarser)
    {
      result.back().interpolate_from(std::move(shares), nodes_of_coarser);
      result.push_back(result.back().coarser());
    };
    while(!mesh.is_coarsest())
    {
      BoxTree coarser = mesh.coarser();
      add(mesh.shares_of(coarser), coarser.n_nodes());
      mesh = std::move(coarser);
    }
    const std::vector<LatticeLevel> lattices
        = lattice_levels(Lattice{mesh.nodes_along(), {}});
    for(std::size_t l = 0; l + 1 < lattices.size(); ++l)
      add(shares_of(lattices[l]), lattices[l].coarse_size());
    return result;
  }
} // namespace meltfront::reference_fem
