#include <verification/run/checkpoint/checkpoint_keeper.h>

#include <algorithm>
#include <sstream>
#include <variant>

namespace meltfront::verification
{
  CheckpointKeeper::CheckpointKeeper(const CheckpointFolder &folder, double interval,
                                     cases::Observer &observer,
                                     std::map<std::string, double> &evidence)
    : LoggedObserver(folder.observations(), observer)
    , folder(folder)
    , interval(interval)
    , evidence(evidence)
  {
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
      go_on_behind(0);
      return nullptr;
    }
    go_on_behind(last->observed_bytes);
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
    folder.write({step, time, bytes(), ++kept, resumptions, std::move(state).str()});
    evidence["checkpoints"] = double(kept);
    last_kept = Clock::now();
  }

  double checkpoint_interval(const cases::Options &options)
  {
    // greenspan's names a file that it goes on from by itself.
    const bool declared = std::ranges::any_of(options.declarations(),
                                              [](const cases::OptionDeclaration &option)
                                              {
                                                return option.key == "checkpoint"
                                                       && std::holds_alternative<double>(
                                                           option.default_value);
                                              });
    return declared ? options.get_double("checkpoint") : 0;
  }
} // namespace meltfront::verification
