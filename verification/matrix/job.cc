#include <verification/matrix/job.h>
#include <verification/record/hash.h>
#include <verification/record/json_values.h>
#include <verification/record/provenance.h>

#include <fmt/format.h>

namespace meltfront::verification
{
  namespace
  {
    /** Whether it ended by itself; else the machine may be to blame. */
    bool ended_by_itself(const RunRecord &record)
    {
      const auto found = record.provenance.find("ended");
      return found == record.provenance.end() || found->second != "killed";
    }

    /** Whether the record is there and of this job, however it ended. */
    bool is_there(const Job &job, const RunnerOptions &options, bool however_it_ended)
    {
      if(!std::filesystem::exists(job.path))
        return false;
      try
      {
        const RunRecord record = read_json(job.path).get<RunRecord>();
        return is_record_of(record, job, options)
               && (however_it_ended || ended_by_itself(record));
      }
      catch(const std::exception &)
      {
        // Not a record as this program writes it: it is made anew.
        return false;
      }
    }

    /** What a record depends on, but for the label, tells its file. */
    std::string shared_path(const Job &job, const RunnerOptions &options)
    {
      const RunRecord record = record_without_result(job, options);
      const nlohmann::json identity{
          record.case_name,
          record.provenance.at("case_hash"),
          record.method,
          record.options,
          record.n,
          record.seed,
          record.threads,
          method_provenance(*job.method, job.run.resolution.options),
          options.program_version,
          options.program_hash};
      return fmt::format("{}/{}.json", options.shared, sha256(identity.dump()));
    }
  } // namespace

  std::filesystem::path Job::folder() const
  {
    return std::filesystem::path(path).parent_path();
  }

  std::string Job::claim() const
  {
    return folder() / "claim";
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

  bool is_record_of(const RunRecord &record, const Job &job, const RunnerOptions &options)
  {
    RunRecord expected = record_without_result(job, options);
    auto was = record.provenance;
    bool same_provenance = true;
    for(const char *key : {"case_hash", "program_version", "program_hash"})
      same_provenance = same_provenance && was[key] == expected.provenance[key];
    for(const auto &[key, value] :
        method_provenance(*job.method, job.run.resolution.options))
      same_provenance = same_provenance && was[key] == value;
    return same_provenance && record.method == expected.method
           && record.case_name == expected.case_name && record.label == expected.label
           && record.options == expected.options && record.n == expected.n
           && record.seed == expected.seed && record.threads == expected.threads;
  }

  bool already_made(const Job &job, const RunnerOptions &options)
  {
    return is_there(job, options, false);
  }

  bool made_since(const Job &job, const RunnerOptions &options,
                  std::filesystem::file_time_type since)
  {
    std::error_code failure;
    const auto written = std::filesystem::last_write_time(job.path, failure);
    return is_there(job, options, !failure && written >= since);
  }

  void share(const Job &job, const RunnerOptions &options)
  {
    if(options.shared.empty() || !already_made(job, options))
      return;
    std::filesystem::create_directories(options.shared);
    std::error_code there;
    std::filesystem::create_hard_link(job.path, shared_path(job, options), there);
  }

  bool take_shared(const Job &job, const RunnerOptions &options)
  {
    if(options.shared.empty() || !std::filesystem::exists(shared_path(job, options)))
      return false;
    RunRecord record = read_json(shared_path(job, options)).get<RunRecord>();
    record.label = job.run.label;
    if(!is_record_of(record, job, options))
      return false;
    write_json(job.path, record);
    return true;
  }

  std::string name_of(const Job &job)
  {
    return fmt::format(
        "{} {} n={}{}", job.run.case_name, job.run.label, job.run.resolution.n,
        job.run.resolution.seed == 1 ? ""
                                     : fmt::format(" seed={}", job.run.resolution.seed));
  }

  RunKind kind_of(const Job &job)
  {
    return {job.run.case_name, job.run.label, job.run.method, job.run.resolution.n};
  }
} // namespace meltfront::verification
