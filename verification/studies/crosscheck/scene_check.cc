#include <cases/error.h>
#include <verification/studies/crosscheck/scene_check.h>

#include <algorithm>

namespace meltfront::verification
{
  namespace
  {
    /** Of the resolutions, those at which every scene is run. */
    constexpr std::size_t base_levels = 3;

    std::vector<LevelPlan> plan_of(const std::vector<const cases::Method *> &methods,
                                   const std::vector<int> &resolutions)
    {
      std::vector<LevelPlan> plan;
      // The longest first: the last to end is a short one.
      for(auto n = resolutions.rbegin(); n != resolutions.rend(); ++n)
        for(const cases::Method *method : methods)
          plan.push_back({method, *n});
      return plan;
    }

    long levels_with(const std::vector<LevelRun> &runs, const std::string &method,
                     RunStatus status)
    {
      return std::ranges::count_if(
          runs, [&](const LevelRun &run)
          { return run.method == method && run.status == status && !run.out_of_time; });
    }

    /** Sort what is no result into refusals, failures and runs out of time. */
    void add_remarks(const std::vector<LevelRun> &runs,
                     const std::vector<const cases::Method *> &methods,
                     SceneVerdict &verdict)
    {
      for(const cases::Method *method : methods)
      {
        const std::string name = method->name();
        if(levels_with(runs, name, RunStatus::finished) >= 2)
          verdict.compared.push_back(name);
        const auto refused = std::ranges::find_if(
            runs, [&](const LevelRun &run)
            { return run.method == name && run.status == RunStatus::refused; });
        if(refused != runs.end() && levels_with(runs, name, RunStatus::finished) < 2
           && levels_with(runs, name, RunStatus::failed) == 0)
          verdict.refusals.push_back({name, 0, refused->message});
      }
      for(const LevelRun &run : runs)
        if(run.status == RunStatus::failed)
          (run.out_of_time ? verdict.out_of_time : verdict.failures)
              .push_back({run.method, run.n, run.message});
    }

    /** The methods that take a case; the others become refusals, without a process. */
    std::vector<const cases::Method *>
    capable(const cases::Case &c, const std::vector<const cases::Method *> &methods,
            std::vector<Remark> &refusals)
    {
      const cases::EffectSet effects = cases::effects_called_for(c.scene);
      const cases::Scene scene = cases::simulated_scene(c.scene, effects);
      std::vector<const cases::Method *> result;
      for(const cases::Method *method : methods)
        try
        {
          cases::require_capable(*method, scene, effects, 1);
          result.push_back(method);
        }
        catch(const cases::Refusal &refusal)
        {
          refusals.push_back({method->name(), 0, refusal.what()});
        }
      return result;
    }

    SceneOutcome outcome_of(const SceneVerdict &verdict)
    {
      if(verdict.contradiction)
        return SceneOutcome::suspect;
      if(!verdict.failures.empty())
        return SceneOutcome::failed;
      if(verdict.compared.size() >= 2)
        return SceneOutcome::agreed;
      return verdict.out_of_time.empty() ? SceneOutcome::refused : SceneOutcome::failed;
    }
  } // namespace

  const char *to_string(SceneOutcome outcome)
  {
    constexpr const char *names[] = {"agreed", "refused", "failed", "suspect"};
    return names[static_cast<std::size_t>(outcome)];
  }

  std::vector<int> crosscheck_resolutions(const cases::Scene &scene)
  {
    const int dimension
        = scene.symmetry == cases::Symmetry::none ? scene.domain.dimension : 1;
    switch(dimension)
    {
    case 1:
      return {20, 32, 52, 84, 136};
    case 2:
      return {12, 20, 32, 52, 84};
    default:
      return {6, 10, 16, 26};
    }
  }

  SceneVerdict check_scene(const cases::Case &c,
                           const std::vector<const cases::Method *> &all,
                           const LevelLimits &limits)
  {
    SceneVerdict verdict;
    const std::vector<const cases::Method *> methods = capable(c, all, verdict.refusals);
    // A single method has nobody to contradict it, but may break down.
    if(methods.empty())
      return verdict;
    const std::vector<int> resolutions = crosscheck_resolutions(c.scene);
    std::vector<LevelRun> runs = make_level_runs(
        c, plan_of(methods, {resolutions.begin(), resolutions.begin() + base_levels}),
        limits);
    add_remarks(runs, methods, verdict);
    const auto compare = [&]
    {
      const std::vector<Comparison> all_of_them = comparisons(runs, c.scene.material);
      verdict.contradiction = worst_contradiction(all_of_them);
      verdict.bars = relative_bars(all_of_them);
      verdict.closest_call = largest_excess(all_of_them);
    };
    compare();
    for(std::size_t i = base_levels; i < resolutions.size() && verdict.contradiction; ++i)
    {
      std::vector<const cases::Method *> compared;
      for(const cases::Method *method : methods)
        if(std::ranges::find(verdict.compared, method->name()) != verdict.compared.end())
          compared.push_back(method);
      const std::vector<LevelRun> finer
          = make_level_runs(c, plan_of(compared, {resolutions[i]}), limits);
      runs.insert(runs.end(), finer.begin(), finer.end());
      compare();
    }
    verdict.outcome = outcome_of(verdict);
    return verdict;
  }
} // namespace meltfront::verification
