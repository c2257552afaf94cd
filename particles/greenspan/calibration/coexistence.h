#ifndef meltfront_particles_greenspan_calibration_coexistence_h
#define meltfront_particles_greenspan_calibration_coexistence_h

#include <particles/greenspan/bar/bar.h>

namespace meltfront::particles::greenspan
{
  /** A bar of which half is molten, left to itself. */
  struct CoexistenceSettings
  {
    BarSettings bar;        ///< its own temperatures are not used
    double guess = 45;      ///< of the melting temperature, within a tenth
    double melting = 4;     ///< time in which one half is melted
    double relaxation = 12; ///< time in which the temperature evens out
    double duration = 20;   ///< time of the average
  };

  struct Coexistence
  {
    double temperature = 0;   ///< at which both phases are in balance
    double front = 0;         ///< mean molten share
    double least_front = 0;   ///< least molten share of a look
    double largest_front = 0; ///< largest
    double heating = 0; ///< of the whole by the errors of the steps, energy per particle
  };

  /**
   * Melting temperature at the piston's pressure: half of a bar is melted, then all baths
   * are taken away. At constant enthalpy the front moves until both halves have the
   * temperature at which neither grows.
   * @throws cases::NumericalError if one phase is gone at the end: the guess is too far
   * off
   * @throws cases::InputError
   */
  Coexistence measure_coexistence(const CoexistenceSettings &settings);
} // namespace meltfront::particles::greenspan

#endif
