#ifndef meltfront_verification_app_commands_h
#define meltfront_verification_app_commands_h

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
    std::string matrix = "default"; ///< name in the library or path of a matrix file
    std::string output;             ///< directory; empty: results/MATRIX
    int jobs = 0;                   ///< runs at once; 0: one per core
    double memory = 0;              ///< GB that a run may take; 0: what the machine has
  };

  struct RunArguments
  {
    std::string case_name;
    std::string method;
    int n = 40;
    std::string output;                ///< directory; empty: results/run-CASE-METHOD-N
    std::vector<std::string> settings; ///< METHOD.KEY=VALUE
    unsigned long seed = 1;
    int threads = 1;
    int frames = 20;          ///< for ParaView
    double memory = 0;        ///< GB that the run may take; 0: what the machine has
    double time_limit = 3600; ///< s; 0: none
  };

  struct CompareArguments
  {
    std::string case_name;
    std::vector<int> resolutions{20, 40, 80, 160};
    std::string output; ///< directory; empty: results/compare-CASE
    int jobs = 0;
    double memory = 0; ///< GB that a run may take; 0: what the machine has
  };

  /** The command line as it was typed, for provenance. */
  void set_command_line(int argc, char **argv);

  /** Run a matrix, write the report, print every criterion with its figure. */
  int verify(const VerifyArguments &arguments);

  /** One run, in a process of its own: run.json, front.csv, picture.svg and fields for
   * ParaView. One that crashes or takes longer than it may is recorded as failed. */
  int run(const RunArguments &arguments);

  /** Every method on one case, as a matrix of its own. */
  int compare(const CompareArguments &arguments);

  /** Tables and plots again from finished runs; nothing is run. */
  int report(const std::string &directory);
} // namespace meltfront::verification

#endif
