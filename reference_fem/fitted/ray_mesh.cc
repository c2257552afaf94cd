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
                   const std::vector<double> &inner_shares,
                   const std::vector<double> &outer_shares)
    : surface(std::move(rays))
    , inner(inner)
    , outer(outer)
    , front_layer(static_cast<unsigned int>(inner_shares.size()) - 1)
  {
    for(std::size_t l = 0; l + 1 < inner_shares.size(); ++l)
    {
      const double from = inner_shares[l], to = inner_shares[l + 1];
      layers.push_back({0, {inner * (1 - from), inner * (1 - to)}, {from, to}});
    }
    for(std::size_t l = 0; l + 1 < outer_shares.size(); ++l)
    {
      const double from = outer_shares[l], to = outer_shares[l + 1];
      layers.push_back({1, {outer * from, outer * to}, {1 - from, 1 - to}});
    }
  }

  RayMesh::RayMesh(FrontSurface rays, double inner, double outer,
                   const std::vector<double> &shares)
    : surface(std::move(rays))
    , inner(inner)
    , outer(outer)
  {
    for(std::size_t l = 0; l + 1 < shares.size(); ++l)
      layers.push_back(
          {0,
           {inner + (outer - inner) * shares[l], inner + (outer - inner) * shares[l + 1]},
           {0, 0}});
  }

  std::array<double, 2> RayMesh::place(unsigned int level) const
  {
    const unsigned int degree = surface.degree;
    const unsigned int layer = std::min<unsigned int>(
        level / degree, static_cast<unsigned int>(layers.size()) - 1);
    const double zeta = node_shares(surface.degree)[level - layer * degree];
    return {layers[layer].a(zeta), layers[layer].c(zeta)};
  }

  cases::Position RayMesh::position(unsigned int ray, double r) const
  {
    cases::Position result{};
    for(int d = 0; d < 3; ++d)
      result[d] = surface.base[ray][d] + r * surface.direction[ray][d];
    return result;
  }
} // namespace meltfront::reference_fem::fitted
