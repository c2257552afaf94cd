#ifndef meltfront_cases_step_ends_h
#define meltfront_cases_step_ends_h

#include <cases/scene.h>

#include <vector>

namespace meltfront::cases
{
  /**
   * Times within the run at which steps had better end, ascending: those of
   * breakpoints_of(), and, where the temperature of a wall or beside it swings faster
   * than steps of the `longest` length (s) follow, times between which no such
   * temperature departs from a straight line by more than about 1/(4 n) of the scene's
   * temperature range; after a jump as many as in the half of a swing that is as
   * large. Twice as many cells n take sqrt(2) times as many steps there: the
   * error of a scheme of second order falls as 1/n, and is seen by whoever compares
   * levels. Where `longest` is short enough there are the breakpoints only.
   *
   * Given fluxes do not count: methods take their means over a step. Temperatures are
   * sampled at uneven times, so that no swing hides between them; a pulse that has no
   * breakpoint and is shorter than 1/300 of the run may.
   *
   * @throws Refusal if a temperature swings so fast that it cannot be sampled
   */
  std::vector<double> step_ends(const Scene &scene, int n, double longest);

  /** The longest equal steps that follow all swings as step_ends() does (s), whatever
   * jumps; infinite where nothing swings. */
  double longest_step_of_walls(const Scene &scene, int n);
} // namespace meltfront::cases

#endif
