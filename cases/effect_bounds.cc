#include <cases/domain_measure.h>
#include <cases/effect_bounds.h>
#include <cases/scene_heat.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace meltfront::cases
{
  namespace
  {
    EffectBound none(const std::string &why)
    {
      return {infinity, infinity, why};
    }

    /** Why the enthalpy of a scene need not contract; empty if it does. */
    std::string no_contraction(const Scene &scene)
    {
      if(scene.problem != ProblemKind::stefan)
        return fmt::format("there is none where the problem is '{}'",
                           to_string(scene.problem));
      if(scene.alloy)
        return "there is none beside solutes";
      if(scene.material.gibbs_thomson_coefficient != 0)
        return "there is none beside curved fronts that melt at another temperature";
      if(scene.material.solid.density != scene.material.liquid.density)
        return "there is none beside displaced liquid";
      if(metastable_initial_phase(scene))
        return "there is none beside a metastable phase";
      return {};
    }

    /** Least heat capacity per volume of either phase at temperatures of the scene
     * (J/(m^3 K)). */
    double least_capacity(const Scene &scene, const TemperatureBounds &bounds)
    {
      double least = infinity;
      for(const PhaseProperties *phase : {&scene.material.solid, &scene.material.liquid})
      {
        double capacity = phase->specific_heat_capacity;
        if(phase->heat_capacity_curve)
        {
          const PropertyCurve &curve = *phase->heat_capacity_curve;
          for(const double value : curve.values())
            capacity = std::min(capacity, value);
          if(std::isfinite(bounds.lower))
            capacity = std::min(capacity, curve(bounds.lower));
        }
        least = std::min(least, capacity * phase->density);
      }
      return least;
    }

    /** The change of the front by that of the solid's volume, both relative. */
    double change_of_front(const Scene &scene, double volume, double share)
    {
      const Domain &domain = scene.domain;
      if(scene.symmetry != Symmetry::cylindrical && scene.symmetry != Symmetry::spherical)
        return share;
      const double between = share * volume;
      double radius = enclosing_coordinate(scene.symmetry, between);
      if(domain.shape == DomainShape::shell)
      {
        const double inner = domain.inner_radius;
        const double least = volume_between(scene.symmetry, 0, inner);
        radius = std::min(radius,
                          enclosing_coordinate(scene.symmetry, least + between) - inner);
      }
      return radius / domain.side();
    }

    /** What heat (J) that an effect handles is worth. */
    EffectBound worth(const Scene &scene, double heat, const std::string &words)
    {
      if(heat == 0)
        return {0, 0, words};
      if(!std::isfinite(heat))
        return none("it handles heat that the scene's data do not bound");
      const double volume = volume_of(scene.domain);
      const TemperatureBounds given = given_temperatures(scene);
      EffectBound bound{0, 0, words};
      if(scene.material.latent_heat > 0)
        bound.front = change_of_front(
            scene, volume,
            std::min(1., heat
                             / (volume * scene.material.latent_heat
                                * std::min(scene.material.solid.density,
                                           scene.material.liquid.density))));
      bound.temperature
          = heat / (volume * least_capacity(scene, given) * (given.upper - given.lower));
      if(!std::isfinite(bound.temperature))
        return none("the scene's data give no range of temperature to relate it to");
      const TemperatureBounds all = temperature_bounds(scene);
      if(std::isfinite(all.upper - all.lower)) // both temperatures lie in the range
        bound.temperature = std::min(bound.temperature, 1.);
      return bound;
    }

    /** Of a property over the temperatures of a phase: max |value/value_m - 1| and max
     * |slope|. */
    struct Variation
    {
      double relative = 0, slope = 0;
    };

    Variation variation_of(const PropertyCurve *curve, double at_melting, double from,
                           double to)
    {
      Variation result;
      if(!curve)
        return result;
      const auto include = [&](double temperature)
      {
        if(std::isfinite(temperature))
          result.relative = std::max(result.relative,
                                     std::abs((*curve)(temperature) / at_melting - 1));
      };
      const double lower = std::min(from, to), upper = std::max(from, to);
      include(lower);
      include(upper);
      const auto &x = curve->temperatures();
      const auto &y = curve->values();
      for(std::size_t i = 0; i < x.size(); ++i)
        if(x[i] > lower && x[i] < upper)
          include(x[i]);
      for(std::size_t i = 0; i + 1 < x.size(); ++i)
        if(x[i + 1] > lower && x[i] < upper)
          result.slope
              = std::max(result.slope, std::abs((y[i + 1] - y[i]) / (x[i + 1] - x[i])));
      return result;
    }

    double greatest_difference_of_capacity(const Scene &scene, double upper)
    {
      const PhaseProperties &solid = scene.material.solid,
                            &liquid = scene.material.liquid;
      const double melting = scene.material.melting_temperature;
      double most = 0;
      constexpr int samples = 4096;
      const bool vary = solid.heat_capacity_curve || liquid.heat_capacity_curve;
      for(int i = 0; i <= (vary ? samples : 0); ++i)
      {
        const double temperature = melting + (upper - melting) * i / samples;
        most = std::max(most, std::abs(liquid.heat_capacity_at(temperature)
                                       - solid.heat_capacity_at(temperature)));
      }
      return most;
    }

    std::string phase_words(const char *what, double ratio, const PhaseHeat &phase,
                            const Scene &scene)
    {
      const double latent = scene.material.latent_heat * scene.material.solid.density;
      return fmt::format("{}{:.6g}{}", what, ratio,
                         latent > 0 ? fmt::format(", Stefan number of the liquid {:.3g}",
                                                  phase.capacity * phase.excess / latent)
                                    : "");
    }

    EffectBound bound_of_phase_conductivity(const Scene &with, const Scene &without)
    {
      if(with.material.liquid.conductivity_curve
         || with.material.solid.conductivity_curve)
        return none("there is none beside conductivities that depend on temperature");
      if(with.material.melting_range)
        return none("there is none beside a melting range");
      const double ratio
          = with.material.liquid.conductivity / with.material.solid.conductivity;
      const SceneHeat heat = bound_scene_heat(without);
      const PhaseHeat &liquid = heat.liquid;
      if(liquid.excess == 0)
        return {0, 0, "no liquid is warmer than the melting temperature"};
      return worth(with,
                   std::abs(ratio - 1)
                       * (liquid.turned + liquid.through_fronts + liquid.through_walls),
                   phase_words("conductivity ratio ", ratio, liquid, with));
    }

    EffectBound bound_of_phase_heat_capacity(const Scene &with, const Scene &without)
    {
      if(with.material.melting_range)
        return none("there is none beside a melting range");
      const SceneHeat heat = bound_scene_heat(without);
      const PhaseHeat &liquid = heat.liquid;
      if(liquid.excess == 0)
        return {0, 0, "no liquid is warmer than the melting temperature"};
      const double share = greatest_difference_of_capacity(with, heat.bounds.upper)
                           * with.material.liquid.density / liquid.capacity;
      return worth(with, share * liquid.turned,
                   phase_words("heat capacity ratio ",
                               with.material.liquid.specific_heat_capacity
                                   / with.material.solid.specific_heat_capacity,
                               liquid, with));
    }

    EffectBound bound_of_varying(const Scene &with, const Scene &without,
                                 bool conductivity)
    {
      if(with.material.melting_range)
        return none("there is none beside a melting range");
      const SceneHeat heat = bound_scene_heat(without);
      const double melting = with.material.melting_temperature;
      double sum = 0, largest = 0;
      for(const auto &[properties, phase, sign] :
          {std::tuple(&with.material.solid, &heat.solid, -1.),
           std::tuple(&with.material.liquid, &heat.liquid, 1.)})
      {
        if(phase->excess == 0)
          continue;
        const double extreme = melting + sign * phase->excess;
        const Variation of
            = conductivity
                  ? variation_of(properties->conductivity_curve.get(),
                                 properties->conductivity, melting, extreme)
                  : variation_of(properties->heat_capacity_curve.get(),
                                 properties->specific_heat_capacity, melting, extreme);
        if(of.relative == 0)
          continue;
        largest = std::max(largest, of.relative);
        sum += of.relative * phase->turned;
        if(conductivity)
          sum += of.relative * phase->through_walls
                 + of.slope * phase->excess / properties->conductivity
                       * (phase->through_fronts
                          + phase->capacity * phase->excess * heat.volume);
      }
      return worth(with, sum,
                   fmt::format("it varies by up to {:.3g} of its value at the melting "
                               "temperature",
                               largest));
    }

    EffectBound bound_of_liquid_motion(const Scene &with, const Scene &without)
    {
      const SceneHeat heat = bound_scene_heat(without);
      if(with.domain.shape != DomainShape::slab || heat.course != HeatCourse::cooling
         || with.boundary(Side::x_min).kind == BoundaryKind::insulated
         || with.material.melting_range)
        return none("there is one only for a slab that freezes from x_min and from a "
                    "uniform start");
      const double solid = with.material.solid.density,
                   liquid = with.material.liquid.density;
      return worth(without,
                   2 * std::abs(liquid / solid - 1) * heat.liquid.capacity
                       * heat.liquid.excess * heat.volume,
                   phase_words("density ratio ", solid / liquid, heat.liquid, with));
    }

    EffectBound bound_of_phase_change(const Scene &with)
    {
      const TemperatureBounds bounds = temperature_bounds(with);
      const Material &material = with.material;
      const double highest = material.melting_range ? material.melting_range->liquidus
                                                    : material.melting_temperature;
      if(bounds.lower > highest || bounds.upper < material.melting_temperature)
        return {0, 0,
                fmt::format("the temperature stays between {:.6g} and {:.6g}",
                            bounds.lower, bounds.upper)};
      return none("something may melt or freeze");
    }

    EffectBound bound_of_walls(const Scene &with, BoundaryKind kind)
    {
      const TemperatureBounds bounds = temperature_bounds(with);
      const double heat = heat_through_walls(with, kind, bounds.lower, bounds.upper);
      return worth(with, heat, fmt::format("at most {:.3g} J pass these walls", heat));
    }

    EffectBound bound_of_wall_temperature(const Scene &with)
    {
      const SceneHeat heat = bound_scene_heat(with);
      std::optional<double> common;
      for(const Side side : with.sides())
      {
        const Boundary &wall = with.boundary(side);
        if(wall.kind == BoundaryKind::insulated || wall.kind == BoundaryKind::periodic)
          continue;
        const double value
            = wall.kind == BoundaryKind::fixed_temperature && wall.value.constant
                  ? wall.value({}, with.start_time)
                  : infinity;
        if(value == infinity || (common && *common != value))
          return none("there is one only for walls of one temperature and no others");
        common = value;
      }
      return worth(with, heat.exchanged,
                   fmt::format("at most {:.3g} J pass walls of given temperature",
                               heat.exchanged));
    }

    EffectBound bound_of_sources(const Scene &with, double heat)
    {
      return worth(with, heat, fmt::format("at most {:.3g} J are released", heat));
    }

    EffectBound bound_of_gibbs_thomson(const Scene &with)
    {
      const bool flat
          = with.domain.shape == DomainShape::slab || with.symmetry == Symmetry::planar;
      return flat ? EffectBound{0, 0, "the front is flat"}
                  : none("how much a front bends is not known");
    }

    EffectBound of_contracting(Effect effect, const Scene &with, const Scene &without)
    {
      switch(effect)
      {
      case Effect::phase_change:
        return bound_of_phase_change(with);
      case Effect::phase_conductivity:
        return bound_of_phase_conductivity(with, without);
      case Effect::phase_heat_capacity:
        return bound_of_phase_heat_capacity(with, without);
      case Effect::heat_sources:
        return bound_of_sources(with, heat_of_sources(with));
      case Effect::moving_source:
        return bound_of_sources(with, 2 * heat_of_sources(with));
      case Effect::volumetric_source:
        return bound_of_sources(with, heat_of_volumetric_source(with));
      case Effect::wall_temperature:
        return bound_of_wall_temperature(with);
      case Effect::wall_flux:
        return bound_of_walls(with, BoundaryKind::flux);
      case Effect::robin_wall:
        return bound_of_walls(with, BoundaryKind::heat_transfer);
      case Effect::radiating_wall:
        return bound_of_walls(with, BoundaryKind::radiation);
      case Effect::variable_conductivity:
        return bound_of_varying(with, without, true);
      case Effect::variable_heat_capacity:
        return bound_of_varying(with, without, false);
      case Effect::liquid_motion:
        return bound_of_liquid_motion(with, without);
      default:
        return none("there is none for this effect");
      }
    }
  } // namespace

  double EffectBound::largest() const
  {
    return std::max(front, temperature);
  }

  EffectBound bound_of_effect(Effect effect, const Scene &with, const Scene &without)
  {
    if(!with.conducts_heat())
      return none("there is none for particle solids");
    if(effect == Effect::gibbs_thomson)
      return bound_of_gibbs_thomson(with);
    const std::string why
        = no_contraction(effect == Effect::liquid_motion ? without : with);
    return why.empty() ? of_contracting(effect, with, without) : none(why);
  }
} // namespace meltfront::cases
