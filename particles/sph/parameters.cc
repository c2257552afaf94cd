#include <cases/error.h>
#include <cases/scene.h>
#include <particles/sph/parameters.h>

#include <fmt/format.h>

#include <algorithm>

namespace meltfront::particles
{
  namespace
  {
    /** In the order of the enumeration. */
    const std::vector<std::string> &arrangement_names()
    {
      static const std::vector<std::string> names{"lattice", "jittered", "relaxed",
                                                  "random", "lennard-jones"};
      return names;
    }

  } // namespace

  const std::vector<std::string> &time_scheme_names()
  {
    static const std::vector<std::string> names{"euler", "rkl2", "backward-euler",
                                                "crank-nicolson"};
    return names;
  }

  cases::Words<KernelShape> smoothing_kernels()
  {
    cases::Words<KernelShape> words;
    for(const std::string &name : smoothing_kernel_names())
      words.emplace_back(name, kernel_shape(name));
    return words;
  }

  cases::Words<LatticeLayout> layouts()
  {
    return {{"cell", LatticeLayout::cell_centred}, {"edge", LatticeLayout::on_edge}};
  }

  void bind_step_limit(SphParameters &parameters, cases::OptionBinder &options)
  {
    options.add("step_limit", parameters.step_limit,
                "What step_factor is a multiple of: the largest explicit step that keeps "
                "the maximum principle, beyond which runs are refused; or the linear "
                "stability limit 2/lambda_max of the assembled rows, with no guard: what "
                "is unstable is left to the checks of the run.",
                {{"monotone", StepLimit::monotone}, {"stability", StepLimit::stability}});
  }

  const SphPolicy &corrected_policy()
  {
    static const SphPolicy policy{
        "sph",
        "Smoothed particle hydrodynamics on enthalpy, corrected: exact second moment, "
        "fronts placed within particles, mirrored walls.",
        "",
        false,
        LatticeLayout::cell_centred,
        FrontRule::automatic,
        true,
        1.0,
        TimeScheme::rkl2,
        1.0};
    return policy;
  }

  const SphPolicy &published_policy()
  {
    static const SphPolicy policy{
        "sph-2005",
        "Smoothed particle hydrodynamics as Monaghan, Huppert and Worster (2005) "
        "computed.",
        "sph",
        true,
        LatticeLayout::on_edge,
        FrontRule::liquid,
        false,
        0.0,
        TimeScheme::euler,
        0.0};
    return policy;
  }

  SphOptions::SphOptions(const SphPolicy &policy)
  {
    values.layout = policy.layout;
    values.front = policy.front;
    values.moment_correction = policy.moment_correction;
    values.smoothing_length = policy.smoothing_length;
    values.time_scheme = policy.time_scheme;
    values.step_factor = policy.step_factor;
    values.arrangement = Arrangement::jittered;
    values.whole_cells = policy.as_published;
  }

  void SphOptions::bind(cases::OptionBinder &options)
  {
    options.add("dimension", values.dimension,
                "Dimension in which a slab is simulated; 0: the lowest (the paper's: 2).",
                0, 3);
    options.add("kernel", values.kernel, "Shape of the smoothing kernel.",
                smoothing_kernels());
    options.add("smoothing_length", values.smoothing_length,
                "Smoothing length over particle spacing; 0: as the paper, 1.2 in planar "
                "scenes and 1.3 in others.",
                0, 4);
    options.add("layout", values.layout,
                "Where the outermost particles are: half a spacing inside, or on the "
                "edge.",
                layouts());
    options.add(
        "moment_correction", values.moment_correction,
        "Divide the kernel's gradient by its second moment, so that the Laplacian "
        "of a quadratic is exact.");
    options.add("front", values.front,
                "Exchange of heat at a front: with the front at its place within the "
                "melting particle, as that particle's own solid fraction says "
                "(sub_particle) or as a line or plane through the particles about it "
                "(plane: two or three dimensions, a lattice whose kernel reaches the "
                "nearest particles, explicit steps; automatic: where that is so), with a "
                "melting particle conducting as its partner, or as the liquid until it "
                "has frozen.",
                {{"automatic", FrontRule::automatic},
                 {"sub_particle", FrontRule::sub_particle},
                 {"plane", FrontRule::plane},
                 {"partner", FrontRule::partner},
                 {"liquid", FrontRule::liquid}});
    cases::Words<TimeScheme> schemes = cases::in_order<TimeScheme>(time_scheme_names());
    schemes.emplace_back("automatic", TimeScheme::automatic);
    options.add(
        "time_scheme", values.time_scheme,
        "Explicit Euler steps, Runge-Kutta-Legendre super steps of second order, "
        "implicit steps of first or second order; automatic: along a line steps as "
        "long as an error allows, by super steps or two implicit stages, whichever "
        "costs less, elsewhere equal super steps.",
        schemes);
    options.add("stages", values.stages,
                "Most stages of a super step, where steps are equal.", 3, 64);
    options.add("step_factor", values.step_factor,
                "Time step over the largest that keeps the maximum principle; 0: as the "
                "paper, 0.15 c rho h^2/k. More than 1 is for implicit steps only.",
                0, 1e6);
    bind_step_limit(values, options);
    options.add(
        "step_error", values.step_error,
        "Wanted relative error of each implicit step, which sets its length; of "
        "automatic the share of a particle by which a front may be elsewhere after "
        "a step of first order; 0: steps of equal length by step_factor, of "
        "automatic 0.01.",
        0, 1);
    options.add("refine", refines_time,
                "What n is the number of: particles along the side, or equal steps in "
                "time.",
                {{"space", false}, {"time", true}});
    options.add(
        "cells", cells,
        "Particles, each for a cell, along the side where n is the number of steps.", 5,
        1e6);
    options.add("arrangement", values.arrangement,
                "Particles on a lattice, displaced from it by `jitter` (by nothing if "
                "that is 0), or relaxed after that until they crowd nowhere; in a box "
                "also random, or moved from there to a minimum of the Lennard-Jones "
                "energy.",
                cases::in_order<Arrangement>(arrangement_names()));
    options.add("jitter", values.jitter,
                "Random displacement of each particle, in particle spacings and per "
                "direction.",
                0, 0.4);
  }

  namespace
  {
    /** @throws Refusal for a jitter that the arrangement has no use for. */
    void require_jitter(const SphPolicy &policy, Arrangement arrangement, double jitter)
    {
      if(arrangement == Arrangement::lattice && jitter > 0)
        throw cases::Refusal(fmt::format(
            "{} does not displace particles from a lattice: jitter has to be 0",
            policy.name));
      if(arrangement == Arrangement::relaxed && jitter == 0)
        throw cases::Refusal(fmt::format(
            "{} relaxes particles that are displaced: jitter has to be positive",
            policy.name));
      if(arrangement >= Arrangement::random && jitter > 0)
        throw cases::Refusal(fmt::format(
            "{} does not displace random particles: jitter has to be 0", policy.name));
    }

    int resolve_dimension(const SphPolicy &policy, const cases::Scene &scene, long wanted)
    {
      if(scene.domain.shape == cases::DomainShape::slab)
        return wanted > 0 ? static_cast<int>(wanted) : (policy.as_published ? 2 : 1);
      if(wanted > 0 && wanted != scene.domain.dimension)
        throw cases::Refusal(
            fmt::format("{} simulates this scene of {} dimensions in these, not in {}",
                        policy.name, scene.domain.dimension, wanted));
      return scene.domain.dimension;
    }
  } // namespace

  SphParameters resolve_parameters(const SphPolicy &policy, const cases::Scene &scene,
                                   const cases::Resolution &resolution)
  {
    const auto options = cases::read_options(SphOptions(policy), resolution.options);
    const bool in_time = options.refines_time;
    SphParameters p = options.values;
    p.dimension = resolve_dimension(policy, scene, p.dimension);
    p.n = in_time ? options.cells : resolution.n;
    p.steps = in_time ? resolution.n : 0;
    p.columns = policy.as_published ? p.n : 0;
    if(p.smoothing_length == 0)
      p.smoothing_length = scene.symmetry == cases::Symmetry::planar ? 1.2 : 1.3;
    if(p.step_error > 0 && !is_implicit(p.time_scheme)
       && p.time_scheme != TimeScheme::automatic)
      throw cases::Refusal(fmt::format(
          "{} chooses steps by a wanted error (step_error) for the implicit schemes "
          "backward-euler and crank-nicolson, and for automatic, only",
          policy.name));
    if(p.step_error > 0 && in_time)
      throw cases::Refusal(fmt::format(
          "{} takes as many steps as n says or as step_error asks for, not both",
          policy.name));
    require_jitter(policy, p.arrangement, p.jitter);
    p.seed = resolution.seed;
    p.threads = resolution.threads;
    return p;
  }
} // namespace meltfront::particles
