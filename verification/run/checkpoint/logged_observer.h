#ifndef meltfront_verification_run_checkpoint_logged_observer_h
#define meltfront_verification_run_checkpoint_logged_observer_h

#include <verification/run/checkpoint/observation_log.h>

#include <optional>

namespace meltfront::verification
{
  /** Hands all that it is told on to an observer, and keeps it in a file, from which a
   * new observer learns what this one knew. */
  class LoggedObserver : public cases::Observer
  {
  public:
    LoggedObserver(std::string file, cases::Observer &observer);

    /** Tell the observer what so many first bytes of the file hold, and go on behind
     * them. Before anything else is called. @throws cases::OutputError */
    void go_on_behind(std::uintmax_t bytes);

    /** How long the file is. @throws cases::OutputError if it could not be written */
    std::uintmax_t bytes()
    {
      return log->bytes();
    }

    void begin(const cases::RunDescription &description) override;
    bool wants(long step, double time) override;
    std::vector<double> wanted_times() const override;
    void observe(const cases::Snapshot &snapshot) override;
    void note(double time, const std::string &event) override;
    void report(const std::string &name, double value) override;

  private:
    std::string file;
    cases::Observer &observer;
    std::optional<ObservationLog> log;
  };
} // namespace meltfront::verification

#endif
