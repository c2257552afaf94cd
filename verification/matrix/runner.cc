#include <cases/error.h>
#include <verification/matrix/criteria_reader.h>
#include <verification/matrix/directory_lock.h>
#include <verification/matrix/matrix_files.h>
#include <verification/matrix/progress.h>
#include <verification/matrix/runner.h>
#include <verification/record/hash.h>
#include <verification/record/json_values.h>
#include <verification/record/label.h>
#include <verification/run/child_process.h>
#include <verification/run/memory_limit.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <filesystem>
#include <thread>

namespace meltfront::verification
{
  namespace
  {
    using Clock = std::chrono::steady_clock;

    constexpr std::chrono::milliseconds polling_pause{5};

    /** A planned run with what is needed to make it. */
    struct Job
    {
      PlannedRun run;
      const cases::Case *the_case;
      const cases::Method *method;
      std::string path; ///< of its record
      double work;      ///< estimate, in any unit: the largest runs start first
    };

    struct RunningJob
    {
      Job job;
      ChildProcess process;
      Clock::time_point start;
    };

    /** Particles or cells times explicit steps: n^d n^2. */
    double estimated_work(const PlannedRun &run, const cases::Case &c)
    {
      return std::pow(run.resolution.n, c.scene.domain.dimension + 2);
    }

    std::map<std::string, std::string> provenance_of(const RunnerOptions &options)
    {
      return {{"program_version", options.program_version},
              {"program_hash", options.program_hash},
              {"command_line", options.command_line}};
    }

    RunRecord record_without_result(const Job &job, const RunnerOptions &options)
    {
      return empty_record(*job.the_case, *job.method, job.run.resolution, job.run.label,
                          provenance_of(options));
    }

    /** Whether the run's record is there and would come out the same again. */
    bool already_made(const Job &job, const RunnerOptions &options)
    {
      if(!std::filesystem::exists(job.path))
        return false;
      try
      {
        const RunRecord old = read_json(job.path).get<RunRecord>();
        RunRecord expected = record_without_result(job, options);
        auto was = old.provenance;
        const bool same_provenance
            = was["case_hash"] == expected.provenance["case_hash"]
              && was["program_version"] == expected.provenance["program_version"]
              && was["program_hash"] == expected.provenance["program_hash"];
        return same_provenance && was["ended"] != "killed"
               && old.method == expected.method && old.case_name == expected.case_name
               && old.label == expected.label && old.options == expected.options
               && old.n == expected.n && old.seed == expected.seed
               && old.threads == expected.threads;
      }
      catch(const std::exception &)
      {
        // Not a record as this program writes it: it is made anew.
        return false;
      }
    }

    std::string name_of(const Job &job)
    {
      return fmt::format("{} {} n={}", job.run.case_name, job.run.label,
                         job.run.resolution.n);
    }

    RunKind kind_of(const Job &job)
    {
      return {job.run.case_name, job.run.label, job.run.method, job.run.resolution.n};
    }

    /** Starts runs, watches them and writes down how they end. */
    class Workers
    {
    public:
      Workers(const RunnerOptions &options, double time_limit, Progress &progress)
        : options(options)
        , time_limit(time_limit)
        , progress(progress)
      {
      }

      void run(std::deque<Job> waiting)
      {
        while(!waiting.empty() || !running.empty())
        {
          start_what_fits(waiting);
          std::this_thread::sleep_for(polling_pause);
          std::erase_if(running, [this](RunningJob &job) { return ended(job); });
          show();
        }
      }

    private:
      int slots_of(const Job &job) const
      {
        return std::min(job.run.resolution.threads, options.jobs);
      }

      void start_what_fits(std::deque<Job> &waiting)
      {
        int used = 0;
        for(const RunningJob &job : running)
          used += slots_of(job.job);
        while(!waiting.empty() && used + slots_of(waiting.front()) <= options.jobs)
        {
          used += slots_of(waiting.front());
          start(std::move(waiting.front()));
          waiting.pop_front();
        }
      }

      void start(Job job)
      {
        const auto folder = std::filesystem::path(job.path).parent_path();
        std::filesystem::create_directories(folder);
        job.run.resolution.memory_limit = options.memory_limit;
        const auto make = [&]
        {
          limit_memory(options.memory_limit, job.run.resolution.threads);
          write_json(job.path, run_one(*job.the_case, *job.method, job.run.resolution,
                                       job.run.label, provenance_of(options), nullptr,
                                       options.repeats));
        };
        ChildProcess process(make, folder / "run.log");
        running.push_back({std::move(job), std::move(process), Clock::now()});
      }

      bool ended(RunningJob &running_job)
      {
        const std::chrono::duration<double> spent = Clock::now() - running_job.start;
        std::string problem;
        if(running_job.process.ended())
          problem = running_job.process.end().problem();
        else if(spent.count() > time_limit)
        {
          running_job.process.kill();
          problem = fmt::format("took longer than its time limit of {} s", time_limit);
        }
        else
          return false;
        const Job &job = running_job.job;
        // A record that is there is whole, whatever befell the process after it.
        if(!std::filesystem::exists(job.path))
          record_failure(job, problem.empty() ? "ended without a record" : problem,
                         running_job.process.end().peak_memory_mb);
        report(job, spent.count());
        return true;
      }

      void record_failure(const Job &job, const std::string &problem,
                          double peak_memory_mb)
      {
        RunRecord record = record_without_result(job, options);
        record.status = RunStatus::failed;
        record.message = fmt::format("{} {}", job.run.method, problem);
        record.peak_memory_mb = peak_memory_mb;
        record.provenance["ended"] = "killed";
        write_json(job.path, record);
      }

      void report(const Job &job, double seconds)
      {
        const auto record = read_json(job.path);
        const std::string status = record.at("status"), message = record.at("message");
        // Repeats are made of short runs only, and say nothing of longer ones.
        const int repeats = std::max(1, record.at("repeats").get<int>());
        progress.run_ended(kind_of(job), seconds / repeats, name_of(job),
                           message.empty()
                               ? fmt::format("{} in {:.2f} s", status, seconds)
                               : fmt::format("{}: {}", status, message),
                           status == to_string(RunStatus::finished));
      }

      void show()
      {
        std::string names;
        for(const RunningJob &job : running)
          names += (names.empty() ? "" : ", ") + name_of(job.job);
        progress.show_running(names);
      }

      const RunnerOptions &options;
      double time_limit;
      Progress &progress;
      std::vector<RunningJob> running;
    };

    RunnerOptions completed(RunnerOptions options)
    {
      if(options.jobs <= 0)
        options.jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
      if(options.program_hash.empty())
        options.program_hash = sha256_of_file("/proc/self/exe");
      return options;
    }

    std::map<std::string, cases::Case> load_cases(const Matrix &matrix,
                                                  const CaseLoader &load_case)
    {
      std::map<std::string, cases::Case> written, planned_ones;
      for(const std::string &name : case_names(matrix))
        written.emplace(name, load_case(name));
      for(const PlannedCase &planned : planned_cases(matrix))
      {
        const cases::Case &base = written.at(planned.base);
        const bool is_new
            = planned_ones
                  .emplace(planned.name,
                           planned.settings.empty()
                               ? base
                               : cases::vary_case(base, planned.name, planned.settings))
                  .second;
        if(!is_new)
          throw cases::InputError(fmt::format(
              "matrix '{}' has two cases of the name '{}'", matrix.name, planned.name));
      }
      return planned_ones;
    }

    /** @throws InputError for a bound that a case and the matrix both set. */
    void check_criteria(const Matrix &matrix,
                        const std::map<std::string, cases::Case> &cases_by_name)
    {
      for(const MatrixCriterion &one : matrix.criteria)
        for(const auto &[name, the_case] : cases_by_name)
          if(in_family(one.case_name, name))
            for(const cases::Criterion &written : the_case.criteria)
              if(bound_the_same(one.criterion, written))
                throw cases::InputError(fmt::format(
                    "{} sets a bound that the case sets itself, '{}'; it belongs to one "
                    "of them",
                    one.place, written.text));
    }
  } // namespace

  MatrixResult run_matrix(const Matrix &matrix, const RunnerOptions &given,
                          const CaseLoader &load_case, const MethodLookup &methods)
  {
    const std::vector<PlannedRun> plan = plan_runs(matrix, methods);
    check_findings(matrix, methods);
    const std::map<std::string, cases::Case> cases_by_name
        = load_cases(matrix, load_case);
    check_criteria(matrix, cases_by_name);
    const RunnerOptions options = completed(given);
    const DirectoryLock lock(options.directory);

    std::vector<StoredCase> case_records;
    for(const PlannedCase &planned : planned_cases(matrix))
      case_records.push_back(
          stored_case(cases_by_name.at(planned.name),
                      planned.settings.empty() ? "" : short_case_name(planned.base),
                      planned.settings));
    write_plan(options.directory, matrix, case_records, plan, options.program_version);

    std::deque<Job> jobs;
    std::vector<RunKind> kinds;
    for(const PlannedRun &run : plan)
    {
      const cases::Case &c = cases_by_name.at(run.case_name);
      Job job{run, &c, &methods(run.method), options.directory + "/" + run.file(),
              estimated_work(run, c)};
      if(already_made(job, options))
        continue;
      // What stands in its place is of another program or case.
      std::filesystem::remove(job.path);
      kinds.push_back(kind_of(job));
      jobs.push_back(std::move(job));
    }
    std::ranges::stable_sort(jobs, std::ranges::greater(), &Job::work);

    {
      Progress progress(options.progress, kinds, plan.size() - kinds.size(),
                        options.jobs);
      Workers(options, matrix.time_limit, progress).run(std::move(jobs));
    }
    MatrixResult result = load_matrix_result(options.directory);
    write_summary(options.directory, result);
    if(options.conclude)
      options.conclude(result);
    return result;
  }
} // namespace meltfront::verification
