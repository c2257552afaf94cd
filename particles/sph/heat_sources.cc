#include <cases/error.h>
#include <particles/sph/heat_sources.h>

#include <fmt/format.h>

#include <cmath>

namespace meltfront::particles
{
  HeatSources::HeatSources(const Discretisation &dis)
    : scale(dis.cross_section)
    , sources(dis.scene.sources)
    , start_time(dis.scene.start_time)
    , power(sources.size(), 0.)
  {
    // A slab's source is a plane: only the distance from this plane counts.
    const bool plane = dis.scene.domain.shape == cases::DomainShape::slab;
    for(std::size_t s = 0; s < sources.size(); ++s)
    {
      if(sources[s].path)
        continue; // see MovingSources
      const std::size_t first = weights.size();
      double sum = 0;
      for(std::size_t a = 0; a < dis.particles.size(); ++a)
      {
        double squared = 0;
        for(int d = 0; d < (plane ? 1 : dis.dimension); ++d)
        {
          const double difference = dis.periodicity.shortest(
              d, dis.particles.position[d][a] - sources[s].position[d]);
          squared += difference * difference;
        }
        const double weight = dis.kernel.value(std::sqrt(squared));
        if(weight > 0)
        {
          weights.push_back(
              {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(s), weight});
          sum += weight;
        }
      }
      if(dis.own.largest(sum) == 0)
        throw cases::Refusal(fmt::format(
            "no particle lies within the kernel's support of source {}", s + 1));
      for(std::size_t i = first; i < weights.size(); ++i)
        weights[i].weight /= sum;
    }
  }

  void HeatSources::prepare_step(double begin, double end)
  {
    for(std::size_t s = 0; s < sources.size(); ++s)
      power[s]
          = scale * (sources[s].energy(end) - sources[s].energy(begin)) / (end - begin);
  }

  void HeatSources::add(std::span<double> flow, double flow_scale)
  {
    meter.measure(
        [&]
        {
          for(const Weight &source : weights)
            flow[source.row] += source.weight * power[source.source] / flow_scale;
        });
  }

  double HeatSources::heat(double time) const
  {
    double sum = 0;
    for(const cases::PointSource &source : sources)
      sum += scale * (source.energy(time) - source.energy(start_time));
    return sum;
  }

  cases::EffectCost HeatSources::cost() const
  {
    return meter.cost(cases::Effect::heat_sources,
                      weights.size() * sizeof(Weight) + power.size() * sizeof(double));
  }
} // namespace meltfront::particles
