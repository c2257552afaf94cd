#include <cases/error.h>
#include <cases/scene.h>
#include <particles/rkpm_tracked/tracking_options.h>

#include <fmt/format.h>

#include <algorithm>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    /** The kernel reaches this much farther than the order, in spacings. */
    constexpr double reach_beyond_order = 0.6;
    /** From 4.3 spacings on the fourth order has growing modes beside fronts and walls.
     */
    constexpr double widest_default = 3.6;

    /** On relaxed nodes the front of `bar-started` was four times as far off with
     * balances as with collocation. */
    Form choose_form(const cases::Scene &scene, const TrackingParameters &parameters)
    {
      if(parameters.basis_order > 2)
        return Form::collocation;
      const bool held = std::ranges::none_of(
          scene.sides(), [&](cases::Side side)
          { return cases::prescribes_heat(scene.boundary(side).kind); });
      return parameters.relax == 0 || !held
                     || scene.domain.shape == cases::DomainShape::shell
                 ? Form::balances
                 : Form::collocation;
    }

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

  void TrackingParameters::bind(cases::OptionBinder &options)
  {
    options.add("dimension", dimension,
                "Dimension in which a symmetric scene is simulated; 0: the lowest.", 0,
                2);
    options.add(
        "form", form,
        "Along a line: balances of cells, which lose no heat and are of second "
        "order in space, or collocation, whose order grows with the basis; "
        "automatic: balances for a basis of order 2, unless nodes are relaxed and all "
        "walls held or insulated.",
        {{"automatic", Form::automatic},
         {"balances", Form::balances},
         {"collocation", Form::collocation}});
    options.add("basis_order", basis_order,
                "Order of the polynomials that are reproduced.", 2, 4);
    options.add(
        "dilation", dilation,
        "Radius of the kernel (a cubic spline) over the spacing; 0: basis_order + "
        "0.6, at most 3.6.",
        0, 20);
    options.add("time_scheme", time_scheme,
                "Backward Euler or backward differentiation of order 2 or 3, for "
                "temperatures and front alike.",
                {{"backward-euler", TimeScheme::backward_euler},
                 {"bdf2", TimeScheme::bdf2},
                 {"bdf3", TimeScheme::bdf3}});
    options.add("steps", steps,
                "Time steps planned over the run; 0: three for two intervals, at least "
                "60, or 640 where only space is refined.",
                0, 1e7);
    options.add(
        "refine", refine,
        "What n refines: both, space (the steps stay) or time (n steps, the nodes "
        "stay).",
        {{"both", Refine::both}, {"space", Refine::space}, {"time", Refine::time}});
    options.add("cells", cells,
                "Cells between nodes along the domain's side where n refines time.", 2,
                1e5);
    options.add(
        "clock", clock_name,
        "Planned steps are equal in t or in sqrt(t); automatic: sqrt(t) for a scene "
        "that starts from an exact solution some time after that began, else t.",
        cases::themselves({"automatic", "t", "sqrt(t)"}));
    options.add("cfl", cfl,
                "CFL number of a front: the farthest that it moves in a step, over the "
                "spacing; steps are divided where it would move farther.",
                1e-3, 1);
    options.add("interpolation_distance", interpolation_distance,
                "Nodes nearer to a front than this, over the spacing, are interpolated "
                "instead of collocated.",
                0, 0.9);
    options.add("arrangement", jittered, "How the inner nodes are arranged.",
                {{"lattice", false}, {"jittered", true}});
    options.add("jitter", jitter,
                "Largest displacement of jittered nodes over the spacing.", 0, 0.45);
    options.add("wall_spacing", wall_spacing,
                "Along a line with balances: distance of nodes beside walls that are not "
                "insulated, over that within; 1: the same.",
                1e-4, 1);
    options.add(
        "start", start,
        "How a phase begins at a wall: from the similarity solution where a "
        "uniform scene meets a wall of constant temperature (automatic), or always as "
        "a thin layer in quasi-steady growth.",
        {{"automatic", Start::automatic}, {"quasi-steady", Start::quasi_steady}});
    options.add("history", exact_history,
                "Temperatures before the start, for the first steps: those of the exact "
                "solution where the scene starts from one, or none (short first steps).",
                {{"exact", true}, {"none", false}});
    options.add(
        "start_depth", start_depth,
        "In the plane: spacings of nodes that a new phase is deep wherever it is, "
        "or what jumps at the start is smooth over, when sph, from which the run "
        "starts there, hands over; from a quarter of the run on half as many.",
        4, 100);
    options.add(
        "start_refinement", start_refinement,
        "In the plane: particles of that run in a spacing of nodes, along a side.", 1,
        16);
    options.add("displaced", displaced,
                "The phase that gives way where the densities differ; the other is at "
                "rest.",
                {{"liquid", Displaced::liquid}, {"solid", Displaced::solid}});
    options.add("relax", relax,
                "Inner nodes are relaxed every so many steps, so that they keep their "
                "distance from the front as it moves through them; 0: they stay.",
                0, 1e6);
    options.add(
        "relax_rule", relax_rule,
        "What relaxed nodes obey: repulsion among nodes and front with springs to "
        "where they were laid, or the Lennard-Jones energy alone as published.",
        {{"springs", RelaxRule::springs}, {"lennard-jones", RelaxRule::lennard_jones}});
  }

  int simulated_dimension(const cases::Scene &scene, const cases::Options &options)
  {
    using cases::DomainShape;
    using cases::Symmetry;
    const bool slab = scene.domain.shape == DomainShape::slab;
    const bool round = scene.domain.round()
                       && (scene.symmetry == Symmetry::cylindrical
                           || scene.symmetry == Symmetry::spherical);
    const int wanted = cases::read_options(TrackingParameters(), options).dimension;
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
    constexpr int fewest_steps = 60;
    constexpr int steps_where_only_space_is_refined = 640;
    auto result = cases::read_options(TrackingParameters(), resolution.options);
    if(result.refine == Refine::time)
      result.steps = resolution.n;
    else
    {
      result.cells = resolution.n;
      if(result.steps == 0)
        result.steps = result.refine == Refine::space
                           ? steps_where_only_space_is_refined
                           : std::max(fewest_steps, 3 * resolution.n / 2);
    }
    if(result.form == Form::automatic)
      result.form = choose_form(scene, result);
    if(result.dilation == 0)
      result.dilation = std::min(result.basis_order + reach_beyond_order, widest_default);
    result.clock = choose_clock(scene, result.clock_name);
    if(!result.jittered)
      result.jitter = 0;
    // Nodes that repel each other do not stay nearer to each other at walls.
    if(result.relax > 0)
      result.wall_spacing = 1;
    return result;
  }
} // namespace meltfront::particles::rkpm_tracked
