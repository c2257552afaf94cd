#ifndef meltfront_reference_fem_fitted_events_transitions_h
#define meltfront_reference_fem_fitted_events_transitions_h

#include <reference_fem/fitted/events/layered_state.h>

namespace meltfront::reference_fem::fitted
{
  /** The scene's initial state on a mesh without a front; its steps are equal in time. */
  RunSegment one_phase_stretch(const EventScene &setting);

  /**
   * A segment anew from its state, for a wall that passes the melting temperature @p soon
   * (s) afterwards: cells halved towards that wall down to the thermal layer's width, so
   * that they hold the same state, and steps equal in the root of time of which twenty or
   * more lead to the passing. A layer of heat that forms at the other wall at that moment
   * has cells for these steps, too.
   */
  RunSegment refined_stretch(const EventScene &setting, const RunSegment &segment,
                             bool passing_inner, double soon);

  /** A segment anew from its state on cells that are halved towards walls where layers of
   * heat form at that moment, with steps that are equal in the root of time. */
  RunSegment drawn_to_walls(const EventScene &setting, const RunSegment &segment,
                            const std::array<cases::WallLayer, 2> &forms);

  /**
   * The run from the moment at which an interval is so thin that it is dropped: at an end
   * of the ray with its front, between two fronts with both, so that its neighbours
   * become one. What heat it still held is kept in RunSegment::before. Cells are halved
   * towards the place, where the temperature has a bend.
   */
  RunSegment remaining_stretch(const EventScene &setting, const RunSegment &past,
                               double time, const dealii::Vector<double> &u,
                               unsigned int vanished);
} // namespace meltfront::reference_fem::fitted

#endif
