#include <cases/case_file/criterion_parser.h>
#include <cases/error.h>
#include <verification/judge/criteria.h>
#include <verification/judge/finding.h>
#include <verification/record/label.h>
#include <verification/run/tests/fakes.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace meltfront::verification::tests
{
  namespace
  {
    /** Errors factor * h^order on four levels. */
    void add_runs(MatrixResult &result, const std::string &case_name, double factor,
                  double order)
    {
      result.cases.push_back({slab_case(case_name)});
      for(const int n : {10, 20, 40, 80})
      {
        RunRecord &run = result.runs.emplace_back();
        run.case_name = case_name;
        run.method = run.label = "sph";
        run.n = n;
        run.status = RunStatus::finished;
        run.description.spacing = 1. / n;
        run.quantities = {{"front_rms", factor * std::pow(1. / n, order)}};
      }
    }

    cases::Criterion order_between(double lower, double upper)
    {
      cases::Criterion criterion;
      criterion.method = "sph";
      criterion.quantity = "front_rms";
      criterion.statistic = cases::Statistic::order;
      criterion.lower = lower;
      criterion.upper = upper;
      return criterion;
    }

    MatrixResult bars()
    {
      MatrixResult result;
      add_runs(result, "bar", 1, 1);
      add_runs(result, "bar[k=1]", 1, 2);
      add_runs(result, "bar[k=10]", 2, 1.5);
      add_runs(result, "bar[k=100]", 2, 0.5);
      return result;
    }

    std::string complaint_about(const std::string &claim)
    {
      try
      {
        pieces_of_claim(claim, 2);
      }
      catch(const cases::InputError &error)
      {
        return error.what();
      }
      return "none";
    }
  } // namespace

  TEST(Findings, HoldWhereEveryCaseOfTheirPatternDoes)
  {
    const std::vector<Finding> findings{
        {"Orders {1}.", {{"bar[k=1|10]", order_between(1.4, 2.1)}}},
        {"Orders {1}, and {2}.",
         {{"bar[k=*]", order_between(1.4, 2.1)}, {"bar", order_between(0.9, 1.1)}}},
        {"Nothing: {1}.", {{"rod", order_between(0, 9)}}}};
    const std::vector<FindingResult> judged = judge_findings(bars(), findings);
    ASSERT_EQ(judged.size(), 3u);
    EXPECT_TRUE(judged[0].holds());
    ASSERT_EQ(judged[0].evidence[0].values.size(), 2u);
    EXPECT_NEAR(judged[0].evidence[0].least(), 1.5, 1e-10);
    EXPECT_NEAR(judged[0].evidence[0].greatest(), 2, 1e-10);
    EXPECT_EQ(claim_text(judged[0]), "Orders 1.5 to 2.");
    EXPECT_FALSE(judged[1].holds());
    EXPECT_FALSE(judged[1].evidence[0].passed());
    EXPECT_FALSE(judged[1].evidence[0].values[2].passed);
    EXPECT_TRUE(judged[1].evidence[1].passed());
    EXPECT_EQ(claim_text(judged[1]), "Orders 0.5 to 2, and 1.");
    EXPECT_FALSE(judged[2].holds()); // nothing was measured
    EXPECT_EQ(claim_text(judged[2]), "Nothing: (not measured).");
  }

  TEST(Findings, FailTheMatrixWhenTheFiguresNoLongerBearThem)
  {
    MatrixResult result = bars();
    result.claims = {{"Order {1}.", {{"bar[k=1]", order_between(1.9, 2.1)}}}};
    evaluate(result);
    EXPECT_TRUE(result.passed);
    for(RunRecord &run : result.runs)
      if(run.case_name == "bar[k=1]" && run.n == 80)
        run.quantities["front_rms"] *= 4;
    evaluate(result);
    ASSERT_EQ(result.findings.size(), 1u);
    EXPECT_FALSE(result.findings[0].holds());
    EXPECT_FALSE(result.passed);
  }

  TEST(Findings, AFailedRunBearsNothingOut)
  {
    MatrixResult result = bars();
    result.runs.back().status = RunStatus::failed;
    const auto judged
        = judge_findings(result, {{"Order {1}.", {{"bar[k=100]", order_between(0, 9)}}}});
    EXPECT_FALSE(judged[0].holds());
  }

  TEST(Findings, ClaimsAreCutAtTheirNumbers)
  {
    const std::vector<ClaimPiece> pieces = pieces_of_claim("a {2} b{1}", 2);
    ASSERT_EQ(pieces.size(), 4u);
    EXPECT_EQ(pieces[0].words, "a ");
    EXPECT_EQ(pieces[1].evidence, 1);
    EXPECT_EQ(pieces[2].words, " b");
    EXPECT_EQ(pieces[3].evidence, 0);
    for(const char *wrong : {"{3}", "{0}", "{x}", "{}", "{1", "{1.5}"})
      EXPECT_NE(complaint_about(wrong).find("1 to 2"), std::string::npos) << wrong;
    EXPECT_EQ(complaint_about("plain"), "none");
  }

  TEST(Findings, ComeBackFromJson)
  {
    Finding finding{
        "Order {1}.",
        {{"bar[k=*]", cases::parse_criterion("sph: order of front_rms >= 1")}}};
    const nlohmann::json stored = finding;
    const auto read = nlohmann::json::parse(stored.dump()).get<Finding>();
    EXPECT_EQ(read.claim, finding.claim);
    ASSERT_EQ(read.evidence.size(), 1u);
    EXPECT_EQ(read.evidence[0].cases, "bar[k=*]");
    EXPECT_EQ(read.evidence[0].criterion.lower, 1);
    EXPECT_EQ(read.evidence[0].criterion.upper, INFINITY);
    EXPECT_EQ(read.evidence[0].criterion.statistic, cases::Statistic::order);
    const nlohmann::json picture = Picture{"c", "bar", {"a", "b"}, "front_rms", "h"};
    EXPECT_EQ(picture.get<Picture>().runs, (std::vector<std::string>{"a", "b"}));
  }

  TEST(Findings, NamesAreCheckedBeforeAnythingIsRun)
  {
    Matrix matrix;
    matrix.name = "m";
    MatrixBlock block;
    block.cases = {"slab"};
    block.methods = {"fake"};
    block.resolutions = {10};
    block.variations = {{"Scene/density", {"1", "2"}}};
    matrix.blocks = {block};
    cases::Criterion criterion = order_between(0, 1);
    criterion.method = "fake[scheme=euler|rkl2]";
    matrix.findings = {{"A.", {{"slab[density=*]", criterion}}}};
    matrix.pictures = {{"c", "slab[density=2]", {"fake"}, "front_rms", "cpu_seconds"}};
    const FakeMethod fake("fake");
    const auto check = [&]
    {
      check_findings(matrix,
                     [&](const std::string &) -> const cases::Method & { return fake; });
    };
    EXPECT_NO_THROW(check());
    const auto rejects = [&](auto &value, const std::string &wrong)
    {
      const std::string right = value;
      value = wrong;
      EXPECT_THROW(check(), cases::InputError) << wrong;
      value = right;
    };
    Evidence &evidence = matrix.findings[0].evidence[0];
    rejects(evidence.cases, "slab");
    rejects(evidence.cases, "slab[density=3]");
    rejects(evidence.criterion.method, "fake[scheme=euler|none]");
    rejects(evidence.criterion.quantity, "front_rmss");
    rejects(matrix.pictures[0].cases, "slab[mass=*]");
    rejects(matrix.pictures[0].runs[0], "fake[step=1]");
    rejects(matrix.pictures[0].quantity, "error");
    rejects(matrix.pictures[0].against, "seconds");
  }
} // namespace meltfront::verification::tests
