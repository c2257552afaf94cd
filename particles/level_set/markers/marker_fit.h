#ifndef meltfront_particles_level_set_markers_marker_fit_h
#define meltfront_particles_level_set_markers_marker_fit_h

#include <particles/level_set/markers/marker_storage.h>

#include <span>

namespace meltfront::particles::level_set
{
  /** When markers around a node set its value; lengths in spacings. */
  struct FitParameters
  {
    bool clustered = true;   ///< keep only markers of the nearest front
    double furthest = 1.5;   ///< markers further from the front do not count
    double nearest = 1;      ///< one at least is as near to the front
    double band = 2;         ///< nodes further from the front are left
    int quadratic = 9;       ///< least markers of a quadratic fit
    int linear = 4;          ///< least markers of a linear fit
    double weight = 0.3;     ///< least sum of weights
    double pivot = 1e-6;     ///< least pivot over the largest diagonal entry
    double quantile = 0.125; ///< of the nearest candidates, whose last is the reference
    double alignment = 0.8;  ///< least cosine with the reference's normal
    double window = 0.4;     ///< furthest from the reference's candidate
    double tolerance = 0.15; ///< furthest from the mean of candidates
    /** The conditions of the fits that 3D needs: 10 and 4 terms. */
    static FitParameters in(int dimension);
  };

  /** What a correction did. */
  struct FitCounts
  {
    std::size_t quadratic = 0; ///< nodes set by a quadratic fit
    std::size_t linear = 0;    ///< by a linear one
    std::size_t mean = 0;      ///< by the mean of tangent planes
    std::size_t left = 0;      ///< near the front, with too few markers
  };

  /**
   * Sets a level set at the nodes near markers from their distances, section 4.2.5 of the
   * report: at each node least squares with hat weights w = prod (1 - |X_i|), X = (x_p -
   * x_i) / spacing, over the markers in the cells around it; phi is the fit at the node.
   * A quadratic polynomial; with few markers a linear one; else the node is left.
   *
   * Clustered, for fronts that come near each other: each marker says c_p = d_p - n_p .
   * (x_p - x_i), the tangent plane's value; the reference is the last of the low quantile
   * of |c_p|, the nearest front; markers with a like normal and value are kept; the
   * quadratic fit counts where it agrees with their weighted mean of c_p, and else that
   * mean.
   */
  FitCounts fit_level_set(const Grid &grid, const Markers &markers,
                          const MarkerCells &cells, const FitParameters &parameters,
                          std::span<double> phi, int threads);
} // namespace meltfront::particles::level_set

#endif
