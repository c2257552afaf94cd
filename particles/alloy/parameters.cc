#include <cases/error.h>
#include <cases/scene.h>
#include <particles/alloy/parameters.h>

#include <fmt/format.h>

#include <algorithm>

namespace meltfront::particles
{
  namespace
  {
    const std::vector<std::string> mean_names{"integral", "arithmetic", "harmonic"};

    /** Of two populations, in the order of TimeScheme. */
    const std::vector<std::string> scheme_names{"euler", "rkl2", "backward-euler",
                                                "crank-nicolson"};

    int resolve_dimension(const std::string &method, const cases::Scene &scene,
                          long wanted, int of_slab)
    {
      if(scene.domain.shape == cases::DomainShape::shell
         || (scene.domain.outline
             && scene.boundary(cases::Side::outer).kind
                    != cases::BoundaryKind::insulated))
        throw cases::Refusal(fmt::format(
            "{} simulates slabs, boxes, balls and what an insulated outline bounds",
            method));
      if(scene.domain.shape == cases::DomainShape::slab)
        return wanted > 0 ? static_cast<int>(wanted) : of_slab;
      if(wanted > 0 && wanted != scene.domain.dimension)
        throw cases::Refusal(fmt::format(
            "{} simulates a box or a ball of {} dimensions in these, not in {}", method,
            scene.domain.dimension, wanted));
      return scene.domain.dimension;
    }

    cases::OptionDeclaration word(const std::string &key, const std::string &value,
                                  const std::string &description,
                                  const std::vector<std::string> &choices)
    {
      return {key, "", value, description, 0, 0, choices};
    }
  } // namespace

  namespace
  {
    /** The options of all methods for alloys that say where particles are. */
    std::vector<cases::OptionDeclaration>
    shared_options(const std::string &layout, bool moment_correction, double smoothing)
    {
      return {
          {"dimension", "1", 0L,
           "Dimension in which a slab is simulated; 0: the lowest (the paper's: 2).", 0,
           3},
          word("kernel", "cubic_spline", "Shape of the smoothing kernel.",
               smoothing_kernel_names()),
          {"smoothing", "1", smoothing, "Smoothing length over particle spacing.", 0.5,
           4},
          word("layout", layout,
               "Where the outermost particles are: half a spacing inside, or on the "
               "edge.",
               {"cell", "edge"}),
          {"moment_correction", "", moment_correction,
           "Divide the kernel's gradient by its second moment, so that the Laplacian of "
           "a quadratic is exact."},
          {"jitter", "1", 0.0,
           "Random displacement of each particle, in particle spacings and per "
           "direction.",
           0, 0.4},
      };
    }

    SphParameters shared_parameters(const cases::Resolution &resolution, int dimension)
    {
      const cases::Options &options = resolution.options;
      SphParameters p{};
      p.dimension = dimension;
      p.kernel = kernel_shape(options.get_string("kernel"));
      p.smoothing = options.get_double("smoothing");
      p.layout = options.get_string("layout") == "edge" ? LatticeLayout::on_edge
                                                        : LatticeLayout::cell_centred;
      p.moment_correction = options.get_bool("moment_correction");
      p.front = FrontRule::partner;
      p.time_scheme = TimeScheme::euler;
      p.step_factor = 1;
      p.jitter = options.get_double("jitter");
      p.seed = resolution.seed;
      p.threads = resolution.threads;
      p.n = resolution.n;
      return p;
    }
  } // namespace

  std::vector<cases::OptionDeclaration> mixture_options()
  {
    std::vector<cases::OptionDeclaration> options = shared_options("cell", true, 1.0);
    options.insert(
        options.end(),
        {word("conductivity", "integral",
              "Conductivity between two particles: its mean over the temperatures "
              "between them in equilibrium, which holds at sharp fronts as in a mush, or "
              "the arithmetic or harmonic mean of both.",
              mean_names),
         word(
             "time_scheme", "rkl2",
             "Explicit Euler steps, Runge-Kutta-Legendre super steps of second order, or "
             "implicit steps of first or second order.",
             time_scheme_names()),
         {"stages", "1", 8L, "Most stages of a super step.", 3, 64},
         {"step_factor", "1", 1.0,
          "Time step over the largest that keeps the maximum principle. More than 1 is "
          "for "
          "implicit steps only.",
          1e-6, 1e6},
         {"step_error", "1", 0.0,
          "Wanted relative error of each implicit step, which sets its length; 0: steps "
          "of equal length by step_factor.",
          0, 1}});
    return options;
  }

  MixtureParameters resolve_mixture_parameters(const cases::Scene &scene,
                                               const cases::Resolution &resolution)
  {
    const cases::Options &options = resolution.options;
    MixtureParameters result{};
    SphParameters &p = result.sph;
    p = shared_parameters(
        resolution,
        resolve_dimension("sph-mixture", scene, options.get_integer("dimension"), 1));
    p.time_scheme = time_scheme(options.get_string("time_scheme"));
    p.stages = static_cast<int>(options.get_integer("stages"));
    p.step_factor = options.get_double("step_factor");
    p.step_error = options.get_double("step_error");
    if(p.step_error > 0 && !is_implicit(p.time_scheme))
      throw cases::Refusal("sph-mixture chooses steps by a wanted error (step_error) for "
                           "the implicit schemes backward-euler and crank-nicolson only");
    const std::string &mean = options.get_string("conductivity");
    result.mean = mean == "arithmetic" ? MeanConductivity::arithmetic
                  : mean == "harmonic" ? MeanConductivity::harmonic
                                       : MeanConductivity::integral;
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
        "corrected",
        "site",
        "energy_function",
        "cell",
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
        "published",
        "kernel",
        "constant",
        "edge",
        false,
        1.3,
        0.15};
    return policy;
  }

  std::vector<cases::OptionDeclaration>
  two_population_options(const TwoPopulationPolicy &policy)
  {
    std::vector<cases::OptionDeclaration> options
        = shared_options(policy.layout, policy.moment_correction, policy.smoothing);
    options.insert(
        options.end(),
        {word("exchange", policy.exchange,
              "Exchange of heat between liquid and ice: so that both together conduct as "
              "a mush does, or as published.",
              {"corrected", "published"}),
         word("new_ice", policy.new_ice,
              "Where new ice goes: to its own site, or spread over the kernel.",
              {"site", "kernel"}),
         word("latent_heat", policy.latent_heat,
              "Heat of freezing below the melting point: L + (c_l - c_s)(T - T_m), with "
              "which the heat is a function of the state, or constant.",
              {"energy_function", "constant"}),
         {"step_factor", "1", policy.step_factor,
          policy.as_published ? "Time step over c rho h^2/k, the smaller of both phases'."
                              : "Time step over the largest that keeps the maximum "
                                "principle. More than 1 is for implicit steps only.",
          1e-6, 1e6}});
    if(!policy.as_published)
      options.insert(
          options.end(),
          {word("time_scheme", "euler",
                "Explicit Euler steps; Runge-Kutta-Legendre super steps of second order; "
                "implicit steps of any length by backward Euler or by Crank and "
                "Nicolson.",
                scheme_names),
           {"stages", "1", 8L, "Most stages of a super step.", 3, 64},
           {"steps", "1", 0L, "Equal steps of the run; 0: by step_factor.", 0,
            1000000000}});
    return options;
  }

  TwoPopulationParameters
  resolve_two_population_parameters(const TwoPopulationPolicy &policy,
                                    const cases::Scene &scene,
                                    const cases::Resolution &resolution)
  {
    const cases::Options &options = resolution.options;
    TwoPopulationParameters result{};
    result.name = policy.name;
    result.as_published = policy.as_published;
    result.sph = shared_parameters(resolution,
                                   resolve_dimension(policy.name, scene,
                                                     options.get_integer("dimension"),
                                                     policy.as_published ? 2 : 1));
    result.exchange = options.get_string("exchange") == "published"
                          ? PhaseExchange::published
                          : PhaseExchange::corrected;
    result.new_ice
        = options.get_string("new_ice") == "kernel" ? NewIce::kernel : NewIce::site;
    result.constant_latent_heat = options.get_string("latent_heat") == "constant";
    result.sph.step_factor = options.get_double("step_factor");
    result.sph.whole_cells = true;
    if(policy.as_published)
      return result;
    result.sph.time_scheme
        = static_cast<TimeScheme>(std::find(scheme_names.begin(), scheme_names.end(),
                                            options.get_string("time_scheme"))
                                  - scheme_names.begin());
    result.sph.stages = static_cast<int>(options.get_integer("stages"));
    result.sph.steps = static_cast<int>(options.get_integer("steps"));
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
