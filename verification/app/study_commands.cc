#include <verification/app/case_settings.h>
#include <verification/app/commands.h>
#include <verification/app/methods.h>
#include <verification/app/study_commands.h>
#include <verification/report/page/report.h>
#include <verification/studies/ablate/ablate.h>
#include <verification/studies/sensitivity/sensitivity.h>

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

namespace meltfront::verification
{
  namespace
  {
    StudySettings settings_of(const StudyArguments &arguments, const char *command)
    {
      StudySettings settings;
      const auto directory_of = [&](const std::string &case_name)
      {
        return !arguments.output.empty()
                   ? arguments.output
                   : default_directory(
                       fmt::format("{}-{}", command, short_case_name(case_name)));
      };
      settings.case_name = varied_case(
          arguments.case_name, settings_of_case(arguments.settings), directory_of);
      settings.method = arguments.method;
      settings.n = arguments.n;
      settings.within = arguments.within;
      settings.runner = runner_options(directory_of(settings.case_name), arguments.jobs,
                                       arguments.memory);
      for(const auto &method : methods())
        settings.methods.push_back(method.get());
      settings.load_case = load_checked_case;
      return settings;
    }

    std::string written(const StudySettings &settings, const char *file)
    {
      return std::filesystem::absolute(settings.runner.directory + "/" + file)
          .lexically_normal()
          .string();
    }
  } // namespace

  int ablate(const StudyArguments &arguments)
  {
    StudySettings settings = settings_of(arguments, "ablate");
    settings.runner.conclude = [&settings](MatrixResult &result)
    { write_report(result, settings.runner.directory); };
    std::fputs(ablation_text(ablate(settings)).c_str(), stdout);
    fmt::print("Written to {}\nReport: {}\n", written(settings, "ablate.json"),
               written(settings, "report.html"));
    return all_well;
  }

  int sensitivity(const StudyArguments &arguments)
  {
    StudySettings settings = settings_of(arguments, "sensitivity");
    settings.runner.repeats.most = 1; // no time is reported
    std::fputs(sensitivity_text(sensitivity(settings)).c_str(), stdout);
    fmt::print("Written to {}\n", written(settings, "sensitivity.json"));
    return all_well;
  }
} // namespace meltfront::verification
