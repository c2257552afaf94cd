#include <cases/case_file/case_file.h>
#include <cases/error.h>
#include <verification/app/methods.h>
#include <verification/record/temporary_directory.h>
#include <verification/run/child_process.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <map>
#include <span>
#include <string>
#include <thread>
#include <vector>

namespace meltfront::verification
{
  namespace
  {
    /** A small scene that a method solves, the first part of it. */
    struct Trial
    {
      std::string case_name;
      int n;
      double share; ///< of the scene's time
      std::vector<std::pair<std::string, std::string>> options{};
    };

    /** By the method's name. With a method that is added comes a trial of it. */
    /** Large enough that a method uses its threads: particles share their work from some
     * 8000 exchanges on. */
    const std::map<std::string, Trial> &trials()
    {
      static const std::map<std::string, Trial> list{
          {"sph", {"line-sink", 100, 1e-4}},
          {"sph-2005", {"line-sink", 101, 1e-4}},
          {"sph-mixture", {"alloy-unit", 9000, 1e-9}},
          {"sph-two-population", {"alloy-unit", 40, 0.01}},
          {"sph-two-population-2005", {"alloy-unit", 40, 0.01}},
          {"rkpm-point-collocation", {"rkpm-wave-2d", 20, 1}},
          {"rkpm-fixed-point", {"rkpm-wave-2d", 20, 1}},
          {"rkpm-moving", {"rkpm-wave-2d", 20, 1}},
          {"rkpm-multiple-fixed", {"rkpm-wave-2d", 20, 1}},
          {"rkpm-derivative-free", {"rkpm-wave-2d", 20, 1}},
          {"moab-integral", {"heat-wave-2d", 20, 1}},
          {"voronoi-fv", {"rkpm-wave-2d", 20, 1}},
          {"rkpm-tracked", {"merging-disks", 20, 0.02}},
          {"greenspan", {"greenspan-rectangle-free", 120, 0.01}},
          {"level-set", {"circle-in-vortex", 64, 0.02}},
          {"level-set-particle", {"circle-in-vortex", 64, 0.02}},
          {"level-set-particle-corrected", {"circle-in-vortex", 64, 0.02}},
          {"level-set-interpolative", {"circle-in-vortex", 64, 0.02}},
          {"fem-enthalpy", {"plane-freezing", 20, 1}},
          {"fem-fitted", {"plane-freezing-started", 20, 1}},
          {"fem-cut", {"merging-disks", 20, 1}},
      };
      return list;
    }

    /** Writes all that snapshots hold to a file, bit by bit. */
    class Recorder : public cases::Observer
    {
    public:
      explicit Recorder(const std::string &file)
        : out(file, std::ios::binary)
      {
      }

      bool wants(long step, double) override
      {
        return step % 7 == 0;
      }

      void observe(const cases::Snapshot &snapshot) override
      {
        write(std::span(&snapshot.time, 1));
        for(int d = 0; d < 3; ++d)
        {
          write(snapshot.positions[d]);
          write(snapshot.front[d]);
        }
        write(snapshot.weights);
        write(snapshot.temperature);
        write(snapshot.solid_fraction);
      }

    private:
      void write(std::span<const double> values)
      {
        out.write(reinterpret_cast<const char *>(values.data()),
                  static_cast<std::streamsize>(values.size_bytes()));
      }

      std::ofstream out;
    };

    /** Threads that this process has, idle ones of OpenMP included. */
    int threads_of_process()
    {
      std::ifstream in("/proc/self/status");
      for(std::string word; in >> word;)
        if(int number = 0; word == "Threads:" && in >> number)
          return number;
      return 0;
    }

    /** A scene of the library as a method simulates it. */
    struct Simulated
    {
      explicit Simulated(const Trial &trial)
        : full(cases::load_case(trial.case_name).scene)
        , effects(cases::effects_called_for(full))
        , scene(cases::simulated_scene(full, effects))
      {
        if(scene.particle_solid) // more particles than a table has
        {
          scene.particle_solid->arrangement = cases::SolidArrangement::rectangle;
          scene.particle_solid->rows = 80;
        }
        scene.end_time
            = scene.start_time + trial.share * (scene.end_time - scene.start_time);
      }

      cases::Scene full;
      cases::EffectSet effects;
      cases::Scene scene;
    };

    cases::Resolution resolution_of(const cases::Method &method, const Trial &trial,
                                    int threads)
    {
      cases::Resolution result{trial.n, cases::Options(method.option_declarations()), 1,
                               threads};
      for(const auto &[key, value] : trial.options)
        result.options.set(key, value);
      return result;
    }

    std::string contents(const std::string &file)
    {
      std::ifstream in(file, std::ios::binary);
      return {std::istreambuf_iterator<char>(in), {}};
    }

    /** What came out of a run in a process of its own. */
    struct Outcome
    {
      std::string bits;
      int threads = 0;
    };

    Outcome solve(const cases::Method &method, const Trial &trial, int threads)
    {
      const TemporaryDirectory directory;
      const std::string bits = (directory.path() / "bits").string(),
                        count = (directory.path() / "threads").string(),
                        log = (directory.path() / "log").string();
      ChildProcess child(
          [&]
          {
            const Simulated simulated(trial);
            Recorder recorder(bits);
            method.solve(simulated.scene, simulated.effects,
                         resolution_of(method, trial, threads), recorder);
            std::ofstream(count) << threads_of_process();
          },
          log);
      while(!child.ended())
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
      EXPECT_EQ(child.end().problem(), "") << contents(log);
      Outcome outcome{contents(bits)};
      std::ifstream(count) >> outcome.threads;
      return outcome;
    }

    class Threads : public testing::TestWithParam<std::string>
    {
    };

    TEST_P(Threads, AreUsedAndGiveTheSameBitsOrAreRefused)
    {
      const cases::Method &method = method_named(GetParam());
      ASSERT_TRUE(trials().contains(GetParam())) << "has no trial";
      const Trial &trial = trials().at(GetParam());
      const Simulated simulated(trial);
      const cases::Capabilities form
          = cases::require_capable(method, simulated.scene, simulated.effects, 1);
      if(form.most_threads == 1)
      {
        EXPECT_THROW(
            cases::require_capable(method, simulated.scene, simulated.effects, 2),
            cases::Refusal);
        return;
      }
      const Outcome one = solve(method, trial, 1), two = solve(method, trial, 2);
      EXPECT_GT(one.bits.size(), 1000);
      EXPECT_TRUE(one.bits == two.bits);
      EXPECT_GT(two.threads, one.threads);
    }

    std::vector<std::string> all_methods()
    {
      std::vector<std::string> names;
      for(const auto &method : methods())
        if(!method->capabilities().empty()) // else its options tell
          names.push_back(method->name());
      return names;
    }

    std::string test_name(const testing::TestParamInfo<std::string> &info)
    {
      std::string name = info.param;
      std::ranges::replace(name, '-', '_');
      return name;
    }

    INSTANTIATE_TEST_SUITE_P(Methods, Threads, testing::ValuesIn(all_methods()),
                             test_name);

    TEST(ThreadsOfTheTrackedFront, AreOneAlongALine)
    {
      const Simulated simulated({"plane-freezing", 20, 1});
      const cases::Method &method = method_named("rkpm-tracked");
      EXPECT_NO_THROW(
          cases::require_capable(method, simulated.scene, simulated.effects, 1));
      EXPECT_THROW(cases::require_capable(method, simulated.scene, simulated.effects, 2),
                   cases::Refusal);
    }
  } // namespace
} // namespace meltfront::verification
