#include <cases/means_of_jumps.h>
#include <particles/sph/volumetric_source.h>

#include <algorithm>

namespace meltfront::particles
{
  VolumetricSource::VolumetricSource(const Discretisation &dis)
    : dis(dis)
    , density(cases::mean_release(dis.scene, dis.spacing))
    , power(dis.particles.size())
    , released{{dis.scene.start_time, 0.}}
  {
  }

  void VolumetricSource::find_power(double begin, double end)
  {
    for(std::size_t a = 0; a < power.size(); ++a)
      power[a] = density(dis.particles.point(a), begin, end) * dis.particle_volume;
    for(const WallCell &cell : dis.wall_cells)
      power[cell.particle] *= cell.share;
    power_known = true;
  }

  void VolumetricSource::prepare_step(double begin, double end)
  {
    meter.measure_setup(
        [&]
        {
          if(!density.steady() || !power_known)
            find_power(begin, end);
          ExactSum own;
          for(const double heat : dis.own.part(std::span<const double>(power)))
            own.add(heat);
          const double sum = dis.own.total(own);
          while(released.size() > 1 && released.back().time > begin)
            released.pop_back();
          released.push_back({end, released.back().heat + (end - begin) * sum});
        });
  }

  void VolumetricSource::add(std::span<double> flow, double flow_scale)
  {
    meter.measure(
        [&]
        {
          for(std::size_t a = 0; a < power.size(); ++a)
            flow[a] += power[a] / flow_scale;
        });
  }

  double VolumetricSource::heat(double time) const
  {
    const auto found = std::ranges::find_if(released, [time](const Released &entry)
                                            { return entry.time >= time; });
    return (found == released.end() ? released.back() : *found).heat;
  }

  cases::EffectCost VolumetricSource::cost() const
  {
    return meter.cost(cases::Effect::volumetric_source,
                      power.size() * sizeof(double) + released.size() * sizeof(Released));
  }
} // namespace meltfront::particles
