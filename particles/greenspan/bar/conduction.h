#ifndef meltfront_particles_greenspan_bar_conduction_h
#define meltfront_particles_greenspan_bar_conduction_h

#include <particles/greenspan/calibration/bulk.h>

namespace meltfront::particles::greenspan
{
  /** A phase between a hot and a cold bath, in a rectangle that repeats itself. */
  struct ConductionSettings
  {
    BulkSettings phase;         ///< its temperature lies between those of the baths
    double half_difference = 4; ///< between a bath and the middle
    double bath_share = 0.1;    ///< of the length, of each bath
    double bath_rate = 10;      ///< per unit of time
    double relaxation = 10;     ///< time until the profile is steady
    double duration = 40;       ///< time of the averages
    int bins = 40;              ///< of the profile, over the whole length
  };

  struct ConductionResult
  {
    double temperature = 0;  ///< mean between the baths
    double conductivity = 0; ///< there
    double flux = 0;         ///< per width
    double imbalance = 0;    ///< of the heat of the two baths, relative to the mean
    double lowest_order
        = 0; ///< least lattice_order of a bin: a solid that melts loses it
    std::vector<double> position, profile; ///< x and mean temperature of the bins
  };

  /**
   * Conductivity by the heat that goes from a hot bath to a cold one (direct method, the
   * baths a quarter and three quarters along x). Between the baths the flux J is the same
   * everywhere: k is J over the slope of the temperatures, fitted over the bins that lie
   * an eighth of the way from bath to bath away from both.
   * @throws cases::InputError, cases::NumericalError
   */
  ConductionResult measure_conduction(const ConductionSettings &settings);
} // namespace meltfront::particles::greenspan

#endif
