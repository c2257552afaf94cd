#include <cases/numbers.h>
#include <particles/sph/phase_map.h>

#include <algorithm>

namespace meltfront::particles
{
  using cases::Effect;

  namespace
  {
    using cases::infinity;

    constexpr Effect phase_effects[]
        = {Effect::phase_change,           Effect::phase_heat_capacity,
           Effect::phase_conductivity,     Effect::variable_conductivity,
           Effect::variable_heat_capacity, Effect::melting_range};
  } // namespace

  Extremes find_extremes(std::span<const double> values, int threads)
  {
    const double *value = values.data();
    double lowest = infinity, highest = -infinity, zero = 0;
#pragma omp parallel for simd schedule(static) num_threads(threads) if(threads > 1)      \
    reduction(min : lowest) reduction(max : highest) reduction(+ : zero)
    for(std::size_t i = 0; i < values.size(); ++i)
    {
      lowest = std::min(lowest, value[i]);
      highest = std::max(highest, value[i]);
      zero += value[i] * 0; // not a number if the value is not finite
    }
    return {lowest, highest, zero == 0};
  }

  ConductionVariable::ConductionVariable(const cases::Material &material,
                                         const cases::EffectSet &effects)
    : material(material)
    , is_mapped(std::any_of(std::begin(phase_effects), std::end(phase_effects),
                            [&](Effect effect) { return effects.contains(effect); }))
    , solid_factor(material.solid.conductivity / material.solid.specific_heat_capacity)
    , liquid_factor(material.liquid.conductivity / material.liquid.specific_heat_capacity)
  {
  }

  double ConductionVariable::of_temperature(double temperature) const
  {
    if(material.curves)
      return material.curves->at_temperature(temperature).kirchhoff;
    const double excess = temperature - material.melting_temperature;
    const cases::PhaseProperties &phase = excess < 0 ? material.solid : material.liquid;
    return (is_mapped ? phase.conductivity : phase.specific_heat_capacity) * excess;
  }

  double ConductionVariable::temperature(double w) const
  {
    if(material.curves)
      return material.curves->at_kirchhoff(w).temperature;
    const cases::PhaseProperties &phase = w < 0 ? material.solid : material.liquid;
    return material.melting_temperature
           + w / (is_mapped ? phase.conductivity : phase.specific_heat_capacity);
  }

  Extremes ConductionVariable::map(std::span<const double> enthalpy, std::span<double> w,
                                   int threads)
  {
    return meter.measure(
        [&]
        {
          if(material.curves)
            return map_by_curves(enthalpy, w, threads);
          const double *h = enthalpy.data();
          double *variable = w.data();
          const double latent = material.latent_heat;
          const double solid = solid_factor, liquid = liquid_factor;
          double lowest = infinity, highest = -infinity, zero = 0;
#pragma omp parallel for simd schedule(static) num_threads(threads) if(threads > 1)      \
    reduction(min : lowest) reduction(max : highest) reduction(+ : zero)
          for(std::size_t i = 0; i < enthalpy.size(); ++i)
          {
            const double value
                = solid * std::min(h[i], 0.) + liquid * std::max(h[i] - latent, 0.);
            variable[i] = value;
            lowest = std::min(lowest, value);
            highest = std::max(highest, value);
            zero += h[i] * 0; // not a number if the enthalpy is not finite
          }
          return Extremes{lowest, highest, zero == 0};
        });
  }

  Extremes ConductionVariable::map_by_curves(std::span<const double> enthalpy,
                                             std::span<double> w, int threads) const
  {
    const cases::ThermalCurves &curves = *material.curves;
    double lowest = infinity, highest = -infinity, zero = 0;
#pragma omp parallel for schedule(static) num_threads(threads) if(threads > 1)           \
    reduction(min : lowest) reduction(max : highest) reduction(+ : zero)
    for(std::size_t i = 0; i < enthalpy.size(); ++i)
    {
      w[i] = curves.at_enthalpy(enthalpy[i]).kirchhoff;
      lowest = std::min(lowest, w[i]);
      highest = std::max(highest, w[i]);
      zero += enthalpy[i] * 0; // not a number if the enthalpy is not finite
    }
    return {lowest, highest, zero == 0};
  }

  void ConductionVariable::slopes(std::span<const double> enthalpy,
                                  std::span<double> slope) const
  {
    if(material.curves)
    {
      for(std::size_t i = 0; i < enthalpy.size(); ++i)
      {
        const cases::ThermalState state = material.curves->at_enthalpy(enthalpy[i]);
        slope[i] = state.conductivity / state.capacity;
      }
      return;
    }
    const double latent = material.latent_heat;
    for(std::size_t i = 0; i < enthalpy.size(); ++i)
      slope[i] = !is_mapped                            ? 1.
                 : enthalpy[i] < 0                     ? solid_factor
                 : enthalpy[i] > latent || latent == 0 ? liquid_factor
                                                       : 0.;
  }

  std::vector<cases::EffectCost>
  ConductionVariable::costs(const cases::EffectSet &effects, std::size_t bytes) const
  {
    std::vector<Effect> sharing;
    for(const Effect effect : phase_effects)
      if(effects.contains(effect))
        sharing.push_back(effect);
    // One pass serves these effects: none can be timed alone.
    std::vector<cases::EffectCost> result;
    for(const Effect effect : sharing)
    {
      result.push_back(meter.cost(effect, bytes / sharing.size()));
      result.back().seconds /= sharing.size();
    }
    return result;
  }
} // namespace meltfront::particles
