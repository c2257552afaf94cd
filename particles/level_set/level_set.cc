#include <cases/error.h>
#include <particles/level_set/level_set.h>

#include <fmt/format.h>

namespace meltfront::particles::level_set
{
  namespace
  {
    constexpr double most_motion = 2; ///< in spacings, of the front in a band at rest
  }                                   // namespace

  LevelSet::LevelSet(const Grid &grid, const ScalarFunction &initial,
                     const LevelSetParameters &parameters)
    : lattice(grid)
    , settings(parameters)
    , phi(grid.size(), 0.)
    , states(grid.size(), 0)
  {
    if(settings.band_layers < 0 || (settings.band_layers > 0 && settings.band_layers < 4))
      throw cases::InputError(fmt::format(
          "a level set's band has {} layers: 0 for the whole grid or at least "
          "4 are possible",
          settings.band_layers));
    if(settings.threads < 1)
      throw cases::InputError(fmt::format(
          "a level set on {} threads: at least 1 is needed", settings.threads));
    const Band all(lattice, whole_grid(lattice));
    for(const NodeRun &run : all.runs())
      for(int n = 0; n < run.length; ++n)
      {
        const Position point
            = lattice.position({run.index[0] + n, run.index[1], run.index[2]});
        const double value = initial(point);
        if(!std::isfinite(value))
          throw cases::InputError(fmt::format(
              "the level set at the start is {} at ({:.6g}, {:.6g}, {:.6g}): it must be "
              "a number",
              value, point[0], point[1], point[2]));
        phi[run.node + n] = value;
        states[run.node + n] = node_state::known;
      }
    computed = extended = all;
    lay_band(nodes_at_front(all));
  }

  cases::PointArrays LevelSet::band_positions() const
  {
    return {positions[0], positions[1], positions[2]};
  }

  double LevelSet::far_value() const
  {
    return (settings.band_layers + Grid::ghost_layers) * std::sqrt(lattice.dimension())
           * lattice.spacing();
  }

  void LevelSet::fill_ghosts(const double level_beyond)
  {
    for(const GhostLine &line : ghost_lines)
    {
      double *border = &phi[line.node];
      double slope = border[0] - border[-line.outwards];
      if(std::abs(border[0]) > level_beyond && slope * border[0] < 0)
        slope = 0;
      for(int layer = 1; layer <= Grid::ghost_layers; ++layer)
        border[layer * line.outwards] = border[0] + layer * slope;
    }
  }

  void LevelSet::follow(const double spacings)
  {
    moved += spacings;
    if(moved + spacings > settings.band_layers / 3.)
      rebuild_band();
  }

  void LevelSet::rebuild_band()
  {
    moved = 0;
    if(settings.band_layers == 0)
      return fill_ghosts();
    lay_band(nodes_at_front(computed));
  }

  std::vector<Interval> LevelSet::nodes_at_front(const Band &searched) const
  {
    std::vector<Interval> front;
    for(const NodeRun &run : searched.runs())
      for(int n = 0; n < run.length; ++n)
      {
        const std::size_t node = run.node + n;
        std::array<int, 3> index = run.index;
        index[0] += n;
        bool cut = false;
        for(int d = 0; d < lattice.dimension(); ++d)
        {
          const std::ptrdiff_t step = lattice.stride(d);
          cut |= index[d] > 0 && (phi[node - step] > 0) != (phi[node] > 0);
          cut |= index[d] < lattice.nodes(d) - 1
                 && (phi[node + step] > 0) != (phi[node] > 0);
        }
        if(!cut)
          continue;
        if(!front.empty() && front.back().k == index[2] && front.back().j == index[1]
           && front.back().end == index[0])
          ++front.back().end;
        else
          front.push_back({index[2], index[1], index[0], index[0] + 1});
      }
    return front;
  }

  void LevelSet::lay_band(std::vector<Interval> front)
  {
    const Band old = std::move(extended);
    if(settings.band_layers == 0)
      computed = extended = Band(lattice, whole_grid(lattice));
    else
    {
      std::vector<Interval> near
          = dilated(lattice, std::move(front), settings.band_layers);
      extended = Band(lattice, dilated(lattice, near, Grid::ghost_layers));
      computed = Band(lattice, std::move(near));
    }
    for(const NodeRun &run : extended.runs())
      for(int n = 0; n < run.length; ++n)
        states[run.node + n] |= node_state::wanted;
    marching.fill(lattice, phi, states, extended);
    drop(old);
    for(const NodeRun &run : computed.runs())
      std::fill_n(&states[run.node], run.length, node_state::known);
    find_ghost_lines();
    find_positions();
    fill_ghosts();
  }

  void LevelSet::drop(const Band &old)
  {
    for(const NodeRun &run : old.runs())
      for(std::size_t node = run.node; node < run.node + run.length; ++node)
      {
        if(!(states[node] & node_state::wanted))
          phi[node] = phi[node] > 0 ? far_value() : -far_value();
        states[node] = 0;
      }
    for(const NodeRun &run : extended.runs())
      std::fill_n(&states[run.node], run.length, std::uint8_t(0));
  }

  void LevelSet::find_ghost_lines()
  {
    ghost_lines.clear();
    for(const NodeRun &run : extended.runs())
      for(int d = 0; d < lattice.dimension(); ++d)
      {
        const std::ptrdiff_t step = lattice.stride(d);
        const int last = lattice.nodes(d) - 1, index = run.index[d];
        if(d == 0)
        {
          if(index < Grid::ghost_layers)
            ghost_lines.push_back({run.node - index, -1});
          if(index + run.length > last - Grid::ghost_layers)
            ghost_lines.push_back({run.node + (last - index), 1});
          continue;
        }
        for(int n = 0; n < run.length; ++n)
        {
          if(index < Grid::ghost_layers)
            ghost_lines.push_back({run.node + n - index * step, -step});
          if(index > last - Grid::ghost_layers)
            ghost_lines.push_back({run.node + n + (last - index) * step, step});
        }
      }
    std::ranges::sort(ghost_lines);
    const auto doubled = std::ranges::unique(ghost_lines);
    ghost_lines.erase(doubled.begin(), doubled.end());
  }

  void LevelSet::find_positions()
  {
    for(int d = 0; d < lattice.dimension(); ++d)
      positions[d].resize(computed.size());
    for(const NodeRun &run : computed.runs())
      for(int n = 0; n < run.length; ++n)
      {
        positions[0][run.first + n] = lattice.coordinate(0, run.index[0] + n);
        for(int d = 1; d < lattice.dimension(); ++d)
          positions[d][run.first + n] = lattice.coordinate(d, run.index[d]);
      }
  }

  std::vector<double> LevelSet::distances_everywhere() const
  {
    std::vector<double> result = phi;
    std::vector<std::uint8_t> reached(lattice.size(), 0);
    const Band all(lattice, whole_grid(lattice));
    for(const NodeRun &run : all.runs())
      for(std::size_t node = run.node; node < run.node + run.length; ++node)
        reached[node] = states[node] | node_state::wanted;
    FastMarching().fill(lattice, result, reached, all);
    return result;
  }
} // namespace meltfront::particles::level_set
