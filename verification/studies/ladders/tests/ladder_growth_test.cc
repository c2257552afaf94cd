#include <verification/judge/answers.h>
#include <verification/matrix/tests/runner_fixture.h>
#include <verification/run/tests/fakes.h>
#include <verification/studies/ladders/advice.h>
#include <verification/studies/ladders/capable_methods.h>
#include <verification/studies/ladders/ladder_growth.h>

#include <gtest/gtest.h>

#include <chrono>
#include <ctime>
#include <filesystem>
#include <map>
#include <thread>

namespace meltfront::verification
{
  namespace
  {
    using tests::FakeMethod;
    using tests::ScratchDirectory;

    /** Time that the processor counts, unlike that of a sleep. */
    void work_for(int milliseconds)
    {
      const std::clock_t end = std::clock() + milliseconds * (CLOCKS_PER_SEC / 1000);
      while(std::clock() < end)
        ;
    }

    class LadderTest : public ::testing::Test
    {
    protected:
      LadderTest()
      {
        options = tests::options_in(scratch.path("out"));
      }

      void add(const std::string &name, double order, FakeMethod::Act act = {},
               tests::Cheat cheat = {})
      {
        methods.emplace(name, std::make_unique<FakeMethod>(name, act, 0.1, order, cheat));
      }

      LadderGrowth growth(double within, const MethodSettings &settings = {})
      {
        std::vector<const cases::Method *> all;
        for(const auto &[name, method] : methods)
          all.push_back(method.get());
        return LadderGrowth(
            "slab", domain, "levels", all, options,
            [](const std::string &name) { return tests::slab_case(name); },
            [this](const std::string &name) -> const cases::Method &
            { return *methods.at(name); },
            within, settings);
      }

      static const Answer &answer(const std::vector<Answer> &answers,
                                  const std::string &quantity)
      {
        return *std::ranges::find(answers, quantity, &Answer::quantity);
      }

      ScratchDirectory scratch;
      cases::Domain domain;
      std::map<std::string, std::unique_ptr<FakeMethod>> methods;
      RunnerOptions options;
    };

    TEST_F(LadderTest, LevelsFillBoxesWhoseSidesDiffer)
    {
      add("one", 1);
      domain.shape = cases::DomainShape::box;
      domain.dimension = 2;
      domain.upper = {0.06, 0.04, 0};
      const LadderGrowth levels = growth(600);
      EXPECT_EQ(levels.fitting(*methods.at("one"), 20), 24);
      EXPECT_EQ(levels.fitting(*methods.at("one"), 36), 36);
      domain.upper = {1, 0.846, 0};
      EXPECT_EQ(growth(600).fitting(*methods.at("one"), 20), 20);
      EXPECT_EQ(growth(600).fitting(*methods.at("one"), 400), 500);
    }

    TEST_F(LadderTest, GrowsUntilThereAreEnoughLevels)
    {
      add("one", 1);
      add("two", 2);
      LadderGrowth levels = growth(600);
      while(levels.grow())
        ;
      for(const GrowingLadder &ladder : levels.ladders())
        EXPECT_EQ(ladder.resolutions,
                  (std::vector<int>{20, 40, 80, 160, 320, 640, 1280, 2560}));
      EXPECT_TRUE(levels.stops().empty());

      const auto answers = answers_of(levels.result(), levels.result().cases.front());
      const Answer &front = answer(answers, "front");
      EXPECT_TRUE(front.consensus.agreed);
      EXPECT_EQ(front.methods.size(), 2u);
      EXPECT_EQ(front.consensus.value, front.methods[1].bar.value);
      for(const MethodAnswer &one : front.methods)
        EXPECT_LE(one.error, one.bar.bar) << one.label;
      const auto errors = level_errors(levels.result(), levels.result().cases.front());
      EXPECT_EQ(errors.size(), 16u);
      ASSERT_NE(cheapest_level(errors, 1e-2), nullptr);
      EXPECT_LE(cheapest_level(errors, 1e-2)->error, 1e-2);
      EXPECT_EQ(cheapest_level(errors, 1e-12), nullptr);
    }

    TEST_F(LadderTest, RunsMethodsWithTheOptionsThatAreAskedFor)
    {
      add("one", 1);
      add("two", 2);
      const MethodSettings settings{
          {"two", {{"step_factor", "1.5"}, {"scheme", "rkl2"}}}};
      LadderGrowth levels = growth(600, settings);
      levels.make_all({20, 40});
      ASSERT_EQ(levels.result().runs.size(), 4u);
      for(const RunRecord &run : levels.result().runs)
      {
        EXPECT_EQ(run.status, RunStatus::finished);
        EXPECT_EQ(run.options.at("step_factor"), run.method == "two" ? "1.5" : "0.5");
        EXPECT_EQ(run.label,
                  run.method == "two" ? "two[scheme=rkl2,step_factor=1.5]" : "one");
      }
      EXPECT_THROW(options_with({{"two", {{"step_factor", "7"}}}}, *methods.at("two")),
                   cases::InputError);
    }

    TEST_F(LadderTest, EndsWhatTakesLongerThanThereIsTime)
    {
      add("good", 1);
      add("slow", 1,
          [](const cases::Scene &, const cases::Resolution &resolution)
          {
            if(resolution.n > 20)
              std::this_thread::sleep_for(std::chrono::seconds(1000));
          });
      LadderGrowth levels = growth(3);
      while(levels.grow())
        ;
      ASSERT_EQ(levels.stops().size(), 2u);
      EXPECT_TRUE(levels.stops()[0].starts_with("good: the time was up before n = "))
          << levels.stops()[0];
      EXPECT_TRUE(levels.stops()[1].starts_with("slow: n = 40 was ended"))
          << levels.stops()[1];
      EXPECT_EQ(levels.finest(*methods.at("slow"))->n, 20);
      levels.conclude({"as time allowed"}, [](MatrixResult &result)
                      { EXPECT_EQ(result.remarks.front(), "as time allowed"); });
      for(const RunRecord &run : levels.result().runs)
        EXPECT_EQ(run.status, RunStatus::finished) << run.label << " " << run.n;
    }

    TEST_F(LadderTest, AMethodThatFailsEndsItsLadderAndSaysWhy)
    {
      add("failing", 1,
          [](const cases::Scene &, const cases::Resolution &resolution)
          {
            if(resolution.n > 40)
              throw cases::NumericalError("failing", 3, 0.5, "temperature", "is bad");
          });
      LadderGrowth levels = growth(600);
      while(levels.grow())
        ;
      ASSERT_EQ(levels.stops().size(), 1u);
      EXPECT_NE(levels.stops().front().find("failed at n = 80"), std::string::npos);
      EXPECT_EQ(levels.finest(*methods.at("failing"))->n, 40);
    }

    TEST_F(LadderTest, ALevelThatIsRefusedIsPassedOver)
    {
      add("choosy", 1,
          [](const cases::Scene &, const cases::Resolution &resolution)
          {
            if(resolution.n == 80 || resolution.n > 400)
              throw cases::Refusal("choosy: a layer lies badly");
          });
      LadderGrowth levels = growth(600);
      while(levels.grow())
        ;
      ASSERT_EQ(levels.stops().size(), 1u);
      EXPECT_NE(levels.stops().front().find("refused at n = 1280"), std::string::npos);
      EXPECT_EQ(levels.finest(*methods.at("choosy"))->n, 320);
      const auto answers = answers_of(levels.result(), levels.result().cases.front());
      const MethodAnswer &front = answer(answers, "front").methods.front();
      EXPECT_LE(front.error, front.bar.bar);
    }

    TEST_F(LadderTest, AWrongLimitContradictsTheOthers)
    {
      add("one", 1);
      add("two", 2);
      add("wrong", 2, {},
          [](tests::State &state)
          {
            for(double &fraction : state.solid_fraction)
              fraction *= 0.9;
          });
      LadderGrowth levels = growth(600);
      for(int level = 0; level < 5; ++level)
        levels.grow();
      const auto answers = answers_of(levels.result(), levels.result().cases.front());
      const Answer &volume = answer(answers, "solid_volume");
      EXPECT_TRUE(volume.consensus.agreed);
      EXPECT_EQ(volume.consensus.support, 2);
      for(const MethodAnswer &one : volume.methods)
        EXPECT_EQ(one.distance_in_bars > 1, one.label == "wrong");
    }

    TEST_F(LadderTest, StepsThatAreNotRefinedAreCheckedAtTheFinestLevel)
    {
      // Takes 200 steps at any level.
      class Stepping : public FakeMethod
      {
      public:
        using FakeMethod::FakeMethod;

        std::vector<cases::OptionDeclaration> option_declarations() const override
        {
          auto declarations = FakeMethod::option_declarations();
          declarations.push_back({"steps", "1", 0., "Steps; 0: its own.", 0, 1e6});
          return declarations;
        }
      };
      add("plain", 1);
      methods.emplace("stepping", std::make_unique<Stepping>("stepping"));
      LadderGrowth levels = growth(600);
      levels.make_all({20, 40});
      levels.check_steps();
      int checks = 0;
      for(const RunRecord &run : levels.result().runs)
        if(run.label != run.method)
        {
          ++checks;
          EXPECT_EQ(run.label, "stepping[steps=400]");
          EXPECT_EQ(run.n, 40);
          EXPECT_EQ(run.status, RunStatus::finished);
        }
      EXPECT_EQ(checks, 1);
      LadderGrowth late = growth(1e-3);
      late.make_all({20, 40});
      late.check_steps();
      EXPECT_TRUE(std::ranges::none_of(late.result().runs,
                                       [](const RunRecord &run) { return run.n == 40; }))
          << "the coarsest come first, and no run begins without time";
      EXPECT_FALSE(late.stops().empty());
      EXPECT_TRUE(std::ranges::all_of(late.result().runs, [](const RunRecord &run)
                                      { return run.label == run.method; }))
          << "no time is left for checks";
    }

    TEST_F(LadderTest, AdviceMeetsTheErrorAndIsRun)
    {
      // The orders that the priors know.
      add("fem-enthalpy", 1.44);
      add("rkpm-tracked", 1.96);
      for(const double wanted : {1e-2, 1e-3, 1e-4})
      {
        LadderGrowth levels = growth(600);
        const Advice advice = advise(levels, {wanted});
        EXPECT_TRUE(advice.reachable) << advice.explanation;
        EXPECT_TRUE(advice.error_is_true);
        EXPECT_LE(advice.error, wanted);
        EXPECT_LE(advice.predicted_error, wanted);
        EXPECT_GT(advice.error, wanted / 30);
        EXPECT_EQ(advice.forecasts.size(), 2u);
        std::filesystem::remove_all(options.directory);
      }
    }

    TEST_F(LadderTest, AdviceSaysWhatIsReachable)
    {
      add("fem-enthalpy", 1.44,
          [](const cases::Scene &, const cases::Resolution &resolution)
          { work_for(resolution.n); });
      LadderGrowth levels = growth(3);
      const Advice advice = advise(levels, {1e-9});
      EXPECT_FALSE(advice.reachable);
      EXPECT_NE(advice.explanation.find("out of reach"), std::string::npos)
          << advice.explanation;
      // On a slow machine the run that was chosen may end at its time limit, without one.
      EXPECT_FALSE(advice.error <= 1e-9) << advice.n << advice.explanation;
    }

    TEST_F(LadderTest, MethodsThatCannotAreLeftOutByReason)
    {
      class Narrow : public FakeMethod
      {
      public:
        using FakeMethod::FakeMethod;

        std::vector<cases::Capabilities> capabilities() const override
        {
          auto narrow = tests::fake_capabilities();
          narrow.shapes.erase(narrow.shapes.begin());
          return {narrow};
        }
      };
      const FakeMethod good("good");
      const Narrow first("first"), second("second");
      const CapableMethods found
          = capable_methods(tests::slab_case("slab"), {&good, &first, &second});
      ASSERT_EQ(found.capable.size(), 1u);
      EXPECT_EQ(found.capable.front(), &good);
      ASSERT_EQ(found.left_out.size(), 1u);
      EXPECT_TRUE(found.left_out.front().starts_with("first, second: "))
          << found.left_out.front();
    }
  } // namespace
} // namespace meltfront::verification
