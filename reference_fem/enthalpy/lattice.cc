#include <reference_fem/enthalpy/lattice.h>

#include <algorithm>

namespace meltfront::reference_fem
{
  LatticeLine::LatticeLine(std::vector<double> position_of_nodes, double period)
    : position(std::move(position_of_nodes))
    , period(period)
    , coarse(nodes() <= 3 ? 1 : nodes() / 2 + 1)
    , places(position.size() + 2)
  {
    if(coarse == 1)
      return;
    if(period > 0)
      coarse = (nodes() + 1) / 2;
    const int n = nodes();
    const auto at = [&](int i)
    {
      return i < 0   ? position[i + n] - period
             : i < n ? position[i]
                     : position[i - n] + period;
    };
    for(int i = -1; i <= n; ++i)
    {
      Place &place = places[static_cast<std::size_t>(i + 1)];
      if(i < 0)
      {
        // Before the first node comes the last, which is a coarse one if its number is
        // even.
        place = {-1, n % 2 == 0 ? 0.5 : 0.};
        if(n % 2 == 0)
          place.share = (at(-1) - at(-2)) / (at(0) - at(-2));
      }
      else if(i >= n)
        place = {coarse, 0};
      else if(i % 2 == 0)
        place = {i / 2, 0};
      else if(i + 1 == n && period == 0)
        place = {coarse - 1, 0};
      else
        place = {i / 2, (at(i) - at(i - 1)) / (at(i + 1) - at(i - 1))};
    }
  }

  LatticeLine LatticeLine::coarser() const
  {
    std::vector<double> kept;
    if(coarse == 1)
      kept.push_back(position.front());
    else
      for(int i = 0; i < nodes(); ++i)
        if(i % 2 == 0 || (i + 1 == nodes() && period == 0))
          kept.push_back(position[static_cast<std::size_t>(i)]);
    return {std::move(kept), period};
  }

  /** Visit the coarse rows between which a row lies, with its shares of them. */
  template <typename Visit>
  void LatticeLevel::for_coarse_rows(int y, int z, const Visit &visit) const
  {
    const LatticeLine::Place &in_y = line[1].place(y), &in_z = line[2].place(z);
    for(int dz = 0; dz < 2; ++dz)
      for(int dy = 0; dy < 2; ++dy)
      {
        const double weight
            = (dz ? in_z.share : 1 - in_z.share) * (dy ? in_y.share : 1 - in_y.share);
        if(weight == 0)
          continue;
        const std::size_t row = line[1].wrapped_coarse(in_y.lower + dy)
                                + std::size_t(line[1].coarse_nodes())
                                      * line[2].wrapped_coarse(in_z.lower + dz);
        visit(row * line[0].coarse_nodes(), weight);
      }
  }

  void LatticeLevel::add_interpolated(const std::vector<double> &on_coarse,
                                      const char *mask, std::vector<double> &fine) const
  {
    const LatticeLine &x = line[0];
    const auto nx = static_cast<std::size_t>(x.nodes());
    const auto coarse = static_cast<std::size_t>(x.coarse_nodes());
    std::vector<double> mixed(coarse + 1); // the first again at the end
    std::size_t node = 0;
    for(int z = 0; z < line[2].nodes(); ++z)
      for(int y = 0; y < line[1].nodes(); ++y)
      {
        std::fill(mixed.begin(), mixed.end(), 0);
        for_coarse_rows(y, z,
                        [&](std::size_t first, double weight)
                        {
                          for(std::size_t i = 0; i < coarse; ++i)
                            mixed[i] += weight * on_coarse[first + i];
                        });
        mixed[coarse] = mixed[0];
        for(std::size_t i = 0; i < nx; ++i, ++node)
        {
          const LatticeLine::Place &place = x.place(static_cast<int>(i));
          if(!mask || mask[node])
            fine[node] += (1 - place.share) * mixed[place.lower]
                          + place.share * mixed[place.lower + 1];
        }
      }
  }

  void LatticeLevel::restrict_row(int y, int z, const double *values,
                                  std::vector<double> &mixed,
                                  std::vector<double> &on_coarse) const
  {
    const LatticeLine &x = line[0];
    const auto coarse = static_cast<std::size_t>(x.coarse_nodes());
    mixed.assign(coarse + 1, 0);
    for(int i = 0; i < x.nodes(); ++i)
    {
      const LatticeLine::Place &place = x.place(i);
      mixed[place.lower] += (1 - place.share) * values[i];
      mixed[place.lower + 1] += place.share * values[i];
    }
    mixed[0] += mixed[coarse];
    for_coarse_rows(y, z,
                    [&](std::size_t first, double weight)
                    {
                      for(std::size_t i = 0; i < coarse; ++i)
                        on_coarse[first + i] += weight * mixed[i];
                    });
  }

  void LatticeLevel::restrict_to(const std::vector<double> &fine, const char *mask,
                                 std::vector<double> &on_coarse) const
  {
    const auto nx = static_cast<std::size_t>(row_length());
    std::vector<double> row(nx), work;
    on_coarse.assign(coarse_size(), 0);
    std::size_t first = 0;
    for(int z = 0; z < line[2].nodes(); ++z)
      for(int y = 0; y < line[1].nodes(); ++y, first += nx)
      {
        for(std::size_t i = 0; i < nx; ++i)
          row[i] = !mask || mask[first + i] ? fine[first + i] : 0;
        restrict_row(y, z, row.data(), work, on_coarse);
      }
  }

  std::vector<LatticeLevel> lattice_levels(const Lattice &lattice)
  {
    constexpr std::size_t few_nodes = 32;
    const auto line = [&](int d)
    {
      // Cells are near to cubes: numbers do for positions.
      std::vector<double> position(lattice.nodes[d]);
      for(std::size_t i = 0; i < position.size(); ++i)
        position[i] = static_cast<double>(i);
      return LatticeLine(std::move(position),
                         lattice.periodic[d] ? double(lattice.nodes[d]) : 0);
    };
    std::vector<LatticeLevel> levels{{{line(0), line(1), line(2)}}};
    while(levels.back().size() > few_nodes)
      levels.push_back(levels.back().coarser());
    return levels;
  }
} // namespace meltfront::reference_fem
