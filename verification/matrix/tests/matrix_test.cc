#include <verification/matrix/matrix.h>
#include <verification/matrix/progress.h>
#include <verification/run/tests/fakes.h>

#include <gtest/gtest.h>

namespace meltfront::verification
{
  namespace
  {
    const tests::FakeMethod fake_a("a"), fake_b("b");

    const cases::Method &lookup(const std::string &name)
    {
      if(name == "a")
        return fake_a;
      if(name == "b")
        return fake_b;
      throw cases::InputError("there is no method '" + name + "'");
    }

    std::vector<std::string> files(const Matrix &matrix)
    {
      std::vector<std::string> names;
      for(const PlannedRun &run : plan_runs(matrix, lookup))
        names.push_back(run.file());
      return names;
    }

    Matrix matrix_of(std::vector<MatrixBlock> blocks)
    {
      return {"test", "", "", false, 600, std::move(blocks)};
    }

    TEST(PlanRuns, GoesCaseByCaseThroughAllBlocks)
    {
      const Matrix matrix = matrix_of({{{"x", "y"}, {"a"}, {20, 40}, {}, {1}, {1}},
                                       {{"y", "x"}, {"b"}, {10}, {}, {1, 2}, {1}}});
      EXPECT_EQ(files(matrix),
                (std::vector<std::string>{
                    "runs/x/a/n=20/run.json", "runs/x/a/n=40/run.json",
                    "runs/x/b/n=10/run.json", "runs/x/b/n=10,seed=2/run.json",
                    "runs/y/a/n=20/run.json", "runs/y/a/n=40/run.json",
                    "runs/y/b/n=10/run.json", "runs/y/b/n=10,seed=2/run.json"}));
    }

    TEST(PlanRuns, CombinesTheOptionsOfEachMethod)
    {
      const Matrix matrix
          = matrix_of({{{"x"},
                        {"a", "b"},
                        {20},
                        {{"a", "step_factor", {"0.9", "1.1"}}, {"a", "scheme", {"rkl2"}}},
                        {1},
                        {1}}});
      EXPECT_EQ(files(matrix), (std::vector<std::string>{
                                   "runs/x/a[scheme=rkl2,step_factor=0.9]/n=20/run.json",
                                   "runs/x/a[scheme=rkl2,step_factor=1.1]/n=20/run.json",
                                   "runs/x/b/n=20/run.json"}));
      const auto runs = plan_runs(matrix, lookup);
      EXPECT_EQ(runs[1].resolution.options.get_double("step_factor"), 1.1);
      EXPECT_EQ(runs[1].resolution.options.get_string("scheme"), "rkl2");
      EXPECT_EQ(runs[2].resolution.options.get_double("step_factor"), 0.5);
    }

    TEST(PlanRuns, PlansTheSameRunOnce)
    {
      const Matrix matrix = matrix_of({{{"x"}, {"a"}, {20, 20}, {}, {1}, {1, 2}},
                                       {{"x"}, {"a"}, {20}, {}, {1}, {1}}});
      EXPECT_EQ(files(matrix),
                (std::vector<std::string>{"runs/x/a/n=20/run.json",
                                          "runs/x/a[threads=2]/n=20/run.json"}));
    }

    TEST(PlanRuns, RejectsWhatCannotBeRun)
    {
      const auto rejected = [](const MatrixBlock &block)
      { EXPECT_THROW(plan_runs(matrix_of({block}), lookup), cases::InputError); };
      rejected({{"x"}, {"c"}, {20}, {}, {1}, {1}});
      rejected({{"x"}, {"a"}, {0}, {}, {1}, {1}});
      rejected({{"x"}, {"a"}, {20}, {}, {1}, {0}});
      rejected({{"x"}, {"a"}, {}, {}, {1}, {1}});
      rejected({{}, {"a"}, {20}, {}, {1}, {1}});
      rejected({{"x"}, {"a"}, {20}, {{"b", "step_factor", {"1"}}}, {1}, {1}});
      rejected({{"x"}, {"a"}, {20}, {{"a", "stepfactor", {"1"}}}, {1}, {1}});
      rejected({{"x"}, {"a"}, {20}, {{"a", "step_factor", {"3"}}}, {1}, {1}});
      rejected({{"x"}, {"a"}, {20}, {{"a", "step_factor", {}}}, {1}, {1}});
    }

    TEST(ShortCaseName, TakesTheNameFromAPath)
    {
      EXPECT_EQ(short_case_name("hard-stefan-0.01"), "hard-stefan-0.01");
      EXPECT_EQ(short_case_name("folder/hard-stefan-0.01.prm"), "hard-stefan-0.01");
      EXPECT_EQ(short_case_name("x.prm"), "x");
    }

    TEST(TimeLeftText, ReadsLikeAWatch)
    {
      EXPECT_EQ(time_left_text(7.6), "8 s");
      EXPECT_EQ(time_left_text(200), "3 min 20 s");
      EXPECT_EQ(time_left_text(7500), "2 h 5 min");
    }

    TEST(Progress, PrintsALineForEachRunWhereThereIsNoTerminal)
    {
      const tests::ScratchDirectory directory;
      std::FILE *out = std::fopen(directory.path("out").c_str(), "w");
      {
        const RunKind a{"x", "a", "a", 20}, b{"x", "b", "b", 20};
        Progress progress(out, {a, b}, 3, 1);
        progress.show_running("x a n=20");
        progress.run_ended(a, 0.1, "x a n=20", "finished in 0.10 s", true);
        progress.run_ended(b, 0.1, "x b n=20", "failed: no reason", false);
      }
      std::fclose(out);
      const auto lines = tests::lines_of(directory.path("out"));
      ASSERT_EQ(lines.size(), 3u);
      EXPECT_EQ(lines[0], "3 runs were finished before and are kept");
      EXPECT_EQ(lines[1].substr(0, 35), "[1/2] x a n=20: finished in 0.10 s,");
      EXPECT_EQ(lines[2], "[2/2] x b n=20: failed: no reason");
    }

    TEST(Progress, TellsOfRefusedRunsOnceForEachReason)
    {
      const tests::ScratchDirectory directory;
      std::FILE *out = std::fopen(directory.path("out").c_str(), "w");
      {
        const RunKind a{"x", "a", "a", 20}, b{"y", "a", "a", 20}, c{"x", "b", "b", 20};
        Progress progress(out, {a, b, c}, 0, 1);
        progress.run_refused(a, "a takes no slab");
        progress.run_refused(b, "a takes no slab");
        progress.run_ended(c, 0.1, "x b n=20", "finished in 0.10 s", true);
      }
      std::fclose(out);
      const auto lines = tests::lines_of(directory.path("out"));
      ASSERT_EQ(lines.size(), 2u);
      EXPECT_EQ(lines[0], "[3/3] x b n=20: finished in 0.10 s");
      EXPECT_EQ(lines[1], "Refused: a takes no slab (2 runs of x, y)");
    }
  } // namespace
} // namespace meltfront::verification
