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

    /** The enumerator that a word stands for. */
    template <typename Enumeration>
    Enumeration choice(const std::vector<std::string> &names, const std::string &name)
    {
      return static_cast<Enumeration>(std::find(names.begin(), names.end(), name)
                                      - names.begin());
    }
  } // namespace

  const std::vector<std::string> &time_scheme_names()
  {
    static const std::vector<std::string> names{"euler", "rkl2", "backward-euler",
                                                "crank-nicolson"};
    return names;
  }

  TimeScheme time_scheme(const std::string &name)
  {
    return choice<TimeScheme>(time_scheme_names(), name);
  }

  const SphPolicy &corrected_policy()
  {
    static const SphPolicy policy{
        "sph",
        "Smoothed particle hydrodynamics on enthalpy, corrected: exact second moment, "
        "fronts placed within particles, mirrored walls.",
        "",
        false,
        "cell",
        "sub_particle",
        true,
        1.0,
        "rkl2",
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
        "edge",
        "liquid",
        false,
        0.0,
        "euler",
        0.0};
    return policy;
  }

  std::vector<cases::OptionDeclaration> sph_options(const SphPolicy &policy)
  {
    return {
        {"dimension", "1", 0L,
         "Dimension in which a slab is simulated; 0: the lowest (the paper's: 2).", 0, 3},
        {"kernel", "", std::string("cubic_spline"), "Shape of the smoothing kernel.", 0,
         0, smoothing_kernel_names()},
        {"smoothing", "1", policy.smoothing,
         "Smoothing length over particle spacing; 0: as the paper, 1.2 in planar scenes "
         "and 1.3 in others.",
         0, 4},
        {"layout", "", policy.layout,
         "Where the outermost particles are: half a spacing inside, or on the edge.", 0,
         0, std::vector<std::string>{"cell", "edge"}},
        {"moment_correction", "", policy.moment_correction,
         "Divide the kernel's gradient by its second moment, so that the Laplacian of a "
         "quadratic is exact."},
        {"front", "", policy.front,
         "Exchange of heat at a front: with the front at its place within the melting "
         "particle, with a melting particle conducting as its partner, or as the liquid "
         "until it has frozen.",
         0, 0, std::vector<std::string>{"sub_particle", "partner", "liquid"}},
        {"time_scheme", "", policy.time_scheme,
         "Explicit Euler steps, Runge-Kutta-Legendre super steps of second order, or "
         "implicit steps of first or second order.",
         0, 0, time_scheme_names()},
        {"stages", "1", 8L, "Most stages of a super step.", 3, 64},
        {"step_factor", "1", policy.step_factor,
         "Time step over the largest that keeps the maximum principle; 0: as the paper, "
         "0.15 c rho h^2/k. More than 1 is for implicit steps only.",
         0, 1e6},
        {"step_error", "1", 0.0,
         "Wanted relative error of each implicit step, which sets its length; 0: steps "
         "of equal length by step_factor.",
         0, 1},
        {"refine", "", std::string("space"),
         "What n is the number of: particles along the side, or equal steps in time.", 0,
         0, std::vector<std::string>{"space", "time"}},
        {"particles", "1", 80L,
         "Particles along the side where n is the number of steps.", 5, 1e6},
        {"arrangement", "", std::string("jittered"),
         "Particles on a lattice, displaced from it by `jitter` (by nothing if that is "
         "0), or relaxed after that until they crowd nowhere; in a box also random, or "
         "moved from there to a minimum of the Lennard-Jones energy.",
         0, 0, arrangement_names()},
        {"jitter", "1", 0.0,
         "Random displacement of each particle, in particle spacings and per direction.",
         0, 0.4},
    };
  }

  namespace
  {
    FrontRule front_rule(const std::string &name)
    {
      if(name == "sub_particle")
        return FrontRule::sub_particle;
      return name == "partner" ? FrontRule::partner : FrontRule::liquid;
    }

    Arrangement resolve_arrangement(const SphPolicy &policy, const std::string &name,
                                    double jitter)
    {
      const auto arrangement = choice<Arrangement>(arrangement_names(), name);
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
      return arrangement;
    }

    int resolve_dimension(const SphPolicy &policy, const cases::Scene &scene, long wanted)
    {
      if(scene.domain.outline
         && scene.boundary(cases::Side::outer).kind != cases::BoundaryKind::insulated)
        throw cases::Refusal(fmt::format(
            "{} simulates what an outline bounds only where its wall is insulated",
            policy.name));
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
    const cases::Options &options = resolution.options;
    SphParameters p;
    p.dimension = resolve_dimension(policy, scene, options.get_integer("dimension"));
    const bool in_time = options.get_string("refine") == "time";
    p.n = in_time ? static_cast<int>(options.get_integer("particles")) : resolution.n;
    p.steps = in_time ? resolution.n : 0;
    p.columns = policy.as_published ? p.n : 0;
    p.kernel = kernel_shape(options.get_string("kernel"));
    p.smoothing = options.get_double("smoothing");
    if(p.smoothing == 0)
      p.smoothing = scene.symmetry == cases::Symmetry::planar ? 1.2 : 1.3;
    p.layout = options.get_string("layout") == "edge" ? LatticeLayout::on_edge
                                                      : LatticeLayout::cell_centred;
    p.moment_correction = options.get_bool("moment_correction");
    p.whole_cells = policy.as_published;
    p.front = front_rule(options.get_string("front"));
    p.time_scheme = time_scheme(options.get_string("time_scheme"));
    p.stages = static_cast<int>(options.get_integer("stages"));
    p.step_factor = options.get_double("step_factor");
    p.step_error = options.get_double("step_error");
    if(p.step_error > 0 && !is_implicit(p.time_scheme))
      throw cases::Refusal(fmt::format(
          "{} chooses steps by a wanted error (step_error) for the implicit schemes "
          "backward-euler and crank-nicolson only",
          policy.name));
    if(p.step_error > 0 && in_time)
      throw cases::Refusal(fmt::format(
          "{} takes as many steps as n says or as step_error asks for, not both",
          policy.name));
    p.jitter = options.get_double("jitter");
    p.arrangement
        = resolve_arrangement(policy, options.get_string("arrangement"), p.jitter);
    p.seed = resolution.seed;
    p.threads = resolution.threads;
    return p;
  }
} // namespace meltfront::particles
