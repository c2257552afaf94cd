#include <reference_fem/enthalpy/distributed/rank_run.h>
#include <reference_fem/enthalpy/state_archive.h>

#include <cases/error.h>

namespace meltfront::reference_fem
{
  /** All that steps depend on and that set-up does not make: the rank's part of it. The
   * mesh and who has what of it come out the same on as many ranks. */
  template <class Archive>
  void RankRun::pass_state(Archive &state)
  {
    state &time &time_before &step_number &queue;
    state &u &u_accepted &u_before &enthalpy &enthalpy_before;
    state &boundary_heat &released_heat &initial_heat &defect;
    state &iterations &capped_steps &statistics &traffic;
  }

  void RankRun::save(boost::archive::binary_oarchive &state) const
  {
    const Earlier left = costs_so_far();
    const double scale = solver->temperature_scale();
    state << left << scale;
    // Boost's archives exchange by reference whichever way they go.
    const_cast<RankRun *>(this)->pass_state(state);
  }

  void RankRun::restore(boost::archive::binary_iarchive &state)
  {
    double scale = 0;
    state >> earlier >> scale;
    solver->set_temperature_scale(scale);
    pass_state(state);
  }

  void RankRun::require_resumable() const
  {
    if(options.checkpoint > 0 && !keeps_states())
      throw cases::Refusal(checkpoints_are_of_single_runs);
  }
} // namespace meltfront::reference_fem
