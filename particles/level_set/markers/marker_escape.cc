#include <cases/numbers.h>
#include <particles/level_set/markers/marker_escape.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::level_set
{
  namespace
  {
    using cases::infinity;

    double length(const Position &a)
    {
      return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    }
  } // namespace

  EscapeCorrection::EscapeCorrection(const Grid &grid, const EscapeParameters &parameters,
                                     const int threads)
    : grid(grid)
    , parameters(parameters)
    , threads(threads)
    , touched(grid.size(), 0)
  {
    for(std::vector<double> &values : said)
      values.resize(grid.size());
    if(parameters.rule == EscapeRule::normals)
      for(std::vector<double> &values : offset)
        values.resize(grid.size());
  }

  std::size_t EscapeCorrection::correct(const Markers &markers,
                                        const std::span<double> phi)
  {
    find_escaped(markers, phi);
    nodes.clear();
    if(parameters.rule == EscapeRule::spheres)
      for(const std::uint32_t p : escaped)
        add_spheres(markers, p, phi);
    else
      for(const std::uint32_t p : escaped)
        add_normals(markers, p, phi);
    merge(phi);
    return escaped.size();
  }

  void EscapeCorrection::find_escaped(const Markers &markers,
                                      const std::span<const double> phi)
  {
    find_depths(markers, phi);
    escaped.clear();
    for(std::size_t p = 0; p < markers.size(); ++p)
      if(depth[p] < -std::abs(markers.distance[p]))
        escaped.push_back(static_cast<std::uint32_t>(p));
  }

  void EscapeCorrection::find_depths(const Markers &markers,
                                     const std::span<const double> phi)
  {
    depth.resize(markers.size());
    const Grid lattice = grid; // a copy that no store can change
    const bool solid = lattice.dimension() == 3;
    const double *x = markers.position[0].data(), *y = markers.position[1].data(),
                 *z = markers.position[2].data(), *radius = markers.distance.data();
    double *result = depth.data();
#pragma omp parallel for schedule(static) num_threads(threads)
    for(std::size_t p = 0; p < markers.size(); ++p)
    {
      const Position at{x[p], y[p], solid ? z[p] : 0};
      result[p] = std::copysign(1., radius[p])
                  * interpolate(lattice, phi.data(), lattice.locate(at));
    }
  }

  bool EscapeCorrection::first_touch(const std::size_t node)
  {
    if(touched[node])
      return false;
    touched[node] = 1;
    nodes.push_back(static_cast<std::uint32_t>(node));
    return true;
  }

  void EscapeCorrection::add_spheres(const Markers &markers, const std::size_t marker,
                                     const std::span<const double> phi)
  {
    const Position at = markers.point(marker);
    const std::size_t cell = grid.locate(at).node;
    const double radius = markers.distance[marker];
    for(int corner = 0; corner < 1 << grid.dimension(); ++corner)
    {
      const std::size_t node = corner_node(grid, cell, corner);
      if(first_touch(node))
        said[0][node] = said[1][node] = phi[node];
      const Position there = grid.position(node);
      const double away = length({there[0] - at[0], there[1] - at[1], there[2] - at[2]});
      if(radius > 0)
        said[1][node] = std::max(said[1][node], radius - away);
      else
        said[0][node] = std::min(said[0][node], radius + away);
    }
  }

  void EscapeCorrection::add_normals(const Markers &markers, const std::size_t marker,
                                     const std::span<const double> phi)
  {
    const Position at = markers.point(marker);
    const CellPlace place = grid.locate(at);
    const std::array<int, 3> low = grid.indices(place.node);
    const Position slope = interpolate_gradient(grid, phi.data(), place);
    const double radius = markers.distance[marker], side = std::copysign(1., radius);
    const double scale = side / length(slope);
    if(!std::isfinite(scale))
      return;
    const bool solid = grid.dimension() == 3;
    for(int k = solid ? -1 : 0; k <= (solid ? 2 : 0); ++k)
      for(int j = -1; j <= 2; ++j)
        for(int i = -1; i <= 2; ++i)
        {
          const std::array<int, 3> index{low[0] + i, low[1] + j, low[2] + k};
          const Position there = grid.position(index);
          const Position way{there[0] - at[0], there[1] - at[1], there[2] - at[2]};
          const double away = length(way);
          const double along
              = scale * (way[0] * slope[0] + way[1] * slope[1] + way[2] * slope[2]);
          if(std::abs(along) < parameters.alignment * away)
            continue;
          add_by_offset(grid.node(index), radius > 0,
                        radius + side * std::copysign(away, along),
                        std::sqrt(std::max(0., away * away - along * along)));
        }
  }

  void EscapeCorrection::add_by_offset(const std::size_t node, const bool positive,
                                       const double value, const double aside)
  {
    if(first_touch(node))
      for(const int sign : {0, 1})
        said[sign][node] = offset[sign][node] = infinity;
    if(aside < offset[positive][node])
    {
      offset[positive][node] = aside;
      said[positive][node] = value;
    }
  }

  void EscapeCorrection::merge(const std::span<double> phi)
  {
    const bool with_grid = parameters.rule == EscapeRule::normals
                           && parameters.merge == EscapeMerge::smaller_magnitude;
    const double furthest = parameters.band * grid.spacing();
    for(const std::size_t node : nodes)
    {
      touched[node] = 0;
      if(!(std::abs(phi[node]) <= furthest))
        continue;
      const double negative = said[0][node], positive = said[1][node];
      const double nearer
          = std::abs(positive) <= std::abs(negative) ? positive : negative;
      phi[node]
          = with_grid && std::abs(phi[node]) <= std::abs(nearer) ? phi[node] : nearer;
    }
  }

  void EscapeCorrection::reset_radii(Markers &markers, const std::span<const double> phi)
  {
    find_depths(markers, phi);
    const double least = 0.1 * grid.spacing(), most = 0.5 * grid.spacing();
    for(std::size_t p = 0; p < markers.size(); ++p)
    {
      double &radius = markers.distance[p];
      if(depth[p] >= -std::abs(radius))
        radius = std::copysign(std::clamp(depth[p], least, most), radius);
    }
  }
} // namespace meltfront::particles::level_set
