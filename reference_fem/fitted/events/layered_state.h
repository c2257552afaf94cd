#ifndef meltfront_reference_fem_fitted_events_layered_state_h
#define meltfront_reference_fem_fitted_events_layered_state_h

#include <cases/exact/wall_layer.h>
#include <reference_fem/fitted/events/segment.h>
#include <reference_fem/fitted/setup.h>

#include <array>
#include <functional>
#include <memory>
#include <vector>

namespace meltfront::reference_fem::fitted
{
  /** A scene in one dimension, and how it is to be solved. */
  struct EventScene
  {
    const cases::Scene &scene;
    const cases::EffectSet &effects;
    const RunOptions &options;
    RayScene rays;
  };

  /** The phases along a ray at a time. */
  struct LayeredState
  {
    double time = 0;              ///< s
    std::vector<double> fronts{}; ///< from the inner end on (m)
    bool solid_inside = true;
    std::vector<std::vector<double>> shares{};     ///< of the cells, by interval
    std::function<double(double r)> temperature{}; ///< by coordinate on the ray (m)
    double heat = 0;                               ///< that it holds, sensible and latent
    HeatContent before; ///< walls and sources: what came in until then
    /** One phase as the scene gives it: its cells are chosen by what happens to it. */
    bool untouched = false;

    bool solid_at(bool inner) const
    {
      return solid_inside == (inner || fronts.size() % 2 == 0);
    }
  };

  /** The scene's initial state, as it has been put on a mesh. */
  LayeredState initial_layers(const EventScene &setting, const RunSegment &segment);

  /** That of a segment at a time. It refers to the arguments. */
  LayeredState layers_of(const RunSegment &segment, double time,
                         const dealii::Vector<double> &u);

  /** Distance from a wall to the first front, or to the other wall (m). */
  double room_at_wall(const EventScene &setting, const LayeredState &state, bool inner);

  /** A phase that appears is so wide at least, of the ray, lest it be lost in rounding.
   */
  inline constexpr double thinnest_seed = 1e-11;

  /** A phase that appears at a wall or a sink, with the thickness of the layer in which
   * the heat of the old phase changes. */
  struct NewLayer
  {
    bool inner = true;
    double width = 0, layer = 0; ///< m
  };

  /** At the inner and the outer wall, as of a state. */
  std::array<cases::WallLayer, 2> layers_at_walls(const EventScene &setting,
                                                  const LayeredState &state);

  /**
   * The problem with further phases at one end of the ray or both, each of equal cells;
   * cells of the old phases are drawn to them, and to walls where layers of heat form
   * without a front.
   * @param thickness of such layers, inner and outer (m); 0 without one
   */
  std::shared_ptr<FittedProblem> problem_with(const EventScene &setting,
                                              const LayeredState &state,
                                              const std::vector<NewLayer> &layers,
                                              std::array<double, 2> thickness,
                                              const Clock &clock);

  /** Coordinates of the fronts with those of the new phases (m). */
  std::vector<double> fronts_with(const EventScene &setting, const LayeredState &state,
                                  const std::vector<NewLayer> &layers);

  /** Phases, walls and source between so many fronts.
   * @throws Refusal for liquid that moves between several */
  Physics physics_between(const EventScene &setting, bool solid_inside,
                          std::size_t fronts);

  /** Steps for the rest of the run (s). */
  int steps_for(const EventScene &setting, double from);

  /** Time until a wall's value may jump or bend next (s); infinite where none does. */
  double time_to_breakpoint(const cases::Scene &scene, double time);

  /** Temperature beside an end of the ray. */
  double temperature_at_end(const EventScene &setting, const LayeredState &state,
                            bool inner);

  /** Coordinate on the ray of a point (m). */
  double coordinate_of(const EventScene &setting, const cases::Position &position);
} // namespace meltfront::reference_fem::fitted

#endif
