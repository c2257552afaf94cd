#include <verification/record/json_values.h>
#include <verification/record/temporary_directory.h>
#include <verification/run/child_process.h>
#include <verification/run/run_one.h>
#include <verification/studies/crosscheck/level_runs.h>

#include <fmt/format.h>

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <thread>

namespace meltfront::verification
{
  namespace
  {
    using Clock = std::chrono::steady_clock;

    constexpr std::chrono::milliseconds polling_pause{2};

    struct RunningLevel
    {
      std::size_t number; ///< in the plan
      ChildProcess process;
      Clock::time_point start;
    };

    /** A machine that others use too slows a run down: its own time counts. By the clock
     * it ends a process that waits for ever. */
    constexpr double clock_over_processor = 10;

    void limit_processor_time(double seconds)
    {
      const auto whole = static_cast<rlim_t>(std::ceil(seconds));
      const rlimit limit{whole, whole + 1};
      setrlimit(RLIMIT_CPU, &limit);
    }

    LevelRun made_run(const cases::Case &c, const LevelPlan &plan)
    {
      CourseObserver observer(c.scene);
      cases::Resolution resolution{plan.n,
                                   cases::Options(plan.method->option_declarations())};
      if(plan.steps > 0)
        resolution.options.set(steps_option(resolution.options),
                               std::to_string(plan.steps));
      RepeatPolicy once;
      once.most = 1;
      const RunRecord record = run_one(c, *plan.method, resolution, plan.method->name(),
                                       {}, &observer, once);
      LevelRun run{record.method, plan.n, record.status, record.message};
      run.spacing = record.description.spacing;
      if(run.status == RunStatus::finished)
        run.course = observer.course();
      return run;
    }

    /** Starts the runs of a plan and takes in what they leave. */
    class LevelPool
    {
    public:
      LevelPool(const cases::Case &c, const std::vector<LevelPlan> &plan,
                const LevelLimits &limits)
        : c(c)
        , plan(plan)
        , limits(limits)
        , runs(plan.size())
      {
      }

      std::vector<LevelRun> make()
      {
        std::size_t next = 0;
        while(next < plan.size() || !running.empty())
        {
          for(; next < plan.size() && static_cast<int>(running.size()) < limits.jobs;
              ++next)
            start(next);
          std::this_thread::sleep_for(polling_pause);
          std::erase_if(running, [this](RunningLevel &level) { return ended(level); });
          show();
        }
        return std::move(runs);
      }

    private:
      std::string file(std::size_t number) const
      {
        return folder.path(fmt::format("{}.json", number));
      }

      void start(std::size_t number)
      {
        const auto make_it = [this, number]
        {
          limit_processor_time(limits.within);
          write_json(file(number), made_run(c, plan[number]));
        };
        running.push_back(
            {number, ChildProcess(make_it, folder.path(fmt::format("{}.log", number))),
             Clock::now()});
      }

      bool ended(RunningLevel &level)
      {
        const std::chrono::duration<double> spent = Clock::now() - level.start;
        std::string problem;
        bool out_of_time = false;
        if(level.process.ended())
        {
          problem = level.process.end().problem();
          out_of_time = level.process.end().signal == SIGXCPU;
        }
        else if(spent.count() > clock_over_processor * limits.within)
        {
          level.process.kill();
          out_of_time = true;
        }
        else
          return false;
        if(out_of_time)
          problem = fmt::format("took longer than its time limit of {} s", limits.within);
        const LevelPlan &planned = plan[level.number];
        LevelRun &run = runs[level.number];
        // A result that is there is whole, whatever befell the process after it.
        if(std::filesystem::exists(file(level.number)))
          run = read_json(file(level.number)).get<LevelRun>();
        else
          run = {planned.method->name(),
                 planned.n,
                 RunStatus::failed,
                 fmt::format("{} {}", planned.method->name(),
                             problem.empty() ? "ended without a result" : problem),
                 out_of_time,
                 !out_of_time};
        return true;
      }

      void show() const
      {
        if(!limits.show)
          return;
        std::string names;
        for(const RunningLevel &level : running)
          names += fmt::format("{}{} n={}", names.empty() ? "" : ", ",
                               plan[level.number].method->name(), plan[level.number].n);
        limits.show(names);
      }

      const cases::Case &c;
      const std::vector<LevelPlan> &plan;
      const LevelLimits &limits;
      const TemporaryDirectory folder;
      std::vector<LevelRun> runs;
      std::vector<RunningLevel> running;
    };
  } // namespace

  void to_json(nlohmann::json &json, const LevelRun &run)
  {
    json = {{"method", run.method},
            {"n", run.n},
            {"status", to_string(run.status)},
            {"message", run.message},
            {"out_of_time", run.out_of_time},
            {"crashed", run.crashed},
            {"spacing", json_of(run.spacing)}};
    if(run.status == RunStatus::finished)
      json["course"] = run.course;
  }

  void from_json(const nlohmann::json &json, LevelRun &run)
  {
    run.method = json.at("method");
    run.n = whole_number_in<int>(json.at("n"));
    const std::string status = json.at("status");
    run.status = status == to_string(RunStatus::finished)  ? RunStatus::finished
                 : status == to_string(RunStatus::refused) ? RunStatus::refused
                                                           : RunStatus::failed;
    run.message = json.at("message");
    run.out_of_time = json.at("out_of_time");
    run.crashed = json.at("crashed");
    run.spacing = number_in(json.at("spacing"));
    if(run.status == RunStatus::finished)
      run.course = json.at("course");
  }

  std::vector<LevelRun> make_level_runs(const cases::Case &c,
                                        const std::vector<LevelPlan> &plan,
                                        const LevelLimits &limits)
  {
    return LevelPool(c, plan, limits).make();
  }
} // namespace meltfront::verification
