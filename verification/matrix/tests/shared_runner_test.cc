#include <verification/matrix/directory_lock.h>
#include <verification/matrix/matrix_files.h>
#include <verification/matrix/run_claim.h>
#include <verification/matrix/tests/runner_fixture.h>
#include <verification/record/json_values.h>

#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <functional>
#include <random>
#include <set>

namespace meltfront::verification
{
  namespace
  {
    using tests::pause_for;
    using tests::RunnerTest;

    /** Several processes on one folder. */
    class SharedRunnerTest : public RunnerTest
    {
    };

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

    TEST_F(SharedRunnerTest, SharesTheWorkWithOtherProcesses)
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

    TEST_F(SharedRunnerTest, WaitsForARunOfAnotherProcessAndTakesItOverWhenThatDies)
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

    TEST_F(SharedRunnerTest, TakesOverAClaimOfAnotherMachineOnlyAfterALongTime)
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
    TEST_F(SharedRunnerTest, AStaleClaimIsTakenOverByOne)
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

    TEST_F(SharedRunnerTest, MatricesShareTheRecordsOfTheSameRuns)
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

    TEST_F(SharedRunnerTest, HoldsItsDirectoryUntilAllIsConcluded)
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

    TEST_F(SharedRunnerTest, SaysWhichRunsAreMissingInAMatrixThatWasKilled)
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
    TEST_F(SharedRunnerTest, LosesAndRepeatsNothingWhenItIsKilled)
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
        pause_for(moment(generator) + kills * kills / 4);
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
  } // namespace
} // namespace meltfront::verification
