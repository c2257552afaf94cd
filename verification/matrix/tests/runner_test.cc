#include <verification/matrix/matrix_files.h>
#include <verification/matrix/tests/runner_fixture.h>
#include <verification/record/json_values.h>
#include <verification/run/child_process.h>

#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <set>

namespace meltfront::verification
{
  namespace
  {
    using tests::pause_for;
    using tests::RunnerTest;
    using tests::ScratchDirectory;

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
      EXPECT_EQ(tests::text_of(scratch.path("out/runs/x/large/n=300/run.log")),
                "noise\n");
#ifdef MELTFRONT_SANITIZE
      GTEST_SKIP() << "sanitizers' own memory is not that of the run";
#endif
      const double difference
          = result.runs[1].peak_memory_mb - result.runs[0].peak_memory_mb;
      EXPECT_NEAR(difference, 200, 4);
    }

    TEST_F(RunnerTest, RejectsABadCaseBeforeAnyRun)
    {
      EXPECT_THROW(run(matrix_of({"good"}, {20}, {"x", "wrong"})), cases::InputError);
      EXPECT_THROW(run(matrix_of({"good"}, {20}, {"x", "folder/x.prm"})),
                   cases::InputError);
      EXPECT_EQ(starts(), 0u);
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
