#include <cases/case_file/case_file.h>
#include <verification/external/external.h>
#include <verification/external/manifest.h>
#include <verification/external/protocol.h>
#include <verification/run/run_one.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace meltfront::verification
{
  namespace
  {
    RunRecord run(const std::string &example, const std::string &case_name, int n)
    {
      const auto method = make_external();
      cases::Resolution resolution{n, cases::Options(method->option_declarations())};
      resolution.options.set("manifest", example);
      return run_one(cases::load_case(case_name), *method, resolution, "external", {},
                     nullptr, {1, 0, 0});
    }

    bool left_out(const RunRecord &record)
    {
      return record.status == RunStatus::refused
             && record.message.find("is left out on this machine") != std::string::npos;
    }

    /** @return manifests */
    int check_folder(const std::string &folder, int most_lines)
    {
      int count = 0;
      for(const auto &file :
          std::filesystem::directory_iterator(external::folder_path(folder)))
        if(file.path().extension() == ".json")
        {
          const std::string name = file.path().stem();
          EXPECT_EQ(external::read_manifest(file.path()).name, name);
          EXPECT_EQ(external::manifest_path(name), file.path());
          ++count;
        }
        else if(file.path().extension() != ".md")
        {
          std::ifstream in(file.path());
          int lines = 0;
          for(std::string line; std::getline(in, line);)
            ++lines;
          EXPECT_LT(lines, most_lines) << file.path();
        }
      return count;
    }

    TEST(Examples, HaveManifestsAsTheSchemaSaysAndFewLines)
    {
      EXPECT_GE(check_folder("examples", 100), 1);
      EXPECT_GE(check_folder("benchmarks", 200), 1);
    }

    TEST(Examples, EnthalpyWithNumpySolvesASlab)
    {
      const RunRecord coarse = run("enthalpy-numpy", "plane-freezing", 20);
      if(left_out(coarse))
        GTEST_SKIP() << coarse.message;
      ASSERT_EQ(coarse.status, RunStatus::finished) << coarse.message;
      const RunRecord fine = run("enthalpy-numpy", "plane-freezing", 80);
      ASSERT_EQ(fine.status, RunStatus::finished) << fine.message;
      EXPECT_LT(fine.quantity("front_rms"), 0.5 * coarse.quantity("front_rms"));
      EXPECT_LT(fine.quantity("front_rms"), 5e-3);
      EXPECT_LT(fine.quantity("budget_defect"), 1e-12);
    }

    TEST(Examples, EnthalpyWithNumpySolvesABox)
    {
      const RunRecord decay = run("enthalpy-numpy", "heat-decay-square", 20);
      if(left_out(decay))
        GTEST_SKIP() << decay.message;
      ASSERT_EQ(decay.status, RunStatus::finished) << decay.message;
      EXPECT_LT(decay.quantity("temperature_l2"), 0.02);
      const RunRecord corner = run("enthalpy-numpy", "corner-freezing", 32);
      ASSERT_EQ(corner.status, RunStatus::finished) << corner.message;
      // The volume of the similar problem.
      EXPECT_NEAR(corner.quantity("solid_volume_end"), 0.26772, 0.01);
    }

    TEST(Examples, EnthalpyWithFreefemSolvesABox)
    {
      const RunRecord corner = run("enthalpy-freefem", "corner-freezing", 32);
      if(left_out(corner))
        GTEST_SKIP() << corner.message;
      ASSERT_EQ(corner.status, RunStatus::finished) << corner.message;
      // The volume of the similar problem.
      EXPECT_NEAR(corner.quantity("solid_volume_end"), 0.26772, 0.01);
      EXPECT_LT(corner.quantity("budget_defect"), 1e-12);
    }

    /** That of fem-enthalpy with as many steps is 2.98e-3 m. */
    void expect_a_small_front_error(const std::string &program)
    {
      const RunRecord sink = run(program, "line-sink-square", 16);
      if(left_out(sink))
        GTEST_SKIP() << sink.message;
      ASSERT_EQ(sink.status, RunStatus::finished) << sink.message;
      EXPECT_LT(sink.quantity("front_rms"), 3.3e-3);
      EXPECT_LT(sink.quantity("budget_defect"), 1e-12);
    }

    TEST(Benchmarks, FreefemSolvesALineSink)
    {
      expect_a_small_front_error("stefan-freefem");
    }

    TEST(Benchmarks, DolfinxSolvesALineSink)
    {
      expect_a_small_front_error("stefan-dolfinx");
    }

    TEST(Examples, RefuseAsTheirManifestsSay)
    {
      const RunRecord sink = run("enthalpy-numpy", "line-sink", 20);
      EXPECT_EQ(sink.status, RunStatus::refused);
      EXPECT_NE(sink.message.find("heat_sources"), std::string::npos) << sink.message;
    }
  } // namespace
} // namespace meltfront::verification
