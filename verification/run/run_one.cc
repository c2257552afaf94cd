#include <cases/effect_bounds.h>
#include <cases/error.h>
#include <cases/out_of_memory.h>
#include <verification/record/hash.h>
#include <verification/record/provenance.h>
#include <verification/run/heat_observer.h>
#include <verification/run/motion_observer.h>
#include <verification/run/run_one.h>
#include <verification/run/timed_repeat.h>

#include <fmt/format.h>

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <new>

namespace meltfront::verification
{
  namespace
  {
    /** Of this process, or of one that it started and that took more. */
    double peak_memory_mb()
    {
      rusage own, of_children;
      getrusage(RUSAGE_SELF, &own);
      getrusage(RUSAGE_CHILDREN, &of_children);
      return static_cast<double>(std::max(own.ru_maxrss, of_children.ru_maxrss)) / 1024;
    }

    double seconds_since(std::chrono::steady_clock::time_point start)
    {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
          .count();
    }

    /** Solve again and again, and keep the least times of all runs in the record. */
    void repeat(const cases::Case &c, const cases::Method &method,
                const cases::Resolution &resolution, const RepeatPolicy &policy,
                RunRecord &record)
    {
      if(record.cost.setup_wall + record.cost.stepping_wall >= policy.short_run)
        return;
      const auto start = std::chrono::steady_clock::now();
      while(record.repeats < policy.most && seconds_since(start) < policy.total_seconds)
        add_repeat(record, timed_solution(c, method, resolution));
    }

    /** What the machine lacks memory for is to be tried again, on another or with another
     * limit. */
    void require_affordable(const cases::Method &method, const cases::Scene &scene,
                            const cases::EffectSet &effects,
                            const cases::Resolution &resolution, RunRecord &record)
    {
      const cases::Demand demand = method.demand(scene, effects, resolution);
      if(demand.bytes > resolution.memory_limit)
        record.provenance["ended"] = "killed";
      cases::require_affordable(method, demand, resolution.memory_limit);
    }

    /** What the case's kind of problem is observed by. */
    std::unique_ptr<RunObserver> observer_of(const cases::Case &c,
                                             const cases::Scene &scene,
                                             const cases::Method &method,
                                             const cases::Capabilities &capabilities,
                                             cases::Observer *second, bool animated)
    {
      if(scene.conducts_heat())
        return std::make_unique<HeatObserver>(c, scene, method.name(), capabilities,
                                              second);
      return std::make_unique<MotionObserver>(c, scene, method.name(), second, animated);
    }

    void solve(const cases::Case &c, const cases::Method &method,
               const cases::Resolution &resolution, cases::Observer *second,
               const RepeatPolicy &policy, const ThroughObserver &through,
               RunRecord &record)
    {
      const cases::EffectSet effects = cases::effects_within(c.scene, c.effect_tolerance);
      record.effects = effects.decisions();
      const cases::Scene scene = cases::simulated_scene(c.scene, effects);
      const cases::Capabilities capabilities = cases::require_capable(
          method, scene, effects, resolution.threads, resolution.options);
      require_affordable(method, scene, effects, resolution, record);
      const auto observer
          = observer_of(c, scene, method, capabilities, second, resolution.seed == 1);
      const auto keep_course = [&]
      {
        observer->keep_course(record);
        record.peak_memory_mb = peak_memory_mb();
      };
      try
      {
        const auto before = through ? through(*observer) : nullptr;
        record.cost
            = method.solve(scene, effects, resolution, before ? *before : *observer);
        observer->require_end();
      }
      catch(...)
      {
        keep_course();
        throw;
      }
      keep_course();
      observer->keep_results(record);
      record.status = RunStatus::finished;
      add_repeat(record, cases::Cost(record.cost));
      // The first seed stands for the time of all; the others are there for their
      // results.
      if(resolution.seed == 1)
        repeat(c, method, resolution, policy, record);
    }
  } // namespace

  std::string run_label(const std::string &method,
                        const std::map<std::string, std::string> &set_options,
                        int threads, int ranks)
  {
    std::string inside;
    for(const auto &[key, value] : set_options)
      inside += fmt::format("{}{}={}", inside.empty() ? "" : ",", key, value);
    if(threads != 1)
      inside += fmt::format("{}threads={}", inside.empty() ? "" : ",", threads);
    if(ranks != 1)
      inside += fmt::format("{}ranks={}", inside.empty() ? "" : ",", ranks);
    return inside.empty() ? method : fmt::format("{}[{}]", method, inside);
  }

  RunRecord empty_record(const cases::Case &c, const cases::Method &method,
                         const cases::Resolution &resolution, const std::string &label,
                         const std::map<std::string, std::string> &provenance)
  {
    RunRecord record;
    record.case_name = c.scene.name;
    record.method = method.name();
    record.label = label;
    record.n = resolution.n;
    record.seed = resolution.seed;
    record.threads = resolution.threads;
    record.options = resolution.options.values();
    record.provenance = build_provenance();
    for(const auto &[key, value] : method_provenance(method, resolution.options))
      record.provenance[key] = value;
    for(const auto &[key, value] : provenance)
      record.provenance[key] = value;
    record.provenance["case_text"] = c.text;
    record.provenance["case_hash"] = sha256(c.text);
    record.provenance["date"] = current_date();
    return record;
  }

  RunRecord run_one(const cases::Case &c, const cases::Method &method,
                    const cases::Resolution &resolution, const std::string &label,
                    const std::map<std::string, std::string> &provenance,
                    cases::Observer *second, const RepeatPolicy &repeats,
                    const ThroughObserver &through)
  {
    RunRecord record = empty_record(c, method, resolution, label, provenance);
    try
    {
      solve(c, method, resolution, second, repeats, through, record);
    }
    catch(const cases::Refusal &refusal)
    {
      record.status = RunStatus::refused;
      record.message = refusal.what();
    }
    // An n or an option that does not go with the scene: the method declines it too.
    catch(const cases::InputError &error)
    {
      record.status = RunStatus::refused;
      record.message = fmt::format("{}: {}", method.name(), error.what());
    }
    catch(const std::bad_alloc &error)
    {
      record.status = RunStatus::failed;
      record.message = fmt::format("{} needs more memory than there is", method.name());
      if(const auto *known = dynamic_cast<const cases::OutOfMemory *>(&error))
        record.message += fmt::format(": {}", known->what());
      // The machine's fault, not the run's: it is to be tried again.
      record.provenance["ended"] = "killed";
    }
    catch(const cases::OutputError &)
    {
      throw; // nothing is wrong with the run
    }
    catch(const std::exception &error)
    {
      record.status = RunStatus::failed;
      record.message = error.what();
    }
    return record;
  }

  std::string steps_option(const cases::Options &options)
  {
    for(const char *key : {"steps", "fewest_steps"})
      if(std::ranges::find(options.declarations(), key, &cases::OptionDeclaration::key)
         != options.declarations().end())
        return key;
    return {};
  }
} // namespace meltfront::verification
