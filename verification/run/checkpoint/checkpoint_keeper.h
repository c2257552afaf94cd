#ifndef meltfront_verification_run_checkpoint_checkpoint_keeper_h
#define meltfront_verification_run_checkpoint_checkpoint_keeper_h

#include <verification/run/checkpoint/checkpoint_folder.h>
#include <verification/run/checkpoint/logged_observer.h>

#include <chrono>
#include <map>

namespace meltfront::verification
{
  /**
   * Stands between a run and its observer and keeps checkpoints of both: the run's state,
   * and all that the observer was told. A run that is resumed tells its new observer the
   * same first, so that what it measures is that of a run that was never left.
   */
  class CheckpointKeeper : public LoggedObserver, private cases::StateKeeper
  {
  public:
    /**
     * Goes on from the folder's last checkpoint where there is one.
     * @param interval between checkpoints (s of wall time)
     * @param evidence what was done is put there, for the record
     */
    CheckpointKeeper(const CheckpointFolder &folder, double interval,
                     cases::Observer &observer, std::map<std::string, double> &evidence);

    cases::StateKeeper *state_keeper() override;

  private:
    std::unique_ptr<std::istream> state_to_resume() override;
    void offer(long step, double time,
               const std::function<void(std::ostream &)> &save) override;

    using Clock = std::chrono::steady_clock;

    CheckpointFolder folder;
    double interval;
    std::map<std::string, double> &evidence;
    long kept = 0;
    int resumptions = 0;
    Clock::time_point last_kept = Clock::now();
  };

  /** Seconds of wall time between the checkpoints that a method's options ask for; 0 of a
   * method that keeps none. */
  double checkpoint_interval(const cases::Options &options);
} // namespace meltfront::verification

#endif
