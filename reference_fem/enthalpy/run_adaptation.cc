#include <reference_fem/enthalpy/run.h>

#include <cases/error.h>
#include <reference_fem/enthalpy/initial_state.h>
#include <reference_fem/enthalpy/sum_over.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem
{
  /** From the coarsest cells to a mesh that suits the initial state, which is taken anew
   * on each mesh on the way. */
  void EnthalpyRun::refine_start()
  {
    refinable = make_refinable_mesh(scene, options.dimension, resolution.n);
    refinement.emplace(scene, effects, *refinable);
    for(bool changed = true; changed;)
    {
      mesh = refinable->discretise();
      make_parts(*refinable);
      enthalpy = initial_enthalpy(scene, *refinable, mesh, free);
      changed = refinable->adapt(refinement->wishes(mesh, enthalpy, {.join = false}), {});
    }
  }

  /** Enthalpies where the step under way has led to. */
  std::vector<double> EnthalpyRun::state_ahead() const
  {
    std::vector<double> result(enthalpy.size());
    for(std::size_t i = 0; i < result.size(); ++i)
      result[i] = free[i] ? heat[i] / mesh.volume[i]
                          : enthalpy_at_wall(static_cast<unsigned int>(i),
                                             scene.material.melting_temperature
                                                 + solver->temperature_excess(u[i]),
                                             enthalpy[i]);
    return result;
  }

  /**
   * Refine the mesh for the step under way where it has led the front to cells that are
   * not the smallest; for the first one, which finds out where the run begins, wherever
   * its result calls for. The step is to be made again then.
   */
  bool EnthalpyRun::refine_for_step()
  {
    const std::vector<double> ahead = state_ahead();
    const bool first = step_number == 0;
    if(!first && refinement->finest_at_front(mesh, ahead, 0))
      return false;
    if(!change_mesh(
           refinement->wishes(mesh, ahead, {.everywhere = first, .join = false})))
      return false;
    continue_on_new_mesh();
    return true;
  }

  /** Adapt the mesh to the state reached, where it is time. */
  void EnthalpyRun::adapt_to_state()
  {
    const auto unknowns = std::ranges::count(free, 1);
    adaptation.unknowns_times_steps += static_cast<double>(unknowns);
    adaptation.most_unknowns = std::max<long>(adaptation.most_unknowns, unknowns);
    if(++adaptation.steps_since < FrontRefinement::most_steps
       && refinement->finest_at_front(mesh, enthalpy, FrontRefinement::fewest_layers))
      return;
    adaptation.steps_since = 0;
    if(!change_mesh(refinement->wishes(mesh, enthalpy, {})))
      return;
    while(change_mesh(
        refinement->wishes(mesh, enthalpy, {.everywhere = false, .join = false})))
      ;
    continue_on_new_mesh();
  }

  /** Change the mesh and carry the heat of the last two times over, all of it. */
  bool EnthalpyRun::change_mesh(const std::vector<Wish> &wishes)
  {
    const auto held = [this](const std::vector<double> &state)
    { return sum_over(mesh.volume, [&](std::size_t i) { return state[i]; }); };
    const double now = held(enthalpy), before = held(enthalpy_before);
    if(!refinable->adapt(wishes, {&enthalpy, &enthalpy_before}))
      return false;
    mesh = refinable->discretise();
    const double magnitude = std::max(
        sum_over(mesh.volume, [this](std::size_t i) { return std::abs(enthalpy[i]); }),
        std::abs(initial_heat));
    const double lost = std::max(std::abs(held(enthalpy) - now),
                                 std::abs(held(enthalpy_before) - before));
    const double relative = lost > 0 ? lost / magnitude : 0;
    adaptation.transfer_defect = std::max(adaptation.transfer_defect, relative);
    if(!(relative <= accepted_balance_defect))
      throw cases::NumericalError(
          "fem-enthalpy", step_number, time, "heat",
          fmt::format("changed by {:.3g} of what is at hand when the mesh was adapted, "
                      "more than {:g}",
                      relative, accepted_balance_defect));
    return true;
  }

  void EnthalpyRun::continue_on_new_mesh()
  {
    adaptation = with_costs();
    ++adaptation.adaptations;
    judge_mesh();
    make_parts(*refinable);
    make_solver();
    u = u_before = CompensatedVector(enthalpy.size());
    for(std::size_t i = 0; i < u.size(); ++i)
    {
      u.set(i, solver->kirchhoff_at_enthalpy(i, enthalpy[i]));
      u_before.set(i, solver->kirchhoff_at_enthalpy(i, enthalpy_before[i]));
    }
    u_accepted = u;
    rhs.resize(u.size());
    heat.resize(u.size());
    check_balance();
  }

  double EnthalpyRun::least_volume_over_typical() const
  {
    double squares = 0;
    for(const double volume : mesh.volume)
      squares += volume * volume;
    return *std::ranges::min_element(mesh.volume)
           / std::sqrt(squares / static_cast<double>(mesh.volume.size()));
  }

  /** What the parts at hand, which are about to be given up, have cost is added. */
  EnthalpyRun::Adaptation EnthalpyRun::with_costs() const
  {
    Adaptation result = adaptation;
    result.effects = effect_costs();
    result.work += solver->work();
    result.linear_iterations += linear_solver->iterations();
    return result;
  }
} // namespace meltfront::reference_fem
