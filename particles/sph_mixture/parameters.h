#ifndef meltfront_particles_sph_mixture_parameters_h
#define meltfront_particles_sph_mixture_parameters_h

#include <particles/sph/parameters.h>

namespace meltfront::particles
{
  /** The conductivity between two particles of a mixture. */
  enum class MeanConductivity
  {
    integral,   ///< mean over the temperatures between both, along the equilibrium
    arithmetic, ///< (k_a + k_b)/2
    harmonic    ///< 2 k_a k_b/(k_a + k_b)
  };

  /** The options of `sph-mixture`. */
  struct MixtureParameters
  {
    MixtureParameters();

    void bind(cases::OptionBinder &options);

    SphParameters sph;
    MeanConductivity mean = MeanConductivity::integral;
  };

  /** @throws cases::Refusal for a domain or dimension that is not simulated. */
  MixtureParameters resolve_mixture_parameters(const cases::Scene &scene,
                                               const cases::Resolution &resolution);
} // namespace meltfront::particles

#endif
