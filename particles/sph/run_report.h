#ifndef meltfront_particles_sph_run_report_h
#define meltfront_particles_sph_run_report_h

#include <cases/method.h>
#include <cases/stopwatch.h>
#include <particles/sph/discretisation.h>
#include <particles/sph/time/time_stepping.h>

#include <span>
#include <string>
#include <vector>

namespace meltfront::particles
{
  /** What a run on these particles is going to do, as far as kernel and arrangement go.
   */
  cases::RunDescription describe_particles(const Discretisation &discretisation,
                                           const SphParameters &parameters,
                                           double time_step, long unknowns);

  /** The same with its steps.
   * @param of_flow what is told of the operator */
  cases::RunDescription describe_run(const Discretisation &discretisation,
                                     const SphParameters &parameters,
                                     const StepPlan &plan, long unknowns,
                                     const std::vector<cases::Parameter> &of_flow);

  /** A scheme in words. @param stages of its super steps */
  std::string describe_scheme(TimeScheme scheme, int stages);

  /** A snapshot on the particles, without budgets. */
  cases::Snapshot particle_snapshot(const Discretisation &discretisation, long step,
                                    double time, std::span<const double> temperature,
                                    std::span<const double> solid_fraction);
} // namespace meltfront::particles

#endif
