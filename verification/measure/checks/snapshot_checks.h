#ifndef meltfront_verification_measure_checks_snapshot_checks_h
#define meltfront_verification_measure_checks_snapshot_checks_h

#include <cases/capabilities.h>
#include <cases/scene.h>
#include <cases/snapshot.h>
#include <verification/measure/checks/check.h>
#include <verification/measure/checks/given_heat.h>
#include <verification/measure/checks/metastable_sites.h>
#include <verification/measure/checks/site_heat.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /**
   * What the harness asks of every snapshot of every method that conducts heat, from the
   * scene's data and the snapshot's sites and weights alone:
   *
   * phase against temperature: the share of the domain that is solid above or liquid
   * below its melting temperature, away from fronts (MetastableFinder); none may be, by
   * more than temperatures may overshoot. Gibbs and Thomson's shift of the melting
   * temperature is allowed for up to the curvature of a body four spacings across;
   *
   * maximum principle: how far temperatures pass the extremes of initial, wall and
   * ambient temperatures, over their span; at most cases::allowed_overshoot() of what the
   * method declares, or round-off in a snapshot that says that it obeys the principle;
   *
   * heat of sites: how far stored and latent heat of the method's book are off what its
   * sites hold (SiteHeat), in relation to it; where a tracked front or a curved wall cuts
   * the volumes of sites, in relation to what the domain can take up: at most the share
   * that a layer one spacing thick along all walls is of it;
   *
   * heat balance: what the book's terms leave over, in relation to the largest of them so
   * far; round-off, but for a method that does not declare that it conserves heat: there
   * a layer of one spacing at all walls and on both sides of the front, 4 h / side, may
   * be unaccounted for, and of the heat that the whole domain can take up a layer of one
   * spacing, h / side, while little has been exchanged;
   *
   * heat of walls, heat of sources: how far the book's terms are off GivenHeat, over what
   * enters and leaves in the whole run; a release in a steady state may lie between
   * that and what the sites sample of it;
   *
   * Properties that depend on temperature end the run where they are no longer known.
   *
   * front against phases: the share of tracked points beside which no phase changes, 1
   * where a method that tracks its front reports none between two phases; none may be.
   *
   * What cannot be asked of a scene or a snapshot is not among the results: unchecked()
   * says why.
   */
  class SnapshotChecks
  {
  public:
    /**
     * @param scene as it is simulated; outlives the object
     * @param capabilities of the method's form that takes it
     * @param method its name, for messages
     * @param spacing of particles, or cell size (m)
     */
    SnapshotChecks(const cases::Scene &scene, const cases::Capabilities &capabilities,
                   const std::string &method, double spacing);

    /**
     * @throws NumericalError with step, time, quantity and place for a value that is not
     * finite or beyond its bound,
     * @throws Refusal where a phase beyond its melting temperature shows that a front
     * should have begun in a way that the method's capabilities do not name.
     */
    void judge(const cases::Snapshot &snapshot);

    /** The worst of the snapshots judged so far; one that ended the run is the last. */
    std::vector<Check> checks() const;

    /** Names of the checks that could not be made, with the reason. */
    std::map<std::string, std::string> unchecked() const;

    /** The bounds of the maximum principle: what the scene's temperatures at the sites
     * and curved fronts add to temperature_bounds(). */
    const cases::TemperatureBounds &bounds() const;

  private:
    enum Kind
    {
      phase,
      principle,
      heat_of_sites_,
      balance,
      heat_of_walls,
      heat_of_sources,
      front,
      n_kinds
    };

    struct Entry
    {
      const char *name;
      std::optional<double> value{}; ///< none as long as nothing was judged
      double bound = 0;
      std::string reason{}; ///< why it is not judged
    };

    /** Relative to the largest temperature: what is nearer is the same, of solutions of
     * systems that are rounded in thousands of steps (cases::temperature_round_off()). */
    static constexpr double same_temperature = 1e-9;

    /** Relative to what enters and leaves: sums over many steps. */
    static constexpr double integral_of_round_off = 1e-6;

    void require_finite(const cases::Snapshot &snapshot) const;
    bool add(Kind kind, double value);
    [[noreturn]] void end_run(const cases::Snapshot &snapshot,
                              const std::string &quantity,
                              const std::string &problem) const;

    // In temperature_checks.cc:
    cases::TemperatureBounds bounds_of_scene() const;
    void include_initial(const cases::Snapshot &snapshot);
    void include_liquidus(const cases::Snapshot &snapshot);
    double span() const;
    double temperature_of_melting() const;
    void judge_known_properties(const cases::Snapshot &snapshot) const;
    void judge_principle(const cases::Snapshot &snapshot);

    // In phase_checks.cc:
    void judge_phase(const cases::Snapshot &snapshot);
    bool releases_towards(bool solid, const cases::Position &place, double time) const;
    void refuse_unnamed_front(const cases::Snapshot &snapshot,
                              const MetastableSites &found) const;
    void judge_front(const cases::Snapshot &snapshot);

    // In heat_checks.cc:
    void judge_heat(const cases::Snapshot &snapshot);
    double expected_of_sources(const cases::Snapshot &snapshot) const;
    bool sites_are_cut() const;
    double heat_of_domain(const cases::Snapshot &snapshot) const;
    double heat_between(const cases::Snapshot &snapshot, double range) const;
    void judge_balance(const cases::Snapshot &snapshot, const SiteHeat &held);

    const cases::Scene &scene;
    cases::Capabilities capabilities;
    std::string method;
    double spacing;
    MetastableFinder finder;
    GivenHeat given;
    cases::TemperatureBounds principle_bounds;
    double lowest_seen, highest_seen;
    double largest_term = 0; ///< of the heat budget so far
    double capillary_shift;  ///< largest plausible one (K)
    bool tracks_front = false;
    std::vector<Entry> entries;
  };
} // namespace meltfront::verification

#endif
