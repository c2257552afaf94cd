#ifndef meltfront_verification_measure_checks_metastable_sites_h
#define meltfront_verification_measure_checks_metastable_sites_h

#include <cases/alloy.h>
#include <cases/scene.h>
#include <cases/snapshot.h>

#include <optional>

namespace meltfront::verification
{
  /** Sites of a phase that is not stable at their temperature, away from any front. */
  struct MetastableSites
  {
    double share = 0; ///< of the domain's volume
    // Of the site that is farthest beyond:
    std::size_t site = 0;
    double beyond = 0; ///< how far solid is too warm, or liquid too cold (K)
    bool solid = false;
  };

  /**
   * Finds solid above and liquid below its melting temperature: of an alloy, liquid below
   * the liquidus of what it holds and the eutectic temperature, and solid that holds
   * solute above the eutectic temperature.
   *
   * A phase that the scene starts with beyond its melting temperature is left out:
   * nothing says where it has to end. Sites within two spacings of a front are left out,
   * where the phase of a site and the temperature of its volume need not agree: of
   * tracked points, or of a site that is of the other phase or partly frozen.
   */
  class MetastableFinder
  {
  public:
    /** @param spacing of the sites (m) */
    MetastableFinder(const cases::Scene &scene, double spacing);

    /** @param tolerance how far beyond a phase may be (K) */
    MetastableSites find(const cases::Snapshot &snapshot, double tolerance) const;

  private:
    double beyond(const cases::Snapshot &snapshot, std::size_t site,
                  double tolerance) const;

    double melting_temperature, eutectic_temperature;
    std::shared_ptr<const cases::MeltingRange> range;
    cases::MetastableStart at_start;
    std::optional<cases::PhaseDiagram> diagram;
    double reach; ///< distance from a front within which sites are left out (m)
  };
} // namespace meltfront::verification

#endif
