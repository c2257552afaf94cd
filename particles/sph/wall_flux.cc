#include <particles/sph/wall_flux.h>

namespace meltfront::particles
{
  WallFlux::WallFlux(const Discretisation &discretisation, const ConductionRows &rows)
    : own(discretisation.own)
    , links(rows.flux_links)
    , values(discretisation.scene, rows.flux_points, links)
  {
  }

  void WallFlux::prepare_step(double begin, double end)
  {
    meter.measure_setup([&] { values.average_step(begin, end); });
  }

  double WallFlux::add(double fraction, std::span<double> flow, double flow_scale)
  {
    return meter.measure(
        [&]
        {
          ExactSum sum;
          for(const WallLink &link : links)
          {
            const double heat
                = link.strength * values.at(link.point, fraction) / flow_scale;
            flow[link.row] += heat;
            sum.add(heat);
          }
          return own.total(sum);
        });
  }

  cases::EffectCost WallFlux::cost() const
  {
    return meter.cost(cases::Effect::wall_flux,
                      links.size() * sizeof(WallLink) + values.bytes());
  }
} // namespace meltfront::particles
