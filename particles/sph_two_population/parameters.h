#ifndef meltfront_particles_sph_two_population_parameters_h
#define meltfront_particles_sph_two_population_parameters_h

#include <particles/sph/parameters.h>

#include <string>

namespace meltfront::particles
{
  /** How the particles of two populations exchange heat. */
  enum class PhaseExchange
  {
    corrected, ///< intrinsic volumes, k_l + k_s between phases: conducts as a mush does
    published  ///< Monaghan et al. (2005), equation 4.2: conducts too much
  };

  /** Where new ice goes. */
  enum class NewIce
  {
    site,  ///< to the ice particle of its own site
    kernel ///< to all ice particles around (Monaghan et al. 2005, equation 4.12)
  };

  /** What distinguishes the corrected method of two populations from the published one:
   * the same code with other defaults. */
  struct TwoPopulationPolicy
  {
    std::string name;
    std::string summary;
    std::string corrected_form;
    bool as_published; ///< in two dimensions, with steps in units of c rho h^2/k
    PhaseExchange exchange;
    NewIce new_ice;
    bool constant_latent_heat;
    LatticeLayout layout;
    bool moment_correction;
    double smoothing_length;
    double step_factor;
  };

  /** `sph-two-population` */
  const TwoPopulationPolicy &corrected_two_population();

  /** `sph-two-population-2005` */
  const TwoPopulationPolicy &published_two_population();

  /** The options of a method of two populations. */
  struct TwoPopulationParameters
  {
    explicit TwoPopulationParameters(const TwoPopulationPolicy &policy);

    void bind(cases::OptionBinder &options);

    std::string name;
    bool as_published;
    SphParameters sph;
    PhaseExchange exchange;
    NewIce new_ice;
    bool constant_latent_heat;
  };

  TwoPopulationParameters
  resolve_two_population_parameters(const TwoPopulationPolicy &policy,
                                    const cases::Scene &scene,
                                    const cases::Resolution &resolution);
} // namespace meltfront::particles

#endif
