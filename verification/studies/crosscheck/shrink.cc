#include <cases/error.h>
#include <verification/studies/crosscheck/shrink.h>

#include <chrono>
#include <set>

namespace meltfront::verification
{
  namespace
  {
    bool shows_it(const SceneDraft &draft,
                  const std::function<bool(const SceneDraft &)> &shows)
    {
      try
      {
        return shows(draft);
      }
      catch(const cases::InputError &)
      {
        return false;
      }
    }
  } // namespace

  SceneDraft shrunk(const SceneDraft &draft,
                    const std::function<bool(const SceneDraft &)> &shows,
                    const ShrinkBudget &budget)
  {
    const auto start = std::chrono::steady_clock::now();
    const auto spent = [&start]
    {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
          .count();
    };
    SceneDraft smallest = draft;
    std::set<std::string> tried{draft.text()};
    int trials = 0;
    for(bool found = true; found;)
    {
      found = false;
      for(const SceneDraft &candidate : smallest.simpler())
      {
        if(!tried.insert(candidate.text()).second)
          continue;
        if(trials++ >= budget.trials || spent() > budget.seconds)
          return smallest;
        if(!shows_it(candidate, shows))
          continue;
        smallest = candidate;
        found = true;
        break;
      }
    }
    return smallest;
  }
} // namespace meltfront::verification
