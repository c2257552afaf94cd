#include <cases/error.h>
#include <cases/scene.h>
#include <particles/alloy/options.h>
#include <particles/sph_two_population/parameters.h>

#include <fmt/format.h>

namespace meltfront::particles
{
  const TwoPopulationPolicy &corrected_two_population()
  {
    static const TwoPopulationPolicy policy{
        "sph-two-population",
        "Smoothed particle hydrodynamics of alloys with particles of liquid and of ice "
        "at "
        "each site, whose exchange of heat conducts as a mush does.",
        "",
        false,
        PhaseExchange::corrected,
        NewIce::site,
        false,
        LatticeLayout::cell_centred,
        true,
        1.0,
        1.0};
    return policy;
  }

  const TwoPopulationPolicy &published_two_population()
  {
    static const TwoPopulationPolicy policy{
        "sph-two-population-2005",
        "Particles of liquid and of ice as Monaghan, Huppert and Worster (2005) "
        "published "
        "them, misprints corrected: conducts too much, so that it does not converge to "
        "the mushy layer's solution.",
        "sph-two-population",
        true,
        PhaseExchange::published,
        NewIce::kernel,
        true,
        LatticeLayout::on_edge,
        false,
        1.3,
        0.15};
    return policy;
  }

  TwoPopulationParameters::TwoPopulationParameters(const TwoPopulationPolicy &policy)
    : name(policy.name)
    , as_published(policy.as_published)
    , exchange(policy.exchange)
    , new_ice(policy.new_ice)
    , constant_latent_heat(policy.constant_latent_heat)
  {
    sph.layout = policy.layout;
    sph.moment_correction = policy.moment_correction;
    sph.smoothing_length = policy.smoothing_length;
    sph.step_factor = policy.step_factor;
    sph.whole_cells = true;
  }

  void TwoPopulationParameters::bind(cases::OptionBinder &options)
  {
    bind_alloy_options(sph, options);
    options.add("exchange", exchange,
                "Exchange of heat between liquid and ice: so that both together conduct "
                "as a mush does, or as published.",
                {{"corrected", PhaseExchange::corrected},
                 {"published", PhaseExchange::published}});
    options.add("new_ice", new_ice,
                "Where new ice goes: to its own site, or spread over the kernel.",
                {{"site", NewIce::site}, {"kernel", NewIce::kernel}});
    options.add(
        "latent_heat", constant_latent_heat,
        "Heat of freezing below the melting point: L + (c_l - c_s)(T - T_m), with "
        "which the heat is a function of the state, or constant.",
        {{"energy_function", false}, {"constant", true}});
    options.add("step_factor", sph.step_factor,
                as_published ? "Time step over c rho h^2/k, the smaller of both phases'."
                             : "Time step over the largest that keeps the maximum "
                               "principle. More than 1 is for implicit steps only.",
                1e-6, 1e6);
    if(as_published)
    {
      options.add("step_limit", sph.step_limit,
                  "Steps no longer than the largest that keeps the maximum principle; or "
                  "of step_factor with no guard, as printed, which breaks bounds where a "
                  "particle has little mass.",
                  {{"monotone", StepLimit::monotone}, {"printed", StepLimit::stability}});
      return;
    }
    bind_step_limit(sph, options);
    options.add("time_scheme", sph.time_scheme,
                "Explicit Euler steps; Runge-Kutta-Legendre super steps of second order; "
                "implicit steps of any length by backward Euler or by Crank and "
                "Nicolson.",
                cases::in_order<TimeScheme>(time_scheme_names()));
    options.add("stages", sph.stages, "Most stages of a super step.", 3, 64);
    options.add("steps", sph.steps, "Equal steps of the run; 0: by step_factor.", 0, 1e9);
  }

  TwoPopulationParameters
  resolve_two_population_parameters(const TwoPopulationPolicy &policy,
                                    const cases::Scene &scene,
                                    const cases::Resolution &resolution)
  {
    auto result
        = cases::read_options(TwoPopulationParameters(policy), resolution.options);
    resolve_alloy_options(result.sph, policy.name, scene, resolution,
                          policy.as_published ? 2 : 1);
    if(result.sph.time_scheme != TimeScheme::euler
       && (result.exchange == PhaseExchange::published || result.new_ice == NewIce::kernel
           || result.constant_latent_heat))
      throw cases::Refusal(fmt::format(
          "{} takes super steps and implicit steps only with exchange = corrected, "
          "new_ice = site and latent_heat = energy_function",
          policy.name));
    return result;
  }
} // namespace meltfront::particles
