#ifndef meltfront_verification_measure_formulas_mirror_symmetry_h
#define meltfront_verification_measure_formulas_mirror_symmetry_h

#include <cases/snapshot.h>
#include <verification/measure/formulas/site_coordinates.h>

#include <cstdint>
#include <vector>

namespace meltfront::verification
{
  /** How far the temperature of a run is from its mirror image in a coordinate plane. */
  class MirrorSymmetry
  {
  public:
    /**
     * @param direction that is mirrored: 0 for T(-x, y, z)
     * @param spacing of the sites (m): images within 1e-6 of it are sites
     */
    MirrorSymmetry(int direction, double spacing);

    /**
     * Largest |T - T at the mirrored site| (K); NaN where a site has no image, as on a
     * mesh that is not symmetric.
     */
    double largest_difference(const cases::Snapshot &snapshot);

  private:
    void find_images(const cases::Snapshot &snapshot);

    int direction;
    double spacing;
    SiteCoordinates sites; ///< tells when sites have moved
    long images_version = 0;
    std::vector<std::uint32_t> image; ///< of each site; empty where one has none
  };
} // namespace meltfront::verification

#endif
