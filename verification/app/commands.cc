#include <cases/case_file/case_file.h>
#include <cases/error.h>
#include <verification/app/capability_list.h>
#include <verification/app/commands.h>
#include <verification/app/console.h>
#include <verification/app/methods.h>
#include <verification/judge/baseline.h>
#include <verification/judge/coverage.h>
#include <verification/judge/criteria.h>
#include <verification/judge/stability.h>
#include <verification/matrix/matrix_file.h>
#include <verification/matrix/matrix_files.h>
#include <verification/matrix/runner.h>
#include <verification/measure/measure.h>
#include <verification/record/json_values.h>
#include <verification/record/label.h>
#include <verification/record/stored_case.h>
#include <verification/report/page/report.h>
#include <verification/report/plots/plot_folder.h>
#include <verification/run/memory_limit.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>

namespace meltfront::verification
{
  namespace
  {
    const char *const program_version = MELTFRONT_VERSION;
    std::string command_line;
  } // namespace

  double memory_limit(double gigabytes)
  {
    return gigabytes > 0 ? 1e9 * gigabytes : available_memory();
  }

  std::map<std::string, std::string> provenance_of_command()
  {
    return {{"program_version", program_version}, {"command_line", command_line}};
  }

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

  int conclude(MatrixResult &result, const std::string &directory, bool details)
  {
    write_results(result, directory);
    std::fputs(console_summary(result, details).c_str(), stdout);
    print_place_of_report(directory);
    return result.passed ? all_well : criterion_failed;
  }

  int report(const std::string &directory, const std::string &keep, bool details)
  {
    MatrixResult result = load_matrix_result(directory);
    const int status = conclude(result, directory, details);
    if(!keep.empty())
      write_baseline(fmt::format("{}/{}.json", keep, result.name), baseline_of(result));
    return status;
  }
} // namespace meltfront::verification
