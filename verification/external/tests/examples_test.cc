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

    TEST(Examples, HaveManifestsAsTheSchemaSaysAndFewLines)
    {
      int count = 0;
      for(const auto &file :
          std::filesystem::directory_iterator(external::folder_path("examples")))
        if(file.path().extension() == ".json")
        {
          const external::Manifest manifest = external::read_manifest(file.path());
          EXPECT_EQ(manifest.name, file.path().stem());
          ++count;
        }
        else
        {
          std::ifstream in(file.path());
          int lines = 0;
          for(std::string line; std::getline(in, line);)
            ++lines;
          EXPECT_LT(lines, 100) << file.path();
        }
      EXPECT_GE(count, 1);
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

    TEST(Examples, RefuseAsTheirManifestsSay)
    {
      const RunRecord sink = run("enthalpy-numpy", "line-sink", 20);
      EXPECT_EQ(sink.status, RunStatus::refused);
      EXPECT_NE(sink.message.find("heat_sources"), std::string::npos) << sink.message;
    }
  } // namespace
} // namespace meltfront::verification
