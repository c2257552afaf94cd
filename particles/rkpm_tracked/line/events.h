#ifndef meltfront_particles_rkpm_tracked_line_events_h
#define meltfront_particles_rkpm_tracked_line_events_h

#include <particles/rkpm_tracked/line/collocation.h>
#include <particles/rkpm_tracked/line/sites.h>

#include <optional>
#include <string>
#include <utility>

namespace meltfront::particles::rkpm_tracked
{
  /** A phase that has all but vanished, and the heat that was still in it. */
  struct Vanished
  {
    double place = 0;     ///< m
    bool solid = false;   ///< what it was
    bool at_wall = false; ///< else between two fronts
    double latent = 0;    ///< J/m^2
    double sensible = 0;  ///< J/m^2
  };

  /** The number of the thinnest interval of a state with a front, and its thickness (m).
   */
  std::pair<std::size_t, double> thinnest_interval(const LineProblem &problem,
                                                   const LineState &state);

  /** Where the densities differ: a phase that gives way to a front, or follows it, and
   * lies at no wall through which it could, by its interval and where in words; none if
   * all have one. */
  std::pair<std::optional<std::size_t>, std::string>
  enclosed_phase(const LineProblem &problem, const LineState &state);

  /**
   * Take an interval out: at a wall with its front, between two fronts with both, so that
   * its neighbours become one. Nodes in it take the melting temperature, but for one on a
   * wall of fixed temperature.
   */
  Vanished remove_interval(const LineProblem &problem, LineState &state,
                           std::size_t number);

  /** How far the temperature at a wall (0: lower, 1: upper) is beyond the melting
   * temperature for the phase there (K); negative where that phase is stable, minus
   * infinity where no other can begin: at an axis, and at an insulated wall without heat
   * released throughout. */
  double wall_excess(const LineProblem &problem, const LineState &state,
                     std::size_t side);

  /**
   * The heat of a state whose walls are no farther than at the melting temperature where
   * the phase there is to melt or freeze at once: a wall that jumps beyond it brings no
   * more heat into the cells beside it than that, and then the layer that appears.
   */
  LineHeat heat_before_layers(const LineProblem &problem, LineState state);

  /** Insert a front near a wall: the other phase appears in a layer there, a twentieth of
   * a spacing thick or less.
   * @return the layer's thickness (m) */
  double insert_layer(const LineProblem &problem, LineState &state, std::size_t side);
} // namespace meltfront::particles::rkpm_tracked

#endif
