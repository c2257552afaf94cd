#include <cases/numbers.h>
#include <verification/measure/formulas/event_watch.h>
#include <verification/measure/formulas/site_grid.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace meltfront::verification
{
  using cases::TimedEvent;

  namespace
  {
    using cases::nan;

    /** A site of this solid fraction or more is frozen throughout. */
    constexpr double solid_from = 1 - 1e-12;

    /** In particle spacings: the eight neighbours on a square lattice touch. */
    constexpr double touching_distance = 1.5;

    /** Share of the volume that may still be liquid when all is frozen. */
    constexpr double no_liquid = 1e-12;

    double squared_distance(const cases::Position &a, const cases::Position &b)
    {
      double sum = 0;
      for(int d = 0; d < 3; ++d)
        sum += (a[d] - b[d]) * (a[d] - b[d]);
      return sum;
    }

    /** When a value passes a threshold between two times, which it may only seem to do.
     */
    double crossing_time(double time_before, double before, double time, double now,
                         double threshold)
    {
      if(now == before)
        return time;
      const double share = (threshold - before) / (now - before);
      return time_before + (time - time_before) * std::clamp(share, 0., 1.);
    }
  } // namespace

  ContactWatch::ContactWatch(const cases::Scene &scene, double spacing)
    : material(scene.material)
    , spacing(spacing)
    , last_time(nan)
    , contact(nan)
  {
    for(const cases::PointSource &source : scene.sources)
      if(source.energy(scene.end_time) < 0)
        sinks.push_back(source.position);
  }

  double ContactWatch::time() const
  {
    return contact;
  }

  double ContactWatch::heat_until_frozen(const cases::Snapshot &snapshot,
                                         std::size_t site) const
  {
    return material.latent_heat * (1 - snapshot.solid_fraction[site])
           + material.solid.specific_heat_capacity
                 * std::min(snapshot.temperature[site] - material.melting_temperature,
                            0.);
  }

  bool ContactWatch::moved(const cases::Snapshot &snapshot) const
  {
    if(body.size() != snapshot.temperature.size())
      return true;
    for(int d = 0; d < snapshot.dimension; ++d)
      if(!std::ranges::equal(positions[d], snapshot.positions[d]))
        return true;
    return false;
  }

  void ContactWatch::begin(const cases::Snapshot &snapshot)
  {
    for(int d = 0; d < snapshot.dimension; ++d)
      positions[d].assign(snapshot.positions[d].begin(), snapshot.positions[d].end());
    find_touching(snapshot);
    find_seeds(snapshot);
    const std::size_t n = snapshot.temperature.size();
    solid.resize(n);
    heat.resize(n);
    for(std::size_t i = 0; i < n; ++i)
    {
      solid[i] = snapshot.solid_fraction[i] >= solid_from;
      heat[i] = heat_until_frozen(snapshot, i);
    }
    rebuild();
  }

  void ContactWatch::find_touching(const cases::Snapshot &snapshot)
  {
    const std::size_t n = snapshot.temperature.size();
    touching.assign(n, {});
    const std::size_t corners = std::size_t(1) << snapshot.dimension;
    for(std::size_t cell = 0; cell + corners <= snapshot.cells.size(); cell += corners)
      for(std::size_t a = cell; a < cell + corners; ++a)
        for(std::size_t b = cell; b < cell + corners; ++b)
          if(snapshot.cells[a] != snapshot.cells[b])
            touching[snapshot.cells[a]].push_back(snapshot.cells[b]);
    if(!snapshot.cells.empty())
      return;
    const double reach = touching_distance * spacing;
    const SiteGrid grid(snapshot, reach);
    for(std::size_t i = 0; i < n; ++i)
    {
      const cases::Position place = site_position(snapshot, i);
      grid.visit(place,
                 [&](std::uint32_t j)
                 {
                   if(j != i
                      && squared_distance(place, site_position(snapshot, j))
                             < reach * reach)
                     touching[i].push_back(j);
                 });
    }
  }

  void ContactWatch::find_seeds(const cases::Snapshot &snapshot)
  {
    seeds.clear();
    for(const cases::Position &sink : sinks)
    {
      double least = std::numeric_limits<double>::infinity();
      std::uint32_t nearest = 0;
      for(std::size_t i = 0; i < snapshot.temperature.size(); ++i)
      {
        const double squared = squared_distance(sink, site_position(snapshot, i));
        if(squared < least)
        {
          least = squared;
          nearest = static_cast<std::uint32_t>(i);
        }
      }
      seeds.push_back(nearest);
    }
  }

  /** The bodies of the solid sites, from nothing. */
  void ContactWatch::rebuild()
  {
    body.resize(solid.size());
    std::iota(body.begin(), body.end(), 0);
    for(std::uint32_t site = 0; site < body.size(); ++site)
      if(solid[site])
        join(site);
  }

  std::uint32_t ContactWatch::body_of(std::uint32_t site)
  {
    while(body[site] != site)
    {
      body[site] = body[body[site]];
      site = body[site];
    }
    return site;
  }

  /** Unite a site that is solid with those that it touches. */
  void ContactWatch::join(std::uint32_t site)
  {
    for(const std::uint32_t other : touching[site])
      if(solid[other])
        body[body_of(other)] = body_of(site);
  }

  bool ContactWatch::connected()
  {
    for(std::size_t a = 0; a < seeds.size(); ++a)
      for(std::size_t b = 0; b < a; ++b)
        if(solid[seeds[a]] && seeds[a] != seeds[b]
           && body_of(seeds[a]) == body_of(seeds[b]))
          return true;
    return false;
  }

  bool ContactWatch::observe(const cases::Snapshot &snapshot)
  {
    if(!std::isnan(contact))
      return true;
    if(moved(snapshot))
    {
      begin(snapshot);
      if(connected())
        contact = snapshot.time;
    }
    follow(snapshot);
    for(const auto &[when, site] : frozen)
    {
      solid[site] = 1;
      join(site);
      if(std::isnan(contact) && connected())
        contact = when;
    }
    last_time = snapshot.time;
    return !std::isnan(contact);
  }

  /** Find what has frozen since the last snapshot, in its order; take apart what has
   * melted. */
  void ContactWatch::follow(const cases::Snapshot &snapshot)
  {
    frozen.clear();
    bool melted = false;
    for(std::uint32_t i = 0; i < body.size(); ++i)
    {
      const double now = heat_until_frozen(snapshot, i);
      const bool is_solid = snapshot.solid_fraction[i] >= solid_from;
      if(is_solid && !solid[i])
        frozen.emplace_back(crossing_time(last_time, heat[i], snapshot.time, now, 0), i);
      if(!is_solid && solid[i])
      {
        solid[i] = 0;
        melted = true;
      }
      heat[i] = now;
    }
    std::ranges::sort(frozen);
    if(melted) // bodies may have come apart
      rebuild();
  }

  EventWatch::EventWatch(const cases::Scene &scene, const std::vector<TimedEvent> &events,
                         double spacing)
    : last_share(nan)
    , last_time(nan)
  {
    times.fill(nan);
    for(const TimedEvent event : events)
      wanted[static_cast<std::size_t>(event)] = true;
    if(awaits(TimedEvent::first_contact))
      contact.emplace(scene, spacing);
  }

  bool EventWatch::awaits(TimedEvent event) const
  {
    return wanted[static_cast<std::size_t>(event)] && std::isnan(time(event));
  }

  bool EventWatch::pending() const
  {
    return awaits(TimedEvent::first_contact) || awaits(TimedEvent::half_frozen)
           || awaits(TimedEvent::all_frozen);
  }

  double EventWatch::time(TimedEvent event) const
  {
    return times[static_cast<std::size_t>(event)];
  }

  void EventWatch::happened(TimedEvent event, double time)
  {
    times[static_cast<std::size_t>(event)] = time;
  }

  void EventWatch::observe(const cases::Snapshot &snapshot)
  {
    if(awaits(TimedEvent::first_contact) && contact->observe(snapshot))
      happened(TimedEvent::first_contact, contact->time());
    if(awaits(TimedEvent::half_frozen) || awaits(TimedEvent::all_frozen))
      follow_volume(snapshot);
  }

  void EventWatch::follow_volume(const cases::Snapshot &snapshot)
  {
    double solid = 0, liquid = 0;
    for(std::size_t i = 0; i < snapshot.weights.size(); ++i)
    {
      solid += snapshot.weights[i] * snapshot.solid_fraction[i];
      liquid += snapshot.weights[i] * (1 - snapshot.solid_fraction[i]);
    }
    const double share = solid / (solid + liquid);
    if(awaits(TimedEvent::half_frozen) && share >= 0.5)
      happened(TimedEvent::half_frozen,
               std::isnan(last_share)
                   ? snapshot.time
                   : crossing_time(last_time, last_share, snapshot.time, share, 0.5));
    if(awaits(TimedEvent::all_frozen) && liquid <= no_liquid * (solid + liquid))
      happened(TimedEvent::all_frozen, snapshot.time);
    last_share = share;
    last_time = snapshot.time;
  }
} // namespace meltfront::verification
