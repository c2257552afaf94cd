#include <verification/record/json_values.h>
#include <verification/run/tests/fakes.h>
#include <verification/studies/crosscheck/crosscheck.h>

#include <gtest/gtest.h>

#include <csignal>
#include <cstdio>
#include <filesystem>

namespace meltfront::verification
{
  namespace
  {
    using tests::FakeMethod;
    using tests::ScratchDirectory;

    /** Scenes that fakes take; each is known by its number and by what stands in its
     * draft. */
    SceneDraft draft_of(std::uint64_t, int index, int)
    {
      SceneDraft draft;
      draft.set("", "title", fmt::format("{}", index));
      draft.set("Scene/Walls/x_min", "kind", "insulated");
      draft.set("Scene/Material/Liquid", "conductivity", "2");
      return draft;
    }

    class CrosscheckTest : public ::testing::Test
    {
    protected:
      CrosscheckTest()
      {
        settings.scenes = 3;
        settings.directory = scratch.path("out");
        settings.jobs = 2;
        settings.program_hash = "a program";
        settings.shrink.trials = 6;
        add("first", 0.3, 1);
        add("second", -2, 2);
      }

      void add(const std::string &name, double factor, double order,
               const FakeMethod::Act &act = {})
      {
        owned.push_back(std::make_unique<FakeMethod>(
            name,
            [this, act](const cases::Scene &scene, const cases::Resolution &resolution)
            {
              tests::append_line(scratch.path("started"), scene.name);
              if(act)
                act(scene, resolution);
            },
            factor, order));
        settings.methods.push_back(owned.back().get());
      }

      nlohmann::json run() const
      {
        return crosscheck(
            settings,
            [](const std::string &text, const std::string &)
            {
              cases::Case c = tests::slab_case("slab");
              c.text = text;
              c.exact = nullptr;
              return c;
            },
            draft_of);
      }

      std::size_t starts() const
      {
        return tests::lines_of(scratch.path("started")).size();
      }

      ScratchDirectory scratch;
      CrosscheckSettings settings;
      std::vector<std::unique_ptr<FakeMethod>> owned;
    };

    TEST_F(CrosscheckTest, HonestMethodsOfFirstAndSecondOrderAgree)
    {
      const nlohmann::json summary = run();
      EXPECT_EQ(summary.at("scenes"), 3);
      EXPECT_EQ(summary.at("agreed"), 3);
      for(const char *other : {"refused", "failed", "suspect"})
        EXPECT_EQ(summary.at(other), 0);
      EXPECT_TRUE(summary.at("suspects").empty());
      EXPECT_EQ(summary.at("compared").at("first"), 3);
      EXPECT_EQ(read_json(settings.directory + "/summary.json"), summary);
      EXPECT_EQ(starts(), 3u * 2 * 3);
    }

    TEST_F(CrosscheckTest, AMethodThatLiesIsFoundAndItsSceneShrunk)
    {
      settings.scenes = 1;
      add("third", 0.1, 1);
      add("liar", 0.05, 0);
      const nlohmann::json summary = run();
      EXPECT_EQ(summary.at("suspect"), 1);
      const nlohmann::json &suspect = summary.at("suspects").at(0);
      EXPECT_EQ(suspect.at("scene"), "scene-1-0");
      EXPECT_EQ(suspect.at("suspected"), std::vector<std::string>{"liar"});
      EXPECT_EQ(suspect.at("methods").size(), 4u);
      EXPECT_EQ(suspect.at("values").size(), 4u);
      EXPECT_EQ(suspect.at("bars").size(), 4u);
      EXPECT_TRUE(suspect.at("quantity").is_string());
      const std::string text
          = tests::text_of(settings.directory + "/suspects/scene-1-0.prm");
      EXPECT_TRUE(text.starts_with("# Suspect: liar, which contradicts the others"))
          << text;
      // It lies whatever the scene holds.
      EXPECT_EQ(text.find("subsection"), std::string::npos) << text;
    }

    TEST_F(CrosscheckTest, WhatIsThereIsNotRunAgainUnlessTheProgramChanged)
    {
      run();
      const std::size_t before = starts();
      settings.scenes = 4;
      EXPECT_EQ(run().at("agreed"), 4);
      EXPECT_EQ(starts(), before + 6);
      std::filesystem::remove(settings.directory + "/scenes/scene-1-2.json");
      run();
      EXPECT_EQ(starts(), before + 12);
      settings.program_hash = "another program";
      run();
      EXPECT_EQ(starts(), before + 12 + 24);
    }

    TEST_F(CrosscheckTest, FailuresAndRefusalsAreCountedWithTheirReasons)
    {
      settings.scenes = 2;
      add("crashing", 0.1, 1, [](const auto &, const auto &) { std::raise(SIGSEGV); });
      nlohmann::json summary = run();
      EXPECT_EQ(summary.at("failed"), 2);
      ASSERT_EQ(summary.at("failures").size(), 6u) << "at each resolution";
      EXPECT_EQ(summary.at("failures").at(0).at("reason"),
                "crashing crashed (Segmentation fault)");
      settings.methods.clear();
      add("honest", 0.1, 1);
      add("refusing", 0.1, 1,
          [](const auto &, const auto &)
          { throw cases::Refusal("takes no scene of 3 walls"); });
      summary = run();
      EXPECT_EQ(summary.at("refused"), 2);
      EXPECT_EQ(summary.at("refusals").at("refusing").at("takes no scene of # walls"), 2);
    }

    TEST_F(CrosscheckTest, ARunOutOfTimeIsNoFailureWhereTwoLevelsAreLeft)
    {
      settings.scenes = 1;
      settings.within = 0.05;
      add("slow", 0.1, 1,
          [](const auto &, const cases::Resolution &resolution)
          {
            if(resolution.n == 54)
              for(volatile long i = 0; i >= 0;)
                i = (i + 1) % 1000;
          });
      const nlohmann::json summary = run();
      EXPECT_EQ(summary.at("agreed"), 1);
      EXPECT_EQ(summary.at("out_of_time").size(), 1u);
      EXPECT_EQ(summary.at("compared").at("slow"), 1);
    }

    TEST_F(CrosscheckTest, FailuresAtCoarseResolutionsAloneLeadToFinerOnes)
    {
      settings.scenes = 1;
      const auto fails_at = [](int first, int last)
      {
        return [first, last](const auto &, const cases::Resolution &resolution)
        {
          if(resolution.n >= first && resolution.n <= last)
            throw cases::NumericalError("a method", 1, 0, "layer", "is not resolved");
        };
      };
      add("coarse", 0.1, 1, fails_at(20, 34));
      nlohmann::json summary = run();
      EXPECT_EQ(summary.at("agreed"), 1);
      EXPECT_EQ(summary.at("too_coarse").size(), 2u);
      EXPECT_EQ(summary.at("compared").at("coarse"), 1);
      settings.methods.pop_back();
      add("fine", 0.1, 1, fails_at(54, 54));
      summary = run();
      EXPECT_EQ(summary.at("failed"), 1);
      settings.methods.pop_back();
      add("crashing", 0.1, 1,
          [](const auto &, const cases::Resolution &resolution)
          {
            if(resolution.n == 20)
              std::raise(SIGSEGV);
          });
      summary = run();
      EXPECT_EQ(summary.at("failed"), 1);
      EXPECT_TRUE(summary.at("too_coarse").empty());
    }

    /** Takes 50 steps whatever the resolution, unless it is given more. */
    class SteadyStepper : public FakeMethod
    {
    public:
      using FakeMethod::FakeMethod;

      std::vector<cases::OptionDeclaration> option_declarations() const override
      {
        return {{"steps", "1", 0L, "A number.", 0, 1e9}};
      }

      cases::Demand demand(const cases::Scene &, const cases::EffectSet &,
                           const cases::Resolution &) const override
      {
        return {1, 50};
      }
    };

    TEST_F(CrosscheckTest, TimeIsRefinedWithSpace)
    {
      settings.scenes = 1;
      const SteadyStepper stepper(
          "stepper",
          [](const auto &, const cases::Resolution &resolution)
          {
            const long steps = resolution.options.get_integer("steps");
            if(steps != (resolution.n == 20 ? 0 : (50 * resolution.n + 19) / 20))
              throw cases::NumericalError("stepper", 1, 0, "steps",
                                          std::to_string(steps));
          });
      settings.methods.push_back(&stepper);
      const nlohmann::json summary = run();
      EXPECT_EQ(summary.at("agreed"), 1) << summary;
    }

    TEST_F(CrosscheckTest, OneMethodAloneIsAnError)
    {
      settings.methods.pop_back();
      EXPECT_THROW(run(), cases::InputError);
    }
  } // namespace
} // namespace meltfront::verification
