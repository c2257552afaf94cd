#ifndef meltfront_cases_exact_sink_profile_h
#define meltfront_cases_exact_sink_profile_h

#include <cases/exact/profiles.h>

#include <string>

namespace meltfront::cases
{
  /**
   * The profile around a sink, its data checked.
   * @throws InputError for lambda <= 0, a far temperature below the melting temperature,
   * a property that is not positive, or unequal densities.
   */
  similarity::RadialProfile<double> sink_profile(int dimension, const Material &material,
                                                 double lambda, double far_temperature,
                                                 const std::string &solution);
} // namespace meltfront::cases

#endif
