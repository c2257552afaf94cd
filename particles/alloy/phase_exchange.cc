#include <particles/alloy/phase_exchange.h>

namespace meltfront::particles
{
  SiteExchange::SiteExchange(const AlloySubstance &substance, double site_mass,
                             bool constant_latent_heat, bool equilibrium)
    : diagram(&substance.diagram)
    , site_mass(site_mass)
    , melting_temperature(substance.material.melting_temperature)
    , latent_heat(substance.material.latent_heat)
    , c_s(substance.material.solid.specific_heat_capacity)
    , c_l(substance.material.liquid.specific_heat_capacity)
    , eutectic_temperature(melting_temperature + substance.eutectic_excess)
    , eutectic_excess(substance.eutectic_excess)
    // 1 - r (1 - f) < f/2, r the density over the crystals'.
    , crowded(substance.expansion > 1
                  ? (substance.expansion - 1) / (substance.expansion - 0.5)
                  : 0.)
    , constant_latent_heat(constant_latent_heat)
    , equilibrium(equilibrium
                  && (crowded > 0 || std::isfinite(substance.eutectic_excess)))
  {
  }
} // namespace meltfront::particles
