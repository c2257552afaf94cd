#ifndef meltfront_particles_level_set_markers_marker_reseeding_h
#define meltfront_particles_level_set_markers_marker_reseeding_h

#include <particles/level_set/markers/marker_seeding.h>

namespace meltfront::particles::level_set
{
  /** Where new markers come from as the front stretches. */
  enum class ReseedingRule
  {
    none,
    grid,    ///< cells near the front are filled up, distances taken from the grid
    midpoint ///< between markers of one front that have moved apart
  };

  struct ReseedingParameters
  {
    ReseedingRule rule = ReseedingRule::midpoint;
    /** How the first markers were strewn: cells that hold as many are left alone, and
     * rule `grid` draws alike. */
    SeedingParameters seeding;
    int most = 48; ///< markers of a cell beyond it go, the youngest first
  };

  /**
   * Keeps the number of markers along a front. They are deleted where |d| > 3 spacings,
   * or |phi| > 3 spacings while |d| > 1, and from crowded cells.
   *
   * Rule `grid`, section 4.2.6 of the report: new markers take over what the grid has
   * lost, distances of thin filaments above all.
   *
   * Rule `midpoint`: marker p with |d_p| < 1 spacing looks along its tangent for the
   * nearest marker q of the same sheet (n_p . n_q > 0.85, the tangent plane of p gives
   * d_q to 0.25 spacings, offset along n_p below half a spacing). If the gap is from 0.5
   * to 1.2 spacings a marker is born between them, with d = (d_p + d_q)/2 + (n_p - n_q) .
   * (x_q - x_p)/8 and the mean normal. In space it looks along two tangents, 45 degrees
   * to all sides of each.
   */
  class MarkerReseeding
  {
  public:
    MarkerReseeding(const Grid &grid, const ReseedingParameters &parameters);

    /**
     * Delete and add markers.
     * @param cells with the markers as they are; sorted anew afterwards
     * @param phi the level set (m)
     */
    void apply(Markers &markers, MarkerCells &cells, std::span<const double> phi);

    /** Markers born since the start. */
    std::size_t born() const
    {
      return total_born;
    }

  private:
    void thin_out(Markers &markers, MarkerCells &cells, std::span<const double> phi);
    void add_from_grid(Markers &markers, MarkerCells &cells, std::span<const double> phi);

    const Grid grid;
    const ReseedingParameters parameters;
    std::uint32_t next_birth = 0;
    std::uint64_t rounds = 0;
    std::size_t total_born = 0;
  };
} // namespace meltfront::particles::level_set

#endif
