#ifndef meltfront_reference_fem_cut_level_set_h
#define meltfront_reference_fem_cut_level_set_h

#include <reference_fem/cut/cut_geometry.h>

#include <functional>

namespace meltfront::reference_fem::cut
{
  using PointFunction = std::function<double(const Point &)>;

  /**
   * Signed distance (m) to the zeros of a function, at the mesh's degrees of freedom near
   * them; its sign times the distance to the nearest of those elsewhere. Newton's method
   * along the function's gradient, by differences: only sign and zeros matter.
   */
  Values signed_distance_to_zeros(const BackgroundMesh &mesh,
                                  const PointFunction &function);

  /** Move values that are nearly zero off the vertices, so that no phase is a point. */
  void keep_off_nodes(const BackgroundMesh &mesh, Values &level_set);

  /**
   * Make a level set the signed distance to its own zeros, outside of the cells that the
   * front cuts: the front itself does not move at all. A node that the front reaches
   * later has the exact distance when it does.
   */
  void redistance(const BackgroundMesh &mesh, const CutGeometry &geometry,
                  Values &level_set);

  struct ValueAndGradient
  {
    double value = 0;
    Gradient gradient;
  };

  /** A level set at a point of a cell, or, continued, beside it. */
  ValueAndGradient evaluate(const BackgroundMesh &mesh, const Cell &cell,
                            const Values &level_set, const Point &unit);

  /** Smallest distance (m) of a cell's nodes into a phase, as the level set says;
   * negative where the cell holds a part of the phase. */
  double distance_to_phase(const Cell &cell, const Values &level_set, Phase phase);
} // namespace meltfront::reference_fem::cut

#endif
