#ifndef meltfront_verification_app_command_line_h
#define meltfront_verification_app_command_line_h

#include <verification/app/answer_commands.h>
#include <verification/app/calibrate.h>
#include <verification/app/commands.h>
#include <verification/app/crosscheck_command.h>
#include <verification/app/manual/manual.h>
#include <verification/app/new_case.h>
#include <verification/app/study_commands.h>
#include <verification/ranks/ranks.h>

#include <CLI/CLI.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /** The commands and their options; parsing `app` stores what is to be done in
   * `action`. */
  struct CommandLine
  {
    CLI::App app{
        "meltfront: the Stefan problem by particles and finite elements, measured "
        "against exact solutions",
        "meltfront"};
    VerifyArguments verify_arguments;
    RunArguments run_arguments;
    CompareArguments compare_arguments;
    AdviseArguments advise_arguments;
    CrosscheckArguments crosscheck_arguments;
    CalibrateArguments calibrate_arguments;
    StudyArguments study_arguments;
    NewCaseArguments new_case_arguments;
    ManualArguments manual_arguments;
    std::string report_directory, kept_directory;
    std::string list_what;
    std::vector<std::string> plugins;
    bool list_as_json = false, report_details = false;
    std::function<int()> action;
    bool is_run = false; ///< the one command that ranks share

    std::optional<RankSession> session; ///< set before parsing where there are several

    CommandLine();

  private:
    void declare_verify();
    void declare_run();
    void declare_compare();
    void declare_advise();
    void declare_crosscheck();
    void declare_calibrate();
    void declare_study(const char *name, const char *description,
                       int (*study)(const StudyArguments &));
    void declare_others();
    void declare_manual();
    void declare_plugins();
  };
} // namespace meltfront::verification

#endif
