#ifndef meltfront_verification_app_commands_h
#define meltfront_verification_app_commands_h

#include <verification/judge/matrix_result.h>
#include <verification/matrix/runner.h>
#include <verification/ranks/ranks.h>

#include <map>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /** What every command exits with. */
  enum ExitStatus
  {
    all_well = 0,
    criterion_failed = 1,
    bad_input = 2,
    run_failed = 3,
    output_failed = 4
  };

  struct VerifyArguments
  {
    /** Name in the library, path of a matrix file, or `full`: all of the library. */
    std::string matrix = "default";
    std::string output;     ///< directory; empty: results/MATRIX
    int jobs = 0;           ///< runs at once; 0: one per core
    double memory = 0;      ///< GB that a run may take; 0: what the machine has
    bool list_runs = false; ///< print the identities of the runs, make none
    std::string launcher;   ///< words before the command that makes one run
    std::string only;       ///< identity or number of the one run to be made
    std::string shared;     ///< directory of records that matrices share
    std::string timing;     ///< `quick` or `careful`; empty: as the matrix says
    std::string against;    ///< directory of results that the figures are held against
    std::string keep;       ///< directory in which the figures are kept for that
    bool details = false;   ///< print every criterion and what was left out
  };

  struct RunArguments
  {
    std::string case_name;
    std::string method;
    int n = 40;
    std::string output;                ///< directory; empty: results/run-CASE-METHOD-N
    std::vector<std::string> settings; ///< METHOD.KEY=VALUE, SUBSECTION/KEY=VALUE
    unsigned long seed = 1;
    int threads = 1;
    int frames = 20;          ///< for ParaView
    double memory = 0;        ///< GB that the run may take; 0: what the machine has
    double time_limit = 3600; ///< s; 0: none
    std::string resume;       ///< directory of a run to go on with, instead of a case
  };

  /** The value of a method's option. */
  struct Setting
  {
    std::string method, key, value;
  };

  /** METHOD.KEY=VALUE. @throws cases::InputError for another form */
  Setting parse_setting(const std::string &text);

  /** Bytes that a run may take. @param gigabytes that were asked for; 0: all there is */
  double memory_limit(double gigabytes);

  /** Of the program and the command line, as records have them. */
  std::map<std::string, std::string> provenance_of_command();

  /** The command line as it was typed, for provenance. */
  void set_command_line(int argc, char **argv);

  /** `results/NAME` for the name, or the path, of a case or matrix. */
  std::string default_directory(const std::string &name);

  /** How every command runs a matrix. @param memory GB that a run may take; 0: what the
   * machine has */
  RunnerOptions runner_options(const std::string &directory, int jobs, double memory);

  /** Load a case and hold the names in its criteria and its reference against what there
   * is. @throws InputError */
  cases::Case load_checked_case(const std::string &name);

  /** Judge a finished matrix and write its summary, report, coverage and capabilities. */
  void write_results(MatrixResult &result, const std::string &directory);

  /** Print where the report of a directory is. */
  void print_place_of_report(const std::string &directory);

  /** Of a matrix of hard cases, say of each run whether it held. */
  void judge_hard_cases(MatrixResult &result);

  /** write_results(), and print what came of it. @return an ExitStatus */
  int conclude(MatrixResult &result, const std::string &directory, bool details = false);

  /** Run a matrix, write the report, print every criterion with its figure; or list its
   * runs, or make one of them. */
  int verify(const VerifyArguments &arguments);

  /** One run, in a process of its own: run.json, front.csv, picture.svg and fields for
   * ParaView. One that crashes or takes longer than it may is recorded as failed.
   * @param session of the ranks that share the run, or null: a process of its own */
  int run(const RunArguments &arguments, const RankSession *session);

  /** Tables and plots again from finished runs; nothing is run.
   * @param keep directory in which the figures are kept (VerifyArguments::keep), or empty
   * @param details as VerifyArguments::details */
  int report(const std::string &directory, const std::string &keep, bool details);
} // namespace meltfront::verification

#endif
