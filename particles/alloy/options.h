#ifndef meltfront_particles_alloy_options_h
#define meltfront_particles_alloy_options_h

#include <cases/method.h>
#include <particles/sph/parameters.h>

namespace meltfront::particles
{
  /** The options of all methods for alloys that say where particles are. */
  void bind_alloy_options(SphParameters &parameters, cases::OptionBinder &options);

  /**
   * What the resolution says, and the dimension in which a scene is simulated;
   * @p of_slab that of a slab where no option says it.
   * @throws cases::Refusal for a domain or dimension that is not simulated.
   */
  void resolve_alloy_options(SphParameters &parameters, const std::string &method,
                             const cases::Scene &scene,
                             const cases::Resolution &resolution, int of_slab);

  /** What all methods for alloys take: slabs, boxes and balls, and what an outline
   * bounds, with walls of these kinds. */
  cases::Capabilities alloy_capabilities(
      std::vector<cases::Effect> effects, std::vector<cases::BoundaryKind> round_walls,
      std::vector<cases::BoundaryKind> outlines,
      std::vector<cases::FrontOrigin> of_pure_substances, int most_threads);
} // namespace meltfront::particles

#endif
