#include <cases/case_file/case_file.h>
#include <cases/error.h>
#include <verification/app/capability_list.h>
#include <verification/app/case_settings.h>
#include <verification/app/commands.h>
#include <verification/app/console.h>
#include <verification/app/field_writer.h>
#include <verification/app/methods.h>
#include <verification/judge/baseline.h>
#include <verification/judge/coverage.h>
#include <verification/judge/criteria.h>
#include <verification/judge/stability.h>
#include <verification/matrix/matrix_file.h>
#include <verification/matrix/matrix_files.h>
#include <verification/matrix/runner.h>
#include <verification/measure/measure.h>
#include <verification/ranks/agreement.h>
#include <verification/ranks/ranked_run.h>
#include <verification/record/json_values.h>
#include <verification/record/label.h>
#include <verification/report/page/report.h>
#include <verification/report/plots/plot_folder.h>
#include <verification/run/child_process.h>
#include <verification/run/memory_limit.h>
#include <verification/run/run_one.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <thread>

namespace meltfront::verification
{
  namespace
  {
    const char *const program_version = MELTFRONT_VERSION;
    std::string command_line;

    /** Bytes that a run may take. @param gigabytes that were asked for; 0: all there is
     */
    double memory_limit(double gigabytes)
    {
      return gigabytes > 0 ? 1e9 * gigabytes : available_memory();
    }

    /** The text of a file, without white space at its end. */
    std::string text_of(const std::string &file)
    {
      std::ifstream in(file);
      std::string text{std::istreambuf_iterator<char>(in), {}};
      text.erase(text.find_last_not_of(" \n\t") + 1);
      return text;
    }

    /** Wait until a process ends, or end it after so many seconds (0: never).
     * @return what went wrong, a clause; else empty */
    std::string wait_for(ChildProcess &process, double time_limit)
    {
      using Clock = std::chrono::steady_clock;
      constexpr std::chrono::milliseconds polling_pause{5};
      const Clock::time_point start = Clock::now();
      while(!process.ended())
      {
        const std::chrono::duration<double> spent = Clock::now() - start;
        if(time_limit > 0 && spent.count() > time_limit)
        {
          process.kill();
          return fmt::format("took longer than its time limit of {} s", time_limit);
        }
        std::this_thread::sleep_for(polling_pause);
      }
      return process.end().problem();
    }

    /** What the run command simulates. */
    struct RunPlan
    {
      cases::Case the_case;
      const cases::Method &method;
      cases::Resolution resolution;
      std::string label, directory;
    };

    std::map<std::string, std::string> provenance_of_command()
    {
      return {{"program_version", program_version}, {"command_line", command_line}};
    }

    /** A run in a process of its own, which writes all files of the run to a directory.
     * @throws cases::OutputError if it cannot. */
    RunRecord run_alone(const RunPlan &plan, const RunArguments &arguments)
    {
      const auto &[c, method, resolution, label, directory] = plan;
      const std::string file = directory + "/run.json", log = directory + "/run.log";
      const std::map<std::string, std::string> provenance = provenance_of_command();
      std::filesystem::remove(file);
      ChildProcess process(
          [&]
          {
            limit_memory(resolution.memory_limit, resolution.threads);
            FieldWriter fields(directory, c.scene.start_time, c.scene.end_time,
                               arguments.frames,
                               c.scene.problem == cases::ProblemKind::particle_solid
                                   ? c.scene.particle_solid->law.cutoff
                                   : 0);
            RepeatPolicy once;
            once.most = 1;
            const RunRecord record
                = run_one(c, method, resolution, label, provenance, &fields, once);
            if(record.status == RunStatus::finished)
              write_run_page(record, stored_case(c), directory);
            write_json(file, record);
          },
          log);
      const std::string problem = wait_for(process, arguments.time_limit);
      if(process.end().exit_status == 1)
        throw cases::OutputError(text_of(log)); // all else is in the record
      if(!std::filesystem::exists(file))
      {
        RunRecord failed = empty_record(c, method, resolution, label, provenance);
        failed.message = fmt::format(
            "{} {}", method.name(), problem.empty() ? "ended without a record" : problem);
        failed.peak_memory_mb = process.end().peak_memory_mb;
        failed.provenance["ended"] = "killed";
        write_json(file, failed);
      }
      return read_json(file).get<RunRecord>();
    }

    /** A run that all ranks of a session share; the first one writes its record. */
    RunRecord run_shared(const RunPlan &plan, const RunArguments &arguments,
                         const RankSession &session)
    {
      const std::string file = plan.directory + "/run.json";
      const MethodOnRanks method(plan.method, session.size());
      const cases::Scene &scene = plan.the_case.scene;
      const auto make_writer = [&]
      {
        return std::make_unique<FieldWriter>(
            plan.directory, scene.start_time, scene.end_time, arguments.frames, 0,
            FieldWriter::Piece{session.rank(), session.size()});
      };
      std::unique_ptr<FieldWriter> fields;
      session.on_first(
          [&]
          {
            std::filesystem::remove(file);
            fields = make_writer();
            return "";
          });
      if(!fields)
        fields = make_writer();
      const RunRecord record
          = run_on_ranks(session, plan.the_case, method, plan.resolution, plan.label,
                         provenance_of_command(), *fields, arguments.time_limit, file);
      session.on_first(
          [&]
          {
            if(record.status == RunStatus::finished)
              write_run_page(record, stored_case(plan.the_case), plan.directory);
            write_json(file, record);
            return "";
          });
      return record;
    }

    /** Read settings of a method (sort_settings()) into its options. */
    std::map<std::string, std::string>
    apply_settings(const std::vector<std::string> &settings, const cases::Method &method,
                   cases::Options &options)
    {
      std::map<std::string, std::string> set;
      for(const std::string &setting : settings)
      {
        const Setting one = parse_setting(setting);
        if(one.method != method.name())
          throw cases::InputError(
              fmt::format("--set {}: this run's method is '{}'", setting, method.name()));
        set[one.key] = one.value;
        options.set(one.key, one.value);
      }
      return set;
    }
  } // namespace

  void set_command_line(int argc, char **argv)
  {
    command_line = "meltfront";
    for(int i = 1; i < argc; ++i)
      command_line += fmt::format(" {}", argv[i]);
  }

  Setting parse_setting(const std::string &text)
  {
    const auto dot = text.find('.'), equals = text.find('=');
    if(dot == std::string::npos || equals == std::string::npos || dot > equals)
      throw cases::InputError(
          fmt::format("--set needs METHOD.KEY=VALUE, not '{}'", text));
    return {text.substr(0, dot), text.substr(dot + 1, equals - dot - 1),
            text.substr(equals + 1)};
  }

  std::string default_directory(const std::string &name)
  {
    return "results/" + short_case_name(name);
  }

  RunnerOptions runner_options(const std::string &directory, int jobs, double memory)
  {
    RunnerOptions options;
    options.directory = directory;
    options.jobs = jobs;
    options.memory_limit = memory_limit(memory);
    options.program_version = program_version;
    options.command_line = command_line;
    options.progress = stderr;
    return options;
  }

  cases::Case load_checked_case(const std::string &name)
  {
    cases::Case c = cases::load_case(name);
    const auto check = [&c](const std::string &where, const auto &check_it)
    {
      try
      {
        check_it();
      }
      catch(const cases::InputError &error)
      {
        throw cases::InputError(fmt::format("{}: {}: {}", c.file, where, error.what()));
      }
    };
    if(c.reference)
      check("reference", [&] { check_label(c.reference->label, method_named); });
    for(const cases::Criterion &criterion : c.criteria)
      check(fmt::format("criterion '{}'", criterion.text),
            [&]
            {
              if(criterion.method != cases::any_method)
                check_label(criterion.method, method_named);
              if(criterion.statistic != cases::Statistic::failure)
                require_quantity(criterion.quantity);
            });
    return c;
  }

  void judge_hard_cases(MatrixResult &result)
  {
    if(!result.hard_cases)
      return;
    result.stability = judge_stability(result);
    result.passed
        = std::ranges::all_of(result.criteria, &CriterionResult::passed)
          && std::ranges::all_of(result.findings, &FindingResult::holds)
          && std::ranges::none_of(result.stability, [](const StabilityVerdict &v)
                                  { return v.verdict == "failed"; });
  }

  void write_results(MatrixResult &result, const std::string &directory)
  {
    judge_hard_cases(result);
    write_summary(directory, result);
    write_report(result, directory);
    write_atomically(directory + "/coverage.csv", coverage_csv(coverage_of(result)));
    write_atomically(directory + "/capabilities.txt", capability_text());
  }

  void print_place_of_report(const std::string &directory)
  {
    fmt::print("Report: {}\n", std::filesystem::absolute(directory + "/report.html")
                                   .lexically_normal()
                                   .string());
  }

  int run(const RunArguments &arguments, const RankSession *session)
  {
    const cases::Method &method = method_named(arguments.method);
    const Settings settings = sort_settings(arguments.settings);
    const auto directory_of = [&](const std::string &case_name)
    {
      return !arguments.output.empty()
                 ? arguments.output
                 : default_directory(
                     fmt::format("run-{}-{}-{}", case_name, method.name(), arguments.n));
    };
    // A case with other values is written to a file, by one rank.
    const auto vary = [&]
    { return varied_case(arguments.case_name, settings.of_case, directory_of); };
    const cases::Case c = cases::load_case(session ? session->on_first(vary) : vary());
    RunPlan plan{c,
                 method,
                 {arguments.n, cases::Options(method.option_declarations()),
                  arguments.seed, arguments.threads, memory_limit(arguments.memory)},
                 {},
                 directory_of(c.scene.name)};
    const auto set = apply_settings(settings.of_method, method, plan.resolution.options);
    plan.label
        = run_label(method.name(), set, arguments.threads, session ? session->size() : 1);
    const std::string &directory = plan.directory;
    make_directory(directory);

    const RunRecord record
        = session ? run_shared(plan, arguments, *session) : run_alone(plan, arguments);
    std::fputs(run_text(record, c).c_str(), stdout);
    fmt::print("Written to {}: run.json{}\n", directory,
               record.status == RunStatus::finished
                   ? ", front.csv, picture.svg, fields.pvd"
                   : "");
    switch(record.status)
    {
    case RunStatus::finished:
      return all_well;
    case RunStatus::refused:
      return bad_input;
    default:
      return run_failed;
    }
  }

  int conclude(MatrixResult &result, const std::string &directory)
  {
    write_results(result, directory);
    std::fputs(console_summary(result).c_str(), stdout);
    print_place_of_report(directory);
    return result.passed ? all_well : criterion_failed;
  }

  int report(const std::string &directory, const std::string &keep)
  {
    MatrixResult result = load_matrix_result(directory);
    const int status = conclude(result, directory);
    if(!keep.empty())
      write_baseline(fmt::format("{}/{}.json", keep, result.name), baseline_of(result));
    return status;
  }
} // namespace meltfront::verification
