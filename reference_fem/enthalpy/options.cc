#include <cases/error.h>
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

    int choose_dimension(const cases::Scene &scene, const cases::Options &options)
    {
      const std::vector<int> possible = mesh_dimensions(scene);
      const int wanted = static_cast<int>(options.get_integer("dimension"));
      if(wanted == 0)
        return possible.front();
      if(std::find(possible.begin(), possible.end(), wanted) == possible.end())
        throw cases::Refusal(
            fmt::format("fem-enthalpy simulates this scene in {} dimensions, not in {}",
                        fmt::join(possible, " or "), wanted));
      return wanted;
    }

    long choose_steps(const cases::Options &options, int n)
    {
      const long steps = options.get_integer("steps");
      if(steps > 0)
        return steps;
      return std::max(fewest_steps,
                      std::lround(options.get_double("steps_per_cell") * n));
    }

    Preconditioner choose_preconditioner(const cases::Options &options)
    {
      const std::string &word = options.get_string("preconditioner");
      return word == "ssor"  ? Preconditioner::ssor
             : word == "amg" ? Preconditioner::amg
                             : Preconditioner::automatic;
    }
  } // namespace

  RunOptions::RunOptions(const cases::Scene &scene, const cases::Resolution &resolution)
    : dimension(choose_dimension(scene, resolution.options))
    , bdf2(resolution.options.get_string("time_scheme") == "bdf2")
    , steps(choose_steps(resolution.options, resolution.n))
    , start_halvings(static_cast<int>(resolution.options.get_integer("start_halvings")))
    , iteration_limit(static_cast<int>(resolution.options.get_integer("iteration_limit")))
    , preconditioner(choose_preconditioner(resolution.options))
  {
  }

  std::vector<cases::OptionDeclaration> enthalpy_options()
  {
    return {
        {"time_scheme",
         "",
         std::string("bdf2"),
         "Time scheme: bdf2 (second order) or backward_euler (first order).",
         0,
         0,
         {"bdf2", "backward_euler"}},
        {"steps_per_cell", "1", 0.78125,
         "Time steps over the run per cell along the domain's side; at least 50 in all.",
         1e-6, 1e6},
        {"steps", "1", 0L, "Time steps over the run; 0: from steps_per_cell.", 0, 1e9},
        {"start_halvings", "1", 3L,
         "The first step is replaced by steps that double from 2^-start_halvings of it.",
         0, 40},
        {"dimension", "1", 0L,
         "Dimension in which a symmetric scene is simulated; 0: the lowest.", 0, 3},
        {"iteration_limit", "1", 100L,
         "Nonlinear iterations after which a step is halved and tried again.", 1, 1e6},
        {"preconditioner",
         "",
         std::string("automatic"),
         "Of conjugate gradients in 2D and 3D: ssor, amg (Trilinos ML) or automatic.",
         0,
         0,
         {"automatic", "ssor", "amg"}}};
  }
} // namespace meltfront::reference_fem
