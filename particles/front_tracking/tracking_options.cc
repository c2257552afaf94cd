#include <cases/error.h>
#include <cases/scene.h>
#include <particles/front_tracking/tracking_options.h>

#include <fmt/format.h>

#include <algorithm>

namespace meltfront::particles::front_tracking
{
  namespace
  {
    /** The kernel reaches this much farther than the order, in spacings. */
    constexpr double reach_beyond_order = 0.6;
    /** From 4.3 spacings on the fourth order has growing modes beside fronts and walls.
     */
    constexpr double widest_default = 3.6;

    Clock choose_clock(const cases::Scene &scene, const std::string &word)
    {
      if(word == "t")
        return Clock::time;
      if(word == "sqrt(t)")
        return Clock::root;
      // A front that sets out like sqrt(t) is a straight line on that clock.
      const bool similar
          = scene.initial.exact && scene.start_time > scene.initial.exact->start_time();
      return similar ? Clock::root : Clock::time;
    }
  } // namespace

  std::vector<cases::OptionDeclaration> tracking_options()
  {
    return {
        {"dimension", "1", 0L,
         "Dimension in which a symmetric scene is simulated; 0: the lowest.", 0, 2},
        {"basis_order", "1", 2L, "Order of the polynomials that are reproduced.", 2, 4},
        {"dilation", "1", 0.,
         "Radius of the kernel (a cubic spline) over the spacing; 0: basis_order + "
         "0.6, at most 3.6.",
         0, 20},
        {"scheme",
         "",
         std::string("bdf2"),
         "Backward Euler or backward differentiation of order 2 or 3, for temperatures "
         "and front alike.",
         0,
         0,
         {"backward-euler", "bdf2", "bdf3"}},
        {"steps", "1", 0L,
         "Time steps planned over the run; 0: three for two intervals, at least 60, or "
         "640 "
         "where only space is refined.",
         0, 1e7},
        {"refine",
         "",
         std::string("both"),
         "What n refines: both, space (the steps stay) or time (n steps, the nodes "
         "stay).",
         0,
         0,
         {"both", "space", "time"}},
        {"intervals", "1", 80L,
         "Intervals between nodes along the domain's side where n refines time.", 2, 1e5},
        {"clock",
         "",
         std::string("auto"),
         "Planned steps are equal in t or in sqrt(t); auto: sqrt(t) for a scene that "
         "starts from an exact solution some time after that began, else t.",
         0,
         0,
         {"auto", "t", "sqrt(t)"}},
        {"largest_move", "1", 0.5,
         "Farthest that a front moves in a step, over the spacing; steps are divided "
         "where it would move farther.",
         1e-3, 1},
        {"absorption", "1", 0.1,
         "Nodes nearer to a front than this, over the spacing, are interpolated instead "
         "of collocated.",
         0, 0.9},
        {"arrangement",
         "",
         std::string("lattice"),
         "How the inner nodes are arranged.",
         0,
         0,
         {"lattice", "jittered"}},
        {"jitter", "1", 0.2, "Largest displacement of jittered nodes over the spacing.",
         0, 0.45},
        {"start",
         "",
         std::string("auto"),
         "How a phase begins at a wall: from the similarity solution where a uniform "
         "scene meets a wall of constant temperature (auto), or always as a thin layer "
         "in quasi-steady growth.",
         0,
         0,
         {"auto", "quasi-steady"}},
        {"history",
         "",
         std::string("exact"),
         "Temperatures before the start, for the first steps: those of the exact "
         "solution where the scene starts from one, or none (short first steps).",
         0,
         0,
         {"exact", "none"}},
        {"displaced",
         "",
         std::string("liquid"),
         "The phase that gives way where the densities differ; the other is at rest.",
         0,
         0,
         {"liquid", "solid"}},
        {"closure",
         "",
         std::string("given-walls"),
         "When the front makes up for heat that collocation lost, in the plane: where "
         "the "
         "heat through all walls is given or none, never, or always.",
         0,
         0,
         {"given-walls", "never", "always"}},
        {"relax", "1", 0L,
         "Inner nodes are relaxed every so many steps, so that they keep their distance "
         "from the front as it moves through them; 0: they stay.",
         0, 1e6},
        {"relax_rule",
         "",
         std::string("homing"),
         "What relaxed nodes obey: repulsion among nodes and front with springs to where "
         "they were laid, or the Lennard-Jones energy alone as published.",
         0,
         0,
         {"homing", "lennard-jones"}}};
  }

  int simulated_dimension(const cases::Scene &scene, const cases::Options &options)
  {
    using cases::DomainShape;
    using cases::Symmetry;
    const bool slab = scene.domain.shape == DomainShape::slab;
    const bool round = scene.domain.round()
                       && (scene.symmetry == Symmetry::cylindrical
                           || scene.symmetry == Symmetry::spherical);
    const long wanted = options.get_integer("dimension");
    if((slab || round) && wanted <= 1)
      return 1;
    if(wanted == 1 || (wanted == 0 && scene.domain.dimension == 1))
      throw cases::Refusal(
          "rkpm-tracked simulates along a line only a slab or what depends on the "
          "distance from an axis or a centre in a ball or a shell");
    if(slab || (wanted != 0 && wanted != scene.domain.dimension))
      throw cases::Refusal(fmt::format(
          "rkpm-tracked does not simulate this scene in {} dimensions", wanted));
    return scene.domain.dimension;
  }

  TrackingParameters read_tracking_parameters(const cases::Scene &scene,
                                              const cases::Resolution &resolution)
  {
    const cases::Options &options = resolution.options;
    constexpr int fewest_steps = 60;
    constexpr int steps_where_only_space_is_refined = 640;
    TrackingParameters result;
    const std::string &refine = options.get_string("refine");
    result.intervals = refine == "time"
                           ? static_cast<int>(options.get_integer("intervals"))
                           : resolution.n;
    result.steps = static_cast<int>(options.get_integer("steps"));
    if(refine == "time")
      result.steps = resolution.n;
    else if(result.steps == 0)
      result.steps = refine == "space" ? steps_where_only_space_is_refined
                                       : std::max(fewest_steps, 3 * resolution.n / 2);
    result.basis_order = static_cast<int>(options.get_integer("basis_order"));
    result.dilation = options.get_double("dilation");
    if(result.dilation == 0)
      result.dilation = std::min(result.basis_order + reach_beyond_order, widest_default);
    const std::string &scheme = options.get_string("scheme");
    result.scheme = scheme == "backward-euler" ? TimeScheme::backward_euler
                    : scheme == "bdf2"         ? TimeScheme::bdf2
                                               : TimeScheme::bdf3;
    result.clock = choose_clock(scene, options.get_string("clock"));
    result.largest_move = options.get_double("largest_move");
    result.absorption = options.get_double("absorption");
    result.jitter = options.get_string("arrangement") == "jittered"
                        ? options.get_double("jitter")
                        : 0;
    result.start
        = options.get_string("start") == "auto" ? Start::automatic : Start::quasi_steady;
    result.exact_history = options.get_string("history") == "exact";
    result.displaced = options.get_string("displaced") == "liquid" ? Displaced::liquid
                                                                   : Displaced::solid;
    const std::string &closure = options.get_string("closure");
    result.closure = closure == "never"    ? Closure::never
                     : closure == "always" ? Closure::always
                                           : Closure::given_walls;
    result.relax = static_cast<int>(options.get_integer("relax"));
    result.relax_rule = options.get_string("relax_rule") == "homing"
                            ? RelaxRule::homing
                            : RelaxRule::lennard_jones;
    return result;
  }
} // namespace meltfront::particles::front_tracking
