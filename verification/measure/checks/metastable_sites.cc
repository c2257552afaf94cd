#include <verification/measure/checks/metastable_sites.h>
#include <verification/measure/formulas/site_grid.h>

#include <algorithm>

namespace meltfront::verification
{
  namespace
  {
    /** Two, and round-off. */
    constexpr double spacings_to_front = 2.001;

    double distance_between(const cases::Position &a, const cases::Position &b)
    {
      return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    }

    /** Tells which places lie beside a front. */
    class FrontVicinity
    {
    public:
      FrontVicinity(const cases::Snapshot &snapshot, double reach)
        : snapshot(snapshot)
        , points(points_of(snapshot))
        , reach(reach)
        , grid(snapshot, reach)
        , point_grid(points, reach)
      {
      }

      bool holds(std::size_t site) const
      {
        const cases::Position place = site_position(snapshot, site);
        const double phase = snapshot.solid_fraction[site];
        bool found = false;
        point_grid.visit(
            place, [&](std::uint32_t point)
            { found |= distance_between(site_position(points, point), place) <= reach; });
        if(!found)
          grid.visit(place,
                     [&](std::uint32_t other)
                     {
                       found |= snapshot.solid_fraction[other] != phase
                                && distance_between(site_position(snapshot, other), place)
                                       <= reach;
                     });
        return found;
      }

    private:
      /** The front's points in the place of sites. */
      static cases::Snapshot points_of(const cases::Snapshot &snapshot)
      {
        cases::Snapshot result;
        result.dimension = snapshot.dimension;
        result.positions = snapshot.front;
        result.temperature = snapshot.front[0]; // as many as there are sites
        return result;
      }

      const cases::Snapshot &snapshot;
      cases::Snapshot points;
      double reach;
      SiteGrid grid, point_grid;
    };
  } // namespace

  MetastableFinder::MetastableFinder(const cases::Scene &scene, double spacing)
    : melting_temperature(scene.material.melting_temperature)
    , eutectic_temperature(scene.alloy ? scene.alloy->eutectic_temperature
                                       : melting_temperature)
    , range(scene.material.melting_range)
    , at_start(cases::metastable_start(scene))
    , reach(spacings_to_front * spacing)
  {
    if(scene.alloy)
      diagram.emplace(scene.material, *scene.alloy);
  }

  double MetastableFinder::beyond(const cases::Snapshot &snapshot, std::size_t site,
                                  double tolerance) const
  {
    const double fraction = snapshot.solid_fraction[site];
    const double temperature = snapshot.temperature[site];
    if(range && fraction > 0 && fraction < 1)
      return std::max(range->solidus - temperature, temperature - range->liquidus);
    if((fraction > 0 && fraction < 1)
       || (fraction >= 1 ? at_start.superheat : at_start.undercooling) > 0)
      return 0;
    double melting = range && fraction <= 0 ? range->liquidus : melting_temperature;
    if(diagram)
    {
      const auto content = [&](std::size_t s) {
        return snapshot.concentration[s].empty() ? 0. : snapshot.concentration[s][site];
      };
      melting = std::max(eutectic_temperature, diagram->liquidus(content(0), content(1)));
      // Crystals are pure: what is solid and holds solute froze at the eutectic.
      if(fraction >= 1 && melting < melting_temperature - tolerance)
        melting = eutectic_temperature;
    }
    return fraction >= 1 ? temperature - melting : melting - temperature;
  }

  MetastableSites MetastableFinder::find(const cases::Snapshot &snapshot,
                                         double tolerance) const
  {
    MetastableSites result;
    std::optional<FrontVicinity> vicinity;
    double volume = 0, metastable = 0;
    for(std::size_t i = 0; i < snapshot.temperature.size(); ++i)
    {
      volume += snapshot.weights[i];
      const double excess = snapshot.weights[i] > 0 ? beyond(snapshot, i, tolerance) : 0;
      if(!(excess > tolerance))
        continue;
      if(!vicinity)
        vicinity.emplace(snapshot, reach);
      if(vicinity->holds(i))
        continue;
      metastable += snapshot.weights[i];
      if(excess > result.beyond)
      {
        result.site = i;
        result.beyond = excess;
        result.solid = snapshot.solid_fraction[i] >= 1;
      }
    }
    result.share = volume > 0 ? metastable / volume : 0;
    return result;
  }
} // namespace meltfront::verification
