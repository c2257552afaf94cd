#include <cases/error.h>
#include <particles/sph/moving_sources.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles
{
  namespace
  {
    /** Longest part of a path that stands for one place, in spacings. */
    constexpr double longest_part = 0.25;

    /** Places by which the length of a path in a step is measured. */
    constexpr int samples_of_path = 16;

    constexpr double most_parts = 4096;
  } // namespace

  MovingSources::MovingSources(const Discretisation &dis)
    : dis(dis)
    , plane(dis.scene.domain.shape == cases::DomainShape::slab)
    , sites(dis.particles)
  {
    if(plane)
      sites.dimension = 1;
  }

  /** Times between which a path is so short that it counts as a place. */
  std::vector<double> MovingSources::parts_of(const cases::Path &path, double begin,
                                              double end) const
  {
    const auto at
        = [&](int part, int parts) { return begin + (end - begin) * part / parts; };
    double length = 0;
    cases::Position last = path.position(begin);
    for(int i = 1; i <= samples_of_path; ++i)
    {
      const cases::Position next = path.position(at(i, samples_of_path));
      length += std::hypot(next[0] - last[0], next[1] - last[1], next[2] - last[2]);
      last = next;
    }
    const int parts = static_cast<int>(
        std::clamp(std::ceil(length / (longest_part * dis.spacing)), 1., most_parts));
    std::vector<double> times;
    for(int i = 0; i < parts; ++i)
      times.push_back(at(i, parts));
    times.push_back(end);
    return times;
  }

  void MovingSources::spread(const cases::PointSource &source, double begin, double end)
  {
    const std::vector<double> times = parts_of(*source.path, begin, end);
    ParticleStorage places{sites.dimension, {}};
    for(std::size_t i = 0; i + 1 < times.size(); ++i)
      places.add(source.at(0.5 * (times[i] + times[i + 1])));
    const NeighbourList near(places, sites, dis.kernel.support(), dis.periodicity);
    for(std::size_t i = 0; i + 1 < times.size(); ++i)
    {
      const std::size_t first = shares.size();
      double sum = 0;
      for(const std::uint32_t row : near[i])
      {
        double squared = 0;
        for(int d = 0; d < sites.dimension; ++d)
          squared += std::pow(
              dis.periodicity.shortest(d, sites.position[d][row] - places.position[d][i]),
              2);
        shares.push_back({row, dis.kernel.value(std::sqrt(squared))});
        sum += shares.back().power;
      }
      if(!(sum > 0))
        throw cases::Refusal(fmt::format(
            "no particle lies within the kernel's support of a source that moves, at "
            "t = {:.6g} s",
            times[i]));
      const double energy = source.energy(times[i + 1]) - source.energy(times[i]);
      for(std::size_t s = first; s < shares.size(); ++s)
        shares[s].power *= dis.cross_section * energy / (sum * (end - begin));
    }
  }

  void MovingSources::prepare_step(double begin, double end)
  {
    meter.measure_setup(
        [&]
        {
          shares.clear();
          for(const cases::PointSource &source : dis.scene.sources)
            if(source.path)
              spread(source, begin, end);
        });
  }

  void MovingSources::add(std::span<double> flow, double flow_scale)
  {
    meter.measure(
        [&]
        {
          for(const Share &share : shares)
            flow[share.row] += share.power / flow_scale;
        });
  }

  cases::EffectCost MovingSources::cost() const
  {
    return meter.cost(cases::Effect::moving_source,
                      shares.capacity() * sizeof(Share)
                          + sites.size() * sites.dimension * sizeof(double));
  }
} // namespace meltfront::particles
