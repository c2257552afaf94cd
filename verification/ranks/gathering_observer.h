#ifndef meltfront_verification_ranks_gathering_observer_h
#define meltfront_verification_ranks_gathering_observer_h

#include <cases/stopwatch.h>
#include <verification/ranks/method_on_ranks.h>
#include <verification/ranks/whole_snapshot.h>

namespace meltfront::verification
{
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
     * @param time_limit wall seconds from now on after which the run is ended; 0: none
     */
    GatheringObserver(const MethodOnRanks &method, MPI_Comm communicator,
                      cases::Observer *whole, cases::Observer *part, double time_limit);

    void begin(const cases::RunDescription &description) override;
    bool wants(long step, double time) override;
    void observe(const cases::Snapshot &snapshot) override;
    void note(double time, const std::string &event) override;
    void report(const std::string &name, double value) override;

  private:
    const MethodOnRanks &method;
    MPI_Comm communicator;
    cases::Observer *whole, *part;
    double time_limit;
    cases::Stopwatch watch;
    WholeSnapshot gatherer;
    bool whole_wanted = false, part_wanted = false;
  };
} // namespace meltfront::verification

#endif
