#ifndef meltfront_verification_run_heat_observer_h
#define meltfront_verification_run_heat_observer_h

#include <cases/numbers.h>
#include <verification/measure/checks/snapshot_checks.h>
#include <verification/measure/formulas/run_statistics.h>
#include <verification/run/run_observer.h>

#include <optional>

namespace meltfront::verification
{
  /**
   * Observes a run that conducts heat: judges each snapshot by SnapshotChecks, where a
   * breach ends the run, reads the front once for all measures, keeps profiles.
   *
   * It asks for the steps around each of Measurement::intermediate_times too. Where no
   * phase changes there is no front and no volume that is solid: these are NaN.
   */
  class HeatObserver : public RunObserver
  {
  public:
    /**
     * As RunObserver.
     * @param capabilities of the method's form that takes the scene
     * @throws InputError if the run ends when it starts (every error would be that of the
     * initial state), or for fewer than 50 samples (but 0, every step).
     */
    HeatObserver(const cases::Case &c, const cases::Scene &simulated,
                 const std::string &method, const cases::Capabilities &capabilities,
                 cases::Observer *second = nullptr);

    void keep_course(RunRecord &record) const override;
    void keep_results(RunRecord &record) const override;
    Results quantities() const override;

    /** Of the end. */
    const RunProfile &profile() const;

  private:
    void start() override;
    bool asks_for(long step, double time) override;
    void see(Sighting sighting) override;
    double exact_front(double time) const;
    double exact_heat() const;
    void add_to_series(const Sighting &sighting);
    void keep_pictures(const Sighting &sighting);

    const cases::ExactSolution *exact;
    cases::Capabilities capabilities;
    std::optional<SnapshotChecks> checks;
    std::optional<FrontReader> reader;
    SnapshotTimes intermediate_times;
    RunProfile end_profile;
    std::vector<TemperatureProbe> probes;
    double exact_volume = cases::nan; ///< of the solid at the end
    /** States of an alloy at the intermediate times; of a pure substance at the one of
     * which a picture is kept. */
    std::vector<RunProfile> profiles;
  };
} // namespace meltfront::verification

#endif
