#include <cases/effect_bounds.h>
#include <cases/error.h>
#include <verification/run/run_one.h>
#include <verification/studies/crosscheck/scene_check.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>

namespace meltfront::verification
{
  namespace
  {
    /** Of the resolutions, those at which every scene is run. */
    constexpr std::size_t base_levels = 3;

    /** The scene as methods see it. */
    struct SimulatedScene
    {
      cases::EffectSet effects;
      cases::Scene scene;
    };

    SimulatedScene simulated(const cases::Case &c)
    {
      cases::EffectSet effects = cases::effects_within(c.scene, c.effect_tolerance);
      cases::Scene scene = cases::simulated_scene(c.scene, effects);
      return {std::move(effects), std::move(scene)};
    }

    /** Time that is refined by at least this share of what space is needs no help: a
     * least number of steps of the coarsest run accounts for the rest. */
    constexpr double refined_alike = 0.9;

    /** The steps that refine time with space, where a method does not by itself; else 0.
     */
    long steps_to_give(const SimulatedScene &of, const cases::Method &method, int n,
                       int coarsest)
    {
      const cases::Options defaults(method.option_declarations());
      if(steps_option(defaults).empty())
        return 0;
      const auto steps = [&](int at) {
        return method.demand(of.scene, of.effects, {at, defaults}).steps;
      };
      try
      {
        const double own = steps(n), wanted = std::ceil(steps(coarsest) * n / coarsest);
        return own > 0 && own < refined_alike * wanted ? std::lround(wanted) : 0;
      }
      catch(const std::runtime_error &)
      {
        return 0; // its run says so, too
      }
    }

    std::vector<LevelPlan> plan_of(const SimulatedScene &of,
                                   const std::vector<const cases::Method *> &methods,
                                   const std::vector<int> &resolutions, int coarsest)
    {
      std::vector<LevelPlan> plan;
      // The longest first: the last to end is a short one.
      for(auto n = resolutions.rbegin(); n != resolutions.rend(); ++n)
        for(const cases::Method *method : methods)
          plan.push_back({method, *n, steps_to_give(of, *method, *n, coarsest)});
      return plan;
    }

    long levels_with(const std::vector<LevelRun> &runs, const std::string &method,
                     RunStatus status)
    {
      return std::ranges::count_if(
          runs, [&](const LevelRun &run)
          { return run.method == method && run.status == status && !run.out_of_time; });
    }

    bool ran_at(const std::vector<LevelRun> &runs, const std::string &method, int n)
    {
      return std::ranges::any_of(runs, [&](const LevelRun &run)
                                 { return run.method == method && run.n == n; });
    }

    /** Whether what failed of a method lies at its coarsest resolutions alone. */
    enum class Coarse
    {
      no,
      perhaps,  ///< finer ones finished, but not three
      found_out ///< three or more finer ones finished
    };

    Coarse finds_coarse(const std::vector<LevelRun> &runs, const std::string &method)
    {
      int finest_failed = 0, coarsest_finished = std::numeric_limits<int>::max();
      for(const LevelRun &run : runs)
        if(run.method == method)
        {
          if(run.status == RunStatus::finished)
            coarsest_finished = std::min(coarsest_finished, run.n);
          else if(run.out_of_time || run.crashed || run.status == RunStatus::refused)
            return Coarse::no;
          else
            finest_failed = std::max(finest_failed, run.n);
        }
      const long finished = levels_with(runs, method, RunStatus::finished);
      if(finest_failed == 0 || finished == 0 || finest_failed > coarsest_finished)
        return Coarse::no;
      return finished < long(base_levels) ? Coarse::perhaps : Coarse::found_out;
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
          (run.out_of_time                                       ? verdict.out_of_time
           : finds_coarse(runs, run.method) == Coarse::found_out ? verdict.too_coarse
                                                                 : verdict.failures)
              .push_back({run.method, run.n, run.message});
    }

    /** The methods that take a case; the others become refusals, without a process. */
    std::vector<const cases::Method *>
    capable(const SimulatedScene &of, const std::vector<const cases::Method *> &methods,
            std::vector<Remark> &refusals)
    {
      std::vector<const cases::Method *> result;
      for(const cases::Method *method : methods)
        try
        {
          cases::require_capable(*method, of.scene, of.effects, 1);
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
      return {20, 34, 54, 86, 138};
    case 2:
      return {12, 20, 34, 54, 86};
    default:
      return {6, 10, 16, 26};
    }
  }

  SceneVerdict check_scene(const cases::Case &c,
                           const std::vector<const cases::Method *> &all,
                           const LevelLimits &limits)
  {
    SceneVerdict verdict;
    const SimulatedScene of = simulated(c);
    const std::vector<const cases::Method *> methods = capable(of, all, verdict.refusals);
    // A single method has nobody to contradict it, but may break down.
    if(methods.empty())
      return verdict;
    const std::vector<int> resolutions = crosscheck_resolutions(c.scene);
    std::vector<LevelRun> runs;
    const auto run_at
        = [&](const std::vector<const cases::Method *> &some, const std::vector<int> &at)
    {
      const std::vector<LevelRun> made
          = make_level_runs(c, plan_of(of, some, at, resolutions.front()), limits);
      runs.insert(runs.end(), made.begin(), made.end());
    };
    const auto those = [&](const auto &wanted)
    {
      std::vector<const cases::Method *> result;
      std::ranges::copy_if(methods, std::back_inserter(result), wanted);
      return result;
    };
    run_at(methods, {resolutions.begin(), resolutions.begin() + base_levels});
    for(std::size_t i = base_levels; i < resolutions.size(); ++i)
      run_at(those([&](const cases::Method *method)
                   { return finds_coarse(runs, method->name()) == Coarse::perhaps; }),
             {resolutions[i]});
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
      run_at(those(
                 [&](const cases::Method *method)
                 {
                   return std::ranges::find(verdict.compared, method->name())
                              != verdict.compared.end()
                          && !ran_at(runs, method->name(), resolutions[i]);
                 }),
             {resolutions[i]});
      compare();
    }
    verdict.outcome = outcome_of(verdict);
    return verdict;
  }
} // namespace meltfront::verification
