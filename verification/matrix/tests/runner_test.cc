#include <verification/matrix/directory_lock.h>
#include <verification/matrix/matrix_files.h>
#include <verification/matrix/run_claim.h>
#include <verification/matrix/runner.h>
#include <verification/record/json_values.h>
#include <verification/run/child_process.h>
#include <verification/run/tests/fakes.h>

#include <gtest/gtest.h>

#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <ctime>
#include <functional>
#include <random>
#include <set>
#include <thread>

namespace meltfront::verification
{
  namespace
  {
    using tests::FakeMethod;
    using tests::ScratchDirectory;

    void pause_for(int milliseconds)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    }

    /** Methods of a test, the log of their runs, and a matrix of them. */
    class RunnerTest : public ::testing::Test
    {
    protected:
      RunnerTest()
      {
        options.directory = scratch.path("out");
        options.jobs = 2;
        options.program_version = "1";
        options.repeats.most = 1;
        add("good", [](const auto &, const auto &) {});
        add("diverging",
            [](const auto &, const auto &) {
              throw cases::NumericalError("diverging", 3, 0.5, "temperature", "is bad");
            });
        add("refusing", [](const auto &, const auto &)
            { throw cases::Refusal("not for this scene"); });
        add("crashing", [](const auto &, const auto &) { std::raise(SIGSEGV); });
        add("leaving", [](const auto &, const auto &) { std::_Exit(7); });
        add("hanging", [](const auto &, const auto &) { pause_for(1000000); });
        add("busy",
            [](const auto &, const auto &)
            {
              const std::clock_t start = std::clock();
              while(std::clock() - start < CLOCKS_PER_SEC / 500)
              {
              }
            });
        add("slow", [](const auto &, const auto &) { pause_for(15); });
        add("large",
            [](const auto &, const cases::Resolution &resolution)
            {
              std::vector<char> bytes(static_cast<std::size_t>(resolution.n) << 20);
              for(std::size_t i = 0; i < bytes.size(); i += 4096)
                bytes[i] = 1;
              std::fputs(bytes[12345] == 7 ? "seven\n" : "noise\n", stdout);
            });
      }

      void add(const std::string &name, const FakeMethod::Act &act)
      {
        methods[name] = std::make_unique<FakeMethod>(
            name,
            [act, this](const cases::Scene &scene, const cases::Resolution &resolution)
            {
              tests::append_line(scratch.path("started"),
                                 fmt::format("{} n={} seed={}", scene.name, resolution.n,
                                             resolution.seed));
              act(scene, resolution);
            });
      }

      MatrixResult run(const Matrix &matrix)
      {
        return run_matrix(
            matrix, options,
            [this](const std::string &name)
            {
              if(name == "wrong")
                throw cases::InputError("there is no case 'wrong'");
              cases::Case c = tests::slab_case(name);
              c.text += case_text;
              return c;
            },
            [this](const std::string &name) -> const cases::Method &
            { return *methods.at(name); });
      }

      static Matrix matrix_of(const std::vector<std::string> &methods,
                              const std::vector<int> &resolutions,
                              const std::vector<std::string> &cases = {"x"})
      {
        return {"test", "A test", "",
                false,  600,      {{cases, methods, resolutions, {}, {1}, {1}}}};
      }

      std::size_t starts() const
      {
        return tests::lines_of(scratch.path("started")).size();
      }

      ScratchDirectory scratch;
      RunnerOptions options;
      std::string case_text;
      std::map<std::string, std::unique_ptr<FakeMethod>> methods;
    };

    TEST_F(RunnerTest, RunsAMatrixAndStoresEverything)
    {
      const MatrixResult result = run(matrix_of({"good"}, {20, 40, 80, 160}, {"x", "y"}));
      EXPECT_TRUE(result.passed);
      EXPECT_EQ(result.title, "A test");
      ASSERT_EQ(result.runs.size(), 8u);
      ASSERT_EQ(result.cases.size(), 2u);
      for(int i = 0; i < 8; ++i)
      {
        EXPECT_EQ(result.runs[i].case_name, i < 4 ? "x" : "y");
        EXPECT_EQ(result.runs[i].status, RunStatus::finished);
        EXPECT_NEAR(result.runs[i].quantities.at("front_rms"), 0.1 / result.runs[i].n,
                    1e-12);
      }
      EXPECT_EQ(result.runs[3].n, 160) << "in the matrix's order, not that of execution";
      for(const char *file :
          {"matrix.json", "summary.json", "cases/x.json", "cases/y.json",
           "runs/x/good/n=20/run.json", "runs/y/good/n=160/run.json"})
        EXPECT_TRUE(std::filesystem::exists(scratch.path("out/") + file)) << file;
      EXPECT_FALSE(std::filesystem::exists(scratch.path("out/runs/x/good/n=20/run.log")));
      EXPECT_EQ(load_matrix_result(options.directory).runs.size(), 8u);
    }

    TEST_F(RunnerTest, OneFailedRunNeverStopsTheOthers)
    {
      Matrix matrix = matrix_of(
          {"diverging", "refusing", "crashing", "leaving", "hanging", "good"}, {20, 40});
      matrix.time_limit = 2;
      const MatrixResult result = run(matrix);
      ASSERT_EQ(result.runs.size(), 12u);
      const auto at = [&](int i) { return result.runs[2 * i]; };
      EXPECT_EQ(at(0).status, RunStatus::failed);
      EXPECT_EQ(at(0).message, "diverging, step 3, t = 0.5: temperature is bad");
      EXPECT_EQ(at(1).status, RunStatus::refused);
      EXPECT_EQ(at(1).message, "not for this scene");
      EXPECT_EQ(at(2).status, RunStatus::failed);
      EXPECT_EQ(at(2).message, "crashing crashed (Segmentation fault)");
      EXPECT_EQ(at(3).status, RunStatus::failed);
      EXPECT_EQ(at(3).message, "leaving ended with status 7");
      EXPECT_EQ(at(4).status, RunStatus::failed);
      EXPECT_EQ(at(4).message, "hanging took longer than its time limit of 2 s");
      EXPECT_EQ(at(5).status, RunStatus::finished);
      EXPECT_EQ(result.omissions.size(), 10u);
      EXPECT_FALSE(result.passed);
      for(const RunRecord &record : result.runs)
        EXPECT_FALSE(record.provenance.at("case_hash").empty());
    }

    TEST_F(RunnerTest, KeepsWhatWasMadeAndRepeatsOnlyWhatTheMachineMayHaveSpoilt)
    {
      Matrix matrix = matrix_of({"good", "diverging", "refusing", "crashing"}, {20});
      run(matrix);
      EXPECT_EQ(starts(), 4u);
      run(matrix);
      EXPECT_EQ(starts(), 5u) << "the crash alone";
      matrix.blocks[0].resolutions = {20, 40};
      matrix.blocks[0].methods = {"good"};
      const MatrixResult result = run(matrix);
      EXPECT_EQ(starts(), 6u);
      EXPECT_EQ(result.runs.size(), 2u);
    }

    TEST_F(RunnerTest, RunsAgainWhenTheCaseOrTheProgramHasChanged)
    {
      const Matrix matrix = matrix_of({"good"}, {20, 40});
      run(matrix);
      case_text = " # changed";
      run(matrix);
      EXPECT_EQ(starts(), 4u);
      options.program_version = "2";
      run(matrix);
      EXPECT_EQ(starts(), 6u);
      options.program_hash = "another build";
      run(matrix);
      EXPECT_EQ(starts(), 8u);
      run(matrix);
      EXPECT_EQ(starts(), 8u);
    }

    TEST_F(RunnerTest, MakesADamagedRecordAnew)
    {
      const Matrix matrix = matrix_of({"good"}, {20});
      run(matrix);
      write_atomically(scratch.path("out/runs/x/good/n=20/run.json"), "{\"case\": ");
      EXPECT_TRUE(run(matrix).passed);
      EXPECT_EQ(starts(), 2u);
    }

    TEST_F(RunnerTest, MeasuresTheMemoryOfEachRunAndKeepsItsOutput)
    {
      const MatrixResult result = run(matrix_of({"large"}, {100, 300}));
      const double difference
          = result.runs[1].peak_memory_mb - result.runs[0].peak_memory_mb;
      EXPECT_NEAR(difference, 200, 4);
      EXPECT_EQ(tests::text_of(scratch.path("out/runs/x/large/n=300/run.log")),
                "noise\n");
    }

    TEST_F(RunnerTest, RejectsABadCaseBeforeAnyRun)
    {
      EXPECT_THROW(run(matrix_of({"good"}, {20}, {"x", "wrong"})), cases::InputError);
      EXPECT_THROW(run(matrix_of({"good"}, {20}, {"x", "folder/x.prm"})),
                   cases::InputError);
      EXPECT_EQ(starts(), 0u);
    }

    /** Run a matrix in so many processes at once, and wait for all. */
    void run_in_processes(int count, const std::function<void()> &run)
    {
      std::vector<pid_t> processes;
      for(int i = 0; i < count; ++i)
      {
        processes.push_back(fork());
        if(processes.back() == 0)
        {
          run();
          _exit(0);
        }
      }
      for(const pid_t process : processes)
      {
        int status = 0;
        waitpid(process, &status, 0);
        EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
      }
    }

    /** A summary without what differs between calls. */
    std::string summary_in(const std::string &directory)
    {
      nlohmann::json summary = read_json(directory + "/summary.json");
      summary.erase("date");
      return summary.dump();
    }

    TEST_F(RunnerTest, SharesTheWorkWithOtherProcesses)
    {
      const Matrix matrix
          = matrix_of({"slow", "good", "diverging"}, {10, 20, 30, 40, 50}, {"x", "y"});
      options.jobs = 1;
      options.directory = scratch.path("alone");
      run(matrix);
      EXPECT_EQ(starts(), 30u);
      for(const int processes : {2, 4})
      {
        std::filesystem::remove(scratch.path("started"));
        options.directory = scratch.path(fmt::format("by {}", processes));
        run_in_processes(processes, [&] { run(matrix); });
        EXPECT_EQ(starts(), 30u) << "each run once";
        const auto log = tests::lines_of(options.directory + "/runs.log");
        EXPECT_EQ(log.size(), 30u);
        std::set<std::string> makers;
        for(const std::string &line : log)
          makers.insert(line.substr(0, line.find("  x")).substr(0, line.find("  y")));
        EXPECT_GT(makers.size(), 1u) << "more than one process took part";
        EXPECT_EQ(summary_in(options.directory), summary_in(scratch.path("alone")));
      }
    }

    /** A process that holds the claim of a run until it is killed. */
    pid_t claim_elsewhere(const std::string &path)
    {
      const pid_t other = fork();
      if(other == 0)
      {
        std::filesystem::create_directories(std::filesystem::path(path).parent_path());
        const auto claim = RunClaim::take(path, 1);
        pause_for(100000);
        _exit(0);
      }
      while(!std::filesystem::exists(path))
        pause_for(1);
      return other;
    }

    TEST_F(RunnerTest, WaitsForARunOfAnotherProcessAndTakesItOverWhenThatDies)
    {
      const pid_t other = claim_elsewhere(scratch.path("out/runs/x/good/n=20/claim"));
      const pid_t runner = fork();
      if(runner == 0)
      {
        run(matrix_of({"good"}, {20, 40}));
        _exit(0);
      }
      while(starts() < 1)
        pause_for(1);
      pause_for(500);
      EXPECT_EQ(starts(), 1u) << "the other process's run waits";
      EXPECT_EQ(waitpid(runner, nullptr, WNOHANG), 0);
      kill(other, SIGKILL);
      // Dead but not waited for, it is no holder any more.
      int status = 0;
      waitpid(runner, &status, 0);
      EXPECT_EQ(status, 0);
      EXPECT_EQ(starts(), 2u);
      waitpid(other, nullptr, 0);
      EXPECT_TRUE(load_matrix_result(options.directory).passed);
    }

    TEST_F(RunnerTest, TakesOverAClaimOfAnotherMachineOnlyAfterALongTime)
    {
      const std::string claim = scratch.path("out/runs/x/good/n=20/claim");
      write_atomically(claim, "another-machine 7 boot:1\n");
      Matrix matrix = matrix_of({"good"}, {20});
      matrix.time_limit = 0.5;
      const auto start = std::chrono::steady_clock::now();
      EXPECT_TRUE(run(matrix).passed);
      const std::chrono::duration<double> waited
          = std::chrono::steady_clock::now() - start;
      EXPECT_GE(waited.count(), 0.9) << "twice the time limit";
      EXPECT_EQ(starts(), 1u);
      EXPECT_FALSE(std::filesystem::exists(claim));
      write_atomically(claim, "another-machine 7 boot:1\n");
      EXPECT_TRUE(RunClaim::held(claim, 1000));
      EXPECT_FALSE(RunClaim::take(claim, 1000));
      write_atomically(claim,
                       fmt::format("{} 999999999 boot:1\n", ClaimHolder::self().host));
      EXPECT_FALSE(RunClaim::held(claim, 1000)) << "of this machine, where it is not";
    }

    // Many take over one stale claim at once: one of them gets it.
    TEST_F(RunnerTest, AStaleClaimIsTakenOverByOne)
    {
      for(int round = 0; round < 20; ++round)
      {
        const std::string claim = scratch.path(fmt::format("{}/claim", round));
        write_atomically(claim,
                         fmt::format("{} 999999999 boot:1\n", ClaimHolder::self().host));
        run_in_processes(4,
                         [&]
                         {
                           const auto taken = RunClaim::take(claim, 1000);
                           if(taken)
                             tests::append_line(scratch.path("taken"), claim);
                           // Held until all have tried.
                           const std::string tried = claim + ".tried";
                           tests::append_line(tried, "once");
                           while(tests::lines_of(tried).size() < 4)
                             pause_for(1);
                         });
      }
      EXPECT_EQ(tests::lines_of(scratch.path("taken")).size(), 20u);
    }

    TEST_F(RunnerTest, MatricesShareTheRecordsOfTheSameRuns)
    {
      options.shared = scratch.path("shared");
      run(matrix_of({"good", "crashing"}, {20, 40}));
      EXPECT_EQ(starts(), 4u);
      options.directory = scratch.path("other");
      const MatrixResult result
          = run(matrix_of({"good", "crashing"}, {20, 40, 80}, {"x", "y"}));
      EXPECT_EQ(starts(), 4u + 12 - 2) << "two good ones are taken over";
      EXPECT_EQ(result.runs.size(), 12u);
      options.directory = scratch.path("third");
      case_text = " # changed";
      run(matrix_of({"good"}, {20}));
      EXPECT_EQ(starts(), 15u);
    }

    TEST_F(RunnerTest, TimesCarefullyInTurnAndGoesOnWhereItStopped)
    {
      Matrix matrix = matrix_of({"busy", "diverging"}, {20, 40});
      matrix.careful_timing = true;
      const MatrixResult result = run(matrix);
      for(const RunRecord &record : result.runs)
      {
        EXPECT_EQ(record.times.careful, record.method == "busy");
        EXPECT_EQ(settled(record.times), record.method == "busy");
      }
      const auto lines = tests::lines_of(scratch.path("started"));
      const auto of = [&](const char *line) { return std::ranges::count(lines, line); };
      EXPECT_GE(of("x n=20 seed=1"), 1 + 2 * 5);
      // A round is one repeat of each, of a solution that warms up and one that counts.
      const std::size_t rounds_from = 4;
      for(std::size_t i = rounds_from; i + 2 < rounds_from + 20; i += 2)
      {
        EXPECT_EQ(lines[i], lines[i + 1]);
        EXPECT_NE(lines[i + 1], lines[i + 2]);
      }
      const auto before = starts();
      EXPECT_TRUE(settled(run(matrix).runs[0].times));
      EXPECT_EQ(starts(), before) << "settled ones are not timed again";
    }

    TEST_F(RunnerTest, MakesOneRunOfAPlan)
    {
      const Matrix matrix = matrix_of({"good"}, {20, 40, 80});
      const auto make = [&](const std::string &which)
      {
        options.only = which;
        make_one_run(
            matrix, options,
            [](const std::string &name) { return tests::slab_case(name); },
            [this](const std::string &name) -> const cases::Method &
            { return *methods.at(name); });
      };
      make("x/good/n=40");
      EXPECT_EQ(starts(), 1u);
      make("2");
      EXPECT_EQ(starts(), 1u) << "it is made";
      make("3");
      EXPECT_EQ(starts(), 2u);
      EXPECT_THROW(make("4"), cases::InputError);
      EXPECT_THROW(make("x/good/n=41"), cases::InputError);
      const MatrixResult result = load_matrix_result(options.directory);
      EXPECT_EQ(result.runs[0].message, "it has not been run yet");
      EXPECT_EQ(result.runs[2].status, RunStatus::finished);
      options.only.clear();
      EXPECT_TRUE(run(matrix).passed);
      EXPECT_EQ(starts(), 3u);
    }

    TEST_F(RunnerTest, HoldsItsDirectoryUntilAllIsConcluded)
    {
      int concluded = 0;
      options.conclude = [&](MatrixResult &result)
      {
        ++concluded;
        EXPECT_TRUE(result.passed);
        // A child has no lock of its parent's: it is as any other process.
        const pid_t other = fork();
        if(other == 0)
        {
          try
          {
            const DirectoryLock lock(options.directory);
          }
          catch(const cases::OutputError &)
          {
            _exit(7);
          }
          _exit(0);
        }
        int status = 0;
        waitpid(other, &status, 0);
        EXPECT_EQ(WEXITSTATUS(status), 7) << "held";
      };
      run(matrix_of({"good"}, {20}));
      EXPECT_EQ(concluded, 1);
    }

    TEST_F(RunnerTest, SaysWhichRunsAreMissingInAMatrixThatWasKilled)
    {
      run(matrix_of({"good"}, {20, 40}));
      std::filesystem::remove(scratch.path("out/runs/x/good/n=40/run.json"));
      const MatrixResult result = load_matrix_result(options.directory);
      EXPECT_EQ(result.runs.size(), 2u);
      EXPECT_FALSE(result.passed);
      EXPECT_EQ(result.omissions.at(0),
                "x, good, n = 40: failed: it has not been run yet");
    }

    /** Records in the output, by path. */
    std::map<std::string, std::string> records_in(const std::string &directory)
    {
      std::map<std::string, std::string> records;
      std::error_code none;
      for(const auto &entry :
          std::filesystem::recursive_directory_iterator(directory + "/runs", none))
        if(entry.path().filename() == "run.json")
          records[entry.path()] = tests::text_of(entry.path());
      return records;
    }

    // Kill the runner at random moments until it comes through: every record that was
    // there stays to the byte, and no run of which there was a record starts again.
    TEST_F(RunnerTest, LosesAndRepeatsNothingWhenItIsKilled)
    {
      std::vector<int> resolutions;
      for(int n = 1; n <= 20; ++n)
        resolutions.push_back(n);
      const Matrix matrix = matrix_of({"slow"}, resolutions, {"x", "y"});
      std::mt19937 generator(4);
      std::uniform_int_distribution<int> moment(5, 120);
      std::map<std::string, std::string> before;
      std::map<std::string, long> starts_before;
      const auto starts_of = [this](const std::string &path)
      {
        const std::string case_name = path.find("/x/") != std::string::npos ? "x" : "y";
        const std::size_t n_at = path.find("n=");
        const std::string line = fmt::format(
            "{} {} seed=1", case_name, path.substr(n_at, path.find('/', n_at) - n_at));
        const auto lines = tests::lines_of(scratch.path("started"));
        return std::ranges::count(lines, line);
      };
      int kills = 0;
      for(bool through = false; !through && kills < 200;)
      {
        const pid_t runner = fork();
        if(runner == 0)
        {
          run(matrix);
          _exit(0);
        }
        // Longer and longer, so that a slow machine comes through as well.
        pause_for(moment(generator) + 2 * kills);
        kill(runner, SIGKILL);
        int status = 0;
        waitpid(runner, &status, 0);
        through = WIFEXITED(status);
        kills += !through;
        pause_for(100); // its children die a moment after it
        const auto now = records_in(options.directory);
        for(const auto &[path, text] : before)
        {
          ASSERT_EQ(now.count(path), 1u) << path << " was lost";
          ASSERT_EQ(now.at(path), text) << path << " was made again";
          ASSERT_EQ(starts_of(path), starts_before[path]) << path << " was repeated";
        }
        for(const auto &[path, text] : now)
          if(before.count(path) == 0)
            starts_before[path] = starts_of(path);
        before = now;
      }
      EXPECT_GE(kills, 2) << "the test must have killed something";
      const MatrixResult result = load_matrix_result(options.directory);
      EXPECT_EQ(result.runs.size(), 40u);
      EXPECT_TRUE(result.passed);
      const std::string killed = summary_in(options.directory);
      options.directory = scratch.path("straight");
      run(matrix);
      EXPECT_EQ(killed, summary_in(options.directory));
    }

    TEST(MatrixResult, SaysWhatIsWrongWithItsFiles)
    {
      const tests::ScratchDirectory directory;
      EXPECT_THROW(load_matrix_result(directory.path()), cases::OutputError);
      write_atomically(directory.path("matrix.json"), "{}");
      EXPECT_THROW(load_matrix_result(directory.path()), cases::OutputError);
    }

    TEST(ChildProcess, DiesWithItsParent)
    {
      const ScratchDirectory scratch;
      const std::string pulse = scratch.path("pulse");
      const pid_t parent = fork();
      if(parent == 0)
      {
        const ChildProcess child(
            [&]
            {
              for(;;)
              {
                tests::append_line(pulse, "alive");
                pause_for(2);
              }
            },
            scratch.path("log"));
        pause_for(100000);
        _exit(0);
      }
      while(tests::lines_of(pulse).size() < 3)
        pause_for(1);
      kill(parent, SIGKILL);
      waitpid(parent, nullptr, 0);
      pause_for(20);
      const auto lines = tests::lines_of(pulse).size();
      pause_for(50);
      EXPECT_EQ(tests::lines_of(pulse).size(), lines);
    }

    TEST(ChildProcess, TellsHowItEnded)
    {
      const ScratchDirectory scratch;
      const auto problem_of = [&](const std::function<void()> &function)
      {
        ChildProcess child(function, scratch.path("log"));
        while(!child.ended())
          pause_for(1);
        return child.end().problem();
      };
      EXPECT_EQ(problem_of([] {}), "");
      EXPECT_EQ(problem_of([] { throw std::runtime_error("why"); }),
                "ended with status 1");
      EXPECT_EQ(tests::text_of(scratch.path("log")), "why");
      EXPECT_EQ(problem_of([] { std::abort(); }), "crashed (Aborted)");
      EXPECT_EQ(problem_of([] { std::raise(SIGKILL); }),
                "was killed, perhaps because memory ran out");
    }
  } // namespace
} // namespace meltfront::verification
