#include <verification/matrix/run_claim.h>
#include <verification/matrix/timing_rounds.h>
#include <verification/record/json_values.h>
#include <verification/run/child_process.h>
#include <verification/run/memory_limit.h>
#include <verification/run/timed_repeat.h>

#include <fmt/format.h>

#include <chrono>
#include <thread>

namespace meltfront::verification
{
  namespace
  {
    RunRecord record_of(const Job &job)
    {
      return read_json(job.path).get<RunRecord>();
    }

    bool to_be_timed(const RunRecord &record)
    {
      return record.status == RunStatus::finished && record.seed == 1
             && record.threads == 1
             && record.cost.setup_cpu + record.cost.stepping_cpu < longest_repeated
             && !(record.times.careful && settled(record.times));
    }

    /** @return whether the process ended well within the time limit */
    bool ends_well(ChildProcess process, double time_limit)
    {
      constexpr std::chrono::milliseconds polling_pause{2};
      const auto start = std::chrono::steady_clock::now();
      while(!process.ended())
      {
        const std::chrono::duration<double> spent
            = std::chrono::steady_clock::now() - start;
        if(spent.count() > time_limit)
          return false; // the process is killed with its object
        std::this_thread::sleep_for(polling_pause);
      }
      return process.end().problem().empty();
    }

    /** Repeat a run once. @return whether it is to be repeated again */
    bool repeat(const Job &job, const RunnerOptions &options, double time_limit)
    {
      const auto claim = RunClaim::take(job.claim(), 2 * time_limit);
      if(!claim || !to_be_timed(record_of(job)))
        return false;
      const auto make = [&]
      {
        limit_memory(options.memory_limit, job.run.resolution.threads);
        RunRecord record = record_of(job);
        repeat_carefully(*job.the_case, *job.method, job.run.resolution, record);
        write_json(job.path, record);
      };
      return ends_well({make, job.folder() / "timing.log"}, time_limit)
             && to_be_timed(record_of(job));
    }
  } // namespace

  void time_carefully(const std::vector<Job> &jobs, const RunnerOptions &options,
                      double time_limit)
  {
    std::vector<Job> left;
    for(const Job &job : jobs)
      if(std::filesystem::exists(job.path) && to_be_timed(record_of(job)))
        left.push_back(job);
    for(int round = 1; !left.empty(); ++round)
    {
      if(options.progress)
        fmt::print(options.progress, "Timing, round {}: {} runs\n", round, left.size());
      std::erase_if(left,
                    [&](const Job &job) { return !repeat(job, options, time_limit); });
    }
  }
} // namespace meltfront::verification
