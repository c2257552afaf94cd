#include <cases/error.h>
#include <verification/external/tests/fixture.h>
#include <verification/external/tests/processes.h>
#include <verification/run/child_process.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace meltfront::verification
{
  namespace
  {
    using tests::ExternalTrial;
    using tests::manifest_of;

    void expect_text(const std::string &message, const std::string &text)
    {
      EXPECT_NE(message.find(text), std::string::npos) << message;
    }

    TEST(External, IsMeasuredAsAMethodOfOurs)
    {
      const RunRecord record = ExternalTrial(manifest_of("well")).run();
      ASSERT_EQ(record.status, RunStatus::finished) << record.message;
      EXPECT_LT(record.quantity("front_rms"), 1e-12);
      EXPECT_LT(record.quantity("temperature_l2"), 1e-12);
      EXPECT_LT(record.quantity("budget_defect"), 1e-12);
      EXPECT_EQ(record.series.time.size(), 101u);
      EXPECT_DOUBLE_EQ(record.description.spacing, 0.05);
      EXPECT_EQ(record.description.unknowns, 20);
      EXPECT_EQ(record.cost.steps, 100);
      EXPECT_EQ(record.cost.work, 7);
      EXPECT_EQ(record.description.parameters.front().value, "well");
      // A method of ours that knows the same solution.
      const tests::FakeMethod ours("ours", {}, 0);
      const RunRecord same
          = run_one(tests::slab_case("slab"), ours,
                    {20, cases::Options(ours.option_declarations())}, "ours", {});
      EXPECT_NEAR(record.quantity("temperature_max"), same.quantity("temperature_max"),
                  1e-12);
      EXPECT_EQ(record.quantities.size(), same.quantities.size());
    }

    TEST(External, CountsTheTimeAndMemoryOfTheProgram)
    {
      // Half a second of a shell's work, before the answer.
      auto manifest = manifest_of("well");
      manifest["command"]
          = {"/bin/sh", "-c",
             "i=0; while [ $i -lt 300000 ]; do i=$((i+1)); done; exec \"$0\" well",
             MELTFRONT_EXTERNAL_PROGRAM};
      const RunRecord record = ExternalTrial(manifest).run();
      ASSERT_EQ(record.status, RunStatus::finished) << record.message;
      EXPECT_GT(record.cost.stepping_cpu, 0.05);
      EXPECT_GE(record.cost.stepping_wall, 0.5 * record.cost.stepping_cpu);
      EXPECT_LT(record.cost.setup_cpu, 0.05);
      EXPECT_GT(record.peak_memory_mb, 1);
    }

    TEST(External, TakesTheCommandAndItsOptionsFromTheUser)
    {
      auto manifest = manifest_of("silent");
      manifest["options"] = {{{"key", "factor"},
                              {"default", 0.5},
                              {"lower", 0},
                              {"upper", 1},
                              {"description", "A number."}}};
      ExternalTrial trial(manifest);
      trial.resolution.options.set(
          "command", std::string("'") + MELTFRONT_EXTERNAL_PROGRAM + "' well");
      EXPECT_EQ(trial.run().status, RunStatus::finished);
      trial.resolution.options.set("options", "factor=0.7");
      EXPECT_EQ(trial.run().status, RunStatus::finished);
      for(const char *wrong : {"factor=2", "faktor=1", "factor"})
      {
        trial.resolution.options.set("options", wrong);
        const RunRecord record = trial.run();
        EXPECT_EQ(record.status, RunStatus::refused) << wrong;
        expect_text(record.message, "factor");
      }
    }

    /** A way to answer, and what the sentence says that the run failed with. */
    struct Lie
    {
      const char *how;
      std::vector<std::string> words;
    };

    class Liar : public testing::TestWithParam<Lie>
    {
    };

    TEST_P(Liar, EndsAsFailedWithASentence)
    {
      ExternalTrial trial(manifest_of(GetParam().how));
      trial.resolution.options.set("answer_limit", "0.01");
      const RunRecord record = trial.run();
      EXPECT_EQ(record.status, RunStatus::failed);
      expect_text(record.message, "external");
      for(const std::string &word : GetParam().words)
        expect_text(record.message, word);
      EXPECT_EQ(record.message.find('\n'), std::string::npos);
      EXPECT_LT(record.message.size(), 600u);
    }

    INSTANTIATE_TEST_SUITE_P(
        External, Liar,
        testing::Values(
            Lie{"front", {"front is reported at", "where no phase changes"}},
            Lie{"phase", {"phase is solid at", "above its melting temperature"}},
            Lie{"nan", {"line 52", "not JSON", "NaN"}},
            Lie{"null", {"line 52", "/temperature", "null"}},
            Lie{"word", {"line 52", "/solid_fraction", "solid"}},
            Lie{"silent", {"answered nothing"}},
            Lie{"crash", {"crashed (Segmentation fault)"}},
            Lie{"status", {"ended with status 3", "the matrix is singular"}},
            Lie{"endless", {"more than 0.01 GB", "answer_limit", "stopped"}},
            Lie{"endless messages", {"more than 0.01 GB", "stopped"}},
            Lie{"garbage", {"line 52", "not JSON"}},
            Lie{"sites", {"line 52", "19 temperatures for 20 sites"}},
            Lie{"weights", {"weights of 1.95", "volume is 1"}},
            Lie{"flat", {"19 weights for 20 sites"}},
            Lie{"coarse", {"spacing 0.9", "0.05"}},
            Lie{"time", {"line 52", "t = 0.51", "t = 0.5 was asked for"}},
            Lie{"missing", {"t = 0.51", "t = 0.5 was asked for"}},
            Lie{"twice", {"t = 0.5", "t = 0.51 was asked for"}},
            Lie{"stop", {"ends before the snapshot of t = 0.5"}},
            Lie{"more", {"follows the line that ends it", "bye"}},
            Lie{"fraction", {"solid fraction of 1.5"}}, Lie{"book", {"unaccounted for"}},
            Lie{"bookless", {"no 'heat'", "conserves"}},
            Lie{"hot", {"temperature is 7", "maximum principle"}},
            Lie{"surplus", {"line 52", "entropy"}}, Lie{"echo", {"kind 'start'"}}),
        [](const auto &info)
        {
          std::string name = info.param.how;
          std::ranges::replace(name, ' ', '_');
          return name;
        });

    TEST(External, PassesOverBlankLines)
    {
      EXPECT_EQ(ExternalTrial(manifest_of("blank")).run().status, RunStatus::finished);
    }

    TEST(External, RefusesAsTheProgramDoes)
    {
      const RunRecord record = ExternalTrial(manifest_of("refused")).run();
      EXPECT_EQ(record.status, RunStatus::refused);
      EXPECT_EQ(record.message, "external (test) refuses the scene: n is odd");
    }

    TEST(External, RefusesEverythingWithoutAManifest)
    {
      const auto method = make_external();
      const RunRecord record
          = run_one(tests::slab_case("slab"), *method,
                    {20, cases::Options(method->option_declarations())}, "external", {});
      EXPECT_EQ(record.status, RunStatus::refused);
      expect_text(record.message, "external takes nothing without a manifest");
      expect_text(record.message, "external.manifest=FILE");
    }

    TEST(External, RefusesByNameWhatTheManifestDoesNotDeclare)
    {
      auto manifest = manifest_of("well");
      manifest["shapes"][0]["walls"] = {"insulated"};
      RunRecord record = ExternalTrial(manifest).run();
      EXPECT_EQ(record.status, RunStatus::refused);
      expect_text(record.message, "no wall of the kind 'fixed temperature'");
      manifest = manifest_of("well");
      manifest["effects"] = {"wall_temperature"};
      record = ExternalTrial(manifest).run();
      EXPECT_EQ(record.status, RunStatus::refused);
      expect_text(record.message, "does not simulate phase_change");
      ExternalTrial threads(manifest_of("well"));
      threads.resolution.threads = 2;
      EXPECT_EQ(threads.run().status, RunStatus::refused);
    }

    TEST(External, IsLeftOutWhereSomethingIsMissing)
    {
      auto manifest = manifest_of("well");
      manifest["requires"] = {{"sh", "-c", "echo no such module >&2; exit 1"}};
      RunRecord record = ExternalTrial(manifest).run();
      EXPECT_EQ(record.status, RunStatus::refused);
      expect_text(record.message, "is left out on this machine");
      expect_text(record.message, "no such module");
      manifest["requires"]
          = nlohmann::json::array({nlohmann::json::array({"no-such-interpreter"})});
      record = ExternalTrial(manifest).run();
      EXPECT_EQ(record.status, RunStatus::refused);
      expect_text(record.message, "no program 'no-such-interpreter'");
    }

    TEST(External, IsAnotherRunWhenItsFilesAreOthers)
    {
      const auto method = make_external();
      ExternalTrial trial(manifest_of("well"));
      const auto before = method->further_provenance(trial.resolution.options);
      EXPECT_EQ(before, method->further_provenance(trial.resolution.options));
      EXPECT_EQ(trial.run().provenance.at("manifest_hash"), before.at("manifest_hash"));
      std::ofstream(trial.path()) << manifest_of("silent");
      EXPECT_NE(before, method->further_provenance(trial.resolution.options));
      const std::string script = trial.scratch.path("solver");
      trial.resolution.options.set("command", "sh " + script);
      std::ofstream(script) << "echo one";
      const auto with_one = method->further_provenance(trial.resolution.options);
      std::ofstream(script) << "echo two";
      EXPECT_NE(with_one, method->further_provenance(trial.resolution.options));
    }

    TEST(External, LeavesNoProcessBehindWhenItsTimeIsUp)
    {
      ExternalTrial trial(manifest_of("late"));
      const std::string file = trial.scratch.path("processes");
      trial.resolution.options.set("command", std::string(MELTFRONT_EXTERNAL_PROGRAM)
                                                  + " late " + file);
      ChildProcess run([&] { trial.run(); }, trial.scratch.path("log"));
      int program = 0, other = 0;
      ASSERT_TRUE(tests::comes_true(
          [&] { return static_cast<bool>(std::ifstream(file) >> program >> other); }));
      EXPECT_TRUE(tests::runs(program));
      EXPECT_TRUE(tests::runs(other));
      run.kill();
      EXPECT_TRUE(tests::comes_true(
          [&] { return !tests::runs(program) && !tests::runs(other); }));
    }
  } // namespace
} // namespace meltfront::verification
