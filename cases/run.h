#ifndef meltfront_cases_run_h
#define meltfront_cases_run_h

#include <cases/method.h>
#include <cases/stopwatch.h>

#include <functional>
#include <vector>

namespace boost::archive
{
  class binary_iarchive;
  class binary_oarchive;
} // namespace boost::archive

namespace meltfront::cases
{
  /**
   * One run of a method on a scene: what is the method's own. Its constructor sets it up;
   * Method::solve makes it, times it and hands its states to the observer.
   */
  class Run
  {
  public:
    virtual ~Run() = default;

    /** What the run is going to do: asked for before the first state is handed over. */
    virtual RunDescription describe() const = 0;

    /** What the run cost and counted, but for its times. */
    virtual Cost cost() const = 0;

    /**
     * Take the run from the scene's start to its end.
     * @param since_setup started when setting it up began
     * @return cost(), with times that exclude the observer's; what comes before the
     * initial state is set-up
     */
    Cost carry_out(const Scene &scene, const Stopwatch &since_setup, Observer &observer);

  protected:
    /** All steps, reached() after each of them and at the initial state, which is step 0;
     * a steady scene's only state is its last. That is at the scene's end time exactly.
     * A run that is resumed goes on from what restore() has read.
     */
    virtual void take_steps() = 0;

    /** Write all that the steps to come depend on, to the bit; counts of what was done
     * too. Called in reached(). By default a run cannot be resumed. */
    virtual void save(boost::archive::binary_oarchive &state) const;

    /** Read what save() wrote of the same run, after it was set up like any other. */
    virtual void restore(boost::archive::binary_iarchive &state);

    /** Whether the times spent until the state that was restored last count as this
     * run's: where ranks share a run, each of their states counts once among all. */
    virtual bool takes_over_times() const
    {
      return true;
    }

    /** Whether states of this run are kept. */
    bool keeps_states() const
    {
      return keeper != nullptr;
    }

    /** Whether restore() was called. */
    bool is_resumed() const
    {
      return resumed;
    }

    /** The state that the run has reached. What the snapshot spans lives until the run
     * goes on. */
    virtual Snapshot snapshot(long step, double time) = 0;

    /** Hands a snapshot over if this is the first state or the last, or if it is wanted.
     */
    void reached(long step, double time);

    /** As Observer::wanted_times(); the start and the end where none are told. */
    std::vector<double> wanted_times() const;

    /** Wait for what another process does. What that says it spent counts as stepping,
     * and the time of this process does not. */
    void work_elsewhere(const std::function<Stopwatch::Seconds()> &work);

    /** As Observer::note. */
    void note(double time, const std::string &event);

    /** As Observer::report. */
    void report(const std::string &name, double value);

  private:
    void resume(std::istream &state);
    void write_state(std::ostream &state, const Stopwatch::Seconds &so_far) const;

    Observer *observer = nullptr;
    StateKeeper *keeper = nullptr;
    bool begun = false, resumed = false;
    double start_time = 0, end_time = 0;
    Stopwatch watch;
    Stopwatch::Seconds setup, elsewhere;
    Stopwatch::Seconds setup_before, stepping_before; ///< until the run was left
  };
} // namespace meltfront::cases

#endif
