#include <verification/judge/baseline.h>
#include <verification/judge/criteria.h>
#include <verification/record/json_values.h>
#include <verification/record/temporary_directory.h>
#include <verification/run/tests/fakes.h>

#include <gtest/gtest.h>

namespace meltfront::verification
{
  namespace
  {
    RunRecord run_at(int n, double front_rms, long steps, std::uint64_t seed = 1)
    {
      RunRecord run;
      run.case_name = "slab";
      run.method = run.label = "sph";
      run.n = n;
      run.seed = seed;
      run.status = RunStatus::finished;
      run.quantities["front_rms"] = front_rms;
      run.quantities["budget_defect"] = 1e-15;
      run.cost.steps = steps;
      run.cost.stepping_cpu = 0.25;
      return run;
    }

    MatrixResult result_of(std::vector<RunRecord> runs, double bound = 0.1)
    {
      cases::Case c = tests::slab_case("slab");
      cases::Criterion criterion;
      criterion.method = "sph";
      criterion.quantity = "front_rms";
      criterion.statistic = cases::Statistic::value;
      criterion.n = 40;
      criterion.upper = bound;
      c.criteria = {criterion};
      MatrixResult result;
      result.name = "test";
      result.program_version = "1";
      result.cases = {StoredCase{c}};
      result.runs = std::move(runs);
      evaluate(result);
      return result;
    }

    BaselineComparison compared(const MatrixResult &was, const MatrixResult &now)
    {
      return compare_with_baseline(now, baseline_of(was));
    }

    TEST(Baseline, ReadsBackWhatItWroteAndWritesTheSameBytes)
    {
      const tests::ScratchDirectory directory;
      const std::string path = directory.path("test.json");
      const MatrixResult result
          = result_of({run_at(40, 1.23456789e-3, 100), run_at(80, 5e-4, 400)});
      write_baseline(path, baseline_of(result));
      const std::string text = tests::text_of(path);
      EXPECT_NE(text.find("\"slab/sph/n=40\": {\"status\": \"finished\", "
                          "\"cpu_seconds\": 0.25, \"budget_defect\": 1e-15, "
                          "\"capped_steps\": 0, \"front_rms\": 0.001235"),
                std::string::npos)
          << text;
      EXPECT_NE(text.find("[\"slab\", \"sph\", \"front_rms at n=40\", 0.001235, true]"),
                std::string::npos)
          << text;
      const Baseline read = read_baseline(path);
      write_baseline(path, read);
      EXPECT_EQ(tests::text_of(path), text);
      EXPECT_TRUE(compare_with_baseline(result, read).flags.empty());
      write_atomically(path, "{}");
      EXPECT_THROW(read_baseline(path), cases::OutputError);
    }

    TEST(Baseline, FlagsErrorsAndWorkThatGrew)
    {
      const MatrixResult was = result_of({run_at(40, 1e-3, 100), run_at(80, 5e-4, 400)});
      EXPECT_TRUE(
          compared(was, result_of({run_at(40, 1.09e-3, 100), run_at(80, 5.4e-4, 430)}))
              .flags.empty())
          << "by less than a tenth";
      const BaselineComparison worse
          = compared(was, result_of({run_at(40, 1.2e-3, 100), run_at(80, 5e-4, 500)}));
      ASSERT_EQ(worse.flags.size(), 2u);
      EXPECT_EQ(worse.flags[0],
                "GREW     slab/sph/n=40 front_rms: 0.001 -> 0.0012 (+20 %)");
      EXPECT_EQ(worse.flags[1], "GREW     slab/sph/n=80 steps: 400 -> 500 (+25 %)");
      const BaselineComparison better
          = compared(was, result_of({run_at(40, 1e-4, 100), run_at(80, 5e-4, 400)}));
      EXPECT_TRUE(better.flags.empty());
      EXPECT_EQ(better.notes.size(), 1u);
    }

    TEST(Baseline, RoundOffMayGrow)
    {
      MatrixResult now = result_of({run_at(40, 1e-3, 100)});
      now.runs[0].quantities["budget_defect"] = 3e-15;
      EXPECT_TRUE(compared(result_of({run_at(40, 1e-3, 100)}), now).flags.empty());
      now.runs[0].quantities["budget_defect"] = 3e-9;
      EXPECT_EQ(compared(result_of({run_at(40, 1e-3, 100)}), now).flags.size(), 1u);
    }

    TEST(Baseline, FlagsWhatIsMissingOrFails)
    {
      const MatrixResult was = result_of({run_at(40, 1e-3, 100), run_at(80, 5e-4, 400)});
      const auto without_run = compared(was, result_of({run_at(40, 1e-3, 100)}));
      ASSERT_EQ(without_run.flags.size(), 1u);
      EXPECT_EQ(without_run.flags[0], "MISSING  slab/sph/n=80");
      EXPECT_EQ(compared(was, result_of({run_at(80, 5e-4, 400)})).flags.size(), 2u)
          << "the run and the criterion on it";

      const auto fails = compared(
          was, result_of({run_at(40, 1e-3, 100), run_at(80, 5e-4, 400)}, 1e-4));
      ASSERT_EQ(fails.flags.size(), 1u);
      EXPECT_EQ(fails.flags[0],
                "FAILS    slab: sph: front_rms at n=40 = 0.001, held with 0.001");

      MatrixResult without_criteria = was;
      without_criteria.criteria.clear();
      EXPECT_EQ(
          compared(without_criteria,
                   result_of({run_at(40, 1e-3, 100), run_at(80, 5e-4, 400)}, 1e-4))
              .flags,
          std::vector<std::string>{"FAILS    slab: sph: front_rms at n=40 = 0.001, new"});
      // What did not hold then need not now.
      const MatrixResult red
          = result_of({run_at(40, 1e-3, 100), run_at(80, 5e-4, 400)}, 1e-4);
      EXPECT_TRUE(compared(red, red).flags.empty());

      RunRecord failed = run_at(80, 5e-4, 400);
      failed.status = RunStatus::failed;
      const auto worse = compared(was, result_of({run_at(40, 1e-3, 100), failed}));
      ASSERT_EQ(worse.flags.size(), 1u);
      EXPECT_EQ(worse.flags[0], "WORSE    slab/sph/n=80: failed, was finished");
    }

    TEST(Baseline, TakesTheWorstOfSeeds)
    {
      const Baseline baseline
          = baseline_of(result_of({run_at(40, -3e-3, 100), run_at(40, 1e-3, 90, 2)}));
      ASSERT_EQ(baseline.runs.size(), 1u);
      const BaselineRuns &runs = baseline.runs.at("slab/sph/n=40");
      EXPECT_EQ(runs.figures.at("front_rms"), 3e-3);
      EXPECT_EQ(runs.figures.at("steps"), 100);
      EXPECT_EQ(runs.cpu_seconds, 0.5);
    }
  } // namespace
} // namespace meltfront::verification
