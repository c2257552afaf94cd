#include <cases/error.h>
#include <cases/step_ends.h>
#include <cases/time_integral.h>
#include <reference_fem/enthalpy/mesh.h>
#include <reference_fem/enthalpy/options.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem
{
  namespace
  {
    /** Coarse runs take more steps than the cells call for, so that their fronts can be
     * compared at 50 times at least. */
    constexpr long fewest_steps = 50;

    int choose_dimension(const cases::Scene &scene, int wanted)
    {
      const std::vector<int> possible = mesh_dimensions(scene);
      if(wanted == 0)
        return possible.front();
      if(std::find(possible.begin(), possible.end(), wanted) == possible.end())
        throw cases::Refusal(
            fmt::format("fem-enthalpy simulates this scene in {} dimensions, not in {}",
                        fmt::join(possible, " or "), wanted));
      return wanted;
    }
  } // namespace

  RunOptions options_for(const cases::Scene &scene, const cases::Resolution &resolution)
  {
    if(scene.domain.mesh && scene.domain.mesh->kind() == cases::CellKind::tetrahedron)
      throw cases::Refusal("fem-enthalpy takes meshes of triangles, quadrilaterals and "
                           "hexahedra: on tetrahedra, which deal.II halves along one "
                           "diagonal always, its errors fall too slowly");
    auto options = cases::read_options(RunOptions(), resolution.options);
    options.dimension = choose_dimension(scene, options.dimension);
    if(options.front_within_cells && options.dimension > 1)
      throw cases::Refusal("fem-enthalpy takes fronts at their places within cells "
                           "(front = within_cells) in one dimension only");
    if(options.steps > 0)
      options.step_ends = cases::breakpoints_of(scene);
    else
    {
      options.steps
          = std::max(fewest_steps, std::lround(options.steps_per_cell
                                               * cells_along(scene, resolution.n)));
      options.step_ends = cases::step_ends(scene, resolution.n,
                                           (scene.end_time - scene.start_time)
                                               / static_cast<double>(options.steps));
    }
    return options;
  }

  void RunOptions::bind(cases::OptionBinder &options)
  {
    options.add("time_scheme", bdf2,
                "Time scheme: bdf2 (second order) or backward-euler (first order).",
                {{"bdf2", true}, {"backward-euler", false}});
    options.add(
        "steps_per_cell", steps_per_cell,
        "Time steps over the run per cell along the domain's side; at least 50 in "
        "all, and more where what walls prescribe swings faster.",
        1e-6, 1e6);
    options.add(
        "steps", steps,
        "Time steps over the run, whatever walls prescribe; 0: from steps_per_cell.", 0,
        1e9);
    options.add("start_halvings", start_halvings,
                "The first step is replaced by steps that double from 2^-start_halvings "
                "of it.",
                0, 40);
    options.add("dimension", dimension,
                "Dimension in which a symmetric scene is simulated; 0: the lowest.", 0,
                3);
    options.add("iteration_limit", iteration_limit,
                "Nonlinear iterations after which a step is halved and tried again.", 1,
                1e6);
    options.add(
        "front", front_within_cells,
        "Heat between a melting node and its neighbours: from the node itself "
        "(nodes), or from where the front lies within its cell (within_cells; in one "
        "dimension only).",
        {{"nodes", false}, {"within_cells", true}});
    options.add("refinement", refine_at_front,
                "Where cells are as small as n says: everywhere (none), or at the front, "
                "at sources and where temperature bends, with larger ones elsewhere "
                "(front; in boxes and half sections of axisymmetric bodies).",
                {{"none", false}, {"front", true}});
    options.add(
        "engine", distributed,
        "What makes the run: the engine of one process, and that of several where "
        "there are (automatic), or the latter also on one (distributed).",
        {{"automatic", false}, {"distributed", true}});
    options.add("preconditioner", preconditioner,
                "Preconditioner of the conjugate gradients in 2D and 3D: ssor, amg "
                "(Trilinos ML) or "
                "automatic.",
                {{"automatic", Preconditioner::automatic},
                 {"ssor", Preconditioner::ssor},
                 {"amg", Preconditioner::amg}});
    options.add("checkpoint", checkpoint,
                "Wall time between checkpoints, from which `meltfront run --resume` goes "
                "on (s); 0: none are kept.",
                0, 1e9);
  }
} // namespace meltfront::reference_fem
