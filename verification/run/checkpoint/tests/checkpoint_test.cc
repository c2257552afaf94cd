#include <verification/record/json_values.h>
#include <verification/run/checkpoint/checkpoint_keeper.h>
#include <verification/run/run_one.h>
#include <verification/run/tests/fakes.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>

namespace meltfront::verification
{
  namespace
  {
    namespace fs = std::filesystem;
    using tests::FakeMethod;

    const nlohmann::json request{{"case", "slab"}, {"program", {{"compiler", "g++"}}}};

    struct Interruption : cases::OutputError
    {
      Interruption()
        : OutputError("the end of the world")
      {
      }
    };

    /** A run that is interrupted when it shows a state for the nth time; 0: never. */
    RunRecord run_kept(const CheckpointFolder *folder, int interrupted_at = 0)
    {
      int shown = 0;
      const FakeMethod method("fake", {}, 0.1, 1,
                              [&](auto &)
                              {
                                if(++shown == interrupted_at)
                                  throw Interruption();
                              });
      cases::Resolution resolution{20, cases::Options(method.option_declarations()), 1,
                                   1};
      resolution.options.set("checkpoint", "1e-9");
      RepeatPolicy once;
      once.most = 1;
      std::map<std::string, double> evidence;
      RunRecord record = run_one(
          tests::slab_case("slab"), method, resolution, "fake", {}, nullptr, once,
          [&](cases::Observer &observer) -> std::unique_ptr<cases::Observer>
          {
            if(!folder)
              return nullptr;
            return std::make_unique<CheckpointKeeper>(*folder, 1e-9, observer, evidence);
          });
      record.cost.evidence.merge(evidence);
      return record;
    }

    /** What a record says of the run itself, not of when and how long. */
    nlohmann::json outcome_of(RunRecord record)
    {
      record.cost.evidence.clear();
      nlohmann::json json = record;
      for(const char *of_the_machine :
          {"times", "peak_memory_mb", "provenance", "cpu_seconds", "wall_seconds"})
        json.erase(of_the_machine);
      for(const char *time : {"setup_wall", "setup_cpu", "stepping_wall", "stepping_cpu"})
        json["cost"].erase(time);
      return json;
    }

    class Checkpoints : public testing::Test
    {
    protected:
      Checkpoints()
      {
        folder.begin(request);
      }

      std::string file(const std::string &name) const
      {
        return scratch.path("checkpoint/" + name);
      }

      void interrupt(int at = 30)
      {
        EXPECT_THROW(run_kept(&folder, at), Interruption);
        ASSERT_TRUE(folder.last());
      }

      void expect_no_resumption(const std::string &because) const
      {
        try
        {
          folder.last();
          ADD_FAILURE() << "resumed";
        }
        catch(const cases::InputError &error)
        {
          EXPECT_NE(std::string(error.what()).find(because), std::string::npos)
              << error.what();
        }
      }

      tests::ScratchDirectory scratch;
      CheckpointFolder folder = CheckpointFolder::in(scratch.path());
    };

    TEST_F(Checkpoints, AResumedRunIsThatWhichWasNeverLeft)
    {
      const nlohmann::json whole = outcome_of(run_kept(&folder));
      EXPECT_EQ(outcome_of(run_kept(nullptr)).at("series"), whole.at("series"));
      for(const int at : {2, 17, 40})
      {
        folder.remove();
        folder.begin(request);
        interrupt(at);
        interrupt(5); // and once more
        const RunRecord resumed = run_kept(&folder);
        EXPECT_EQ(resumed.cost.evidence.at("times resumed"), 2);
        EXPECT_GT(resumed.cost.evidence.at("last resumed after step"), 1);
        const nlohmann::json difference
            = nlohmann::json::diff(whole, outcome_of(resumed));
        EXPECT_TRUE(difference.empty()) << difference.dump(1);
      }
    }

    TEST_F(Checkpoints, BeginsAtTheStartBeforeTheFirstOne)
    {
      EXPECT_FALSE(folder.last());
      const RunRecord record = run_kept(&folder);
      EXPECT_EQ(record.status, RunStatus::finished);
      EXPECT_FALSE(record.cost.evidence.contains("times resumed"));
    }

    TEST_F(Checkpoints, AnUnfinishedRunIsNotOverwritten)
    {
      interrupt();
      const std::string state = tests::text_of(file("state.bin"));
      EXPECT_THROW(folder.begin(request), cases::InputError);
      EXPECT_EQ(tests::text_of(file("state.bin")), state);
    }

    TEST_F(Checkpoints, DamageIsFound)
    {
      interrupt();
      const std::string whole = tests::text_of(file("state.bin"));
      const auto replace = [&](const std::string &text)
      { std::ofstream(file("state.bin"), std::ios::binary) << text; };
      for(const std::size_t length : {std::size_t(0), std::size_t(20), whole.size() - 1})
      {
        replace(whole.substr(0, length));
        expect_no_resumption(length > 100 ? "is damaged or cut off" : "is no checkpoint");
      }
      std::string flipped = whole;
      flipped.back() = static_cast<char>(flipped.back() ^ 1);
      replace(flipped);
      expect_no_resumption("is damaged or cut off");
      replace(whole);
      EXPECT_TRUE(folder.last());
      fs::resize_file(file("observed.bin"), 10);
      expect_no_resumption("observed.bin is cut off");
    }

    TEST_F(Checkpoints, DamagedObservationsAreFound)
    {
      interrupt();
      const std::string whole = tests::text_of(file("observed.bin"));
      for(const std::size_t at : {std::size_t(0), std::size_t(30), whole.size() / 2})
      {
        std::string flipped = whole;
        flipped[at] = static_cast<char>(flipped[at] ^ 64);
        std::ofstream(file("observed.bin"), std::ios::binary) << flipped;
        EXPECT_THROW(run_kept(&folder), cases::OutputError);
      }
      std::ofstream(file("observed.bin"), std::ios::binary) << whole;
      EXPECT_EQ(run_kept(&folder).status, RunStatus::finished);
    }

    TEST_F(Checkpoints, AnotherRunsStateIsFound)
    {
      interrupt();
      nlohmann::json other = request;
      other["case"] = "pipe";
      write_json(file("request.json"), other);
      expect_no_resumption("is the checkpoint of another run");
    }

    TEST_F(Checkpoints, AnotherProgramsRunIsNotResumed)
    {
      EXPECT_EQ(folder.request({{"compiler", "g++"}}), request);
      EXPECT_THROW(folder.request({{"compiler", "clang"}}), cases::InputError);
      for(const char *damaged : {"{", "\"case\"", "3", "{}", R"({"program": "g++"})"})
      {
        std::ofstream(file("request.json")) << damaged;
        EXPECT_THROW(folder.request({{"compiler", "g++"}}), cases::InputError) << damaged;
      }
      folder.remove();
      EXPECT_THROW(folder.request({}), cases::InputError);
    }

    /** A file that cannot be written ends the run in one sentence; the checkpoint before
     * stays. */
    TEST_F(Checkpoints, StayWhereTheNextCannotBeWritten)
    {
      interrupt(10);
      const long step = folder.last()->step;
      fs::create_directory(file("state.bin.part"));
      EXPECT_THROW(run_kept(&folder), cases::OutputError);
      EXPECT_EQ(folder.last()->step, step);
      fs::remove(file("state.bin.part"));
      EXPECT_EQ(run_kept(&folder).status, RunStatus::finished);
    }
  } // namespace
} // namespace meltfront::verification
