#include <particles/sph/time/implicit_heat_flow.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles
{
  namespace
  {
    /** How far beyond a kink, over the latent heat, a particle is put. */
    constexpr double beyond_kink = 1e-13;
  } // namespace

  ImplicitHeatFlow::ImplicitHeatFlow(HeatFlow &heat_flow, const cases::Material &material,
                                     std::size_t particles)
    : heat_flow(heat_flow)
    , latent_heat(material.curves ? material.curves->jump() : material.latent_heat)
    , n(particles)
  {
    if(!material.melting_range)
      return;
    if(latent_heat == 0)
      ends_of_range.push_back(0);
    ends_of_range.push_back(material.enthalpy(material.melting_range->liquidus));
  }

  double ImplicitHeatFlow::evaluate(std::span<const double> enthalpy, double fraction,
                                    std::span<double> flow)
  {
    heat_flow.follow(enthalpy);
    return heat_flow.evaluate(enthalpy, fraction, flow);
  }

  double ImplicitHeatFlow::largest_sensible_heat(std::span<const double> enthalpy) const
  {
    double sensible = 1e-3 * latent_heat;
    for(std::size_t a = 0; a < n; ++a)
      sensible = std::max({sensible, -enthalpy[a], enthalpy[a] - latent_heat});
    return sensible;
  }

  double ImplicitHeatFlow::stop_at_kink(double from, double to) const
  {
    // Of a jump's ends see below; a path crosses what it meets first.
    for(const double kink : ends_of_range)
    {
      // A little beyond it, so that the next iteration is on the other branch.
      const double beyond = beyond_kink * ends_of_range.back();
      if(from < kink - beyond && to > kink)
        return kink + beyond;
      if(from > kink + beyond && to < kink)
        return kink - beyond;
    }
    if(latent_heat == 0)
      return to;
    const double beyond = beyond_kink * latent_heat;
    if(from < 0 && to > latent_heat)
      return 0;
    if(from > latent_heat && to < 0)
      return latent_heat;
    if(from < 0 && to > 0)
      return 0;
    if(from > latent_heat && to < latent_heat)
      return latent_heat;
    if(from >= 0 && from <= latent_heat)
      return std::clamp(to, -beyond, latent_heat + beyond);
    return to;
  }

  void ImplicitHeatFlow::correct(std::span<const double> correction,
                                 std::span<double> enthalpy) const
  {
    for(std::size_t a = 0; a < enthalpy.size(); ++a)
      enthalpy[a] = stop_at_kink(enthalpy[a], enthalpy[a] + correction[a]);
  }
} // namespace meltfront::particles
