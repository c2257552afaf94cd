#include <reference_fem/fitted/ray_mesh.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace meltfront::reference_fem::fitted
{
  std::vector<double> graded_shares(int cells, double ratio, bool front_first)
  {
    std::vector<double> shares{0};
    for(int c = 0; c < cells; ++c)
      shares.push_back(shares.back() + std::pow(ratio, front_first ? c : cells - 1 - c));
    const double total = shares.back();
    for(double &share : shares)
      share /= total;
    return shares;
  }

  RayMesh::RayMesh(FrontSurface rays, double inner, double outer,
                   std::vector<std::vector<double>> given)
    : surface(std::move(rays))
    , inner(inner)
    , outer(outer)
    , shares(std::move(given))
  {
    const std::size_t last = shares.size() - 1;
    for(std::size_t interval = 0; interval <= last; ++interval)
    {
      const std::vector<double> &cells = shares[interval];
      for(std::size_t l = 0; l + 1 < cells.size(); ++l)
      {
        const double from = cells[l], to = cells[l + 1];
        Layer layer{static_cast<unsigned int>(interval)};
        if(interval > 0)
          layer.carried.push_back({1 - from, 1 - to});
        if(interval < last)
          layer.carried.push_back({from, to});
        layer.fixed = last == 0       ? std::array{inner + (outer - inner) * from,
                                             inner + (outer - inner) * to}
                      : interval == 0 ? std::array{inner * (1 - from), inner * (1 - to)}
                      : interval == last ? std::array{outer * from, outer * to}
                                         : std::array{0., 0.};
        layers.push_back(layer);
      }
      if(interval < last)
        front_levels.push_back(static_cast<unsigned int>(layers.size()) * surface.degree);
    }
  }

  unsigned int RayMesh::front_at(unsigned int level) const
  {
    const auto found = std::ranges::find(front_levels, level);
    return found == front_levels.end()
               ? none
               : static_cast<unsigned int>(found - front_levels.begin());
  }

  unsigned int RayMesh::interval_of(unsigned int level) const
  {
    return static_cast<unsigned int>(std::ranges::lower_bound(front_levels, level)
                                     - front_levels.begin());
  }

  std::vector<unsigned int> RayMesh::fronts_of(unsigned int interval) const
  {
    std::vector<unsigned int> result;
    if(interval > 0)
      result.push_back(interval - 1);
    if(interval < n_fronts())
      result.push_back(interval);
    return result;
  }

  RayMesh::Place RayMesh::place(unsigned int level) const
  {
    const unsigned int degree = surface.degree;
    const unsigned int number = std::min<unsigned int>(
        level / degree, static_cast<unsigned int>(layers.size()) - 1);
    const double zeta = node_shares(degree)[level - number * degree];
    const auto between = [zeta](const std::array<double, 2> &faces)
    { return faces[0] + (faces[1] - faces[0]) * zeta; };
    const Layer &layer = layers[number];
    Place result{between(layer.fixed), {}};
    const std::vector<unsigned int> fronts = fronts_of(layer.interval);
    for(std::size_t k = 0; k < fronts.size(); ++k)
      if(const double c = between(layer.carried[k]); c != 0)
        result.carried.emplace_back(fronts[k], c);
    return result;
  }

  cases::Position RayMesh::position(unsigned int ray, double r) const
  {
    cases::Position result{};
    for(int d = 0; d < 3; ++d)
      result[d] = surface.base[ray][d] + r * surface.direction[ray][d];
    return result;
  }
} // namespace meltfront::reference_fem::fitted
