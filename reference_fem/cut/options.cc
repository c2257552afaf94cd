#include <reference_fem/cut/options.h>

namespace meltfront::reference_fem::cut
{
  std::vector<cases::OptionDeclaration> cut_options()
  {
    return {
        {"degree", "1", 1L, "Degree of the temperature's elements.", 1, 2},
        {"level_set_degree", "1", 2L, "Degree of the level set's elements.", 1, 2},
        {"refinement", "1", 0L,
         "Divisions of the cells at the front: n counts the finest cells, of which "
         "2^refinement make a side of one far from the front; 0 is a uniform mesh.",
         0, 6},
        {"band", "1", 9.,
         "Finest cells on each side of the front when the mesh is made anew.", 4.5, 1e3},
        {"grading", "1", 3.,
         "Cells of each further size between the finest and the coarsest.", 1, 1e3},
        {"step_factor", "1", 0.25,
         "Cells that the front may cross in a time step, at its fastest.", 1e-4, 0.5},
        {"fewest_steps", "1", 100L, "Time steps over the run are at least so many.", 1,
         1e9},
        {"solves", "1", 2L,
         "Solves per step: the first on the front predicted from past speeds, each "
         "further one on the front corrected by the speed found.",
         1, 20},
        {"smoothing", "1", 0.25,
         "Smoothing of the front's speed along it, in squares of a cell.", 0, 10},
        {"seed_cells", "1", 3.,
         "Radius in cells of a front that is seeded around a sink in liquid.", 1.5, 100},
        {"penalty", "1", 40., "Nitsche's penalty on front and walls.", 1, 1e4},
        {"ghost_penalty", "1", 0.04,
         "Penalty on jumps of the normal derivative between the cells at the front.",
         1e-4, 1e2}};
  }

  RunOptions::RunOptions(const cases::Options &options)
    : degree(static_cast<int>(options.get_integer("degree")))
    , level_set_degree(static_cast<int>(options.get_integer("level_set_degree")))
    , refinement(static_cast<int>(options.get_integer("refinement")))
    , widths{options.get_double("band"), options.get_double("grading")}
    , step_factor(options.get_double("step_factor"))
    , fewest_steps(options.get_integer("fewest_steps"))
    , solves(static_cast<int>(options.get_integer("solves")))
    , smoothing(options.get_double("smoothing"))
    , seed_cells(options.get_double("seed_cells"))
  {
    stabilization.penalty = options.get_double("penalty");
    stabilization.ghost = options.get_double("ghost_penalty");
  }
} // namespace meltfront::reference_fem::cut
