#include <verification/app/tests/run_program.h>

namespace meltfront::verification::tests
{
  namespace
  {
    nlohmann::json outcome(const fs::path &directory)
    {
      nlohmann::json run = read_json(directory / "run.json");
      return {run.at("quantities"), run.at("series"), run.at("profile"),
              run.at("cost").at("steps"), run.at("cost").at("work")};
    }

    /** Killed again and again, at any moment, it ends with the same results. */
    TEST(Program, ResumesARunThatWasKilled)
    {
      const TemporaryDirectory scratch;
      const std::string run
          = "run corner-freezing --method fem-enthalpy --n 64 --frames 3 "
            "--set fem-enthalpy.checkpoint=0.02";
      ASSERT_EQ(run_program(run + " --out " + scratch.path("whole").string()).status, 0);
      EXPECT_FALSE(fs::exists(scratch.path("whole") / "checkpoint"));

      const std::string killed = scratch.path("killed").string();
      double seconds = 0.3;
      for(int k = 0; k < 12 && !fs::exists(killed + "/run.json"); ++k, seconds *= 1.4)
        run_and_kill(fs::exists(killed + "/checkpoint/request.json")
                         ? "run --resume " + killed
                         : run + " --out " + killed,
                     seconds);
      EXPECT_EQ(outcome(killed), outcome(scratch.path("whole")));
      for(const fs::directory_entry &entry :
          fs::directory_iterator(scratch.path("whole")))
        EXPECT_TRUE(fs::exists(killed / entry.path().filename())) << entry.path();
    }

    /** greenspan's option of that name is a file. */
    TEST(Program, RunsWhatKeepsCheckpointsOfItsOwn)
    {
      const TemporaryDirectory scratch;
      const Outcome run = run_program("run greenspan-triangle-fast --method greenspan "
                                      "--n 28 --set greenspan.checkpoint="
                                      + scratch.path("state").string() + " --out "
                                      + scratch.path("run").string());
      EXPECT_EQ(run.status, 0) << run.output;
      EXPECT_FALSE(fs::exists(scratch.path("state"))); // it has served
    }

    TEST(Program, SaysWhatItCannotResume)
    {
      const TemporaryDirectory scratch;
      const Outcome nothing = run_program("run --resume " + scratch.path().string());
      EXPECT_EQ(nothing.status, 2);
      expect_text(nothing, "holds no run to resume");
      const Outcome without_case = run_program("run --method fem-enthalpy");
      EXPECT_EQ(without_case.status, 2);
      expect_text(without_case, "run needs a case");
      const Outcome other_method
          = run_program("run plane-freezing-started --method sph --n 20 --set "
                        "sph.checkpoint=10 --out "
                        + scratch.path("sph").string());
      EXPECT_EQ(other_method.status, 2);
      expect_text(other_method, "checkpoint");
      const Outcome alloy
          = run_program("run alloy-sodium-nitrate --method fem-enthalpy --n 20 --set "
                        "fem-enthalpy.checkpoint=10 --out "
                        + scratch.path("alloy").string());
      EXPECT_EQ(alloy.status, 2);
      expect_text(alloy, "pure substances");
      EXPECT_FALSE(fs::exists(scratch.path("alloy") / "checkpoint"));
    }
  } // namespace
} // namespace meltfront::verification::tests
