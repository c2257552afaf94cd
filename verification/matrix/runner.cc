#include <cases/error.h>
#include <verification/matrix/criteria_reader.h>
#include <verification/matrix/directory_lock.h>
#include <verification/matrix/job.h>
#include <verification/matrix/matrix_files.h>
#include <verification/matrix/progress.h>
#include <verification/matrix/run_claim.h>
#include <verification/matrix/runner.h>
#include <verification/matrix/timing_rounds.h>
#include <verification/matrix/workers.h>
#include <verification/record/json_values.h>
#include <verification/record/label.h>
#include <verification/record/provenance.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <filesystem>
#include <thread>

namespace meltfront::verification
{
  namespace
  {
    /** Particles or cells times explicit steps: n^d n^2. */
    double estimated_work(const PlannedRun &run, const cases::Case &c)
    {
      return std::pow(run.resolution.n, c.scene.domain.dimension + 2);
    }

    /** The time now by the clock of the file system that holds the directory. */
    std::filesystem::file_time_type file_time(const std::string &directory)
    {
      const ClaimHolder self = ClaimHolder::self();
      const std::string path
          = fmt::format("{}/.time.{}.{}", directory, self.host, self.process);
      write_atomically(path, "");
      const auto now = std::filesystem::last_write_time(path);
      std::filesystem::remove(path);
      return now;
    }

    RunnerOptions completed(RunnerOptions options)
    {
      if(options.jobs <= 0)
        options.jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
      if(options.program_hash.empty())
        options.program_hash = verification::program_hash();
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

    /** A matrix whose names have been held against what there is. */
    struct Prepared
    {
      const Matrix &matrix;
      const MethodLookup &methods;
      std::vector<PlannedRun> plan;
      std::map<std::string, cases::Case> cases_by_name;
    };

    Prepared prepared(const Matrix &matrix, const CaseLoader &load_case,
                      const MethodLookup &methods)
    {
      Prepared result{matrix, methods, plan_runs(matrix, methods), {}};
      check_findings(matrix, methods);
      result.cases_by_name = load_cases(matrix, load_case);
      check_criteria(matrix, result.cases_by_name);
      return result;
    }

    void write_plan(const Prepared &prepared, const RunnerOptions &options)
    {
      std::vector<StoredCase> records;
      for(const PlannedCase &planned : planned_cases(prepared.matrix))
        records.push_back(
            stored_case(prepared.cases_by_name.at(planned.name),
                        planned.settings.empty() ? "" : short_case_name(planned.base),
                        planned.settings));
      write_plan(options.directory, prepared.matrix, records, prepared.plan,
                 options.program_version);
    }

    /** All runs, or the only one that is wanted. */
    std::vector<Job> jobs_of(const Prepared &prepared, const RunnerOptions &options)
    {
      std::vector<PlannedRun> runs = prepared.plan;
      if(!options.only.empty())
        runs = {find_run(prepared.plan, options.only)};
      std::vector<Job> jobs;
      for(const PlannedRun &run : runs)
      {
        const cases::Case &c = prepared.cases_by_name.at(run.case_name);
        jobs.push_back({run, &c, &prepared.methods(run.method),
                        options.directory + "/" + run.file(), estimated_work(run, c)});
      }
      return jobs;
    }

    /** Make what has not been made, the largest first. */
    void make_runs(const Prepared &prepared, const RunnerOptions &options)
    {
      const auto since = file_time(options.directory);
      const std::vector<Job> all = jobs_of(prepared, options);
      std::deque<Job> missing;
      std::vector<RunKind> kinds;
      for(const Job &job : all)
        if(!already_made(job, options))
        {
          kinds.push_back(kind_of(job));
          missing.push_back(job);
        }
      std::ranges::stable_sort(missing, std::ranges::greater(), &Job::work);
      Progress progress(options.progress, kinds, all.size() - kinds.size(), options.jobs);
      for(const Job &job : missing)
        if(const auto known = options.known_seconds.find(job.run.identity());
           known != options.known_seconds.end())
          progress.expect(kind_of(job), known->second);
      Workers(options, prepared.matrix.time_limit, since, progress)
          .run(std::move(missing));
    }

    void take_times(const Prepared &prepared, const RunnerOptions &options)
    {
      if(prepared.matrix.careful_timing)
        time_carefully(jobs_of(prepared, options), options, prepared.matrix.time_limit);
    }
  } // namespace

  MatrixResult run_matrix(const Matrix &matrix, const RunnerOptions &given,
                          const CaseLoader &load_case, const MethodLookup &methods)
  {
    const Prepared of_matrix = prepared(matrix, load_case, methods);
    const RunnerOptions options = completed(given);
    {
      const DirectoryLock lock(options.directory, DirectoryLock::IfHeld::wait);
      write_plan(of_matrix, options);
    }
    make_runs(of_matrix, options);
    take_times(of_matrix, options);
    const DirectoryLock lock(options.directory, DirectoryLock::IfHeld::wait);
    write_plan(of_matrix, options); // another matrix may have been run here meanwhile
    MatrixResult result = load_matrix_result(options.directory);
    write_summary(options.directory, result);
    if(options.conclude)
      options.conclude(result);
    return result;
  }

  void make_one_run(const Matrix &matrix, const RunnerOptions &given,
                    const CaseLoader &load_case, const MethodLookup &methods)
  {
    const Prepared of_matrix = prepared(matrix, load_case, methods);
    const RunnerOptions options = completed(given);
    if(!std::filesystem::exists(options.directory + "/matrix.json"))
    {
      const DirectoryLock lock(options.directory, DirectoryLock::IfHeld::wait);
      write_plan(of_matrix, options);
    }
    make_runs(of_matrix, options);
  }
} // namespace meltfront::verification
