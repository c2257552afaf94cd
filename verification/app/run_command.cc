#include <cases/case_file/case_file.h>
#include <cases/case_file/output_reader.h>
#include <cases/error.h>
#include <verification/app/case_settings.h>
#include <verification/app/commands.h>
#include <verification/app/console.h>
#include <verification/app/field_writer.h>
#include <verification/app/methods.h>
#include <verification/app/probe_writer.h>
#include <verification/app/several_observers.h>
#include <verification/matrix/directory_lock.h>
#include <verification/matrix/matrix_files.h>
#include <verification/ranks/agreement.h>
#include <verification/ranks/ranked_run.h>
#include <verification/record/json_values.h>
#include <verification/record/provenance.h>
#include <verification/record/stored_case.h>
#include <verification/report/page/report.h>
#include <verification/report/plots/plot_folder.h>
#include <verification/run/checkpoint/checkpoint_keeper.h>
#include <verification/run/child_process.h>
#include <verification/run/memory_limit.h>
#include <verification/run/run_one.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <thread>

namespace meltfront::verification
{
  namespace
  {
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
      std::vector<std::string> settings{}; ///< of the method, as they were given
    };

    /** Where a run whose options ask for checkpoints keeps them. */
    std::optional<KeptRun> kept_run(const RunPlan &plan)
    {
      const double interval = checkpoint_interval(plan.resolution.options);
      if(interval == 0)
        return {};
      return KeptRun{CheckpointFolder::in(plan.directory), interval};
    }

    /** What keeps the checkpoints that a run's options ask for, if they do. */
    ThroughObserver checkpoints_of(const RunPlan &plan,
                                   std::map<std::string, double> &evidence)
    {
      const std::optional<KeptRun> kept = kept_run(plan);
      if(!kept)
        return {};
      return [kept, &evidence](cases::Observer &observer)
      {
        return std::make_unique<CheckpointKeeper>(kept->folder, kept->interval, observer,
                                                  evidence);
      };
    }

    /** A run in a process of its own, which writes all files of the run to a directory.
     * @throws cases::OutputError if it cannot. */
    RunRecord run_alone(const RunPlan &plan, const RunArguments &arguments)
    {
      const auto &[c, method, resolution, label, directory, settings] = plan;
      const std::string file = directory + "/run.json", log = directory + "/run.log";
      const std::map<std::string, std::string> provenance = provenance_of_command();
      RepeatPolicy once;
      once.most = 1;
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
            ProbeWriter probes(directory, c);
            SeveralObservers observers({&fields, &probes});
            std::map<std::string, double> evidence;
            RunRecord record = run_one(c, method, resolution, label, provenance,
                                       &observers, once, checkpoints_of(plan, evidence));
            record.cost.evidence.merge(evidence);
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
            FieldWriter::Piece{session.rank(), session.size(),
                               !arguments.resume.empty()});
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
      const RunRecord record = run_on_ranks(
          session, plan.the_case, method, plan.resolution, plan.label,
          provenance_of_command(), *fields, arguments.time_limit, file, kept_run(plan));
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

    /** What a run that is resumed has to be the same in. */
    nlohmann::json this_program()
    {
      nlohmann::json program = build_provenance();
      program["program_version"] = provenance_of_command().at("program_version");
      return program;
    }

    /** A run that was left in a directory. */
    struct LeftRun
    {
      cases::Case the_case;
      RunArguments arguments;
      bool shared; ///< as ranks share one, be it one of them
    };

    /** @throws cases::InputError if there is none, or several ranks are to go on with one
     * that ranks do not share */
    LeftRun left_run(const RunArguments &arguments, int ranks)
    {
      const nlohmann::json request
          = CheckpointFolder::in(arguments.resume).request(this_program());
      const bool shared
          = request.contains("shared") && request.at("shared") == nlohmann::json(true);
      if(ranks > 1 && !shared)
        throw cases::InputError(fmt::format(
            "{} was begun by what makes runs of one process, and {} ranks cannot go on "
            "with it: resume it without mpirun",
            arguments.resume, ranks));
      RunArguments result = arguments;
      result.output = arguments.resume;
      try
      {
        request.at("method").get_to(result.method);
        result.n = whole_number_in<int>(request.at("n"));
        request.at("settings").get_to(result.settings);
        result.seed = whole_number_in<std::uint64_t>(request.at("seed"));
        result.threads = whole_number_in<int>(request.at("threads"));
        result.frames = whole_number_in<int>(request.at("frames"));
        return {request.at("case").get<StoredCase>(), result, shared};
      }
      catch(const nlohmann::json::exception &problem)
      {
        throw cases::InputError(fmt::format("{}/checkpoint/request.json is damaged: {}",
                                            arguments.resume, problem.what()));
      }
    }

    nlohmann::json request_of(const RunPlan &plan, const RunArguments &arguments,
                              bool shared)
    {
      return {{"case", stored_case(plan.the_case)},
              {"method", plan.method.name()},
              {"n", plan.resolution.n},
              {"settings", plan.settings},
              {"seed", plan.resolution.seed},
              {"threads", plan.resolution.threads},
              {"frames", arguments.frames},
              {"shared", shared},
              {"program", this_program()}};
    }

    /** Where a run was interrupted its checkpoint stays, and is told. */
    void conclude_checkpoints(const RunRecord &record, const std::string &directory)
    {
      const CheckpointFolder folder = CheckpointFolder::in(directory);
      if(!record.provenance.contains("ended"))
        folder.remove();
      else if(const auto last = folder.last())
        fmt::print("Its checkpoint after step {} (t = {:.6g} s): go on with `meltfront "
                   "run --resume {}`\n",
                   last->step, last->time, directory);
    }

    /** The files that a case asks for, `, probes.csv, line-1.csv`. */
    std::string output_words(const cases::OutputRequest &output)
    {
      std::string words = output.probes.empty() ? "" : ", probes.csv";
      for(std::size_t i = 1; i <= output.lines.size(); ++i)
        words += fmt::format(", line-{}.csv", i);
      return words;
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
    /** Whether a run of one process is made as ranks share one: so several can go on with
     * it. */
    bool shares_on_one(const RunPlan &plan)
    {
      const auto *shared = dynamic_cast<const cases::SharedMethod *>(&plan.method);
      return kept_run(plan) && shared && shared->shares_on_one(plan.resolution.options);
    }

    /** Make a run and tell what came of it.
     * @param shared it goes on with one that ranks shared
     * @return an ExitStatus */
    int run_case(const cases::Case &c, const RunArguments &arguments,
                 const std::string &directory, const RankSession *session, bool shared)
    {
      const cases::Method &method = method_named(arguments.method);
      RunPlan plan{c,
                   method,
                   {arguments.n, cases::Options(method.option_declarations()),
                    arguments.seed, arguments.threads, memory_limit(arguments.memory)},
                   {},
                   directory,
                   sort_settings(arguments.settings).of_method};
      const auto set = apply_settings(plan.settings, method, plan.resolution.options);
      std::optional<RankSession> alone;
      if(!session && (shared || shares_on_one(plan)))
        session = &alone.emplace();
      if(session && !output_words(cases::output_of(c)).empty())
        throw cases::InputError(fmt::format(
            "{}: probes and lines are not written of runs that ranks share", c.file));
      const int ranks = session ? session->size() : 1;
      plan.label = run_label(method.name(), set, arguments.threads, ranks);
      std::optional<DirectoryLock> lock;
      const auto begin = [&]
      {
        lock.emplace(directory);
        const CheckpointFolder folder = CheckpointFolder::in(directory);
        if(arguments.resume.empty())
          folder.begin(kept_run(plan) ? request_of(plan, arguments, session != nullptr)
                                      : nlohmann::json());
        else
          folder.last(); // throws where the run could not go on from it
        return "";
      };
      session ? session->on_first(begin) : begin();
      const RunRecord record
          = session ? run_shared(plan, arguments, *session) : run_alone(plan, arguments);
      std::fputs(run_text(record, c).c_str(), stdout);
      fmt::print("Written to {}: run.json{}\n", directory,
                 record.status == RunStatus::finished
                     ? ", front.csv, picture.svg, fields.pvd"
                           + output_words(cases::output_of(c))
                     : "");
      if(!session || session->rank() == 0)
        conclude_checkpoints(record, directory);
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
  } // namespace

  int run(const RunArguments &arguments, const RankSession *session)
  {
    if(!arguments.resume.empty())
    {
      if(!arguments.settings.empty())
        throw cases::InputError("--resume takes no --set: the run goes on as it began");
      const LeftRun left = left_run(arguments, session ? session->size() : 1);
      return run_case(left.the_case, left.arguments, arguments.resume, session,
                      left.shared);
    }
    if(arguments.case_name.empty() || arguments.method.empty())
      throw cases::InputError("run needs a case and --method, or --resume DIRECTORY");
    const cases::Method &method = method_named(arguments.method);
    const auto directory_of = [&](const std::string &case_name)
    {
      return !arguments.output.empty()
                 ? arguments.output
                 : default_directory(
                     fmt::format("run-{}-{}-{}", case_name, method.name(), arguments.n));
    };
    // A case with other values is written to a file, by one rank.
    const auto vary = [&]
    {
      return varied_case(arguments.case_name, sort_settings(arguments.settings).of_case,
                         directory_of);
    };
    const cases::Case c = cases::load_case(session ? session->on_first(vary) : vary());
    const std::string directory = directory_of(c.scene.name);
    make_directory(directory);
    return run_case(c, arguments, directory, session, false);
  }
} // namespace meltfront::verification
