#include <verification/studies/crosscheck/contradiction.h>

#include <gtest/gtest.h>

#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    Statement says(const std::string &method, double value, double bar)
    {
      return {method, {value, bar, 1, true}};
    }

    using Positions = std::vector<std::size_t>;

    TEST(Contradicting, NobodyWhereBarsMeet)
    {
      EXPECT_EQ(
          contradicting({says("a", 1, 0.1), says("b", 1.15, 0.1), says("c", 1.1, 0.01)}),
          Positions());
    }

    TEST(Contradicting, TheOneAgainstManyEvenWithTheSmallestBar)
    {
      EXPECT_EQ(contradicting({says("a", 1, 0.1), says("liar", 2, 1e-9),
                               says("c", 1.1, 0.05), says("d", 1.05, 0.2)}),
                Positions{1});
    }

    TEST(Contradicting, BothOfAPair)
    {
      EXPECT_EQ(contradicting({says("a", 1, 0.1), says("b", 1.3, 0.1)}),
                (Positions{0, 1}));
    }

    TEST(Contradicting, AllWhereTheyAreDivided)
    {
      EXPECT_EQ(contradicting({says("a", 1, 0.1), says("b", 1, 0.1), says("c", 2, 0.1),
                               says("d", 2, 0.1)}),
                (Positions{0, 1, 2, 3}));
    }

    TEST(Contradicting, AWideBarContradictsNobody)
    {
      EXPECT_EQ(contradicting({says("a", 1, 0.1), says("b", 7, 100), says("c", 1, 0.1)}),
                Positions());
    }

    /** Runs of a method whose solid fraction is 0.5 plus an error of an order, and whose
     * temperature is right. */
    void add_ladder(const std::string &method, double factor, double order, double lie,
                    std::vector<LevelRun> &runs)
    {
      for(const int n : {20, 40, 80})
      {
        LevelRun run{method, n, RunStatus::finished};
        run.spacing = 1. / n;
        run.course.lowest = -1;
        run.course.highest = 1;
        run.course.quantities["temperature"]
            = std::vector<double>(course_intervals + 1, 0.3);
        for(int k = 0; k <= course_intervals; ++k)
          run.course.quantities["solid fraction"].push_back(
              0.5 * std::sqrt(k / 24.) + factor * std::pow(run.spacing, order) + lie * k);
        runs.push_back(run);
      }
    }

    TEST(WorstContradiction, HonestMethodsOfFirstAndSecondOrderAgree)
    {
      std::vector<LevelRun> runs;
      add_ladder("first", 0.7, 1, 0, runs);
      add_ladder("second", -3, 2, 0, runs);
      add_ladder("exact", 0, 1, 0, runs);
      EXPECT_FALSE(worst_contradiction(comparisons(runs, cases::Material())));
    }

    /** What is all but solid is at the melting temperature until its last liquid is gone,
     * however wrong the time of that. */
    TEST(WorstContradiction, MeltingHidesAnErrorOfTheSolidFraction)
    {
      const auto contradiction = [](double error_of_solid)
      {
        std::vector<LevelRun> runs;
        add_ladder("late", 0, 1, 0, runs);
        add_ladder("right", 0, 1, 0, runs);
        for(LevelRun &run : runs)
        {
          const bool late = run.method == "late";
          run.course.quantities["temperature near x = 0/3"]
              = std::vector<double>(course_intervals + 1, late ? 0 : -0.002);
          run.course.quantities["solid fraction near x = 0/3"] = std::vector<double>(
              course_intervals + 1, late ? 1 - error_of_solid * run.spacing : 1);
        }
        return worst_contradiction(comparisons(runs, cases::Material()));
      };
      EXPECT_TRUE(contradiction(0));
      EXPECT_FALSE(contradiction(0.05));
    }

    TEST(WorstContradiction, ALieThatConvergesIsFound)
    {
      std::vector<LevelRun> runs;
      add_ladder("first", 0.7, 1, 0, runs);
      add_ladder("liar", 0.1, 2, 0.003, runs);
      add_ladder("second", -3, 2, 0, runs);
      const auto found = worst_contradiction(comparisons(runs, cases::Material()));
      ASSERT_TRUE(found);
      EXPECT_EQ(found->quantity, "solid fraction");
      EXPECT_EQ(found->suspects, std::vector<std::string>{"liar"});
      EXPECT_EQ(found->time_share, 1);
      EXPECT_GT(found->excess, 1);
      EXPECT_EQ(found->statements.size(), 3u);
      const auto bars = relative_bars(comparisons(runs, cases::Material()));
      EXPECT_GE(bars.at("first"), reading_error);
      EXPECT_LT(bars.at("first"), 0.05);
    }

    TEST(WorstContradiction, RunsThatDidNotFinishSayNothing)
    {
      std::vector<LevelRun> runs;
      add_ladder("first", 0.7, 1, 0, runs);
      add_ladder("liar", 0.1, 2, 0.003, runs);
      for(LevelRun &run : runs)
        if(run.method == "liar")
          run.status = RunStatus::failed;
      EXPECT_FALSE(worst_contradiction(comparisons(runs, cases::Material())));
    }
  } // namespace
} // namespace meltfront::verification
