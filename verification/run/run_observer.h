#ifndef meltfront_verification_run_run_observer_h
#define meltfront_verification_run_run_observer_h

#include <cases/case.h>
#include <cases/method.h>
#include <verification/measure/measure.h>
#include <verification/record/run_record.h>

#include <memory>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /**
   * Takes the snapshots of a run that its measures need, keeps its course, and hands a
   * second observer what that wants.
   *
   * Snapshots are taken of the initial state, of the first step at or after each of
   * Measurement::samples times equidistant in t or sqrt(t), of the end, and of what the
   * kind of scene asks for. A measure may watch every step.
   */
  class RunObserver : public cases::Observer
  {
  public:
    void begin(const cases::RunDescription &description) override;
    bool wants(long step, double time) override;
    std::vector<double> wanted_times() const override;
    void observe(const cases::Snapshot &snapshot) override;
    void note(double time, const std::string &event) override;

    /** @throws NumericalError if the method did not take the run to its end. */
    void require_end() const;

    /** Write what is known of a run however it ended. */
    virtual void keep_course(RunRecord &record) const;

    /** Write what is known of a run that reached its end. */
    virtual void keep_results(RunRecord &record) const;

    const RunSeries &series() const;

    /** Tracked points on the front at the intermediate times and at the end. */
    const std::vector<FrontFrame> &frames() const;

    /** What the measures know, by name; where heat is conducted NaN for what they do not
     * know. */
    virtual Results quantities() const;

  protected:
    /**
     * @param c the case, which outlives the observer
     * @param simulated the case's scene as it is handed to the method, outlives it too
     * @param method its name, for messages
     * @param second receives what it wants of the same run, or null
     */
    RunObserver(const cases::Case &c, const cases::Scene &simulated,
                const std::string &method, cases::Observer *second);

    /** Begin to measure. */
    virtual void start() = 0;

    /** Whether the state after a step is to be seen, whatever others want. */
    virtual bool asks_for(long step, double time) = 0;

    /** Every state that the method hands out. */
    virtual void look(const cases::Snapshot &)
    {
    }

    /** A state that was asked for, or the end. @param sighting without what is read */
    virtual void see(Sighting sighting) = 0;

    void start_measures(MeasuredScenes scenes, const InterfaceComparison *carried);
    bool sample_is_due(long step, double time) const;
    bool intermediate_is_due(double time) const;
    void observe_with_all(const Sighting &sighting);
    void keep_front(const cases::Snapshot &snapshot);

    const cases::Case &the_case;
    const cases::Scene &scene;
    std::string method;
    int samples;      ///< times equidistant on the clock at which the series is kept
    double tolerance; ///< a time this near another is the same (s)
    cases::RunDescription description;
    RunSeries run_series;
    std::vector<FrontFrame> front_frames;

    cases::Observer *second;

  private:
    double clock(double time) const;

    std::vector<std::unique_ptr<Measure>> started;
    int next_sample = 0;               ///< index of the next of the samples
    std::size_t next_intermediate = 0; ///< of Measurement::intermediate_times
    bool ended = false;
    long last_step = -1;
    double last_time;
    std::vector<RunEvent> run_events;
  };
} // namespace meltfront::verification

#endif
