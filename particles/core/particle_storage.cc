#include <particles/core/particle_storage.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meltfront::particles
{
  namespace
  {
    /** Put the lowest 21 bits of a coordinate two bits apart. */
    std::uint64_t spread(std::uint64_t bits)
    {
      bits &= 0x1fffff;
      bits = (bits | bits << 32) & 0x1f00000000ffff;
      bits = (bits | bits << 16) & 0x1f0000ff0000ff;
      bits = (bits | bits << 8) & 0x100f00f00f00f00f;
      bits = (bits | bits << 4) & 0x10c30c30c30c30c3;
      return (bits | bits << 2) & 0x1249249249249249;
    }
  } // namespace

  void ParticleStorage::add(const std::array<double, 3> &point)
  {
    for(int d = 0; d < dimension; ++d)
      position[d].push_back(point[d]);
  }

  std::array<double, 3> ParticleStorage::point(std::size_t particle) const
  {
    std::array<double, 3> result{};
    for(int d = 0; d < dimension; ++d)
      result[d] = position[d][particle];
    return result;
  }

  std::vector<std::uint32_t> order_along_curve(const ParticleStorage &particles,
                                               double cube_side)
  {
    std::vector<std::uint64_t> key(particles.size(), 0);
    for(int d = 0; d < particles.dimension; ++d)
    {
      const auto &x = particles.position[d];
      const double lowest = x.empty() ? 0 : *std::min_element(x.begin(), x.end());
      for(std::size_t i = 0; i < x.size(); ++i)
        key[i] |= spread(static_cast<std::uint64_t>((x[i] - lowest) / cube_side)) << d;
    }
    std::vector<std::uint32_t> order(particles.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&key](std::uint32_t a, std::uint32_t b)
                     { return key[a] < key[b]; });
    return order;
  }

  void reorder(ParticleStorage &particles, std::span<const std::uint32_t> order)
  {
    for(int d = 0; d < particles.dimension; ++d)
    {
      std::vector<double> sorted(order.size());
      for(std::size_t i = 0; i < order.size(); ++i)
        sorted[i] = particles.position[d][order[i]];
      particles.position[d] = std::move(sorted);
    }
  }
} // namespace meltfront::particles
