#ifndef meltfront_verification_measure_formulas_event_watch_h
#define meltfront_verification_measure_formulas_event_watch_h

#include <cases/case.h>
#include <cases/snapshot.h>

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace meltfront::verification
{
  /**
   * When two bodies of solid first connect. A body is made of sites frozen throughout
   * that touch: corners of one cell of a mesh, particles nearer than 1.5 spacings. (Sites
   * half frozen, with the front in their middle, leave a gap of a spacing between two
   * bodies that they join: contact would come early in proportion to the spacing.) The
   * bodies are those around the scene's sinks, each found by the site that is nearest to
   * it.
   *
   * Sites join in the order in which they freeze, interpolated in their enthalpy between
   * two snapshots: the time found is finer than a step.
   */
  class ContactWatch
  {
  public:
    /** @param spacing of particles (m) */
    ContactWatch(const cases::Scene &scene, double spacing);

    /** Snapshots come in their order. @return whether the bodies are one. */
    bool observe(const cases::Snapshot &snapshot);

    /** The time of the contact (s), NaN as long as there is none. */
    double time() const;

  private:
    bool moved(const cases::Snapshot &snapshot) const;
    void begin(const cases::Snapshot &snapshot);
    void find_touching(const cases::Snapshot &snapshot);
    void find_seeds(const cases::Snapshot &snapshot);
    void rebuild();
    void follow(const cases::Snapshot &snapshot);
    void join(std::uint32_t site);

    /** Specific enthalpy (J/kg) above that of the solid at the melting point; of a liquid
     * its latent heat. */
    double heat_until_frozen(const cases::Snapshot &snapshot, std::size_t site) const;
    std::uint32_t body_of(std::uint32_t site);
    bool connected();

    cases::Material material;
    std::vector<cases::Position> sinks;
    double spacing;
    std::array<std::vector<double>, 3> positions; ///< for which `touching` holds
    std::vector<std::vector<std::uint32_t>> touching;
    std::vector<std::uint32_t> seeds; ///< the sites nearest to the sinks
    std::vector<std::uint32_t> body;  ///< a forest: each site points towards its root
    std::vector<char> solid;          ///< sites frozen throughout, in the last snapshot
    std::vector<double> heat;         ///< heat_until_frozen() in the last snapshot
    std::vector<std::pair<double, std::uint32_t>> frozen; ///< since then, with the times
    double last_time;
    double contact;
  };

  /**
   * The times of a run's events (cases::TimedEvent), from a snapshot of every step:
   *
   * first_contact: ContactWatch; half_frozen: half of the volume is solid, interpolated
   * between two snapshots; all_frozen: the first snapshot in which no more than 1e-12 of
   * the volume is liquid.
   */
  class EventWatch
  {
  public:
    EventWatch(const cases::Scene &scene, const std::vector<cases::TimedEvent> &wanted,
               double spacing);

    /** Whether an event that is wanted has not happened yet. */
    bool pending() const;

    void observe(const cases::Snapshot &snapshot);

    /** The time of an event (s); NaN for one that is not wanted or has not happened. */
    double time(cases::TimedEvent event) const;

  private:
    bool awaits(cases::TimedEvent event) const;
    void happened(cases::TimedEvent event, double time);
    void follow_volume(const cases::Snapshot &snapshot);

    std::array<bool, cases::n_timed_events> wanted{};
    std::array<double, cases::n_timed_events> times;
    std::optional<ContactWatch> contact;
    double last_share, last_time; ///< solid share of the volume in the last snapshot
  };
} // namespace meltfront::verification

#endif
