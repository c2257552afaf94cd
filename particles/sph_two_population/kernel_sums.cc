#include <particles/sph/bent_walls.h>
#include <particles/sph_two_population/kernel_sums.h>

#include <cmath>

namespace meltfront::particles
{
  KernelSums::KernelSums(const Discretisation &dis)
    : own(dis.kernel.value(0))
  {
    const NeighboursInSight in_sight(
        dis,
        NeighbourList(dis.particles, dis.kernel.support() * (1 - 1e-9), dis.periodicity));
    const NeighbourList &neighbours = in_sight.seen;
    std::vector<double> weights;
    weights.reserve(neighbours.size());
    for(std::size_t a = 0; a < neighbours.rows(); ++a)
      for(const std::uint32_t b : neighbours[a])
      {
        double squared = 0;
        for(int d = 0; d < dis.dimension; ++d)
        {
          const double difference = dis.periodicity.shortest(
              d, dis.particles.position[d][a] - dis.particles.position[d][b]);
          squared += difference * difference;
        }
        weights.push_back(dis.kernel.value(std::sqrt(squared)));
      }
    rows = ParticleOperator(neighbours, weights);
  }

  void KernelSums::sum(std::span<const double> value, std::span<double> result) const
  {
    rows.apply_pairs([v = value.data()](std::size_t, std::size_t b) { return v[b]; },
                     result, 1);
    for(std::size_t a = 0; a < rows.rows(); ++a)
      result[a] += own * value[a];
  }
} // namespace meltfront::particles
