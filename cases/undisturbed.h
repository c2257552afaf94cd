#ifndef meltfront_cases_undisturbed_h
#define meltfront_cases_undisturbed_h

#include <string>

namespace meltfront::cases
{
  struct Scene;

  /**
   * For methods that seed the fronts around sinks by a similarity solution and set out
   * from a later time: nothing else is to change the liquid until then.
   * @param far its temperature at the start (K)
   * @param until the time at which the method sets out (s)
   * @throws Refusal where a source does not draw the same power all the time, a wall
   * that does not carry the exact solution gives or takes heat, or heat is released in
   * the domain
   */
  void require_undisturbed(const Scene &scene, double far, double until,
                           const std::string &method);
} // namespace meltfront::cases

#endif
