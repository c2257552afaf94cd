#include <reference_fem/enthalpy/run.h>
#include <reference_fem/enthalpy/state_archive.h>

#include <cases/error.h>

namespace meltfront::reference_fem
{
  /** @throws cases::Refusal where checkpoints are asked for and none can be kept */
  void EnthalpyRun::require_resumable() const
  {
    if(options.checkpoint == 0)
      return;
    if(!keeps_states())
      throw cases::Refusal(checkpoints_are_of_single_runs);
    if(alloy || motion)
      throw cases::Refusal("fem-enthalpy keeps checkpoints (checkpoint) of pure "
                           "substances at rest only: not of alloys, nor where liquid is "
                           "displaced");
  }

  /** All that steps depend on and that set-up does not make. */
  template <class Archive>
  void EnthalpyRun::pass_state(Archive &state)
  {
    state &time &time_before &step_number &queue;
    state &u &u_accepted &u_before &enthalpy &enthalpy_before;
    state &boundary_heat &released_heat &initial_heat &defect;
    state &iterations &capped_steps &statistics;
  }

  void EnthalpyRun::save(boost::archive::binary_oarchive &state) const
  {
    const Adaptation left = with_costs();
    const double scale = solver->temperature_scale();
    state << left << scale;
    if(refinable)
      refinable->save(state);
    // Boost's archives exchange by reference whichever way they go.
    const_cast<EnthalpyRun *>(this)->pass_state(state);
  }

  void EnthalpyRun::restore(boost::archive::binary_iarchive &state)
  {
    double scale = 0;
    state >> adaptation >> scale;
    if(refinable)
    {
      refinable->restore(state);
      mesh = refinable->discretise();
      judge_mesh();
      make_parts(*refinable);
      make_solver();
      rhs.resize(mesh.volume.size());
      heat.resize(mesh.volume.size());
    }
    solver->set_temperature_scale(scale);
    pass_state(state);
  }
} // namespace meltfront::reference_fem
