#ifndef meltfront_verification_ranks_gathering_keeper_h
#define meltfront_verification_ranks_gathering_keeper_h

#include <verification/ranks/part_observer.h>

#include <mpi.h>

namespace meltfront::verification
{
  /**
   * Keeps states of a run that ranks share: the first rank's keeper decides when, and is
   * given what all ranks write, each its part. So one file, written whole or not at all,
   * holds the same moment of all ranks. On as many ranks each goes on from its own part,
   * on another number of them each from what it needs of all parts.
   *
   * All of it is called on all ranks at the same time.
   */
  class GatheringKeeper : public cases::StateKeeper
  {
  public:
    /**
     * @param whole keeps the states of all; null on all ranks but the first
     * @param part observes this rank's part of the run
     */
    GatheringKeeper(MPI_Comm communicator, cases::StateKeeper *whole, PartObserver &part);

    std::unique_ptr<std::istream> state_to_resume() override;
    void offer(long step, double time,
               const std::function<void(std::ostream &)> &save) override;

  private:
    MPI_Comm communicator;
    cases::StateKeeper *whole;
    PartObserver &part;
  };
} // namespace meltfront::verification

#endif
