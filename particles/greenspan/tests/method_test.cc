// The method on scenes: that it is the experiment, what it refuses, checkpoints.

#include <cases/error.h>
#include <cases/method.h>
#include <cases/scene.h>
#include <particles/greenspan/greenspan.h>
#include <particles/greenspan/scene_experiment.h>
#include <particles/greenspan/tests/report_runs.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>

namespace meltfront::particles::greenspan
{
  namespace
  {
    /** Keeps the last state and all outcomes; may end the run as a kill would. */
    class Recorder : public cases::Observer
    {
    public:
      struct Killed
      {
      };

      bool wants(long step, double) override
      {
        if(step == kill_at)
          throw Killed();
        return step % 1000 == 0;
      }

      void observe(const cases::Snapshot &snapshot) override
      {
        for(int d = 0; d < 2; ++d)
        {
          position[d].assign(snapshot.positions[d].begin(), snapshot.positions[d].end());
          velocity[d].assign(snapshot.velocity[d].begin(), snapshot.velocity[d].end());
        }
        time = snapshot.time;
      }

      void report(const std::string &name, double value) override
      {
        outcomes[name] = value;
      }

      long kill_at = -1;
      double time = 0;
      std::array<std::vector<double>, 2> position, velocity;
      std::map<std::string, double> outcomes;
    };

    cases::Scene fast_scene(double end_time)
    {
      cases::Scene scene;
      scene.name = "fast";
      scene.problem = cases::ProblemKind::particle_solid;
      scene.end_time = end_time;
      cases::ParticleSolid solid;
      solid.gravity = 32;
      solid.disturbance = 1e-6;
      solid.base = cases::SolidBase{};
      solid.heating = cases::PointHeating{{0.2, 5.8, 0}, {{30000, 0.02}}, -2, 2.5};
      scene.particle_solid = solid;
      return scene;
    }

    cases::Resolution resolution_of(int n,
                                    const std::map<std::string, std::string> &set = {})
    {
      cases::Resolution resolution;
      resolution.n = n;
      resolution.options = cases::Options(make_greenspan()->option_declarations());
      for(const auto &[key, value] : set)
        resolution.options.set(key, value);
      return resolution;
    }

    cases::Cost solve(const cases::Scene &scene, const cases::Resolution &resolution,
                      Recorder &recorder)
    {
      const cases::EffectSet effects = cases::effects_called_for(scene);
      return make_greenspan()->solve(cases::simulated_scene(scene, effects), effects,
                                     resolution, recorder);
    }

    TEST(GreenspanMethod, RunsTheExperimentThatTheReportDescribes)
    {
      const cases::Scene scene = fast_scene(0.5);
      Recorder recorder;
      const cases::Cost cost = solve(scene, resolution_of(28), recorder);
      EXPECT_EQ(cost.steps, 5000);
      EXPECT_EQ(cost.effects.size(), 3u);
      Experiment experiment = triangle_fast(-2);
      experiment.steps = 5000;
      disturb(experiment.start, 1e-6, 1);
      const RunRecord record = run(experiment);
      EXPECT_EQ(recorder.outcomes.at("first_break"), record.first_break);
      EXPECT_EQ(recorder.outcomes.at("bonds_kept"), record.old_bonds);
      EXPECT_EQ(recorder.outcomes.at("kinetic_energy_end"), record.kinetic_energy);
      EXPECT_EQ(recorder.outcomes.at("fluid_end"),
                static_cast<double>(record.final_fluid.size()));
      EXPECT_EQ(recorder.time, 0.5);
    }

    TEST(GreenspanMethod, AKilledRunGoesOnFromItsCheckpointBitForBit)
    {
      const std::string file
          = (std::filesystem::temp_directory_path() / "meltfront-checkpoint-test")
                .string();
      std::filesystem::remove(file);
      const cases::Scene scene = fast_scene(0.5);
      Recorder whole;
      solve(scene, resolution_of(28), whole);

      const cases::Resolution saved
          = resolution_of(28, {{"checkpoint", file}, {"checkpoint_interval", "1500"}});
      Recorder killed;
      killed.kill_at = 3800;
      EXPECT_THROW(solve(scene, saved, killed), Recorder::Killed);
      ASSERT_TRUE(std::filesystem::exists(file));
      Recorder resumed;
      solve(scene, saved, resumed);
      EXPECT_FALSE(std::filesystem::exists(file));
      EXPECT_EQ(resumed.position, whole.position);
      EXPECT_EQ(resumed.velocity, whole.velocity);
      ASSERT_EQ(resumed.outcomes.size(), whole.outcomes.size());
      for(const auto &[name, value] : whole.outcomes)
      {
        const double after = resumed.outcomes.at(name);
        EXPECT_TRUE(after == value || (std::isnan(after) && std::isnan(value))) << name;
      }
    }

    TEST(GreenspanMethod, RefusesTheCheckpointOfAnotherRunAndWhatIsNone)
    {
      const std::string file
          = (std::filesystem::temp_directory_path() / "meltfront-checkpoint-bad")
                .string();
      std::filesystem::remove(file);
      cases::Resolution saved
          = resolution_of(28, {{"checkpoint", file}, {"checkpoint_interval", "1000"}});
      Recorder killed;
      killed.kill_at = 2500;
      EXPECT_THROW(solve(fast_scene(0.5), saved, killed), Recorder::Killed);
      Recorder other;
      EXPECT_THROW(solve(fast_scene(0.6), saved, other), cases::InputError);
      saved.seed = 2;
      EXPECT_THROW(solve(fast_scene(0.5), saved, other), cases::InputError);
      std::ofstream(file) << "no checkpoint";
      EXPECT_THROW(solve(fast_scene(0.5), saved, other), cases::InputError);
      std::filesystem::remove(file);
      saved = resolution_of(28, {{"checkpoint", file}, {"checkpoint_interval", "150"}});
      EXPECT_THROW(solve(fast_scene(0.5), saved, other), cases::Refusal);
    }

    TEST(GreenspanMethod, RefusesWhatDoesNotFitTheSolid)
    {
      Recorder recorder;
      EXPECT_THROW(solve(fast_scene(0.1), resolution_of(40), recorder), cases::Refusal);
      EXPECT_THROW(
          solve(fast_scene(0.1), resolution_of(28, {{"step_factor", "2"}}), recorder),
          cases::Refusal);
      cases::Scene corners = fast_scene(0.1);
      corners.particle_solid->corners = {29};
      EXPECT_THROW(solve(corners, resolution_of(28), recorder), cases::Refusal);
      cases::Scene crowded = fast_scene(0.1); // 28 spacings across, in space of 20
      crowded.particle_solid->arrangement = cases::SolidArrangement::disk;
      crowded.particle_solid->cell = {20, 20};
      EXPECT_THROW(solve(crowded, resolution_of(28), recorder), cases::Refusal);
    }

    TEST(GreenspanMethod, StopsInTheStepInWhichTheMotionBreaks)
    {
      cases::Scene scene = fast_scene(1);
      scene.particle_solid->heating->stages = {{100, 0.01}, {10000, 1e3}};
      Recorder recorder;
      try
      {
        solve(scene, resolution_of(28), recorder);
        FAIL() << "the motion broke unseen";
      }
      catch(const cases::NumericalError &error)
      {
        // kicked in step 101, too far in the next
        EXPECT_NE(std::string(error.what()).find("step 102"), std::string::npos)
            << error.what();
      }
    }

    TEST(GreenspanMethod, LaysGeneratedSolidsToRestAndTheyStay)
    {
      cases::Scene scene = fast_scene(0.5);
      scene.particle_solid->arrangement = cases::SolidArrangement::triangle;
      scene.particle_solid->heating.reset();
      Recorder recorder;
      solve(scene, resolution_of(7), recorder);
      EXPECT_EQ(recorder.outcomes.at("bonds_kept"), 63);
      EXPECT_EQ(recorder.position[0].size(), 28u);
    }
  } // namespace
} // namespace meltfront::particles::greenspan
