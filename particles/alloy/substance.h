#ifndef meltfront_particles_alloy_substance_h
#define meltfront_particles_alloy_substance_h

#include <cases/scene.h>

#include <vector>

namespace meltfront::particles
{
  /** What a scene's particles consist of: the solvent and the solutes that are there at
   * the start. */
  struct AlloySubstance
  {
    /** @throws cases::InputError for a negative diffusivity or slope.
     * @throws cases::Refusal if crystals would form without giving off heat. */
    AlloySubstance(const cases::Scene &scene, const std::string &method);

    std::size_t n_solutes() const
    {
      return numbers.size();
    }

    bool diffuses() const;

    /** W/(m K) */
    double largest_conductivity() const;

    /** J/(kg K) */
    double least_heat_capacity() const;

    cases::Material material;
    double density;                   ///< of every particle (kg/m^3)
    std::vector<std::size_t> numbers; ///< of the solutes in the scene's alloy
    cases::Alloy alloy;               ///< without the solutes that are absent
    cases::PhaseDiagram diagram;
    double expansion;       ///< density over the crystals'
    double eutectic_excess; ///< T_E - T_m (K), minus infinity for none
  };
} // namespace meltfront::particles

#endif
