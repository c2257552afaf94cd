#include <particles/alloy/wall_variable.h>
#include <particles/sph/conduction_spectrum.h>
#include <particles/sph/effective_conductivity.h>
#include <particles/sph_two_population/two_population_exchange.h>
#include <particles/sph_two_population/two_population_flow.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles
{
  using cases::Effect;

  namespace
  {
    /** H(p, q) <= 2 p for what a particle exchanges with either population, while its own
     * heat capacity goes with p: rows up to four times those of one conductivity. */
    constexpr double published_excess = 4;
  } // namespace

  TwoPopulationFlow::TwoPopulationFlow(const Discretisation &dis,
                                       const AlloySubstance &substance,
                                       const cases::EffectSet &effects,
                                       const TwoPopulationParameters &parameters,
                                       Sites &sites)
    : effects(effects)
    , substance(substance)
    , parameters(parameters)
    , sites(sites)
    , volume(dis.particle_volume)
    , threads(1)
    , path(substance)
    , rows(dis, parameters.sph.moment_correction)
    , self_strength(-2 * volume * volume * dis.kernel.radial_derivative_over_distance(0)
                    / rows.second_moment)
    , wall_excess(excess_variable(substance.material))
  {
    require_true_conductivity(dis, rows.rows);
    if(effects.contains(Effect::solute_diffusion) && substance.diffuses())
      diffusion.emplace(dis, parameters.sph, substance, rows.rows);
    if(effects.contains(Effect::wall_temperature))
      wall_temperature.emplace(dis, rows, wall_excess);
  }

  void TwoPopulationFlow::prepare_step(double begin, double end)
  {
    if(wall_temperature)
      wall_temperature->prepare_step(begin, end);
  }

  void TwoPopulationFlow::hold_walls(double fraction)
  {
    if(!wall_temperature)
      return;
    const double melting = substance.material.melting_temperature;
    wall_temperature->hold(fraction, sites.ice.excess,
                           [melting](std::uint32_t, double temperature)
                           { return temperature - melting; });
  }

  template <typename Visitor>
  void TwoPopulationFlow::with_path(const Visitor &visitor) const
  {
    if(const CurvedLiquidus *curve = sites.curved_liquidus())
      visitor([this, curve](double excess, std::size_t site)
              { return curve->solid_path(excess, sites.concentration[0][site]); });
    else
      visitor([this](double excess, std::size_t site)
              { return path.whole(excess, sites.depression[site]); });
  }

  template <typename Path>
  double TwoPopulationFlow::wall_solid_share(std::size_t site, double wall,
                                             const Path &solid_path) const
  {
    // Such that the mean of both shares is that over the temperatures between site and
    // wall, along the equilibrium of the site's composition.
    const double own = sites.liquid.excess[site], lowered = sites.depression[site];
    const double difference = wall - own;
    if(std::abs(difference) < 1e-6 * lowered)
      return sites.ice.share[site];
    const double mean = (solid_path(wall, site) - solid_path(own, site)) / difference;
    return std::clamp(2 * mean - sites.ice.share[site], 0., 1.);
  }

  template <typename Path>
  double TwoPopulationFlow::other_share_of_wall(bool of_ice, std::size_t site,
                                                double wall, const Path &solid_path) const
  {
    const double solid = wall_solid_share(site, wall, solid_path);
    return of_ice ? 1 - solid : solid;
  }

  template <typename Pair>
  void TwoPopulationFlow::pass(const Pair &pair, std::span<double> flow)
  {
    rows.rows.apply_pairs(pair, flow, threads);
    for(std::size_t a = 0; a < rows.rows.rows(); ++a)
      flow[a] += self_strength * pair.at_site(a);
  }

  template <typename Pair>
  double TwoPopulationFlow::population_heat(const Pair &pair, double fraction,
                                            std::span<double> flow)
  {
    pass(pair, flow);
    double heat = 0;
    if(wall_temperature)
      with_path(
          [&](const auto &solid_path)
          {
            heat = wall_temperature->add(
                [&](std::size_t row, double wall)
                {
                  return pair.from_wall(
                      row, wall, other_share_of_wall(pair.of_ice, row, wall, solid_path));
                },
                fraction, flow);
          });
    return heat;
  }

  CorrectedPair TwoPopulationFlow::to_liquid_pair(const double *liquid,
                                                  const double *ice) const
  {
    const double k_l = substance.material.liquid.conductivity;
    const double k_s = substance.material.solid.conductivity;
    return {{sites.liquid, liquid}, {sites.ice, ice}, false, k_l, 0.5 * (k_l + k_s)};
  }

  CorrectedPair TwoPopulationFlow::to_ice_pair(const double *liquid,
                                               const double *ice) const
  {
    const double k_l = substance.material.liquid.conductivity;
    const double k_s = substance.material.solid.conductivity;
    return {{sites.ice, ice}, {sites.liquid, liquid}, true, k_s, 0.5 * (k_l + k_s)};
  }

  double TwoPopulationFlow::heat_at(std::span<const double> liquid_excess,
                                    std::span<const double> ice_excess, double fraction,
                                    std::span<double> to_liquid, std::span<double> to_ice)
  {
    ++evaluations;
    const double *liquid = liquid_excess.data(), *ice = ice_excess.data();
    return population_heat(to_liquid_pair(liquid, ice), fraction, to_liquid)
           + population_heat(to_ice_pair(liquid, ice), fraction, to_ice);
  }

  double TwoPopulationFlow::heat(double fraction, std::span<double> to_liquid,
                                 std::span<double> to_ice)
  {
    if(parameters.exchange == PhaseExchange::corrected)
      return heat_at(sites.liquid.excess, sites.ice.excess, fraction, to_liquid, to_ice);
    ++evaluations;
    const PopulationView liquid(sites.liquid), ice(sites.ice);
    const double k_l = substance.material.liquid.conductivity;
    const double k_s = substance.material.solid.conductivity;
    const double *solid = sites.solid_volume.data();
    return population_heat(PublishedPair{liquid, ice, solid, false, k_l, k_s}, fraction,
                           to_liquid)
           + population_heat(PublishedPair{ice, liquid, solid, true, k_s, k_l}, fraction,
                             to_ice);
  }

  void TwoPopulationFlow::linearise(double fraction)
  {
    const double *liquid = sites.liquid.excess.data(), *ice = sites.ice.excess.data();
    set_diagonal(to_liquid_pair(liquid, ice), fraction, wall_slope[0], diagonal[0]);
    set_diagonal(to_ice_pair(liquid, ice), fraction, wall_slope[1], diagonal[1]);
  }

  void TwoPopulationFlow::set_diagonal(const CorrectedPair &pair, double fraction,
                                       std::vector<double> &wall_rate,
                                       std::vector<double> &diagonal)
  {
    wall_rate.assign(rows.rows.padded_rows(), 0.);
    diagonal.resize(rows.rows.padded_rows());
    if(wall_temperature)
      with_path(
          [&](const auto &solid_path)
          {
            wall_temperature->differentiate(
                [&](std::size_t row, double wall)
                {
                  return -pair.wall_conductivity(
                      row, other_share_of_wall(pair.of_ice, row, wall, solid_path));
                },
                fraction, wall_rate);
          });
    pass(CorrectedPairSlope{pair}, diagonal);
    for(std::size_t a = 0; a < diagonal.size(); ++a)
      diagonal[a] = wall_rate[a] - diagonal[a];
    if(wall_temperature)
      for(const std::uint32_t row : wall_temperature->dirichlet_rows())
        diagonal[row] = 0;
  }

  void TwoPopulationFlow::apply_derivative(std::span<const double> liquid_change,
                                           std::span<const double> ice_change,
                                           std::span<double> to_liquid,
                                           std::span<double> to_ice)
  {
    ++evaluations;
    const double *liquid = liquid_change.data(), *ice = ice_change.data();
    pass(to_liquid_pair(liquid, ice), to_liquid);
    pass(to_ice_pair(liquid, ice), to_ice);
    for(std::size_t a = 0; a < rows.rows.rows(); ++a)
    {
      to_liquid[a] += wall_slope[0][a] * liquid[a];
      to_ice[a] += wall_slope[1][a] * ice[a];
    }
    if(wall_temperature)
      for(const std::uint32_t row : wall_temperature->dirichlet_rows())
        to_liquid[row] = to_ice[row] = 0;
  }

  void TwoPopulationFlow::follow()
  {
    composition.assign(sites.concentration.begin(), sites.concentration.end());
    diffusion->follow(sites.liquid_fraction, sites.depression, composition);
  }

  void TwoPopulationFlow::solute(std::size_t solute, std::span<double> flow)
  {
    diffusion->flow(solute, rows.rows, flow, threads);
  }

  double TwoPopulationFlow::monotone_step() const
  {
    const cases::Material &m = substance.material;
    const double heat_rate
        = substance.largest_conductivity() * (rows.largest_row_sum + self_strength)
          * (parameters.exchange == PhaseExchange::published ? published_excess : 1);
    const double capacity
        = std::min(substance.density * m.liquid.specific_heat_capacity,
                   sites.crystal_density * m.solid.specific_heat_capacity);
    double step = volume * capacity / heat_rate;
    if(diffusion)
      step = std::min(step, solute_step());
    return step;
  }

  StepLimits TwoPopulationFlow::step_limits(const cases::Scene &scene, StepLimit asked,
                                            std::span<const std::uint32_t> held) const
  {
    StepLimits limits{monotone_step()};
    if(asked == StepLimit::monotone)
      return limits;
    limits.stable
        = stable_step(scene, volume * substance.density, largest_eigenvalue(rows, held));
    if(diffusion)
      limits.stable = std::min(limits.stable, solute_step());
    return limits;
  }

  long TwoPopulationFlow::work() const
  {
    // Both populations pass over the rows, and meet both at each neighbour.
    std::size_t per_evaluation = 4 * rows.rows.interactions();
    if(wall_temperature)
      per_evaluation += 2 * wall_temperature->size();
    return evaluations * static_cast<long>(per_evaluation) + sites.work
           + (diffusion ? diffusion->work() : 0);
  }

  std::vector<cases::EffectCost>
  TwoPopulationFlow::effect_costs(std::size_t per_solute) const
  {
    std::vector<cases::EffectCost> costs = sites.costs(effects, per_solute);
    if(diffusion)
      costs.push_back(diffusion->cost(0));
    if(wall_temperature)
      costs.push_back(wall_temperature->cost());
    return costs;
  }
} // namespace meltfront::particles
