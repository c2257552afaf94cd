#ifndef meltfront_particles_level_set_markers_marker_storage_h
#define meltfront_particles_level_set_markers_marker_storage_h

#include <particles/level_set/grid.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace meltfront::particles::level_set
{
  /**
   * Massless particles that move with the front: a structure of arrays. Each knows its
   * signed distance from the front, positive inside the tracked phase; schemes that look
   * at escaped markers only keep the sign of its side times its radius there.
   */
  struct Markers
  {
    int dimension = 2;
    std::array<std::vector<double>, 3> position; ///< m; empty beyond the dimension
    std::vector<double> distance;                ///< m
    /** Unit vector along the gradient of the distance; empty where no scheme needs it. */
    std::array<std::vector<double>, 3> normal;
    std::vector<std::uint32_t> birth; ///< number in the order of birth

    std::size_t size() const
    {
      return distance.size();
    }

    bool with_normals() const
    {
      return !normal[0].empty();
    }

    Position point(std::size_t marker) const
    {
      return {position[0][marker], position[1][marker],
              dimension == 3 ? position[2][marker] : 0};
    }

    /** Add one; the normal only counts if normals are kept. */
    void add(const Position &point, double distance, const Position &normal,
             bool keep_normal, std::uint32_t born);

    /** New marker i is old marker order[i]; those not in the order are dropped. */
    void reorder(std::span<const std::uint32_t> order);
  };

  /** A corner of the cell with a key: bit d of its number says whether it is the upper
   * one along coordinate d. */
  inline std::size_t corner_node(const Grid &grid, std::size_t key, int corner)
  {
    for(int d = 0; d < grid.dimension(); ++d)
      if(corner >> d & 1)
        key += static_cast<std::size_t>(grid.stride(d));
    return key;
  }

  /**
   * Markers sorted by the grid's cells, and the nodes near them. A cell's key is the
   * number of its lowest node. The effort grows with the number of markers, not with that
   * of cells.
   */
  class MarkerCells
  {
  public:
    explicit MarkerCells(const Grid &grid);

    /**
     * Sort the markers by cell, in each cell in their order before. Markers further from
     * the grid than a spacing are dropped.
     */
    void sort(Markers &markers);

    /** Cells that hold markers. */
    std::size_t size() const
    {
      return keys.size();
    }

    /** Key of such a cell. */
    std::uint32_t key(std::size_t cell) const
    {
      return keys[cell];
    }

    /** First marker of such a cell; of the one behind the last, the number of markers. */
    std::size_t first(std::size_t cell) const
    {
      return begin[cell];
    }

    /** Markers of the cell with a key, as a range of indices. */
    std::pair<std::size_t, std::size_t> markers_of(std::uint32_t key) const
    {
      const std::uint32_t number = number_of[key];
      return number == 0
                 ? std::pair<std::size_t, std::size_t>{0, 0}
                 : std::pair<std::size_t, std::size_t>{begin[number - 1], begin[number]};
    }

    /** Nodes of the grid, without ghosts, that are corners of such cells. */
    const std::vector<std::uint32_t> &nodes() const
    {
      return node_list;
    }

    /** Most markers in a cell. */
    std::size_t fullest() const
    {
      return most;
    }

  private:
    void find_runs();
    void list_nodes();

    const Grid grid;
    std::vector<std::uint32_t> number_of; ///< by key: 1 + the cell's number, 0 if empty
    std::vector<std::uint8_t> listed;     ///< by node, while nodes are listed
    std::vector<std::uint32_t> keys, begin, node_list;
    std::vector<std::uint32_t> marker_keys, order, other_keys, other_order;
    std::size_t most = 0;
  };
} // namespace meltfront::particles::level_set

#endif
