#ifndef meltfront_verification_ranks_gathering_observer_h
#define meltfront_verification_ranks_gathering_observer_h

#include <cases/stopwatch.h>
#include <verification/ranks/method_on_ranks.h>
#include <verification/ranks/whole_snapshot.h>

namespace meltfront::verification
{
  /** How long a run may take, and whether it was ended for it. */
  struct TimeLimit
  {
    double seconds = 0; ///< of wall time; 0: as long as it takes
    bool exceeded = false;
  };

  /**
   * Stands between a run on several ranks and who observes it: on the first rank an
   * observer of whole snapshots, whose wishes are those of all ranks, and on each rank
   * one of its part, who wants the same on all. What an observer throws on one rank ends
   * the run on all of them.
   */
  class GatheringObserver : public cases::Observer
  {
  public:
    /**
     * @param whole observes whole snapshots; null on all ranks but the first
     * @param part observes this rank's parts, or null on all ranks
     * @param limit of the time from now on, which the first rank looks at
     * @param keeper keeps states of the run, or null on all ranks
     */
    GatheringObserver(const MethodOnRanks &method, MPI_Comm communicator,
                      cases::Observer *whole, cases::Observer *part, TimeLimit &limit,
                      cases::StateKeeper *keeper = nullptr);

    void begin(const cases::RunDescription &description) override;
    bool wants(long step, double time) override;
    void observe(const cases::Snapshot &snapshot) override;
    void note(double time, const std::string &event) override;
    void report(const std::string &name, double value) override;
    cases::StateKeeper *state_keeper() override
    {
      return keeper;
    }

  private:
    const MethodOnRanks &method;
    MPI_Comm communicator;
    cases::Observer *whole, *part;
    TimeLimit &limit;
    cases::StateKeeper *keeper;
    cases::Stopwatch watch;
    WholeSnapshot gatherer;
    bool whole_wanted = false, part_wanted = false;
  };
} // namespace meltfront::verification

#endif
