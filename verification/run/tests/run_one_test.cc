#include <verification/run/run_one.h>
#include <verification/run/tests/fakes.h>

#include <gtest/gtest.h>

#include <chrono>
#include <new>
#include <thread>

namespace meltfront::verification
{
  namespace
  {
    using tests::FakeMethod;

    cases::Resolution resolution_of(const cases::Method &method, int n)
    {
      return {n, cases::Options(method.option_declarations()), 1, 1};
    }

    RunRecord run_fake(const FakeMethod &method, int n = 40,
                       const cases::Case &c = tests::slab_case("slab"))
    {
      return run_one(c, method, resolution_of(method, n), method.name(), {});
    }

    TEST(RunOne, RecordsAFinishedRun)
    {
      const FakeMethod method("fake", {}, 0.1, 1);
      const RunRecord record = run_fake(method);
      EXPECT_EQ(record.status, RunStatus::finished) << record.message;
      EXPECT_EQ(record.case_name, "slab");
      EXPECT_EQ(record.label, "fake");
      EXPECT_EQ(record.n, 40);
      EXPECT_NEAR(record.quantities.at("front_rms"), 0.1 / 40, 1e-12);
      EXPECT_EQ(record.description.spacing, 1. / 40);
      EXPECT_EQ(record.cost.work, 40 * 200);
      EXPECT_EQ(
          record.effects.size(),
          cases::effects_called_for(tests::slab_case("slab").scene).decisions().size());
      EXPECT_EQ(record.options.at("step_factor"), "0.5");
      EXPECT_GT(record.peak_memory_mb, 1);
      for(const char *key : {"case_text", "case_hash", "compiler", "flags", "cpu",
                             "packages", "system", "date"})
        EXPECT_FALSE(record.provenance.at(key).empty()) << key;
      EXPECT_NE(record.provenance.at("packages").find("fmt 9"), std::string::npos);
    }

    TEST(RunOne, CopiesTheProvenanceItIsGiven)
    {
      const FakeMethod method("fake");
      const RunRecord record
          = run_one(tests::slab_case("slab"), method, resolution_of(method, 10), "fake",
                    {{"program_version", "1.2"}, {"command_line", "meltfront x"}});
      EXPECT_EQ(record.provenance.at("program_version"), "1.2");
      EXPECT_EQ(record.provenance.at("command_line"), "meltfront x");
    }

    TEST(RunOne, RepeatsShortRunsAndKeepsTheLeastTime)
    {
      constexpr double longer = 0.3, not_short = 0.6; // s
      for(const double first_time : {longer, not_short})
      {
        int solves = 0;
        const FakeMethod method("hastening",
                                [&](const auto &, const auto &)
                                {
                                  if(solves++ == 0)
                                    std::this_thread::sleep_for(
                                        std::chrono::duration<double>(first_time));
                                });
        const RunRecord record = run_fake(method);
        EXPECT_EQ(solves, first_time == longer ? 5 : 1);
        EXPECT_EQ(record.repeats, solves);
        EXPECT_LT(record.cost.setup_wall, first_time == longer ? longer : 2 * not_short);
      }
    }

    TEST(RunOne, RecordsARefusal)
    {
      const FakeMethod method("fake", [](const cases::Scene &, const cases::Resolution &)
                              { throw cases::Refusal("the step is beyond the limit"); });
      const RunRecord record = run_fake(method);
      EXPECT_EQ(record.status, RunStatus::refused);
      EXPECT_EQ(record.message, "the step is beyond the limit");
      EXPECT_TRUE(record.quantities.empty());
    }

    TEST(RunOne, RefusesASceneWithAnEffectThatTheMethodLacks)
    {
      class OnlyConduction : public FakeMethod
      {
      public:
        using FakeMethod::FakeMethod;
        std::vector<cases::Capabilities> capabilities() const override
        {
          cases::Capabilities result = tests::fake_capabilities();
          result.effects = {cases::Effect::wall_temperature};
          return {result};
        }
      };
      const RunRecord record = run_fake(OnlyConduction("conduction"));
      EXPECT_EQ(record.status, RunStatus::refused);
      EXPECT_NE(record.message.find("phase_change"), std::string::npos);
      EXPECT_EQ(
          record.effects.size(),
          cases::effects_called_for(tests::slab_case("slab").scene).decisions().size());
    }

    TEST(RunOne, RecordsEveryOtherExceptionAsAFailure)
    {
      const FakeMethod diverging("fake",
                                 [](const cases::Scene &, const cases::Resolution &) {
                                   throw cases::NumericalError(
                                       "fake", 3, 0.5, "temperature", "is not finite");
                                 });
      RunRecord record = run_fake(diverging);
      EXPECT_EQ(record.status, RunStatus::failed);
      EXPECT_EQ(record.message, "fake, step 3, t = 0.5: temperature is not finite");
      const FakeMethod greedy("greedy",
                              [](const cases::Scene &, const cases::Resolution &)
                              { throw std::bad_alloc(); });
      record = run_fake(greedy);
      EXPECT_EQ(record.status, RunStatus::failed);
      EXPECT_NE(record.message.find("memory"), std::string::npos);
    }

    TEST(RunOne, KeepsTheCourseOfARunThatBreaksABoundAndNoResult)
    {
      const FakeMethod wild("wild", {}, -500,
                            1); // a front far outside, T beyond the bounds
      const RunRecord record = run_fake(wild);
      EXPECT_EQ(record.status, RunStatus::failed);
      EXPECT_NE(record.message.find("wild, step "), std::string::npos) << record.message;
      EXPECT_EQ(record.series.time.size(), 1u);
      EXPECT_TRUE(record.quantities.empty());
    }

    TEST(RunOne, JudgesWhatAMethodHandsOut)
    {
      const RunRecord honest = run_fake(FakeMethod("honest"));
      EXPECT_EQ(honest.status, RunStatus::finished) << honest.message;
      EXPECT_GE(honest.checks.size(), 4u);
      for(const Check &check : honest.checks)
        EXPECT_TRUE(check.passed) << check.name;

      static const double nowhere = 0.9;
      const std::map<std::string, tests::Cheat> cheats{
          {"phase against temperature", // ignores the wall that freezes
           [](tests::State &state)
           {
             std::ranges::fill(state.solid_fraction, 0);
             state.book(0);
           }},
          {"maximum principle",
           [](tests::State &state)
           {
             state.temperature.back() = 1.01;
             state.book(0);
           }},
          {"heat of sites",
           [](tests::State &state)
           {
             state.snapshot.heat.stored += 0.5;
             state.snapshot.heat.boundary += 0.5;
           }},
          {"heat of sources",
           [](tests::State &state)
           {
             state.snapshot.heat.sources += 0.5;
             state.snapshot.heat.boundary -= 0.5;
           }},
          {"front against phases", [](tests::State &state) {
             state.snapshot.front[0] = {&nowhere, 1};
           }}};
      for(const auto &[name, cheat] : cheats)
      {
        const RunRecord record = run_fake(FakeMethod("cheat", {}, 0.1, 1, cheat));
        EXPECT_EQ(record.status, RunStatus::failed) << name;
        for(const Check &check : record.checks)
          EXPECT_EQ(check.passed, check.name != name)
              << check.name << ", cheat: " << name;
      }
    }

    TEST(RunLabel, NamesOptionsAndThreads)
    {
      EXPECT_EQ(run_label("sph", {}, 1), "sph");
      EXPECT_EQ(run_label("sph", {{"step_factor", "1.1"}}, 1), "sph[step_factor=1.1]");
      EXPECT_EQ(run_label("sph", {{"a", "1"}, {"b", "2"}}, 2), "sph[a=1,b=2,threads=2]");
    }
  } // namespace
} // namespace meltfront::verification
