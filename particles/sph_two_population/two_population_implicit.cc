#include <particles/sph_two_population/two_population_implicit.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meltfront::particles
{
  namespace
  {
    /** Solutions of a step, each with the volumes of the one before. */
    constexpr int volume_passes = 2;

    constexpr int most_iterations = 60;
    constexpr int most_linear_iterations = 500;

    /** Of a linear solve: residual over right-hand side. */
    constexpr double linear_tolerance = 1e-4;

    /** Of the residual over a tenth of a site's latent heat. */
    constexpr double relative_tolerance = 1e-10;

    /** How far beyond a kink, over a site's latent heat, it is put. */
    constexpr double beyond_kink_of_phases = 1e-13;
  } // namespace

  TwoPopulationImplicit::TwoPopulationImplicit(TwoPopulationFlow &flows, Sites &sites)
    : flows(flows)
    , sites(sites)
    , size(sites.liquid.mass.size())
    , krylov(2 * size, [this](std::span<const double> change, std::span<double> result)
             { apply(change, result); })
    , base(sites.is_dirichlet.size())
    , dissolved(sites.is_dirichlet.size())
  {
    for(auto *array : {&heat, &flow, &excess, &residual, &correction, &diagonal, &change})
      array->assign(2 * size, 0.);
    for(auto &array : slope)
      array.assign(2 * size, 0.);
  }

  bool TwoPopulationImplicit::take_step(double duration, double weight, double begin,
                                        double end, double &wall_heat)
  {
    const std::span<double> flows_in(flow);
    for(std::size_t a = 0; a < base.size(); ++a)
    {
      base[a] = sites.content(a);
      dissolved[a] = sites.dissolved(a);
    }
    if(weight < 1)
    {
      const double before = (1 - weight) * duration;
      wall_heat
          += before
             * flows.heat(begin, flows_in.first(size), flows_in.subspan(size, size));
      for(std::size_t a = 0; a < base.size(); ++a)
      {
        base[a].liquid_heat += before * flow[a];
        base[a].ice_heat += before * flow[size + a];
      }
    }
    flows.hold_walls(end);
    factor = weight * duration;
    std::fill(heat.begin(), heat.end(), 0.);
    for(int pass = 0; pass < volume_passes; ++pass)
    {
      if(!solve(end))
        return false;
      finish();
    }
    wall_heat += factor * through_walls;
    return true;
  }

  void TwoPopulationImplicit::finish()
  {
    // By the flows of the last iterate, whose exchange cancels to the last bit.
    for(std::size_t a = 0; a < base.size(); ++a)
      if(!sites.is_dirichlet[a])
      {
        SiteContent<double> site = base[a];
        site.liquid_heat += factor * flow[a];
        site.ice_heat += factor * flow[size + a];
        sites.set_content(a, site);
      }
    sites.change_phase();
  }

  template <typename SoluteOf>
  void TwoPopulationImplicit::respond(const SoluteOf &solute_of)
  {
    const SiteExchange &exchange = sites.phase_exchange();
    for(std::size_t a = 0; a < base.size(); ++a)
    {
      if(sites.is_dirichlet[a])
      {
        excess[a] = excess[size + a] = sites.ice.excess[a];
        continue;
      }
      SiteContent<DualNumber> site{
          base[a].liquid_mass, DualNumber(base[a].liquid_heat + heat[a], {1, 0}),
          base[a].ice_mass, DualNumber(base[a].ice_heat + heat[size + a], {0, 1})};
      exchange.settle(site, solute_of(dissolved[a]));
      const bool any_liquid = site.liquid_mass.value > 0;
      const bool any_ice = site.ice_mass.value > 0;
      const DualNumber liquid
          = any_liquid ? exchange.liquid_excess(site) : exchange.ice_excess(site);
      const DualNumber ice = any_ice ? exchange.ice_excess(site) : liquid;
      excess[a] = liquid.value;
      excess[size + a] = ice.value;
      for(std::size_t by = 0; by < 2; ++by)
      {
        slope[by][a] = liquid.slope[by];
        slope[by][size + a] = ice.slope[by];
      }
    }
  }

  double TwoPopulationImplicit::evaluate(double fraction)
  {
    sites.with_liquidus([this](const auto &solute_of) { respond(solute_of); });
    const std::span<const double> x(excess);
    const std::span<double> f(flow);
    through_walls = flows.heat_at(x.first(size), x.subspan(size, size), fraction,
                                  f.first(size), f.subspan(size, size));
    double largest = 0, zero = 0;
    for(std::size_t i = 0; i < 2 * size; ++i)
    {
      residual[i] = factor * flow[i] - heat[i];
      largest = std::max(largest, std::abs(residual[i]));
      zero += 0 * residual[i]; // not a number if the residual is not finite
    }
    return largest + zero;
  }

  bool TwoPopulationImplicit::solve(double fraction)
  {
    flows.linearise(fraction);
    const double scale = 0.1 * sites.site_mass * sites.phase_exchange().heat_of_melting();
    for(int iteration = 0;; ++iteration)
    {
      const double largest = evaluate(fraction);
      double stiffest = 1;
      for(std::size_t a = 0; a < size; ++a)
      {
        diagonal[a] = 1 - factor * flows.liquid_diagonal()[a] * slope[0][a];
        diagonal[size + a] = 1 - factor * flows.ice_diagonal()[a] * slope[1][size + a];
        stiffest = std::max({stiffest, diagonal[a], diagonal[size + a]});
      }
      const double rounding = 64 * std::numeric_limits<double>::epsilon() * stiffest;
      if(largest <= (relative_tolerance + rounding) * scale)
        return true;
      if(iteration == most_iterations || !std::isfinite(largest))
        return false;
      const int iterations = krylov
                                 .solve(diagonal, residual, correction, linear_tolerance,
                                        most_linear_iterations)
                                 .iterations;
      if(iterations == 0)
        return false;
      krylov_iterations += iterations;
      sites.with_liquidus([this](const auto &solute_of) { correct(solute_of); });
    }
  }

  template <typename SoluteOf>
  void TwoPopulationImplicit::correct(const SoluteOf &solute_of)
  {
    const SiteExchange &exchange = sites.phase_exchange();
    const double beyond
        = beyond_kink_of_phases * sites.site_mass * exchange.heat_of_melting();
    for(std::size_t a = 0; a < base.size(); ++a)
    {
      const double from
          = base[a].liquid_heat + base[a].ice_heat + heat[a] + heat[size + a];
      const double step = correction[a] + correction[size + a];
      double part = 1;
      for(const double kink : exchange.kinks(solute_of(dissolved[a])))
      {
        const double to_kink = kink - from;
        if(std::abs(to_kink) > 2 * beyond && to_kink * step > 0
           && std::abs(step) > std::abs(to_kink))
          part = std::min(part, (std::abs(to_kink) + beyond) / std::abs(step));
      }
      heat[a] += part * correction[a];
      heat[size + a] += part * correction[size + a];
    }
  }

  void TwoPopulationImplicit::apply(std::span<const double> given,
                                    std::span<double> result)
  {
    for(std::size_t a = 0; a < size; ++a)
    {
      change[a] = slope[0][a] * given[a] + slope[1][a] * given[size + a];
      change[size + a]
          = slope[0][size + a] * given[a] + slope[1][size + a] * given[size + a];
    }
    const std::span<const double> x(change);
    flows.apply_derivative(x.first(size), x.subspan(size, size), result.first(size),
                           result.subspan(size, size));
    for(std::size_t i = 0; i < 2 * size; ++i)
      result[i] = given[i] - factor * result[i];
  }
} // namespace meltfront::particles
