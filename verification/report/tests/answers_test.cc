#include <verification/report/page/report.h>
#include <verification/report/tests/fixture.h>
#include <verification/report/tests/well_formed.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace meltfront::verification
{
  namespace
  {
    /** A run whose front is off by factor h^order at all times but the start. */
    RunRecord run_with_course(const std::string &label, int n, double factor,
                              double order)
    {
      RunRecord run = fixture::run("plane", label, n, factor, order, 1e-3);
      run.series = {};
      run.cost.steps = 4L * n * n;
      run.probes.clear();
      const double error = factor * std::pow(n, -order);
      for(int i = 0; i <= 100; ++i)
      {
        const double t = i / 100.;
        run.series.time.push_back(t);
        run.series.front_exact.push_back(0.5 * std::sqrt(t));
        run.series.front.push_back(0.5 * std::sqrt(t) * (1 + error));
      }
      for(const double x : {0.1, 0.9})
        run.probes.push_back({"x", {x}, x + error, x});
      return run;
    }

    MatrixResult one_case()
    {
      MatrixResult result;
      result.name = "compare-plane";
      result.cases = {fixture::plane_case("plane")};
      for(const int n : {20, 40, 80})
      {
        result.runs.push_back(run_with_course("fem-enthalpy", n, 0.3, 1.5));
        result.runs.push_back(run_with_course("rkpm-tracked", n, 0.2, 2));
      }
      result.remarks = {"Left out: fem-cut: takes <no> slab"};
      return result;
    }

    std::string page_of(const MatrixResult &result)
    {
      const fixture::Directory directory;
      write_report(result, directory.path());
      std::string html = directory.read("report.html");
      EXPECT_EQ(fixture::first_mistake(html), "");
      return html;
    }

    void expect_in(const std::string &html, const std::string &words)
    {
      EXPECT_NE(html.find(words), std::string::npos) << words;
    }
  } // namespace

  TEST(AnswersChapter, SaysWhoAgreesWhatIsCheapestAndWhoIsLeftOut)
  {
    const std::string html = page_of(one_case());
    expect_in(html, "What the methods answer");
    expect_in(html, "in which 2 of 2 methods agree");
    expect_in(html, "temperature: agreed at 2 of 2 places");
    expect_in(html, "CPU seconds at equal error");
    expect_in(html, "Relative error at equal cost");
    expect_in(html, "<b>Left out: </b>fem-cut.");
    expect_in(html, "Left out: fem-cut: takes &lt;no&gt; slab.");
    EXPECT_EQ(html.find("contradicted by"), std::string::npos);
  }

  TEST(AnswersChapter, NamesTheMethodThatContradicts)
  {
    MatrixResult result = one_case();
    for(const int n : {20, 40, 80})
    {
      RunRecord wrong = run_with_course("sph-2005", n, 0.2, 2);
      for(double &front : wrong.series.front)
        front *= 0.8;
      result.runs.push_back(wrong);
    }
    expect_in(page_of(result), "contradicted by sph-2005");
  }

  TEST(AnswersChapter, SaysThatOneLevelGivesNoErrorBar)
  {
    MatrixResult result = one_case();
    std::erase_if(result.runs, [](const RunRecord &run) { return run.n != 20; });
    ASSERT_FALSE(result.runs.empty());
    const std::string html = page_of(result);
    expect_in(html, "no error bar");
    EXPECT_EQ(html.find("no consensus;"), std::string::npos);
  }

  TEST(AnswersChapter, SaysThatThereIsNoConsensus)
  {
    MatrixResult result = one_case();
    for(RunRecord &run : result.runs)
      if(run.label == "rkpm-tracked")
        for(double &front : run.series.front)
          front *= 0.8;
    expect_in(page_of(result), "no consensus");
  }

  TEST(AnswersChapter, ManyCasesHaveNone)
  {
    EXPECT_EQ(page_of(fixture::matrix()).find("What the methods answer"),
              std::string::npos);
  }

  TEST(CoverageChapter, HoldsBarsAgainstTheTruth)
  {
    const std::string html = page_of(one_case());
    expect_in(html, "How far error bars can be trusted");
    expect_in(html, "front over time");
  }
} // namespace meltfront::verification
