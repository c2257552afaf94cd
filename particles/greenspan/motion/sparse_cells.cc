#include <particles/greenspan/motion/sparse_cells.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::greenspan
{
  namespace
  {
    /** Bits of a cell's number in each direction; what lies farther out shares the
     * outermost cell. */
    constexpr int bits = 21;
    constexpr double middle = 1 << (bits - 1);

    std::uint64_t cell_number(double x, double inverse_width)
    {
      return static_cast<std::uint64_t>(
          std::clamp(std::floor(x * inverse_width) + middle, 1., 2 * middle - 2));
    }

    /** A particle in the order of cells: rows of them along x, one after the other. */
    struct Placed
    {
      std::uint64_t cell;
      std::uint32_t particle;
    };

    /** Particles by cells, with their coordinates side by side. */
    class SparseCells
    {
    public:
      SparseCells(int dimension, const std::array<std::vector<double>, 3> &position,
                  std::size_t n, double radius)
        : placed(n)
      {
        const double inverse_width = 1 / radius;
        for(std::size_t i = 0; i < n; ++i)
        {
          std::uint64_t cell = 0;
          for(int d = 0; d < dimension; ++d)
            cell |= cell_number(position[d][i], inverse_width) << (bits * d);
          placed[i] = {cell, static_cast<std::uint32_t>(i)};
        }
        std::sort(placed.begin(), placed.end(),
                  [](const Placed &a, const Placed &b) {
                    return a.cell < b.cell
                           || (a.cell == b.cell && a.particle < b.particle);
                  });
        for(int d = 0; d < dimension; ++d)
        {
          coordinate[d].resize(n);
          for(std::size_t i = 0; i < n; ++i)
            coordinate[d][i] = position[d][placed[i].particle];
        }
      }

      std::vector<Placed> placed;
      std::array<std::vector<double>, 3> coordinate;
    };

    /** The particles in three cells beside each other, as a window that only moves on. */
    struct Window
    {
      std::int64_t offset; ///< from the middle one's row of cells
      std::size_t begin = 0, end = 0;

      void move_to(const std::vector<Placed> &placed, std::uint64_t cell)
      {
        const std::uint64_t centre = cell + static_cast<std::uint64_t>(offset);
        while(begin < placed.size() && placed[begin].cell < centre - 1)
          ++begin;
        end = std::max(begin, end);
        while(end < placed.size() && placed[end].cell <= centre + 1)
          ++end;
      }
    };

    std::vector<Window> windows(int dimension)
    {
      std::vector<Window> result;
      for(std::int64_t k = dimension == 3 ? -1 : 0; k <= (dimension == 3 ? 1 : 0); ++k)
        for(std::int64_t j = -1; j <= 1; ++j)
          result.push_back({k * (std::int64_t(1) << (2 * bits)) + j * (1 << bits)});
      return result;
    }

    /** Append the neighbours of one particle; without a branch each candidate is written
     * and counted only if it is near. */
    template <int dimension>
    void find_row(const SparseCells &cells, const std::vector<Window> &around,
                  std::size_t i, double squared_radius, FoundRows &found)
    {
      std::size_t candidates = 0;
      for(const Window &window : around)
        candidates += window.end - window.begin;
      const std::size_t first = found.entries.size();
      found.entries.resize(first + candidates);
      std::uint32_t *entry = found.entries.data() + first;
      std::size_t length = 0;
      for(const Window &window : around)
        for(std::size_t j = window.begin; j < window.end; ++j)
        {
          double squared = 0;
          for(int d = 0; d < dimension; ++d)
          {
            const double apart = cells.coordinate[d][i] - cells.coordinate[d][j];
            squared += apart * apart;
          }
          entry[length] = cells.placed[j].particle;
          length += (squared < squared_radius) & (i != j);
        }
      found.entries.resize(first + length);
      const std::uint32_t particle = cells.placed[i].particle;
      found.first[particle] = first;
      found.length[particle] = static_cast<std::uint32_t>(length);
    }
  } // namespace

  FoundRows find_in_cells(int dimension,
                          const std::array<std::vector<double>, 3> &position,
                          std::size_t n, double radius)
  {
    const SparseCells cells(dimension, position, n, radius);
    std::vector<Window> around = windows(dimension);
    FoundRows found{std::vector<std::size_t>(n), std::vector<std::uint32_t>(n), {}};
    found.entries.reserve((dimension == 3 ? 24 : 8) * n + 1000);
    for(std::size_t i = 0; i < n; ++i)
    {
      if(i == 0 || cells.placed[i].cell != cells.placed[i - 1].cell)
        for(Window &window : around)
          window.move_to(cells.placed, cells.placed[i].cell);
      if(dimension == 2)
        find_row<2>(cells, around, i, radius * radius, found);
      else
        find_row<3>(cells, around, i, radius * radius, found);
    }
    return found;
  }

  FoundRows find_among_all(int dimension,
                           const std::array<std::vector<double>, 3> &position,
                           std::size_t n, double radius)
  {
    FoundRows found{std::vector<std::size_t>(n), std::vector<std::uint32_t>(n),
                    std::vector<std::uint32_t>(n * n)};
    std::size_t end = 0;
    for(std::size_t a = 0; a < n; ++a)
    {
      found.first[a] = end;
      for(std::size_t b = 0; b < n; ++b)
      {
        double squared = 0;
        for(int d = 0; d < dimension; ++d)
        {
          const double difference = position[d][a] - position[d][b];
          squared += difference * difference;
        }
        found.entries[end] = static_cast<std::uint32_t>(b);
        end += (squared < radius * radius) & (a != b);
      }
      found.length[a] = static_cast<std::uint32_t>(end - found.first[a]);
    }
    found.entries.resize(end);
    return found;
  }
} // namespace meltfront::particles::greenspan
