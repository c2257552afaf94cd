#ifndef meltfront_particles_scattered_linear_choices_h
#define meltfront_particles_scattered_linear_choices_h

#include <cases/method.h>
#include <particles/scattered/linear_problem.h>

#include <string>
#include <vector>

namespace meltfront::particles
{
  /** Names of LinearScheme, in its order. */
  const std::vector<std::string> &linear_scheme_names();

  /** The steps that are asked for, or those by default, of which a run takes no more. */
  long linear_steps(const LinearOptions &options, int n);

  /** As many steps as a run may have, of at least s^2 / (2 d a) each, with s^2 the
   * largest mean square distance over which a row of the mass matrix spreads what a site
   * stores, a the diffusivity, d the dimension: in shorter ones heat moves less far than
   * that, and temperatures beside a wall that jumps overshoot whatever the spacing
   * (Vermeer and Verruijt 1981; linear elements: h^2 / (6 a)). */
  long most_monotone_steps(const cases::Scene &scene, const LinearProblem &problem,
                           const LinearSites &sites);
} // namespace meltfront::particles

#endif
