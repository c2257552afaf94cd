#include <cases/data_folder.h>
#include <cases/error.h>
#include <verification/app/commands.h>
#include <verification/app/methods.h>
#include <verification/judge/baseline.h>
#include <verification/matrix/matrix_file.h>
#include <verification/matrix/matrix_files.h>
#include <verification/matrix/runner.h>
#include <verification/record/json_values.h>
#include <verification/report/page/front_page.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>

namespace meltfront::verification
{
  namespace
  {
    /** The word for every matrix of the library. */
    const std::string all_matrices = "full";

    std::string directory_of(const VerifyArguments &arguments)
    {
      return arguments.output.empty() ? default_directory(arguments.matrix)
                                      : arguments.output;
    }

    Matrix matrix_of(const VerifyArguments &arguments)
    {
      Matrix matrix = load_matrix(arguments.matrix);
      if(!arguments.timing.empty())
        matrix.careful_timing = arguments.timing == "careful";
      return matrix;
    }

    /** `LAUNCHER /path/meltfront verify MATRIX --out DIR --only`, in words. */
    std::vector<std::string> launcher_of(const VerifyArguments &arguments)
    {
      std::vector<std::string> words;
      std::istringstream in(arguments.launcher);
      for(std::string word; in >> word;)
        words.push_back(word);
      if(words.empty())
        return words;
      const std::string matrix
          = std::filesystem::exists(arguments.matrix)
                ? std::filesystem::absolute(arguments.matrix).string()
                : arguments.matrix;
      for(const std::string &word :
          {std::filesystem::read_symlink("/proc/self/exe").string(),
           std::string("verify"), matrix, std::string("--out"),
           std::filesystem::absolute(directory_of(arguments)).string()})
        words.push_back(word);
      if(!arguments.shared.empty())
        words.insert(words.end(),
                     {"--shared", std::filesystem::absolute(arguments.shared).string()});
      if(arguments.memory > 0)
        words.insert(words.end(), {"--memory", fmt::format("{}", arguments.memory)});
      for(const std::string &plugin : plugin_files())
        words.insert(words.end(), {"--plugin", plugin});
      words.push_back("--only");
      return words;
    }

    /** The figures of a matrix in a directory: kept ones, or those of its records. */
    Baseline baseline_in(const std::string &directory, const std::string &matrix)
    {
      if(const std::string kept = fmt::format("{}/{}.json", directory, matrix);
         std::filesystem::exists(kept))
        return read_baseline(kept);
      for(const std::string &folder : {directory, directory + "/" + matrix})
        if(std::filesystem::exists(folder + "/matrix.json")
           && read_json(folder + "/matrix.json").at("name") == matrix)
        {
          MatrixResult result = load_matrix_result(folder);
          judge_hard_cases(result);
          return baseline_of(result);
        }
      throw cases::InputError(fmt::format("{} holds no results of the matrix '{}': "
                                          "neither {}.json nor a directory that it "
                                          "wrote",
                                          directory, matrix, matrix));
    }

    int hold_against(const Baseline &baseline, const MatrixResult &result,
                     const std::string &directory)
    {
      const BaselineComparison comparison = compare_with_baseline(result, baseline);
      fmt::print("Against {} (version {}):\n{}", directory, baseline.program_version,
                 comparison_text(comparison));
      return comparison.flags.empty() ? all_well : criterion_failed;
    }

    /** What is to be done with a result beside its report: keep its figures, and hold
     * them against others, which are read before the runs, that may replace them. */
    std::function<int(const MatrixResult &)>
    figures_check(const VerifyArguments &arguments)
    {
      std::optional<Baseline> baseline;
      if(!arguments.against.empty())
        baseline = baseline_in(arguments.against, short_case_name(arguments.matrix));
      return [arguments, baseline](const MatrixResult &result)
      {
        if(!arguments.keep.empty())
          write_baseline(fmt::format("{}/{}.json", arguments.keep, result.name),
                         baseline_of(result));
        return baseline        ? hold_against(*baseline, result, arguments.against)
               : result.passed ? int(all_well)
                               : int(criterion_failed);
      };
    }

    int run_and_conclude(const Matrix &matrix, RunnerOptions options, bool details,
                         const std::function<int(const MatrixResult &)> &then)
    {
      int status = all_well;
      options.conclude = [&](MatrixResult &result)
      {
        conclude(result, options.directory, details);
        status = then(result);
      };
      run_matrix(matrix, options, load_checked_case, method_named);
      return status;
    }

    /** What the runs of a matrix took when its figures were last committed (s). */
    std::map<std::string, double> known_seconds(const std::string &matrix)
    {
      std::map<std::string, double> seconds;
      const std::string file
          = cases::data_path(fmt::format("results/reference/{}.json", matrix));
      if(std::filesystem::exists(file))
        for(const auto &[run, figures] : read_baseline(file).runs)
          seconds[run] = figures.cpu_seconds;
      return seconds;
    }

    RunnerOptions options_of(const VerifyArguments &arguments, const Matrix &matrix)
    {
      RunnerOptions options
          = runner_options(directory_of(arguments), arguments.jobs, arguments.memory);
      if(matrix.hard_cases) // judged by what comes out, not by its time
        options.repeats.most = 1;
      options.known_seconds = known_seconds(matrix.name);
      options.shared = arguments.shared;
      options.only = arguments.only;
      options.launcher = launcher_of(arguments);
      return options;
    }

    /** One matrix of several: its report, and its line. */
    int verify_one_of_all(const VerifyArguments &arguments,
                          std::vector<MatrixLine> &lines)
    {
      const Matrix matrix = matrix_of(arguments);
      RunnerOptions options = options_of(arguments, matrix);
      const auto then = figures_check(arguments);
      int status = all_well;
      options.conclude = [&](MatrixResult &result)
      {
        write_results(result, options.directory);
        lines.push_back(matrix_line(result, result.name + "/report.html"));
        fmt::print("{}", line_text(lines.back()));
        status = then(result);
        std::fflush(stdout);
      };
      run_matrix(matrix, options, load_checked_case, method_named);
      return status;
    }

    /** All matrices of the library, each in a folder of its own, with a page before them.
     */
    int verify_all(const VerifyArguments &arguments)
    {
      const std::string directory = directory_of(arguments);
      std::vector<MatrixLine> lines;
      int status = all_well;
      for(const std::string &name : matrix_names())
      {
        VerifyArguments of_matrix = arguments;
        of_matrix.matrix = name;
        of_matrix.output = directory + "/" + name;
        of_matrix.shared = directory + "/shared";
        status = std::max(status, verify_one_of_all(of_matrix, lines));
        write_front_page(lines, directory + "/report.html");
      }
      print_place_of_report(directory);
      return status;
    }
  } // namespace

  int verify(const VerifyArguments &arguments)
  {
    if(arguments.matrix == all_matrices && arguments.only.empty() && !arguments.list_runs)
      return verify_all(arguments);
    const Matrix matrix = matrix_of(arguments);
    if(arguments.list_runs)
    {
      for(const PlannedRun &run : plan_runs(matrix, method_named))
        fmt::print("{}\n", run.identity());
      return all_well;
    }
    const RunnerOptions options = options_of(arguments, matrix);
    if(!arguments.only.empty())
    {
      make_one_run(matrix, options, load_checked_case, method_named);
      return all_well;
    }
    return run_and_conclude(matrix, options, arguments.details, figures_check(arguments));
  }
} // namespace meltfront::verification
