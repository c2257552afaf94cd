#ifndef meltfront_particles_alloy_mixture_state_h
#define meltfront_particles_alloy_mixture_state_h

#include <particles/alloy/substance.h>
#include <particles/sph/discretisation.h>

#include <vector>

namespace meltfront::particles
{
  /** What a scene's particles hold at the start. */
  struct MixtureState
  {
    /** @throws cases::InputError for a mass fraction below 0 or, all solutes together,
     * above 1. */
    MixtureState(const Discretisation &discretisation, const AlloySubstance &substance);

    std::vector<double> enthalpy;                   ///< J/kg
    std::vector<std::vector<double>> concentration; ///< one array per solute

    /**
     * Bounds on the temperature. Where solute diffuses, brine that gets saltier melts ice
     * and cools: the lower bound then reaches down to the liquidus (or the eutectic
     * temperature) of the highest concentrations in the liquid.
     */
    cases::TemperatureBounds bounds(const cases::Scene &scene,
                                    const AlloySubstance &substance) const;

    /** All particles have the same concentrations. */
    bool uniform() const;
  };
} // namespace meltfront::particles

#endif
