#ifndef meltfront_reference_fem_enthalpy_box_tree_h
#define meltfront_reference_fem_enthalpy_box_tree_h

#include <reference_fem/enthalpy/nested_level.h>

#include <array>
#include <cstdint>
#include <vector>

namespace meltfront::reference_fem
{
  /**
   * Boxes halved here and there, as plain numbers: what multigrid needs of such a mesh
   * and of the coarser ones that come about when all siblings that are cells are joined
   * at once. Neighbours may differ in size by any factor.
   *
   * Lengths are counted in smallest cells.
   */
  class BoxTree
  {
  public:
    using Place = std::array<std::uint32_t, 3>;

    struct Cell
    {
      Place corner;       ///< its lowest
      std::uint32_t size; ///< a power of two
    };

    /** @param largest cell that there can be */
    BoxTree(int dimension, std::uint32_t largest, std::vector<Cell> cells);

    /** Nodes are the vertices that do not hang, along x first. */
    std::size_t n_nodes() const
    {
      return nodes.size();
    }

    Place node(std::size_t i) const
    {
      return place(nodes[i]);
    }

    /** No cell is smaller than the largest. */
    bool is_coarsest() const;

    BoxTree coarser() const;

    /** How the nodes interpolate between those of a coarser mesh. */
    SparseRows shares_of(const BoxTree &coarser) const;

    /** Of the coarsest: how many along each direction. */
    std::array<unsigned int, 3> nodes_along() const;

  private:
    /** A number by which places are in the order of x first. */
    static std::uint64_t number(const Place &place);
    static Place place(std::uint64_t number);
    /** One that keeps the smallest cells of each cell together. */
    std::uint64_t along_curve(const Place &place) const;

    const Cell *cell_around(const Place &smallest) const;
    const Cell *largest_around(const Place &vertex) const;
    bool is_corner(const Place &vertex, const Cell &cell) const;
    void add_shares(const Place &vertex, double weight,
                    std::vector<std::pair<unsigned int, double>> &found) const;

    int dimension;
    std::uint32_t largest;
    std::vector<Cell> cells;           ///< along the curve
    std::vector<std::uint64_t> firsts; ///< of the cells, their corners along the curve
    std::vector<std::uint64_t> nodes;  ///< numbers of their places
  };

  /**
   * Levels from a mesh of such boxes down to few nodes: first the tree's, then lattices.
   * @param network of the nodes of the mesh
   * @throws std::logic_error if the mesh has other nodes than the network
   */
  std::vector<NestedLevel> nested_levels(BoxTree mesh, int dimension,
                                         const ConductionMatrix &network);
} // namespace meltfront::reference_fem

#endif
