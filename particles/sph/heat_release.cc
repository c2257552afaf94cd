#include <cases/compensated_sum.h>
#include <particles/sph/heat_release.h>

#include <algorithm>

namespace meltfront::particles
{
  HeatRelease::HeatRelease(const Discretisation &dis)
    : dis(dis)
    , density(*dis.scene.heat_release)
    , power(dis.particles.size())
    , released{{dis.scene.start_time, 0.}}
  {
  }

  void HeatRelease::prepare_step(double begin, double end)
  {
    meter.measure_setup(
        [&]
        {
          for(std::size_t a = 0; a < power.size(); ++a)
            power[a] = density(dis.particles.point(a), begin, end) * dis.particle_volume;
          for(const WallCell &cell : dis.wall_cells)
            power[cell.particle] *= cell.share;
          cases::CompensatedSum sum;
          for(const double heat : power)
            sum.add(heat);
          while(released.size() > 1 && released.back().time > begin)
            released.pop_back();
          released.push_back({end, released.back().heat + (end - begin) * sum.value()});
        });
  }

  void HeatRelease::add(std::span<double> flow, double flow_scale)
  {
    meter.measure(
        [&]
        {
          for(std::size_t a = 0; a < power.size(); ++a)
            flow[a] += power[a] / flow_scale;
        });
  }

  double HeatRelease::heat(double time) const
  {
    const auto found = std::ranges::find_if(released, [time](const Released &entry)
                                            { return entry.time >= time; });
    return (found == released.end() ? released.back() : *found).heat;
  }

  cases::EffectCost HeatRelease::cost() const
  {
    return meter.cost(cases::Effect::heat_release,
                      power.size() * sizeof(double) + released.size() * sizeof(Released));
  }
} // namespace meltfront::particles
