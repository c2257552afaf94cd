#ifndef meltfront_reference_fem_enthalpy_distributed_box_lattice_h
#define meltfront_reference_fem_enthalpy_distributed_box_lattice_h

#include <cases/scene.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numbers>

namespace meltfront::reference_fem
{
  /**
   * The nodes of a box of alike cells, numbered along x first, then y, then z: the same
   * whatever rank has which of them. Of a half section about an axis they are numbered
   * along the axis (y) first, where cells have the same volume, then away from it (x).
   */
  struct BoxLattice
  {
    /** Of a node: cells from the lower side in each direction; of a cell, its lower
     * corner. */
    using Place = std::array<unsigned int, 3>;

    int dimension = 2;
    bool about_axis = false;
    Place cells{};                    ///< by direction; none across a plane
    cases::Position lower{}, upper{}; ///< by coordinate

    /** The coordinate along a direction, and the direction of a coordinate. */
    int coordinate(int direction) const
    {
      return about_axis ? 1 - direction : direction;
    }

    std::uint64_t n_nodes() const
    {
      return number_of(cells) + 1;
    }

    std::uint64_t number_of(const Place &node) const
    {
      return node[0]
             + (cells[0] + std::uint64_t(1))
                   * (node[1] + (cells[1] + std::uint64_t(1)) * node[2]);
    }

    Place place_of(std::uint64_t number) const
    {
      const std::uint64_t nx = cells[0] + std::uint64_t(1),
                          ny = cells[1] + std::uint64_t(1);
      return {static_cast<unsigned int>(number % nx),
              static_cast<unsigned int>(number / nx % ny),
              static_cast<unsigned int>(number / nx / ny)};
    }

    double spacing(int direction) const
    {
      const int c = coordinate(direction);
      return (upper[c] - lower[c]) / cells[direction];
    }

    double cell_volume() const
    {
      double volume = 1;
      for(int d = 0; d < dimension; ++d)
        volume *= spacing(d);
      return volume;
    }

    cases::Position position(const Place &node) const
    {
      cases::Position result{};
      for(int d = 0; d < dimension; ++d)
      {
        const int c = coordinate(d);
        result[c] = node[d] == cells[d] ? upper[c] : lower[c] + node[d] * spacing(d);
      }
      return result;
    }

    bool at_lower(const Place &node, int direction) const
    {
      return node[direction] == 0;
    }
    bool at_upper(const Place &node, int direction) const
    {
      return node[direction] == cells[direction];
    }

    /** The part of a cell's volume, area or length that goes with a node: half of it for
     * every side of the box that the node is on, sides across one direction left out. */
    double share_of_cell(const Place &node, int without = -1) const
    {
      double share = 1;
      for(int d = 0; d < dimension; ++d)
        if(d != without && (at_lower(node, d) || at_upper(node, d)))
          share /= 2;
      return share;
    }

    /** The integral of a node's shape function, about an axis with the weight 2 pi r;
     * `without` a direction that over what lies across it at the node, times the spacing
     * along it. */
    double measure(const Place &node, int without = -1) const
    {
      const double of_section = cell_volume() * share_of_cell(node, without);
      return about_axis ? of_section * around(node, without) : of_section;
    }

    /** Whether a node is the lower corner of a cell. */
    bool begins_cell(const Place &node) const
    {
      for(int d = 0; d < dimension; ++d)
        if(at_upper(node, d))
          return false;
      return true;
    }

    /** Bits by direction of a corner that is given by coordinates, or the other way. */
    unsigned int bits_of_corner(unsigned int which) const
    {
      return about_axis ? (which & 1) << 1 | which >> 1 : which;
    }

    /** A corner of a cell: upper along a direction where its bit is set. */
    static Place corner(Place cell, unsigned int which)
    {
      for(unsigned int d = 0; d < 3; ++d)
        cell[d] += which >> d & 1;
      return cell;
    }

    unsigned int n_corners() const
    {
      return 1u << dimension;
    }

    /** Visit the places between two, which included, in the order of their numbers. */
    template <typename Visit>
    static void visit_between(const Place &first, const Place &last, const Visit &visit)
    {
      Place place;
      for(place[2] = first[2]; place[2] <= last[2]; ++place[2])
        for(place[1] = first[1]; place[1] <= last[1]; ++place[1])
          for(place[0] = first[0]; place[0] <= last[0]; ++place[0])
            visit(place);
    }

    /** Visit a node and those that share cells with it. */
    template <typename Visit>
    void visit_around(const Place &node, const Visit &visit) const
    {
      Place first = node, last = node;
      for(int d = 0; d < dimension; ++d)
      {
        first[d] -= at_lower(node, d) ? 0 : 1;
        last[d] += at_upper(node, d) ? 0 : 1;
      }
      visit_between(first, last, visit);
    }

    /** Where 2^dimension cells are one. All numbers of cells are to be even. */
    BoxLattice coarser() const
    {
      BoxLattice result = *this;
      for(unsigned int &along : result.cells)
        along /= 2;
      return result;
    }

    /** Visit the nodes of the coarser lattice between which a node interpolates, each
     * with its share. */
    template <typename Visit>
    static void visit_coarser(const Place &node, const Visit &visit)
    {
      Place first, last;
      double share = 1;
      for(std::size_t d = 0; d < 3; ++d)
      {
        first[d] = node[d] / 2;
        last[d] = first[d] + node[d] % 2;
        share /= 1 + node[d] % 2;
      }
      visit_between(first, last, [&](const Place &place) { visit(place, share); });
    }

  private:
    /** The mean of 2 pi r over a node's shape function, or at the node alone. */
    double around(const Place &node, int without) const
    {
      constexpr int away = 1;
      double radius = position(node)[0];
      if(without != away && at_lower(node, away))
        radius += spacing(away) / 3;
      if(without != away && at_upper(node, away))
        radius -= spacing(away) / 3;
      return 2 * std::numbers::pi * radius;
    }
  };
} // namespace meltfront::reference_fem

#endif
