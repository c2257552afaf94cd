#include <cases/error.h>
#include <verification/app/capability_list.h>
#include <verification/app/command_descriptions.h>
#include <verification/app/command_line.h>
#include <verification/app/list.h>

#include <fmt/format.h>

#include <cstdio>

namespace meltfront::verification
{
  namespace
  {
    void add_settings(CLI::App *command, std::vector<std::string> &settings)
    {
      command
          ->add_option("--set", settings,
                       "option of a method, METHOD.KEY=VALUE, or key of the case, "
                       "SUBSECTION/KEY=VALUE")
          ->take_all();
    }

    void add_case_settings(CLI::App *command, std::vector<std::string> &settings)
    {
      command
          ->add_option("--set", settings,
                       "other value of a key of the case, SUBSECTION/KEY=VALUE")
          ->take_all();
    }

    void add_memory_option(CLI::App *command, double &memory)
    {
      command
          ->add_option(
              "--memory", memory,
              "memory limit of a run in GB; runs estimated to exceed it are refused "
              "(default: the machine's memory)")
          ->check(CLI::PositiveNumber);
    }

    void add_details_flag(CLI::App *command, bool &details)
    {
      command->add_flag("-v,--details", details,
                        "print every criterion with its figure, and what was left out");
    }

    void add_keep_option(CLI::App *command, std::string &keep)
    {
      command
          ->add_option("--keep-reference", keep,
                       "keep the figures that --against reads, in DIR/MATRIX.json "
                       "(results/reference)")
          ->expected(0, 1)
          ->default_str("results/reference");
    }
  } // namespace

  CommandLine::CommandLine()
  {
    app.require_subcommand(1);
    app.footer(
        "Exit status: 0 all well, 1 an acceptance criterion failed, 2 bad arguments or "
        "case file, 3 a run failed numerically, 4 input or output failed.");
    declare_verify();
    declare_run();
    declare_compare();
    declare_advise();
    declare_crosscheck();
    declare_study(
        "ablate",
        "take each effect out of a case in turn: what changes, beside the bound "
        "known before, and what it saves",
        ablate);
    declare_study(
        "sensitivity",
        "how front and temperature of a case depend on each of its data, beside "
        "the numerical error",
        sensitivity);
    declare_calibrate();
    declare_others();
    declare_manual();
    declare_plugins();
    add_examples(app);
  }

  void CommandLine::declare_verify()
  {
    const auto add_options = [this](CLI::App *command)
    {
      command->add_option("--out", verify_arguments.output, "directory (results/MATRIX)");
      command
          ->add_option("--jobs", verify_arguments.jobs,
                       "number of concurrent runs (one per core)")
          ->check(CLI::Range(0, 1024));
      add_memory_option(command, verify_arguments.memory);
      add_details_flag(command, verify_arguments.details);
    };
    auto *verify_command
        = app.add_subcommand("verify", "run a verification matrix and write its report");
    verify_command->add_option(
        "matrix", verify_arguments.matrix,
        "matrix of the library, a matrix file, or 'full': all of the "
        "library (default)");
    add_options(verify_command);
    verify_command->add_option(
        "--against", verify_arguments.against,
        "hold the figures against those in this directory (results/reference): what grew "
        "by a tenth, holds no longer or is missing is printed, and the exit status is 1");
    add_keep_option(verify_command, verify_arguments.keep);
    verify_command
        ->add_option("--timing", verify_arguments.timing,
                     "quick: short runs repeated a few times; careful: all below 10 s in "
                     "turn until their times agree (as the matrix says)")
        ->check(CLI::IsMember({"quick", "careful"}));
    verify_command->add_option("--shared", verify_arguments.shared,
                               "directory of records that several matrices share");
    auto *list_runs = verify_command->add_flag(
        "--list-runs", verify_arguments.list_runs,
        "print one line for each run, as --only takes it, and make none");
    auto *launcher = verify_command->add_option(
        "--launcher", verify_arguments.launcher,
        "command that starts each run as a process of its own, e.g. 'srun -n1'");
    verify_command
        ->add_option(
            "--only", verify_arguments.only,
            "make this one run, by its line of --list-runs or the line's number, "
            "and judge nothing")
        ->excludes(launcher)
        ->excludes(list_runs);
    verify_command->callback([this]
                             { action = [this] { return verify(verify_arguments); }; });

    auto *stability = app.add_subcommand(
        "stability", "run the matrix of hard cases (verify stability)");
    add_options(stability);
    stability->callback(
        [this]
        {
          verify_arguments.matrix = "stability";
          action = [this] { return verify(verify_arguments); };
        });
  }

  void CommandLine::declare_run()
  {
    auto *command = app.add_subcommand(
        "run", "run one method on a case; writes fields for ParaView");
    RunArguments &a = run_arguments;
    auto *resume = command->add_option(
        "--resume", a.resume,
        "directory of a run that was interrupted, to go on with from its checkpoint "
        "(option `checkpoint` of its method), instead of a case");
    command->add_option("case", a.case_name, "case of the library, or a case file")
        ->excludes(resume);
    command->add_option("--method", a.method, "method")->excludes(resume);
    command->add_option("--n", a.n, "particles or cells along the domain's side (40)")
        ->check(CLI::Range(2, 1000000))
        ->excludes(resume);
    command->add_option("--out", a.output, "directory (results/run-CASE-METHOD-N)")
        ->excludes(resume);
    add_settings(command, a.settings);
    command->add_option("--seed", a.seed, "seed of random arrangements (1)")
        ->excludes(resume);
    command->add_option("--threads", a.threads, "number of threads (1)")
        ->check(CLI::Range(1, 1024))
        ->excludes(resume);
    command->add_option("--frames", a.frames, "number of output times for ParaView (20)")
        ->check(CLI::Range(1, 10000))
        ->excludes(resume);
    add_memory_option(command, a.memory);
    command
        ->add_option("--time-limit", a.time_limit,
                     "time limit of the run in seconds; 0: none (3600)")
        ->check(CLI::NonNegativeNumber);
    command->callback(
        [this]
        {
          is_run = true;
          action = [this] { return run(run_arguments, session ? &*session : nullptr); };
        });
  }

  void CommandLine::declare_compare()
  {
    auto *command = app.add_subcommand(
        "compare", "what every method that can answers to a case, with error bars");
    CompareArguments &a = compare_arguments;
    command->add_option("case", a.case_name, "case of the library, or a case file")
        ->required();
    add_settings(command, a.settings);
    command
        ->add_option("--within", a.within,
                     "seconds for all runs (60; with --n as long as they take)")
        ->check(CLI::PositiveNumber);
    command
        ->add_option("--n", a.resolutions,
                     "resolutions of all methods, instead of those that time allows")
        ->delimiter(',')
        ->check(CLI::Range(2, 1000000));
    command->add_option("--out", a.output, "directory (results/compare-CASE)");
    command->add_option("--jobs", a.jobs, "number of concurrent runs (one per core)")
        ->check(CLI::Range(0, 1024));
    add_memory_option(command, a.memory);
    command->callback([this] { action = [this] { return compare(compare_arguments); }; });
  }

  void CommandLine::declare_advise()
  {
    auto *command = app.add_subcommand(
        "advise", "the cheapest method and resolution that reach an error, then the run");
    AdviseArguments &a = advise_arguments;
    command->add_option("case", a.case_name, "case of the library, or a case file")
        ->required();
    add_case_settings(command, a.settings);
    command
        ->add_option("--front-error", a.front_error,
                     "wanted error of the front, root mean square over time, relative to "
                     "its end (1e-3)")
        ->check(CLI::PositiveNumber);
    command
        ->add_option("--temperature-error", a.temperature_error,
                     "wanted error of the temperature at the end, root mean square over "
                     "places, relative to its range (not asked for)")
        ->check(CLI::PositiveNumber);
    command->add_option("--within", a.within, "seconds for all runs (60)")
        ->check(CLI::PositiveNumber);
    command->add_option("--out", a.output, "directory (results/advise-CASE)");
    command->add_option("--jobs", a.jobs, "number of concurrent runs (one per core)")
        ->check(CLI::Range(0, 1024));
    add_memory_option(command, a.memory);
    command->callback([this] { action = [this] { return advise(advise_arguments); }; });
  }

  void CommandLine::declare_crosscheck()
  {
    auto *command = app.add_subcommand(
        "crosscheck", "run random scenes and report methods that contradict the others");
    CrosscheckArguments &a = crosscheck_arguments;
    command->add_option("--scenes", a.scenes, "number of scenes (20)")
        ->check(CLI::Range(1, 1000000));
    command->add_option("--seed", a.seed, "seed of the scenes (1)");
    command
        ->add_option("--dimension", a.dimension,
                     "dimension of the scenes: 1, 2 or 3 (any)")
        ->check(CLI::Range(1, 3));
    command->add_option("--out", a.output, "directory (results/crosscheck-SEED)");
    command->add_option("--jobs", a.jobs, "number of concurrent runs (one per core)")
        ->check(CLI::Range(0, 1024));
    command->add_option("--within", a.within, "CPU time limit of a run in seconds (20)")
        ->check(CLI::PositiveNumber);
    command
        ->add_option("--methods", a.methods,
                     "methods, separated by commas (all but those as published)")
        ->delimiter(',');
    command->callback([this]
                      { action = [this] { return crosscheck(crosscheck_arguments); }; });
  }

  void CommandLine::declare_study(const char *name, const char *description,
                                  int (*study)(const StudyArguments &))
  {
    auto *command = app.add_subcommand(name, description);
    StudyArguments &a = study_arguments;
    command->add_option("case", a.case_name, "case of the library, or a case file")
        ->required();
    add_case_settings(command, a.settings);
    command->add_option("--method", a.method, "method (the first that takes the case)");
    command->add_option("--n", a.n, "finest resolution (as the time allows)")
        ->check(CLI::Range(8, 1000000));
    command
        ->add_option("--within", a.within, "CPU time of all runs in seconds, about (60)")
        ->check(CLI::PositiveNumber);
    command->add_option("--out", a.output,
                        fmt::format("directory (results/{}-CASE)", name));
    command->add_option("--jobs", a.jobs, "number of concurrent runs (one per core)")
        ->check(CLI::Range(0, 1024));
    add_memory_option(command, a.memory);
    command->callback([this, study]
                      { action = [this, study] { return study(study_arguments); }; });
  }

  void CommandLine::declare_calibrate()
  {
    auto *command = app.add_subcommand(
        "calibrate",
        "measure the continuum properties of a particle solid; writes a material");
    CalibrateArguments &a = calibrate_arguments;
    command->add_option("what", a.what, "greenspan")
        ->required()
        ->check(CLI::IsMember({"greenspan"}));
    command->add_option("--substance", a.substance, "triangle or rectangle (triangle)")
        ->check(CLI::IsMember({"triangle", "rectangle"}));
    command->add_flag("--full", a.full, "longer runs with smaller errors (minutes)");
    command->add_option("--pressure", a.pressure, "force per length")
        ->check(CLI::Range(0., 1000.));
    command->add_option("--hot", a.hot, "temperature of the wall that melts (60)");
    command->add_option("--cold", a.cold, "temperature of the solid (30)");
    command->add_option("--seeds", a.seeds, "number of independent runs")
        ->check(CLI::Range(2, 1000));
    command->add_option("--jobs", a.jobs, "number of concurrent seeds (one per core)")
        ->check(CLI::Range(0, 1024));
    command->add_option("--out", a.output, "file (results/calibration-SUBSTANCE.prm)");
    command->callback([this]
                      { action = [this] { return calibrate(calibrate_arguments); }; });
  }

  void CommandLine::declare_others()
  {
    auto *list_command = app.add_subcommand(
        "list",
        "list cases, methods, effects, matrices, quantities, keys or capabilities");
    list_command
        ->add_option(
            "what", list_what,
            "cases, methods, effects, matrices, quantities, keys of case files, or "
            "capabilities of methods")
        ->check(CLI::IsMember({"cases", "methods", "effects", "matrices", "quantities",
                               "keys", "capabilities"}));
    list_command->add_flag("--json", list_as_json, "capabilities as JSON");
    list_command->callback(
        [this]
        {
          action = [this]
          {
            if(list_as_json && list_what != "capabilities")
              throw meltfront::cases::InputError(
                  "only capabilities are listed as JSON: meltfront list capabilities "
                  "--json");
            std::fputs(list_as_json ? capability_json().c_str()
                                    : list_text(list_what).c_str(),
                       stdout);
            return int(all_well);
          };
        });

    auto *new_command
        = app.add_subcommand("new", "write a case file to begin with, NAME.prm");
    new_command->add_option("name", new_case_arguments.name, "name of the case, or path")
        ->required();
    new_command->add_option("--like", new_case_arguments.like,
                            "case of the library, or case file, to begin with (a slab "
                            "that explains its keys)");
    new_command->callback([this]
                          { action = [this] { return new_case(new_case_arguments); }; });

    auto *report_command = app.add_subcommand(
        "report", "write tables, plots and report anew from finished runs");
    report_command
        ->add_option("directory", report_directory, "directory of a finished matrix")
        ->required();
    add_keep_option(report_command, kept_directory);
    add_details_flag(report_command, report_details);
    report_command->callback(
        [this]
        {
          action = [this]
          { return report(report_directory, kept_directory, report_details); };
        });
    app.add_subcommand("test", "build and run all tests (./meltfront test)")
        ->callback(
            [this]
            {
              action = []() -> int
              {
                throw meltfront::cases::InputError(
                    "the tests are run by the script: ./meltfront test");
              };
            });
  }

  void CommandLine::declare_manual()
  {
    auto *command = app.add_subcommand(
        "manual",
        "write the whole manual as one page, a man page, or what bash completes");
    ManualArguments &a = manual_arguments;
    command->add_option("--out", a.output,
                        "file (results/manual.html; standard output for man and bash)");
    command->add_option("--format", a.format, "html, man or bash (html)")
        ->check(CLI::IsMember({"html", "man", "bash"}));
    command->callback(
        [this]
        {
          action = [this]
          {
            manual_arguments.commands = descriptions_of(app);
            return manual(manual_arguments);
          };
        });
  }

  /** Of every command that methods are named to. */
  void CommandLine::declare_plugins()
  {
    for(const char *command : {"verify", "stability", "run", "compare", "advise",
                               "crosscheck", "ablate", "sensitivity", "list"})
      app.get_subcommand(command)
          ->add_option("--plugin", plugins,
                       "shared library with methods of its own, which join all others; "
                       "may be given several times")
          ->allow_extra_args(false);
  }
} // namespace meltfront::verification
