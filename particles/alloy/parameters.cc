#include <cases/error.h>
#include <cases/scene.h>
#include <particles/alloy/parameters.h>

#include <fmt/format.h>

#include <algorithm>

namespace meltfront::particles
{
  namespace
  {
    int resolve_dimension(const std::string &method, const cases::Scene &scene,
                          int wanted, int of_slab)
    {
      if(scene.domain.shape == cases::DomainShape::shell
         || (scene.domain.outline
             && scene.boundary(cases::Side::outer).kind
                    != cases::BoundaryKind::insulated))
        throw cases::Refusal(fmt::format(
            "{} simulates slabs, boxes, balls and what an insulated outline bounds",
            method));
      if(scene.domain.shape == cases::DomainShape::slab)
        return wanted > 0 ? wanted : of_slab;
      if(wanted > 0 && wanted != scene.domain.dimension)
        throw cases::Refusal(fmt::format(
            "{} simulates a box or a ball of {} dimensions in these, not in {}", method,
            scene.domain.dimension, wanted));
      return scene.domain.dimension;
    }

    /** The options of all methods for alloys that say where particles are. */
    void bind_shared(SphParameters &p, cases::OptionBinder &options)
    {
      options.add("dimension", p.dimension,
                  "Dimension in which a slab is simulated; 0: the lowest (the paper's: "
                  "2).",
                  0, 3);
      options.add("kernel", p.kernel, "Shape of the smoothing kernel.",
                  smoothing_kernels());
      options.add("smoothing", p.smoothing, "Smoothing length over particle spacing.",
                  0.5, 4);
      options.add("layout", p.layout,
                  "Where the outermost particles are: half a spacing inside, or on the "
                  "edge.",
                  layouts());
      options.add("moment_correction", p.moment_correction,
                  "Divide the kernel's gradient by its second moment, so that the "
                  "Laplacian of a quadratic is exact.");
      options.add("jitter", p.jitter,
                  "Random displacement of each particle, in particle spacings and per "
                  "direction.",
                  0, 0.4);
    }

    void resolve_shared(SphParameters &p, const cases::Resolution &resolution)
    {
      p.seed = resolution.seed;
      p.threads = resolution.threads;
      p.n = resolution.n;
    }
  } // namespace

  MixtureParameters::MixtureParameters()
  {
    sph.time_scheme = TimeScheme::rkl2;
  }

  void MixtureParameters::bind(cases::OptionBinder &options)
  {
    bind_shared(sph, options);
    options.add("conductivity", mean,
                "Conductivity between two particles: its mean over the temperatures "
                "between them in equilibrium, which holds at sharp fronts as in a mush, "
                "or the arithmetic or harmonic mean of both.",
                {{"integral", MeanConductivity::integral},
                 {"arithmetic", MeanConductivity::arithmetic},
                 {"harmonic", MeanConductivity::harmonic}});
    options.add("time_scheme", sph.time_scheme,
                "Explicit Euler steps, Runge-Kutta-Legendre super steps of second order, "
                "or implicit steps of first or second order.",
                cases::in_order<TimeScheme>(time_scheme_names()));
    options.add("stages", sph.stages, "Most stages of a super step.", 3, 64);
    options.add(
        "step_factor", sph.step_factor,
        "Time step over the largest that keeps the maximum principle. More than 1 "
        "is for implicit steps only.",
        1e-6, 1e6);
    options.add("step_error", sph.step_error,
                "Wanted relative error of each implicit step, which sets its length; 0: "
                "steps of equal length by step_factor.",
                0, 1);
  }

  MixtureParameters resolve_mixture_parameters(const cases::Scene &scene,
                                               const cases::Resolution &resolution)
  {
    auto result = cases::read_options(MixtureParameters(), resolution.options);
    SphParameters &p = result.sph;
    resolve_shared(p, resolution);
    p.dimension = resolve_dimension("sph-mixture", scene, p.dimension, 1);
    if(p.step_error > 0 && !is_implicit(p.time_scheme))
      throw cases::Refusal("sph-mixture chooses steps by a wanted error (step_error) for "
                           "the implicit schemes backward-euler and crank-nicolson only");
    return result;
  }

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
    sph.smoothing = policy.smoothing;
    sph.step_factor = policy.step_factor;
    sph.whole_cells = true;
  }

  void TwoPopulationParameters::bind(cases::OptionBinder &options)
  {
    bind_shared(sph, options);
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
      return;
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
    resolve_shared(result.sph, resolution);
    result.sph.dimension = resolve_dimension(policy.name, scene, result.sph.dimension,
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
