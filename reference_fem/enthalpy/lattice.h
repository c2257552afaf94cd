#ifndef meltfront_reference_fem_enthalpy_lattice_h
#define meltfront_reference_fem_enthalpy_lattice_h

#include <array>
#include <cstddef>
#include <vector>

namespace meltfront::reference_fem
{
  /** How the nodes of a Cartesian mesh lie: numbered along x first, then y, then z. A
   * periodic direction has as many nodes as cells, any other one more. */
  struct Lattice
  {
    std::array<unsigned int, 3> nodes{1, 1, 1};
    std::array<bool, 3> periodic{};

    std::size_t size() const
    {
      return std::size_t(nodes[0]) * nodes[1] * nodes[2];
    }
  };

  /**
   * One direction of a lattice, and how its nodes interpolate linearly between those of
   * the next coarser one: every other node and the last; one node where there are three
   * or fewer.
   */
  class LatticeLine
  {
  public:
    /** Positions ascend; a period beyond zero joins the ends. */
    LatticeLine(std::vector<double> position, double period);

    int nodes() const
    {
      return static_cast<int>(position.size());
    }

    LatticeLine coarser() const;

    int coarse_nodes() const
    {
      return coarse;
    }

    /** The interpolation at node i, -1 <= i <= nodes(): (1 - share) of the coarse node
     * `lower`, share of the next one. Beyond the ends numbers go on. */
    struct Place
    {
      int lower = 0;
      double share = 0;
    };
    const Place &place(int i) const
    {
      return places[static_cast<std::size_t>(i + 1)];
    }

    /** The coarse node that a number stands for, round a period. */
    int wrapped_coarse(int i) const
    {
      return i < 0 ? i + coarse : i >= coarse ? i - coarse : i;
    }

    int wrapped(int i) const
    {
      return i < 0 ? i + nodes() : i >= nodes() ? i - nodes() : i;
    }

  private:
    std::vector<double> position;
    double period; ///< 0: none
    int coarse;
    std::vector<Place> places; ///< of the nodes from -1 to nodes()
  };

  class LatticeMatrix;

  /** A level of lattices: its directions. Rows are the nodes along x. */
  struct LatticeLevel
  {
    using Matrix = LatticeMatrix;

    std::array<LatticeLine, 3> line;

    int row_length() const
    {
      return line[0].nodes();
    }
    int rows() const
    {
      return line[1].nodes() * line[2].nodes();
    }
    std::size_t size() const
    {
      return std::size_t(row_length()) * rows();
    }
    bool in_space() const
    {
      return line[2].nodes() > 1;
    }
    /** How often a coarser level is visited where fronts are moved: along a line two
     * visits of each level by the one above would double its cost with every level. */
    int visits() const
    {
      return rows() > 1 ? 2 : 1;
    }
    /** The row at a number of rows from another one, round periods. */
    int row(int y, int z) const
    {
      return line[1].wrapped(y) + line[1].nodes() * line[2].wrapped(z);
    }
    LatticeLevel coarser() const
    {
      return {{line[0].coarser(), line[1].coarser(), line[2].coarser()}};
    }

    /** fine += P coarse, where the mask (none: everywhere) is not zero. */
    void add_interpolated(const std::vector<double> &on_coarse, const char *mask,
                          std::vector<double> &fine) const;

    /** coarse += P' of one row of values. @param work is overwritten */
    void restrict_row(int y, int z, const double *values, std::vector<double> &work,
                      std::vector<double> &on_coarse) const;

    /** P' of values, zero where the mask is. */
    void restrict_to(const std::vector<double> &fine, const char *mask,
                     std::vector<double> &on_coarse) const;

    std::size_t coarse_size() const
    {
      return std::size_t(line[0].coarse_nodes()) * line[1].coarse_nodes()
             * line[2].coarse_nodes();
    }

  private:
    template <typename Visit>
    void for_coarse_rows(int y, int z, const Visit &visit) const;
  };

  /** The levels of a lattice from the finest to one of at most 32 nodes. */
  std::vector<LatticeLevel> lattice_levels(const Lattice &lattice);
} // namespace meltfront::reference_fem

#endif
