#include <cases/case_file/case_file.h>
#include <cases/error.h>
#include <verification/app/methods.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace meltfront::verification
{
  namespace
  {
    /** A run that no machine can make: too large, or by its options too long. */
    struct Impossible
    {
      std::string method, case_name;
      int n;
      std::vector<std::pair<std::string, std::string>> options;
      std::string reason; ///< of the refusal, a part of it
    };

    const std::string memory = "GB of memory", steps = "time steps";

    const std::vector<Impossible> &impossible()
    {
      static const std::vector<Impossible> list{
          {"sph", "line-sink", 1'000'000, {}, memory},
          {"sph", "plane-freezing", 40, {{"step_factor", "1e-20"}}, steps},
          {"sph",
           "plane-freezing",
           40,
           {{"time_scheme", "backward-euler"}, {"step_factor", "1e-20"}},
           steps},
          {"sph", "plane-freezing", 1'000'000'000, {{"refine", "time"}}, steps},
          {"sph-2005", "plane-freezing-2005", 1'000'000, {}, memory},
          {"sph-mixture", "alloy-unit", 1'000'000, {}, steps},
          {"sph-two-population", "alloy-unit", 40, {{"steps", "1000000000"}}, steps},
          {"sph-two-population-2005", "alloy-unit", 1'000'000, {}, steps},
          {"rkpm-point-collocation", "rkpm-wave-2d", 1'000'000, {}, memory},
          {"rkpm-fixed-point", "heat-wave-2d", 20, {{"steps", "1000000000"}}, steps},
          {"rkpm-moving", "rkpm-wave-2d", 1'000'000, {}, memory},
          {"rkpm-multiple-fixed", "rkpm-wave-2d", 1'000'000, {}, memory},
          {"rkpm-derivative-free", "rkpm-wave-2d", 1'000'000, {}, memory},
          {"moab-integral", "heat-wave-2d", 1'000'000, {}, memory},
          {"moab-integral", "heat-wave-2d", 20, {{"steps", "1000000000"}}, steps},
          {"voronoi-fv", "rkpm-wave-2d", 1'000'000, {}, memory},
          {"rkpm-tracked", "merging-disks", 1'000'000, {}, memory},
          {"greenspan", "greenspan-triangle-free", 1'000'000, {}, memory},
          {"greenspan",
           "greenspan-rectangle-free",
           15'000,
           {{"neighbours", "all-pairs"}},
           memory},
          {"level-set", "sphere-in-deformation", 1'000'000, {}, memory},
          {"level-set-particle", "circle-in-vortex", 1'000'000, {}, memory},
          {"level-set-particle-corrected", "circle-in-vortex", 1'000'000, {}, memory},
          {"level-set-interpolative", "circle-in-vortex", 1'000'000, {}, memory},
          {"fem-enthalpy", "merging-disks", 1'000'000, {}, memory},
          {"fem-enthalpy", "plane-freezing", 40, {{"steps", "100000000"}}, steps},
          {"fem-cut", "merging-disks", 1'000'000, {}, memory},
          {"fem-cut", "merging-disks", 40, {{"fewest_steps", "1000000000"}}, steps}};
      return list;
    }

    class NothingWanted : public cases::Observer
    {
      bool wants(long, double) override
      {
        return false;
      }

      void observe(const cases::Snapshot &) override
      {
      }
    };

    class Demands : public testing::TestWithParam<Impossible>
    {
    };

    TEST_P(Demands, AreRefusedInAdvance)
    {
      const Impossible &trial = GetParam();
      const cases::Method &method = method_named(trial.method);
      cases::Scene full = cases::load_case(trial.case_name).scene;
      if(full.particle_solid) // of any number of particles, not of a table
        full.particle_solid->arrangement
            = trial.case_name.find("triangle") == std::string::npos
                  ? cases::SolidArrangement::rectangle
                  : cases::SolidArrangement::triangle;
      const cases::EffectSet effects = cases::effects_called_for(full);
      const cases::Scene scene = cases::simulated_scene(full, effects);
      cases::Resolution resolution{trial.n, cases::Options(method.option_declarations())};
      resolution.memory_limit = 32e9;
      for(const auto &[key, value] : trial.options)
        resolution.options.set(key, value);
      NothingWanted none;
      try
      {
        method.solve(scene, effects, resolution, none);
        FAIL() << "was run";
      }
      catch(const cases::Refusal &refusal)
      {
        EXPECT_NE(std::string(refusal.what()).find(trial.reason), std::string::npos)
            << refusal.what();
      }
    }

    std::string test_name(const testing::TestParamInfo<Impossible> &info)
    {
      std::string name = info.param.method + "_" + std::to_string(info.index);
      std::ranges::replace(name, '-', '_');
      return name;
    }

    INSTANTIATE_TEST_SUITE_P(Methods, Demands, testing::ValuesIn(impossible()),
                             test_name);

    /** All methods that estimate what they take are tried above; what an external program
     * takes nobody knows. */
    TEST(DemandsOfAll, AreTried)
    {
      for(const auto &method : methods())
      {
        const auto tries
            = [&](const Impossible &trial) { return trial.method == method->name(); };
        EXPECT_TRUE(method->name() == "fem-fitted" || method->name() == "external"
                    || std::ranges::any_of(impossible(), tries))
            << method->name();
      }
    }
  } // namespace
} // namespace meltfront::verification
