#ifndef meltfront_particles_level_set_markers_marker_scheme_h
#define meltfront_particles_level_set_markers_marker_scheme_h

#include <particles/level_set/advection.h>
#include <particles/level_set/markers/marker_escape.h>
#include <particles/level_set/markers/marker_fit.h>
#include <particles/level_set/markers/marker_motion.h>
#include <particles/level_set/markers/marker_reseeding.h>

#include <string>

namespace meltfront::particles::level_set
{
  /** Which markers correct a level set, and how. */
  struct MarkerParameters
  {
    /** Whether all markers count, by a fit; else those that have escaped. */
    bool interpolative = true;
    FitParameters fit;       ///< only of the interpolative scheme
    EscapeParameters escape; ///< only of the others
    int per_cell = 12;       ///< markers drawn in each cell near the front
    /** Whether distances are strained with the flow; they stay anyway where it is rigid.
     * Only of the interpolative scheme. */
    bool carry_distance = true;
    ReseedingRule reseeding = ReseedingRule::midpoint; ///< not where the flow is rigid
    int reseed_every = 20;                             ///< steps
    int correct_every = 1;                             ///< steps
    std::uint64_t seed = 1;
    int threads = 1; ///< results have the same bits for any number

    /** The particle level set of Enright, Fedkiw, Ferziger, Mitchell (2002). */
    static MarkerParameters original();

    /** With the values of escaped markers signed by the side of the node. */
    static MarkerParameters corrected(EscapeMerge merge = EscapeMerge::smaller_magnitude);

    /**
     * The interpolative scheme of the Sandia report (Erickson et al. 2016).
     * @param clustered whether only the nearest front counts at a node: for any flow but
     * a rigid one; else a single fit through all markers, distances kept
     */
    static MarkerParameters interpolating(int dimension, bool clustered = true);
  };

  /** What markers have done since they were seeded. */
  struct MarkerWork
  {
    double moved = 0;       ///< markers, summed over the steps
    double corrections = 0; ///< times that the level set was corrected
    double nodes = 0;       ///< nodes set by fits, summed over the corrections
    double escaped = 0;     ///< escaped markers, summed over the corrections
    double born = 0;        ///< by reseeding
  };

  /**
   * Markers that know the true front and correct a level set that moves with the same
   * velocity. Per step: move, correct; after a reinitialisation refresh; now and then
   * reseed.
   *
   * @code
   * MarkerScheme scheme(grid, MarkerParameters::interpolating(2, false), "front
   * tracking"); scheme.seed([&](const Position &p) { return distance(p); });
   * scheme.move(velocity, step);
   * advection.step(level_set, velocity_function(velocity), step);
   * scheme.correct(level_set);
   * @endcode
   */
  class MarkerScheme
  {
  public:
    /**
     * @param method its name, for messages
     * @throws cases::InputError for parameters out of range
     */
    MarkerScheme(const Grid &grid, const MarkerParameters &parameters,
                 std::string method);

    /** Replace all markers by new ones along a front. */
    void seed(const DistanceFunction &distance);

    /** Move the markers by a step.
     * @throws cases::NumericalError if one's place is not finite afterwards */
    void move(const cases::VelocityField &velocity, const TimeStep &step);

    /** Correct the level set, whose front may move by less than two spacings. */
    void correct(LevelSet &level_set);

    /** Correct after a reinitialisation; markers that look for escapes take new radii. */
    void refresh(LevelSet &level_set);

    /** Delete and add markers. */
    void reseed(const LevelSet &level_set);

    /** Whether it is time for a correction or for reseeding, after a step's number. */
    bool corrects_at(long step) const;
    bool reseeds_at(long step) const;

    const Markers &markers() const
    {
      return all;
    }

    const MarkerWork &work() const
    {
      return done;
    }

  private:
    Carried carried(const cases::VelocityField &velocity) const;

    const Grid grid;
    const MarkerParameters parameters;
    Markers all;
    MarkerCells cells;
    EscapeCorrection escapes;
    MarkerReseeding reseeding;
    MarkerMotion motion;
    MarkerWork done;
    bool rigid = true; ///< whether all motion so far was
  };
} // namespace meltfront::particles::level_set

#endif
