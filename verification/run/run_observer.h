#ifndef meltfront_verification_run_run_observer_h
#define meltfront_verification_run_run_observer_h

#include <cases/case.h>
#include <cases/method.h>
#include <verification/measure/checks/snapshot_checks.h>
#include <verification/measure/formulas/event_watch.h>
#include <verification/measure/formulas/front_reader.h>
#include <verification/measure/formulas/mirror_symmetry.h>
#include <verification/measure/formulas/run_statistics.h>
#include <verification/run/alloy_measures.h>
#include <verification/run/run_measures.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /**
   * Measures a run that conducts heat: reads fronts and budgets from each snapshot, holds
   * them against the case's exact solution, keeps the profile of the end.
   *
   * Snapshots are taken of the initial state, of the first step at or after each of
   * Measurement::samples times equidistant in t or sqrt(t), of the end, and of the steps
   * around each of Measurement::marks. Events (Measurement::events) look at every step
   * until they have happened, at nothing but the solid fractions. Each is judged by
   * SnapshotChecks: a breach ends the run. Where no phase changes there is no
   * front and no volume that is solid: these quantities are NaN.
   */
  class RunObserver : public RunMeasures
  {
  public:
    /**
     * @param c the case, which outlives the observer
     * @param simulated the case's scene as it is handed to the method, outlives it too
     * @param method its name, for messages
     * @param capabilities of the method's form that takes the scene
     * @param second receives what it wants of the same run, or null
     * @throws InputError if the run ends when it starts (every error would be that of the
     * initial state), or for fewer than 50 samples (but 0, every step).
     */
    RunObserver(const cases::Case &c, const cases::Scene &simulated,
                const std::string &method, const cases::Capabilities &capabilities,
                cases::Observer *second = nullptr);

    void begin(const cases::RunDescription &description) override;
    bool wants(long step, double time) override;
    void observe(const cases::Snapshot &snapshot) override;
    void note(double time, const std::string &event) override;

    void require_end() const override;
    void keep_course(RunRecord &record) const override;
    void keep_results(RunRecord &record) const override;

    const cases::RunDescription &description() const;
    const RunSeries &series() const;
    const RunProfile &profile() const;

    /** States of an alloy at the marks; of a pure substance at the one of which a picture
     * is kept. */
    std::vector<RunProfile> mark_profiles() const;

    /** What the method reported between snapshots. */
    const std::vector<RunEvent> &events() const;

    /** Tracked points on the front at the marks and at the end. */
    const std::vector<FrontFrame> &frames() const;

    /**
     * Results by name, NaN where not defined; errors of the front are found - exact, in
     * m:
     *
     * front_rms, front_max: over all snapshots but an initial one without a front; no
     * root mean square of fewer than 50;
     * front_end: |error| at the end; front_end_position: the front found there;
     * front_rms_relative, front_end_relative: over the exact front at the end;
     * front_late_max_relative: largest over the second half of the time, over the same;
     * front_isotherm_rms: of the front read from T = T_m;
     * front_max_ice_rms, front_heat_loss_rms: of the readings of the same names, over
     * snapshots with at least one fully frozen site;
     * front_points_rms, front_points_max: of the signed distance of tracked front points
     * from the exact front, over the same snapshots as front_rms;
     * roundness_end: roundness() of tracked points at the end, of a round front;
     * front_row_solid_fraction: mean solid fraction of the partly frozen sites at the
     * end; front_backsteps: farthest that the front fell back behind where it had been
     * on its way (the exact front's, or without one its own net way);
     * front_mode_end: front_mode_amplitude() at the end of Measurement::front_mode;
     * front_floor: Measurement::front_floor, where it is not zero;
     * front_square_slope, front_square_r2: SquareLaw from Measurement::front_square_from
     * on (m^2/s), and how much of the variance it explains;
     * solid_volume_end: at the end (m, m^2, m^3 in the measure of the scene);
     * solid_volume_1 to _8: at Measurement::marks, interpolated() between steps;
     * solid_volume_backsteps: farthest that it fell back, over its net change;
     * temperature_l2, temperature_max, temperature_rmse, temperature_sites_l2:
     * TemperatureError at the end;
     * temperature_overshoot: farthest beyond the bounds of the maximum principle in any
     * snapshot, over their span; 0 within them, NaN where they are not both finite;
     * first_contact, half_frozen, all_frozen: times of Measurement::events (s);
     * mirror_asymmetry: largest MirrorSymmetry of any snapshot (K), where asked for;
     * budget_defect: largest of any snapshot;
     * those of AlloyMeasures.
     */
    std::map<std::string, double> quantities() const;

    /** The names of all of them. */
    static const std::vector<std::string> &quantity_names();

  private:
    double clock(double time) const;
    bool sample_is_due(long step, double time) const;
    bool wants_itself(long step, double time) const;
    bool round_front() const;
    void measure(const cases::Snapshot &snapshot, bool keep);
    void add_to_series(const cases::Snapshot &snapshot, const FrontReading &reading,
                       double lowest, double highest);
    double exact_front(double time) const; ///< NaN before the solution's start
    void compare_fronts(const cases::Snapshot &snapshot, const FrontReading &reading);
    void keep_frame(const cases::Snapshot &snapshot);
    void add_volumes(std::map<std::string, double> &values) const;
    void measure_end(const cases::Snapshot &snapshot);

    const cases::Case &the_case;
    const cases::Scene &scene;
    const cases::ExactSolution *exact;
    std::string method;
    cases::Observer *second;
    cases::Capabilities capabilities;
    std::optional<SnapshotChecks> checks;

    cases::RunDescription run_description;
    std::optional<FrontReader> reader;
    std::optional<EventWatch> event_watch;
    std::optional<MirrorSymmetry> mirror;
    std::optional<AlloyMeasures> alloy;
    int samples;         ///< times equidistant on the clock at which the series is kept
    int next_sample = 0; ///< index of the next of them
    long last_step = -1;
    double last_time;
    RunSeries run_series;
    RunProfile end_profile;
    std::vector<FrontFrame> front_frames;
    std::vector<RunEvent> run_events;
    FrontCourse course, volume_course;
    ErrorStatistics front, late_front, isotherm, max_ice, heat_loss, front_points;
    double farthest_point; ///< NaN as long as no point was tracked
    double overshoot;      ///< over the bounds' span
    MarkWatch marks;
    std::size_t next_mark = 0; ///< of Measurement::marks, whose frame is to be kept
    std::vector<double> volume_times, volumes; ///< of all snapshots
    double worst_defect, worst_asymmetry;
    std::map<std::string, double> at_end;
  };
} // namespace meltfront::verification

#endif
