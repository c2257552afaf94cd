#include <cases/dense_sampling.h>
#include <cases/domain_measure.h>
#include <cases/numbers.h>
#include <cases/scene_heat.h>
#include <cases/wall_law.h>

#include <algorithm>
#include <cmath>

namespace meltfront::cases
{
  namespace
  {
    constexpr int intervals = 512;

    double time_span(const Scene &scene)
    {
      return scene.end_time - scene.start_time;
    }

    bool has_value(const Boundary &wall)
    {
      return wall.kind == BoundaryKind::fixed_temperature || prescribes_heat(wall.kind);
    }

    /** Extremes of what a wall is given. */
    TemperatureBounds given_extremes(const Scene &scene, Side side)
    {
      TemperatureBounds result{infinity, -infinity};
      visit_wall_values(scene, side, scene.boundary(side).value,
                        [&](double value)
                        {
                          result.lower = std::min(result.lower, value);
                          result.upper = std::max(result.upper, value);
                        });
      return result;
    }

    /** Total variation in time of the part of a wall's temperature that is above
     * (sign 1) or below (-1) the melting temperature (K). */
    double variation_of_wall(const Scene &scene, Side side, double sign)
    {
      const Boundary &wall = scene.boundary(side);
      if(wall.value.constant)
        return 0;
      std::vector<double> times = wall.value.breakpoints;
      for(int i = 0; i <= intervals; ++i)
        times.push_back(scene.start_time + time_span(scene) * i / intervals);
      std::ranges::sort(times);
      double most = 0;
      visit_wall(
          scene.domain, side,
          [&](const Position &p)
          {
            double sum = 0, before = 0;
            for(std::size_t k = 0; k < times.size(); ++k)
            {
              const double excess = std::max(
                  sign * (wall.value(p, times[k]) - scene.material.melting_temperature),
                  0.);
              sum += k > 0 ? std::abs(excess - before) : 0;
              before = excess;
            }
            most = std::max(most, sum);
          });
      return most;
    }

    /** u = int k dT between two temperatures of a phase (W/m). */
    double kirchhoff(const PhaseProperties &phase, double from, double to)
    {
      double sum = 0;
      for(int i = 0; i < intervals; ++i)
        sum += phase.conductivity_at(from + (to - from) * (i + 0.5) / intervals);
      return std::abs(to - from) * sum / intervals;
    }

    /** Between two temperatures, through the phases that they belong to. */
    double kirchhoff(const Material &material, double from, double to)
    {
      const double melting = material.melting_temperature;
      const auto part = [&](const PhaseProperties &phase, double lower, double upper)
      { return upper > lower ? kirchhoff(phase, lower, upper) : 0; };
      const double lower = std::min(from, to), upper = std::max(from, to);
      return part(material.solid, lower, std::min(upper, melting))
             + part(material.liquid, std::max(lower, melting), upper);
    }

    double greatest_capacity(const PhaseProperties &phase, double lowest, double highest)
    {
      double most = phase.specific_heat_capacity;
      if(phase.heat_capacity_curve)
      {
        for(const double end : {lowest, highest})
          most = std::max(most, phase.heat_capacity_at(end));
        const PropertyCurve &curve = *phase.heat_capacity_curve;
        for(std::size_t i = 0; i < curve.values().size(); ++i)
          if(curve.temperatures()[i] > lowest && curve.temperatures()[i] < highest)
            most = std::max(most, curve.values()[i]);
      }
      return most * phase.density;
    }

    bool starts_uniform(const Scene &scene)
    {
      return scene.initial.temperature.constant && !scene.initial.front && !scene.alloy;
    }

    HeatCourse course_of(const Scene &scene)
    {
      if(!starts_uniform(scene) || !scene.sources.empty() || scene.volumetric_source)
        return HeatCourse::both_ways;
      const double start = scene.initial.temperature({}, scene.start_time);
      bool warmer = false, colder = false;
      for(const Side side : scene.sides())
      {
        const Boundary &wall = scene.boundary(side);
        if(!has_value(wall))
          continue;
        if(!wall.value.constant)
          return HeatCourse::both_ways;
        const double drive = wall.value({}, scene.start_time)
                             - (wall.kind == BoundaryKind::flux ? 0 : start);
        warmer |= drive > 0;
        colder |= drive < 0;
      }
      if(warmer && colder)
        return HeatCourse::both_ways;
      return warmer ? HeatCourse::heating : HeatCourse::cooling;
    }

    /** The temperature that a one-way scene tends to at its walls. */
    double driving_temperature(const Scene &scene, HeatCourse course)
    {
      const TemperatureBounds given = given_temperatures(scene);
      return course == HeatCourse::heating ? given.upper : given.lower;
    }

    /** Of a slab: whether one end has the driving temperature and the other is insulated
     * or kept at that of the start. @param kept told which */
    bool one_end_drives(const Scene &scene, double driving, bool &kept)
    {
      if(scene.domain.shape != DomainShape::slab)
        return false;
      const double start = scene.initial.temperature({}, scene.start_time);
      int drives = 0, quiet = 0;
      kept = false;
      for(const Side side : {Side::x_min, Side::x_max})
      {
        const Boundary &wall = scene.boundary(side);
        if(wall.kind == BoundaryKind::insulated)
          ++quiet;
        else if(wall.kind == BoundaryKind::fixed_temperature)
        {
          const double value = wall.value({}, scene.start_time);
          if(value == start)
          {
            kept = true;
            ++quiet;
          }
          else if(value == driving)
            ++drives;
        }
      }
      return drives == 1 && quiet == 1;
    }

    double heat_exchanged(const Scene &scene, const SceneHeat &heat)
    {
      if(heat.course == HeatCourse::both_ways)
        return infinity;
      for(const Side side : scene.sides())
        if(scene.boundary(side).kind == BoundaryKind::flux)
          return infinity;
      const Material &material = scene.material;
      const double start = scene.initial.temperature({}, scene.start_time);
      const double driving = driving_temperature(scene, heat.course);
      const double fraction = heat.course == HeatCourse::heating ? 0 : 1;
      const double density = std::max(material.solid.density, material.liquid.density);
      const double difference
          = density
            * std::abs(
                material.enthalpy(driving, fraction)
                - material.enthalpy(start, scene.initial.solid_fraction_at_melting));
      double most = heat.volume * difference;
      if(bool kept = false; one_end_drives(scene, driving, kept))
        most = std::min(most, std::sqrt(2 * kirchhoff(material, start, driving)
                                        * time_span(scene) * difference));
      return most;
    }

    /** What a phase's own book allows to pass its fronts (J). */
    double own_book(const Scene &scene, const SceneHeat &heat, const PhaseHeat &phase,
                    double sign)
    {
      const double melting = scene.material.melting_temperature;
      double at_start = 0;
      visit_densely(
          scene, {&scene.initial.temperature},
          [&](const Position &p)
          {
            at_start = std::max(
                at_start,
                sign * (scene.initial.temperature(p, scene.start_time) - melting));
          });
      for(const Side side : scene.sides())
        if(scene.boundary(side).kind == BoundaryKind::fixed_temperature)
        {
          const TemperatureBounds wall = given_extremes(scene, side);
          if(sign * ((sign > 0 ? wall.upper : wall.lower) - melting) > 0)
            return infinity;
        }
      return phase.capacity * at_start * heat.volume + phase.through_walls;
    }

    /** In a slab with one end kept at the start's temperature, of the phase at the start;
     * see bound_scene_heat(). */
    double book_of_slab(const Scene &scene, const SceneHeat &heat, const PhaseHeat &phase,
                        double sign)
    {
      const bool starts = sign > 0 ? heat.course == HeatCourse::cooling
                                   : heat.course == HeatCourse::heating;
      bool kept = false;
      const double driving = driving_temperature(scene, heat.course);
      if(!starts || !one_end_drives(scene, driving, kept) || !kept)
        return infinity;
      const Material &material = scene.material;
      const double start = scene.initial.temperature({}, scene.start_time);
      const double own = kirchhoff(material, material.melting_temperature, start);
      const double other = kirchhoff(material, material.melting_temperature, driving);
      const double length = scene.domain.side();
      if(own == 0)
        return infinity;
      return (phase.capacity * phase.excess * length * length / 2
              + own * time_span(scene))
             / (length * own / (own + other));
    }

    PhaseHeat bound_phase(const Scene &scene, const SceneHeat &heat, double sign)
    {
      const Material &material = scene.material;
      const double melting = material.melting_temperature;
      const double extreme = sign > 0 ? std::max(heat.bounds.upper, melting)
                                      : std::min(heat.bounds.lower, melting);
      PhaseHeat phase;
      phase.excess = std::abs(extreme - melting);
      double swing = phase.excess;
      if(heat.course == HeatCourse::both_ways)
      {
        swing *= 2;
        for(const Side side : scene.sides())
          if(has_value(scene.boundary(side)))
            swing += variation_of_wall(scene, side, sign);
      }
      const PhaseProperties &properties = sign > 0 ? material.liquid : material.solid;
      phase.capacity = greatest_capacity(properties, std::min(melting, extreme),
                                         std::max(melting, extreme));
      for(const BoundaryKind kind :
          {BoundaryKind::flux, BoundaryKind::heat_transfer, BoundaryKind::radiation})
        phase.through_walls += heat_through_walls(scene, kind, std::min(melting, extreme),
                                                  std::max(melting, extreme));
      if(phase.excess > 0)
        phase.turned
            = std::min(phase.capacity * swing * heat.volume,
                       properties.heat_capacity_curve ? infinity : heat.exchanged);
      phase.through_fronts = phase.excess == 0
                                 ? 0
                                 : std::min(own_book(scene, heat, phase, sign),
                                            book_of_slab(scene, heat, phase, sign));
      return phase;
    }
  } // namespace

  TemperatureBounds given_temperatures(const Scene &scene)
  {
    Scene given = scene;
    given.sources.clear();
    given.volumetric_source.reset();
    given.material.gibbs_thomson_coefficient = 0;
    for(auto &wall : given.boundaries)
      if(wall && wall->kind == BoundaryKind::flux)
        wall = Boundary();
    return temperature_bounds(given);
  }

  double heat_through_wall(const Scene &scene, Side side, double lowest, double highest)
  {
    const Boundary &wall = scene.boundary(side);
    if(wall.kind == BoundaryKind::fixed_temperature)
      return infinity;
    if(!prescribes_heat(wall.kind))
      return 0;
    const TemperatureBounds given = given_extremes(scene, side);
    double most = 0;
    for(const double value : {given.lower, given.upper})
      for(const double temperature : {lowest, highest})
        most = std::max(most, std::abs(heat_through(wall, value, temperature).flux));
    return most * area_of(scene.domain, side) * time_span(scene);
  }

  double heat_through_walls(const Scene &scene, BoundaryKind kind, double lowest,
                            double highest)
  {
    double sum = 0;
    for(const Side side : scene.sides())
      if(scene.boundary(side).kind == kind)
        sum += heat_through_wall(scene, side, lowest, highest);
    return sum;
  }

  double heat_of_sources(const Scene &scene)
  {
    constexpr int pieces = 4096;
    double sum = 0;
    for(const PointSource &source : scene.sources)
    {
      double before = 0;
      for(int i = 1; i <= pieces; ++i)
      {
        const double energy
            = source.energy(scene.start_time + time_span(scene) * i / pieces);
        sum += std::abs(energy - before);
        before = energy;
      }
    }
    return sum;
  }

  double heat_of_volumetric_source(const Scene &scene)
  {
    double most = 0;
    if(scene.volumetric_source)
      visit_release(scene, [&](double value) { most = std::max(most, std::abs(value)); });
    return most == 0 ? 0 : most * volume_of(scene.domain) * time_span(scene);
  }

  SceneHeat bound_scene_heat(const Scene &scene)
  {
    SceneHeat heat;
    heat.volume = volume_of(scene.domain);
    heat.bounds = temperature_bounds(scene);
    heat.course = course_of(scene);
    heat.exchanged = heat_exchanged(scene, heat);
    heat.solid = bound_phase(scene, heat, -1);
    heat.liquid = bound_phase(scene, heat, 1);
    // The book of the front: what one phase gives melts, or goes on into the other.
    const double latent
        = scene.material.latent_heat
          * std::max(scene.material.solid.density, scene.material.liquid.density)
          * heat.volume;
    const double solid = heat.solid.through_fronts, liquid = heat.liquid.through_fronts;
    heat.solid.through_fronts = std::min(solid, latent + liquid);
    heat.liquid.through_fronts = std::min(liquid, latent + solid);
    return heat;
  }
} // namespace meltfront::cases
