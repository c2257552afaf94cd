#include <cases/error.h>
#include <verification/matrix/workers.h>
#include <verification/record/json_values.h>
#include <verification/record/provenance.h>
#include <verification/run/memory_limit.h>
#include <verification/run/run_one.h>

#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <thread>

namespace meltfront::verification
{
  namespace
  {
    constexpr std::chrono::milliseconds polling_pause{5};
    constexpr std::chrono::milliseconds pause_between_looks{200};

    /** Replace this process by a command. */
    void execute(const std::vector<std::string> &words)
    {
      std::vector<char *> arguments;
      for(const std::string &word : words)
        arguments.push_back(const_cast<char *>(word.c_str()));
      arguments.push_back(nullptr);
      execvp(arguments[0], arguments.data());
      throw cases::OutputError(
          fmt::format("cannot start '{}': {}", words[0], std::strerror(errno)));
    }

    /** A line of DIR/runs.log, which tells of every run once who made it. */
    void log_run(const RunnerOptions &options, const Job &job, const std::string &status,
                 double seconds)
    {
      const ClaimHolder self = ClaimHolder::self();
      const std::string line
          = fmt::format("{}  {} {}  {}  {}  {:.2f} s\n", current_date(), self.host,
                        self.process, name_of(job), status, seconds);
      std::ofstream(options.directory + "/runs.log", std::ios::app) << line << std::flush;
    }
  } // namespace

  Workers::Workers(const RunnerOptions &options, double time_limit,
                   std::filesystem::file_time_type since, Progress &progress)
    : options(options)
    , time_limit(time_limit)
    , since(since)
    , progress(progress)
  {
  }

  void Workers::run(std::deque<Job> jobs)
  {
    waiting = std::move(jobs);
    while(!waiting.empty() || !running.empty() || !elsewhere.empty())
    {
      start_what_fits();
      std::this_thread::sleep_for(polling_pause);
      std::erase_if(running, [this](RunningJob &job) { return ended(job); });
      look_elsewhere();
      show();
    }
  }

  double Workers::stale_after() const
  {
    return 2 * time_limit;
  }

  int Workers::slots_of(const Job &job) const
  {
    return std::min(job.run.resolution.threads, options.jobs);
  }

  void Workers::start_what_fits()
  {
    int used = 0;
    for(const RunningJob &job : running)
      used += slots_of(job.job);
    while(!waiting.empty() && used + slots_of(waiting.front()) <= options.jobs)
    {
      const std::size_t before = running.size();
      Job job = std::move(waiting.front());
      waiting.pop_front();
      const int slots = slots_of(job);
      start(std::move(job));
      used += running.size() > before ? slots : 0;
    }
  }

  void Workers::start(Job job)
  {
    if(!options.launcher.empty())
    {
      std::filesystem::create_directories(job.folder());
      ChildProcess process = launched(job);
      running.push_back({std::move(job), {}, std::move(process), Clock::now()});
      return;
    }
    std::filesystem::create_directories(job.folder());
    std::optional<RunClaim> claim = RunClaim::take(job.claim(), stale_after());
    if(!claim)
    {
      elsewhere.push_back(std::move(job));
      return;
    }
    // Another process may have made it between the look at the record and the claim.
    if(made_since(job, options, since))
    {
      claim.reset();
      report(job, 0);
      return;
    }
    // What stands in its place is of another program or case, or was spoilt.
    std::filesystem::remove(job.path);
    if(take_shared(job, options))
    {
      claim.reset();
      report(job, 0);
      return;
    }
    job.run.resolution.memory_limit = options.memory_limit;
    ChildProcess process = made_here(job);
    running.push_back(
        {std::move(job), std::move(claim), std::move(process), Clock::now()});
  }

  ChildProcess Workers::made_here(const Job &job) const
  {
    const auto make = [&]
    {
      limit_memory(options.memory_limit, job.run.resolution.threads);
      write_json(job.path,
                 run_one(*job.the_case, *job.method, job.run.resolution, job.run.label,
                         provenance_of(options), nullptr, options.repeats));
    };
    return {make, job.folder() / "run.log"};
  }

  ChildProcess Workers::launched(const Job &job) const
  {
    std::vector<std::string> words = options.launcher;
    words.push_back(job.run.identity());
    return {[&] { execute(words); }, job.folder() / "launcher.log"};
  }

  bool Workers::ended(RunningJob &running_job)
  {
    const std::chrono::duration<double> spent = Clock::now() - running_job.start;
    std::string problem;
    if(running_job.process.ended())
      problem = running_job.process.end().problem();
    else if(running_job.claim
            && (spent.count() > time_limit || Clock::now() > options.deadline))
    {
      running_job.process.kill();
      problem = fmt::format("took longer than its time limit of {} s",
                            std::min(time_limit, spent.count()));
    }
    else
      return false;
    const Job &job = running_job.job;
    if(!running_job.claim)
    {
      end_launched(running_job, problem);
      return true;
    }
    // A record that is there is whole, whatever befell the process after it.
    if(!std::filesystem::exists(job.path))
      record_failure(job,
                     fmt::format("{} {}", job.run.method,
                                 problem.empty() ? "ended without a record" : problem),
                     running_job.process.end().peak_memory_mb);
    log_run(options, job, read_json(job.path).at("status"), spent.count());
    share(job, options);
    report(job, spent.count());
    running_job.claim.reset();
    return true;
  }

  /** The launched process has claimed the run, made and recorded it, unless another holds
   * the claim or it was not even started. */
  void Workers::end_launched(RunningJob &running_job, const std::string &problem)
  {
    const std::chrono::duration<double> spent = Clock::now() - running_job.start;
    Job &job = running_job.job;
    if(!made_since(job, options, since))
    {
      const auto claim = RunClaim::take(job.claim(), stale_after());
      if(!claim)
      {
        elsewhere.push_back(std::move(job));
        return;
      }
      record_failure(job,
                     fmt::format("the launched process {} (see launcher.log)",
                                 problem.empty() ? "ended without a record" : problem),
                     0);
    }
    report(job, spent.count());
  }

  void Workers::record_failure(const Job &job, const std::string &problem,
                               double peak_memory_mb)
  {
    RunRecord record = record_without_result(job, options);
    record.status = RunStatus::failed;
    record.message = problem;
    record.peak_memory_mb = peak_memory_mb;
    record.provenance["ended"] = "killed";
    write_json(job.path, record);
  }

  void Workers::report(const Job &job, double seconds)
  {
    const auto record = read_json(job.path);
    const std::string status = record.at("status"), message = record.at("message");
    if(status == to_string(RunStatus::refused))
      return progress.run_refused(kind_of(job), message);
    // Repeats are made of short runs only, and say nothing of longer ones.
    const int repeats = std::max(1, whole_number_in<int>(record.at("repeats")));
    const std::string how = seconds > 0 ? fmt::format("{} in {:.2f} s", status, seconds)
                                        : fmt::format("{} elsewhere", status);
    // What took another process no time here took some all the same.
    const double known = number_in(record.at("cost").at("setup_wall"))
                         + number_in(record.at("cost").at("stepping_wall"));
    progress.run_ended(kind_of(job), seconds > 0 ? seconds / repeats : known,
                       name_of(job),
                       message.empty() ? how : fmt::format("{}: {}", status, message),
                       status == to_string(RunStatus::finished));
  }

  void Workers::look_elsewhere()
  {
    if(elsewhere.empty() || Clock::now() - looked < pause_between_looks)
      return;
    looked = Clock::now();
    std::erase_if(elsewhere,
                  [this](Job &job)
                  {
                    if(made_since(job, options, since))
                      report(job, 0);
                    else if(!RunClaim::held(job.claim(), stale_after()))
                      waiting.push_front(std::move(job));
                    else
                      return false;
                    return true;
                  });
  }

  void Workers::show()
  {
    std::string names;
    for(const RunningJob &job : running)
      names += (names.empty() ? "" : ", ") + name_of(job.job);
    if(names.empty() && !elsewhere.empty())
      names = fmt::format("waiting for {} runs of other processes", elsewhere.size());
    progress.show_running(names);
  }
} // namespace meltfront::verification
