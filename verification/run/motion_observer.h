#ifndef meltfront_verification_run_motion_observer_h
#define meltfront_verification_run_motion_observer_h

#include <verification/measure/formulas/interface_error.h>
#include <verification/run/run_measures.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /**
   * Measures a run in which things move and no heat is conducted: particles of a solid,
   * or a front that a velocity carries along.
   *
   * Snapshots are taken of the initial state, of the first step at or after each of
   * Measurement::samples times, of each of Measurement::marks and of the end. A state
   * that is not finite ends the run with a NumericalError. If it is animated, up to 61
   * frames of at most 2000 particles are kept: 12 of them before the first mark, where
   * there is one, since marks stand where things happen.
   */
  class MotionObserver : public RunMeasures
  {
  public:
    /** As measures_of(). */
    MotionObserver(const cases::Case &c, const cases::Scene &simulated,
                   const std::string &method, cases::Observer *second = nullptr,
                   bool animated = false);

    void begin(const cases::RunDescription &description) override;
    bool wants(long step, double time) override;
    void observe(const cases::Snapshot &snapshot) override;
    void note(double time, const std::string &event) override;
    void outcome(const std::string &name, double value) override;

    void require_end() const override;
    void keep_course(RunRecord &record) const override;
    void keep_results(RunRecord &record) const override;

    /**
     * Results by name, NaN where not defined: those of cases::outcomes() that the method
     * told; of a particle solid
     *
     * solid_1 to solid_8, solid_end: particles that are solid at Measurement::marks and
     * at the end;
     *
     * and of a front that is carried along, at the same times, as InterfaceErrors:
     *
     * volume_error: relative, with its sign;
     * front_l1: mean distance between the fronts, in spacings;
     * shape_mismatch, shape_missing, shape_extra: over the exact region's volume;
     * normal_rms (degrees), curvature_rms (relative): at the points of the front.
     */
    static const std::vector<std::string> &quantity_names();

  private:
    bool at_the_end(double time) const;
    bool sample_is_due(long step, double time) const;
    bool mark_is_due(double time) const;
    bool picture_is_due(double time) const;
    void judge(const cases::Snapshot &snapshot) const;
    void add_to_series(const cases::Snapshot &snapshot);
    void measure(const cases::Snapshot &snapshot, const std::string &suffix);
    void keep_frame(const cases::Snapshot &snapshot);
    void keep_picture(const cases::Snapshot &snapshot);

    const cases::Case &the_case;
    const cases::Scene &scene;
    std::string method;
    cases::Observer *second;

    cases::RunDescription run_description;
    double tolerance; ///< a time this near another is the same (s)
    int samples;
    int next_sample = 0;
    std::size_t next_mark = 0;
    std::vector<double> picture_times; ///< of the animation
    std::size_t next_picture = 0;
    std::optional<InterfaceComparison> comparison;
    bool ended = false;
    long last_step = -1;
    double last_time;
    RunSeries run_series;
    std::vector<FrontFrame> front_frames;
    std::vector<ParticleFrame> particle_frames, animation;
    std::vector<RunEvent> run_events;
    std::map<std::string, double> values;
  };
} // namespace meltfront::verification

#endif
