#include <reference_fem/cut/options.h>

#include <cases/dense_sampling.h>
#include <cases/expression_words.h>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace meltfront::reference_fem::cut
{
  void RunOptions::bind(cases::OptionBinder &options)
  {
    options.add(
        "scheme", scheme,
        "Conservative: heat balanced by construction, degree 1, uniform mesh; knows "
        "passes, cfl, fewest_steps, seed_cells, start, penalty and ghost_penalty. "
        "Extension: BDF2, degree 2, refined meshes. Automatic: extension where one of "
        "its own options is set, else conservative.",
        cases::in_order<Scheme>({"automatic", "extension", "conservative"}));
    options.add(
        "passes", passes,
        "Solves per stage of the conservative scheme, at most, each for temperatures "
        "and front together; they end when the front rests.",
        2, 50);
    options.add("degree", degree, "Degree of the temperature's elements.", 1, 2);
    options.add("level_set_degree", level_set_degree,
                "Degree of the level set's elements.", 1, 2);
    options.add(
        "refinement", refinement,
        "Divisions of the cells at the front: n counts the finest cells, of which "
        "2^refinement make a side of one far from the front; 0 is a uniform mesh.",
        0, 6);
    options.add("band", widths.finest,
                "Finest cells on each side of the front when the mesh is made anew.", 4.5,
                1e3);
    options.add("grading", widths.grading,
                "Cells of each further size between the finest and the coarsest.", 1,
                1e3);
    options.add("cfl", cfl,
                "CFL number of the front: cells that it crosses in a time step, at most.",
                1e-4, 0.5);
    options.add("fewest_steps", fewest_steps,
                "Time steps over the run are at least so many; 0: as many as cells along "
                "the side and 50 or more, of the extension and where the scene gives "
                "something that varies with time 100 or more.",
                0, 1e9);
    options.add(
        "solves", solves,
        "Solves per step: the first on the front predicted from past speeds, each "
        "further one on the front corrected by the speed found.",
        1, 20);
    options.add("speed_smoothing", speed_smoothing,
                "Smoothing of the front's speed along it, in squares of a cell.", 0, 10);
    options.add("seed_cells", seed_cells,
                "Radius in cells of a front that is seeded around a sink in liquid.", 1.5,
                100);
    options.add("start", start,
                "Where the front of the conservative scheme comes from: the scene, or a "
                "run of fem-enthalpy that goes before (enthalpy); automatic is the scene "
                "where it has one and no temperature jumps at the start.",
                cases::in_order<StartFrom>({"automatic", "scene", "enthalpy"}));
    options.add("start_depth", start_depth,
                "Cells that a new phase is deep wherever it is, or over which what jumps "
                "at the start is smooth, when fem-enthalpy hands over.",
                2, 100);
    options.add("start_refinement", start_refinement,
                "Cells of that run in one of the mesh, along a side.", 1, 16);
    options.add("penalty", stabilisation.penalty, "Nitsche's penalty on front and walls.",
                1, 1e4);
    options.add("ghost_penalty", stabilisation.ghost,
                "Penalty on jumps of the normal derivative between the cells at the "
                "front.",
                1e-4, 1e2);
  }

  namespace
  {
    /** Of what varies with time: as many as resolve ten swings. */
    constexpr long fewest_of_varying_data = 100;
    constexpr long fewest_of_constant_data = 50;

    /** What an exact solution gives is as smooth as its front's motion. */
    bool varies_with_time(const cases::Scene &scene)
    {
      const auto varies = [](const cases::Field &field)
      { return field.expression != "exact" && cases::may_vary_with(field, "t"); };
      return (scene.volumetric_source && varies(*scene.volumetric_source))
             || std::ranges::any_of(scene.sources,
                                    [](const cases::PointSource &source) {
                                      return cases::may_depend_on(source.expression, "t");
                                    })
             || std::ranges::any_of(scene.boundaries,
                                    [&](const std::optional<cases::Boundary> &wall) {
                                      return wall && wall->value.value && !wall->exact
                                             && varies(wall->value);
                                    });
    }
  } // namespace

  RunOptions options_for(const cases::Scene &scene, const cases::Resolution &resolution)
  {
    auto options = cases::read_options(RunOptions(), resolution.options);
    if(options.fewest_steps > 0)
      return options;
    const bool conservative = chosen_scheme(options).scheme == Scheme::conservative;
    options.fewest_steps = !conservative ? fewest_of_varying_data
                           : varies_with_time(scene)
                               ? std::max<long>(fewest_of_varying_data, resolution.n)
                               : std::max<long>(fewest_of_constant_data, resolution.n);
    return options;
  }

  std::string option_of_extension(const RunOptions &options)
  {
    const RunOptions standing;
    const std::pair<const char *, bool> given[]{
        {"degree", options.degree != standing.degree},
        {"refinement", options.refinement != standing.refinement},
        {"level_set_degree", options.level_set_degree != standing.level_set_degree},
        {"solves", options.solves != standing.solves},
        {"speed_smoothing", options.speed_smoothing != standing.speed_smoothing}};
    for(const auto &[name, is_set] : given)
      if(is_set)
        return name;
    return {};
  }

  SchemeChoice chosen_scheme(const RunOptions &options)
  {
    if(options.scheme != Scheme::automatic)
      return {options.scheme, "as the option scheme says"};
    if(const std::string name = option_of_extension(options); !name.empty())
      return {Scheme::extension,
              fmt::format("automatic: the option {} is its own", name)};
    return {Scheme::conservative, "automatic: no option is the extension's own"};
  }
} // namespace meltfront::reference_fem::cut
