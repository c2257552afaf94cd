#include <verification/run/checkpoint/logged_observer.h>

#include <utility>

namespace meltfront::verification
{
  LoggedObserver::LoggedObserver(std::string file, cases::Observer &observer)
    : file(std::move(file))
    , observer(observer)
  {
  }

  void LoggedObserver::go_on_behind(std::uintmax_t bytes)
  {
    ObservationLog::tell(file, bytes, observer);
    log.emplace(file, bytes);
  }

  void LoggedObserver::begin(const cases::RunDescription &description)
  {
    log->begin(description);
    observer.begin(description);
  }

  bool LoggedObserver::wants(long step, double time)
  {
    log->step(step, time);
    return observer.wants(step, time);
  }

  std::vector<double> LoggedObserver::wanted_times() const
  {
    return observer.wanted_times();
  }

  void LoggedObserver::observe(const cases::Snapshot &snapshot)
  {
    log->snapshot(snapshot);
    observer.observe(snapshot);
  }

  void LoggedObserver::note(double time, const std::string &event)
  {
    log->note(time, event);
    observer.note(time, event);
  }

  void LoggedObserver::report(const std::string &name, double value)
  {
    log->report(name, value);
    observer.report(name, value);
  }
} // namespace meltfront::verification
