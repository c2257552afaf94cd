#ifndef meltfront_particles_alloy_wall_variable_h
#define meltfront_particles_alloy_wall_variable_h

#include <particles/sph/phase_map.h>

namespace meltfront::particles
{
  /** The conduction variable with which walls hand over T - T_m: that of a substance
   * without phases and with a heat capacity of one. */
  inline ConductionVariable excess_variable(const cases::Material &material)
  {
    cases::Material unit;
    unit.melting_temperature = material.melting_temperature;
    return {unit, cases::EffectSet({})};
  }
} // namespace meltfront::particles

#endif
