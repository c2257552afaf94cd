#ifndef meltfront_verification_measure_formulas_site_coordinates_h
#define meltfront_verification_measure_formulas_site_coordinates_h

#include <cases/position.h>
#include <cases/snapshot.h>

#include <array>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /** The position of a site (m); coordinates beyond the snapshot's dimension are zero. */
  cases::Position site_position(const cases::Snapshot &snapshot, std::size_t site);

  /** A place as messages name it, `x = 0.5` or `(0.5, 0.25)`. */
  std::string place_text(const cases::Position &place, int dimension);

  /**
   * The coordinates (x or r, m) of a snapshot's sites, computed again only when sites
   * have moved: snapshots of every step would otherwise cost more than the steps.
   */
  class SiteCoordinates
  {
  public:
    explicit SiteCoordinates(cases::Symmetry symmetry);

    /** One coordinate per site, valid until the next call. */
    const std::vector<double> &of(const cases::Snapshot &snapshot);

    /** How often they have been computed: what is derived from them holds while it stays.
     */
    long version() const;

  private:
    bool moved(const cases::Snapshot &snapshot) const;

    cases::Symmetry symmetry;
    std::array<std::vector<double>, 3> positions; ///< for which `coordinates` holds
    std::vector<double> coordinates;
    long times_computed = 0;
  };
} // namespace meltfront::verification

#endif
