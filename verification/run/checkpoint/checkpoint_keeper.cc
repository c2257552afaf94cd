#include <verification/run/checkpoint/checkpoint_keeper.h>

#include <algorithm>
#include <sstream>

namespace meltfront::verification
{
  CheckpointKeeper::CheckpointKeeper(CheckpointFolder folder, double interval,
                                     cases::Observer &observer,
                                     std::map<std::string, double> &evidence)
    : folder(std::move(folder))
    , interval(interval)
    , observer(observer)
    , evidence(evidence)
  {
  }

  void CheckpointKeeper::begin(const cases::RunDescription &description)
  {
    log->begin(description);
    observer.begin(description);
  }

  bool CheckpointKeeper::wants(long step, double time)
  {
    log->step(step, time);
    return observer.wants(step, time);
  }

  std::vector<double> CheckpointKeeper::wanted_times() const
  {
    return observer.wanted_times();
  }

  void CheckpointKeeper::observe(const cases::Snapshot &snapshot)
  {
    log->snapshot(snapshot);
    observer.observe(snapshot);
  }

  void CheckpointKeeper::note(double time, const std::string &event)
  {
    log->note(time, event);
    observer.note(time, event);
  }

  void CheckpointKeeper::report(const std::string &name, double value)
  {
    log->report(name, value);
    observer.report(name, value);
  }

  cases::StateKeeper *CheckpointKeeper::state_keeper()
  {
    return this;
  }

  std::unique_ptr<std::istream> CheckpointKeeper::state_to_resume()
  {
    std::optional<Checkpoint> last = folder.last();
    if(!last)
    {
      log.emplace(folder.observations());
      return nullptr;
    }
    ObservationLog::tell(folder.observations(), last->observed_bytes, observer);
    log.emplace(folder.observations(), last->observed_bytes);
    kept = last->kept;
    resumptions = last->resumptions + 1;
    evidence["times resumed"] = resumptions;
    evidence["last resumed after step"] = double(last->step);
    return std::make_unique<std::istringstream>(std::move(last->state));
  }

  void CheckpointKeeper::offer(long step, double time,
                               const std::function<void(std::ostream &)> &save)
  {
    const std::chrono::duration<double> since = Clock::now() - last_kept;
    if(since.count() < interval)
      return;
    std::ostringstream state;
    save(state);
    folder.write({step, time, log->bytes(), ++kept, resumptions, std::move(state).str()});
    evidence["checkpoints"] = double(kept);
    last_kept = Clock::now();
  }

  double checkpoint_interval(const cases::Options &options)
  {
    const bool declared = std::ranges::any_of(options.declarations(),
                                              [](const cases::OptionDeclaration &option)
                                              { return option.key == "checkpoint"; });
    return declared ? options.get_double("checkpoint") : 0;
  }
} // namespace meltfront::verification
