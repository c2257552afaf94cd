#ifndef meltfront_cases_means_of_jumps_h
#define meltfront_cases_means_of_jumps_h

#include <cases/scene.h>

#include <functional>

namespace meltfront::cases
{
  /**
   * A scene as a method sees it whose nodes or particles lie a distance `width_on` (m)
   * apart along each wall: what a wall gives and what jumps along it, as far as its
   * expression tells (may_jump_with()), is at a place the mean
   *
   *   1/width integral over the wall within width/2 of the place
   *
   * of what was given: along a straight side what is within the side, around a circle and
   * along an outline past its corners, in space over a square. Values at places that lie
   * the width apart then sum up to the integral over the wall, where values of the
   * expression itself leave out or add half a width beside each jump. Of a wall that
   * radiates it is the mean of the ambient temperature's fourth powers. Walls of a mesh
   * give what they were given.
   */
  Scene with_means_of_jumps(const Scene &scene,
                            const std::function<double(Side)> &width_on);

  /** The same of what a scene with a volumetric source releases throughout, for a method
   * that takes it at one place of each cell: where it jumps in space the mean over the
   * cube of this width about a place, of a rectangular domain over what is within. */
  Field mean_release(const Scene &scene, double width);

  /** Of the range of temperatures at the start the least difference that counts as a
   * jump.
   */
  inline constexpr double negligible_jump = 1e-3;

  /** Whether temperatures may jump in space at the start, as those of bodies that touch
   * do, as far as their expression tells (may_jump_with()); not of an exact solution, nor
   * where a phase is undercooled or superheated, which no method smooths. */
  bool may_jump_at_start(const Scene &scene);
} // namespace meltfront::cases

#endif
