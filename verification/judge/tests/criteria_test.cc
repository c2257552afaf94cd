#include <verification/judge/criteria.h>
#include <verification/matrix/matrix_files.h>
#include <verification/record/json_values.h>
#include <verification/record/label.h>
#include <verification/run/tests/fakes.h>

#include <gtest/gtest.h>

namespace meltfront::verification
{
  namespace
  {
    RunRecord run_at(int n, double front_rms, const std::string &label = "sph")
    {
      RunRecord run;
      run.case_name = "slab";
      run.method = run.label = label;
      run.n = n;
      run.status = RunStatus::finished;
      run.description.spacing = 1. / n;
      run.quantities["front_rms"] = front_rms;
      run.cost.capped_steps = n == 80 ? 2 : 0;
      return run;
    }

    RunRecord ended(int n, RunStatus status, const std::string &message)
    {
      RunRecord run = run_at(n, 0);
      run.status = status;
      run.message = message;
      return run;
    }

    cases::Criterion criterion(cases::Statistic statistic, double lower, double upper,
                               int n = 0, const std::string &quantity = "front_rms")
    {
      cases::Criterion c;
      c.method = "sph";
      c.quantity = quantity;
      c.statistic = statistic;
      c.n = n;
      c.lower = lower;
      c.upper = upper;
      return c;
    }

    constexpr double infinity = std::numeric_limits<double>::infinity();

    /** First-order errors 0.1/n at four resolutions. */
    std::vector<RunRecord> first_order()
    {
      return {run_at(20, 0.1 / 20), run_at(40, 0.1 / 40), run_at(80, 0.1 / 80),
              run_at(160, 0.1 / 160)};
    }

    MatrixResult evaluated(std::vector<RunRecord> runs,
                           const std::vector<cases::Criterion> &criteria)
    {
      cases::Case c = tests::slab_case("slab");
      c.criteria = criteria;
      MatrixResult result;
      result.cases = {StoredCase{c}};
      result.runs = std::move(runs);
      evaluate(result);
      return result;
    }

    TEST(Criteria, JudgeAValueAnOrderAndTheWorst)
    {
      using enum cases::Statistic;
      const MatrixResult result = evaluated(
          first_order(),
          {criterion(value, -infinity, 0.1 / 40, 40),
           criterion(value, -infinity, 0.002, 40), criterion(value, 0.0024, 0.0026, 40),
           criterion(order, 0.9, infinity), criterion(order, 1.25, infinity),
           criterion(worst, -infinity, 0.005), criterion(worst, -infinity, 0.004),
           criterion(worst, -infinity, 0, 0, "capped_steps")});
      const std::vector<bool> passed{true, false, true, true, false, true, false, false};
      const std::vector<double> values{0.0025, 0.0025, 0.0025, 1, 1, 0.005, 0.005, 2};
      ASSERT_EQ(result.criteria.size(), passed.size());
      for(std::size_t i = 0; i < passed.size(); ++i)
      {
        EXPECT_EQ(result.criteria[i].passed, passed[i]) << i;
        EXPECT_NEAR(result.criteria[i].value, values[i], 1e-12) << i;
      }
      EXPECT_EQ(result.criteria[0].quantity, "front_rms at n=40");
      EXPECT_EQ(result.criteria[3].quantity, "order of front_rms");
      EXPECT_EQ(result.criteria[5].quantity, "worst front_rms");
      EXPECT_FALSE(result.passed);
      EXPECT_TRUE(result.omissions.empty());
      EXPECT_TRUE(evaluated(first_order(), {criterion(order, 0.9, 1.1)}).passed);
    }

    TEST(Criteria, CountOnlyTheRowsTheyName)
    {
      auto runs = first_order();
      runs.push_back(run_at(320, 1)); // spoils the order if it counts
      auto some = criterion(cases::Statistic::order, 0.9, 1.1);
      some.n_from = 20;
      some.n_to = 160;
      const MatrixResult result = evaluated(runs, {some});
      EXPECT_TRUE(result.criteria.at(0).passed);
      EXPECT_EQ(result.criteria.at(0).quantity, "order of front_rms over n=20..160");
    }

    TEST(Criteria, OnAnyMethodAreJudgedLabelByLabel)
    {
      auto runs = first_order();
      for(const auto &label : {"sph[jitter=0.2]", "refusing", "without"})
        runs.push_back(run_at(20, 0.5, label));
      runs[5].status = RunStatus::refused;
      runs[6].quantities.clear();
      auto any = criterion(cases::Statistic::worst, -infinity, 0.4);
      any.method = cases::any_method;
      const MatrixResult result = evaluated(runs, {any});
      ASSERT_EQ(result.criteria.size(), 2u)
          << "neither what was refused nor what measures nothing is concerned";
      EXPECT_EQ(result.criteria[0].method, "sph");
      EXPECT_TRUE(result.criteria[0].passed);
      EXPECT_EQ(result.criteria[1].method, "sph[jitter=0.2]");
      EXPECT_FALSE(result.criteria[1].passed);

      runs.push_back(ended(20, RunStatus::failed, "broke"));
      runs.back().label = "failing";
      EXPECT_TRUE(std::isnan(evaluated(runs, {any}).criteria.at(2).value));

      any.quantity = "front_max";
      const MatrixResult nothing = evaluated(first_order(), {any});
      EXPECT_TRUE(nothing.criteria.empty());
      EXPECT_EQ(nothing.omissions.at(0),
                "slab, any method: worst front_max: not judged: the matrix has no such "
                "run");
    }

    TEST(Criteria, FailWithNaNWhereARunFailed)
    {
      using enum cases::Statistic;
      auto runs = first_order();
      runs[1] = ended(40, RunStatus::failed, "temperature is not finite");
      const MatrixResult result = evaluated(
          runs, {criterion(value, -infinity, 1, 40), criterion(order, 0, infinity),
                 criterion(worst, -infinity, 1), criterion(value, -infinity, 1, 20)});
      for(const int i : {0, 1, 2})
      {
        EXPECT_TRUE(std::isnan(result.criteria.at(i).value)) << i;
        EXPECT_FALSE(result.criteria.at(i).passed) << i;
      }
      EXPECT_TRUE(result.criteria.at(3).passed);
      ASSERT_EQ(result.omissions.size(), 1u);
      EXPECT_EQ(result.omissions[0],
                "slab, sph, n = 40: failed: temperature is not finite");
    }

    TEST(Criteria, FailOnAQuantityThatIsNaNOrUnknown)
    {
      using enum cases::Statistic;
      auto runs = first_order();
      runs[3].quantities["front_rms"] = std::nan("");
      EXPECT_FALSE(evaluated(runs, {criterion(worst, -infinity, 1)}).passed);
      EXPECT_FALSE(evaluated(runs, {criterion(order, -infinity, 10)}).passed);
      EXPECT_FALSE(
          evaluated(first_order(), {criterion(worst, -infinity, 1, 0, "front_rsm")})
              .passed);
    }

    TEST(Criteria, AFailedRunSpoilsAMatrixAndARefusedOneDoesNot)
    {
      auto runs = first_order();
      runs.push_back(ended(320, RunStatus::refused, "too fine"));
      const MatrixResult refused
          = evaluated(runs, {criterion(cases::Statistic::order, 0.9, 1.1)});
      EXPECT_TRUE(refused.passed);
      EXPECT_EQ(refused.omissions.at(0), "slab, sph, n = 320: refused: too fine");
      runs.back() = ended(320, RunStatus::failed, "crashed");
      EXPECT_FALSE(evaluated(runs, {}).passed);
    }

    TEST(Criteria, AFailureThatIsKnownSpoilsNothingAndMustHappen)
    {
      const auto fails = criterion(cases::Statistic::failure, 1, 1, 40, "failure");
      const auto runs = [](RunStatus status) {
        return std::vector{run_at(20, 0.1), ended(40, status, "blew up at step 7")};
      };
      EXPECT_TRUE(evaluated(runs(RunStatus::failed), {fails}).passed);
      EXPECT_FALSE(evaluated(runs(RunStatus::finished), {fails}).passed);
      EXPECT_FALSE(evaluated(runs(RunStatus::refused), {fails}).passed);
      // A run that was killed did not see the error itself.
      auto killed = runs(RunStatus::failed);
      killed[1].provenance["ended"] = "killed";
      EXPECT_FALSE(evaluated(killed, {fails}).passed);
    }

    TEST(Criteria, AreNotJudgedWithoutSuchARunAndSaySo)
    {
      using enum cases::Statistic;
      auto other = criterion(worst, -infinity, 1);
      other.method = "fem-enthalpy";
      auto runs = first_order();
      runs.pop_back();
      const MatrixResult result = evaluated(
          runs, {criterion(value, -infinity, 1, 640), other, criterion(order, 0.9, 1.1)});
      EXPECT_TRUE(result.criteria.empty());
      ASSERT_EQ(result.omissions.size(), 3u);
      EXPECT_EQ(result.omissions[0],
                "slab, sph: front_rms at n=640: not judged: the matrix has no such run");
      EXPECT_NE(result.omissions[2].find("four resolutions"), std::string::npos);
    }

    TEST(Criteria, ConcernRunsWithoutOptionsSet)
    {
      auto runs = first_order();
      runs.push_back(run_at(40, 100, "sph[jitter=0.2]"));
      EXPECT_TRUE(
          evaluated(runs, {criterion(cases::Statistic::worst, -infinity, 1)}).passed);
    }

    TEST(Criteria, TakeTheWorstOfSeedsNeverASignedMean)
    {
      using enum cases::Statistic;
      auto runs = first_order();
      for(std::size_t i = 0; i < 4; ++i)
      {
        RunRecord second = runs[i];
        second.seed = 2;
        second.quantities["front_rms"] *= 3;
        runs.push_back(second);
      }
      const MatrixResult result
          = evaluated(runs, {criterion(value, -infinity, 1, 20), criterion(worst, 0, 1),
                             criterion(order, 0, 2)});
      EXPECT_NEAR(result.criteria.at(0).value, 0.015, 1e-12);
      EXPECT_NEAR(result.criteria.at(1).value, 0.015, 1e-12);
      EXPECT_NEAR(result.criteria.at(2).value, 1, 1e-12);

      // Their mean is nothing.
      RunRecord above = run_at(20, 0.04), below = run_at(20, -0.04);
      below.seed = 2;
      const MatrixResult opposite
          = evaluated({above, below}, {criterion(value, -0.05, 0.03, 20),
                                       criterion(value, -0.03, 0.05, 20)});
      EXPECT_EQ(opposite.criteria.at(0).value, 0.04);
      EXPECT_EQ(opposite.criteria.at(1).value, -0.04);
      EXPECT_FALSE(opposite.passed);
    }

    TEST(Criteria, AnOrderFailsWhereItsFitSaysNothing)
    {
      using enum cases::Statistic;
      // Falls with order 1 overall, and grows on the way.
      const std::vector<RunRecord> oscillating{run_at(20, 0.02), run_at(40, 0.004),
                                               run_at(80, 0.008), run_at(160, 0.001)};
      const MatrixResult result = evaluated(
          oscillating, {criterion(order, 0.5, infinity), criterion(order, -infinity, 3)});
      EXPECT_GT(result.criteria.at(0).value, 0.5);
      EXPECT_FALSE(result.criteria.at(0).passed);
      EXPECT_EQ(result.criteria.at(0).remark, "oscillating");
      EXPECT_TRUE(result.criteria.at(1).passed) << "convergence is not asked for";

      std::vector<RunRecord> stagnating = first_order(), fast = first_order();
      for(RunRecord &run : stagnating)
        run.quantities["front_rms"] += 0.003;
      for(RunRecord &run : fast)
        run.quantities["front_rms"] = std::pow(run.quantities["front_rms"], 4);
      EXPECT_EQ(
          evaluated(stagnating, {criterion(order, 0.1, infinity)}).criteria.at(0).remark,
          "stagnating");
      EXPECT_EQ(evaluated(fast, {criterion(order, 1, infinity)}).criteria.at(0).remark,
                "suspiciously fast");
    }

    TEST(Criteria, TakeTheMedianOverSeeds)
    {
      std::vector<RunRecord> runs;
      for(const double error : {9., 1., 2., 4.})
      {
        runs.push_back(run_at(20, error));
        runs.back().seed = runs.size();
      }
      const cases::Criterion middle = criterion(cases::Statistic::median, 0, 3, 20);
      const MatrixResult even = evaluated(runs, {middle});
      EXPECT_EQ(even.criteria.at(0).value, 3);
      EXPECT_EQ(even.criteria.at(0).quantity, "median front_rms at n=20");
      EXPECT_TRUE(even.passed);
      runs.erase(runs.begin() + 1);
      EXPECT_EQ(evaluated(runs, {middle}).criteria.at(0).value, 4);
      runs.push_back(ended(20, RunStatus::failed, "broke"));
      EXPECT_TRUE(std::isnan(evaluated(runs, {middle}).criteria.at(0).value));
    }

    TEST(FamilyCriteria, AreOnTheWorstMemberThatWasRun)
    {
      using enum cases::Statistic;
      MatrixResult result;
      const double slopes[] = {2, 0.5, 1, 3};
      const char *names[] = {"sink-1", "sink-2", "sink-3", "slab"};
      for(int i = 0; i < 4; ++i)
      {
        result.cases.push_back(stored_case(tests::slab_case(names[i]), "", {}));
        for(const int n : {20, 40, 80, 160})
        {
          result.runs.push_back(run_at(n, std::pow(n, -slopes[i])));
          result.runs.back().case_name = names[i];
        }
      }
      result.cases.push_back(stored_case(tests::slab_case("sink-not-run"), "", {}));
      result.family_criteria = {{"sink-*", criterion(order, 0.9, infinity)},
                                {"sink-*", criterion(order, -infinity, 2.5)},
                                {"s*", criterion(order, -infinity, 2.5)},
                                {"sunk-*", criterion(order, 0.9, infinity)}};
      evaluate(result);
      ASSERT_EQ(result.criteria.size(), 3u);
      EXPECT_EQ(result.criteria[0].case_name, "sink-2");
      EXPECT_EQ(result.criteria[0].quantity, "order of front_rms, worst of sink-*");
      EXPECT_NEAR(result.criteria[0].value, 0.5, 1e-12);
      EXPECT_FALSE(result.criteria[0].passed);
      EXPECT_EQ(result.criteria[1].case_name, "sink-1");
      EXPECT_TRUE(result.criteria[1].passed);
      EXPECT_EQ(result.criteria[2].case_name, "slab");
      EXPECT_FALSE(result.criteria[2].passed);
      ASSERT_EQ(result.omissions.size(), 1u);
      EXPECT_NE(result.omissions[0].find("sunk-*"), std::string::npos);

      result.runs[2].quantities["front_rms"] = std::numeric_limits<double>::quiet_NaN();
      evaluate(result);
      EXPECT_EQ(result.criteria[0].case_name, "sink-1");
      EXPECT_FALSE(result.criteria[0].passed);
      EXPECT_FALSE(result.passed);
    }

    TEST(FamilyCriteria, FamiliesAreNamesWithStars)
    {
      EXPECT_TRUE(in_family("sink-*", "sink-"));
      EXPECT_TRUE(in_family("*-0.1*0", "sink-0.10"));
      EXPECT_TRUE(in_family("star[k=*,l=*]", "star[k=1,l=10]"));
      EXPECT_FALSE(in_family("sink-*", "sin"));
      EXPECT_FALSE(in_family("sink-*x", "sink-0.10"));
      EXPECT_FALSE(in_family("sink", "sink-0.10"));
      EXPECT_TRUE(is_family("sink-*"));
      EXPECT_FALSE(is_family("sink-0.10"));
    }

    TEST(Summary, HoldsVerdictBoundsAndOmissions)
    {
      using enum cases::Statistic;
      const tests::ScratchDirectory directory;
      auto runs = first_order();
      runs.push_back(ended(320, RunStatus::refused, "too fine"));
      auto short_of = criterion(order, 1.25, infinity);
      short_of.expected_failure = "1.0 measured";
      write_summary(directory.path(),
                    evaluated(runs, {criterion(value, -infinity, 1, 40), short_of,
                                     criterion(order, 0.9, 1.1),
                                     criterion(value, -infinity, 1, 320)}));
      const auto json = read_json(directory.path("summary.json"));
      EXPECT_EQ(json.at("passed"), false);
      const auto &list = json.at("criteria");
      ASSERT_EQ(list.size(), 4u);
      EXPECT_EQ(list[0].at("case"), "slab");
      EXPECT_EQ(list[0].at("method"), "sph");
      EXPECT_EQ(list[0].at("quantity"), "front_rms at n=40");
      EXPECT_EQ(list[0].at("bound"), 1);
      EXPECT_EQ(list[0].at("relation"), "<=");
      EXPECT_EQ(list[0].at("passed"), true);
      EXPECT_EQ(list[1].at("bound"), 1.25);
      EXPECT_EQ(list[1].at("relation"), ">=");
      EXPECT_EQ(list[1].at("expected_failure"), "1.0 measured");
      EXPECT_EQ(list[1].at("passed"), false);
      EXPECT_EQ(list[2].at("bound"), nlohmann::json({0.9, 1.1}));
      EXPECT_TRUE(list[3].at("value").is_null());
      EXPECT_EQ(json.at("omissions").size(), 1u);
    }
  } // namespace
} // namespace meltfront::verification
