#ifndef meltfront_verification_measure_checks_unresolved_data_h
#define meltfront_verification_measure_checks_unresolved_data_h

#include <cases/scene.h>

#include <string>

namespace meltfront::verification
{
  /**
   * Which temperature that a scene gives has a feature so narrow that it lies between
   * points one spacing apart, or is taken for as wide as that: no book of heat tells of
   * it. Asked of the initial temperature and of temperatures of walls and beside them:
   * whether one departs by more than a quarter of all given temperatures' range within
   * half a spacing on both sides of a place. A bell exp(-(x/w)^2) does if w is less than
   * the spacing; what steps from one value to another does not. Samples are
   * those of cases::visit_densely(). Exact states are left out.
   *
   * @param spacing m
   * @return a sentence with the place and a spacing that would do; empty if there is none
   */
  std::string unresolved_data(const cases::Scene &scene, double spacing);

  /**
   * Which part of the domain is too narrow for a spacing, so that refining may change
   * little until it no longer is: a wall about a centre or an axis that drives heat and
   * whose diameter is less than the width, a shell with a wall that drives heat of less
   * than two widths, or a box thinner than the spacing in a direction in which something
   * varies (walls that drive heat there, sources, the initial temperature or the heat
   * released). Outlines and meshes are left out: their
   * cells fit them.
   *
   * @param spacing m
   * @param width that finer cells beside walls resolve (m), the spacing where there are
   * none
   * @return a sentence that names it and a spacing that would do; empty if there is none
   */
  std::string unresolved_walls(const cases::Scene &scene, double spacing, double width);
} // namespace meltfront::verification

#endif
