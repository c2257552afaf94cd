#include <verification/app/tests/run_program.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <string>

using namespace meltfront::verification::tests;

/** What `new` writes is a case that runs, needs no other file and overwrites none. */
TEST(App, WritesACaseToBeginWith)
{
  const TemporaryDirectory directory;
  const std::string folder = directory.path().string();
  for(const std::string like : {"", " --like corner-freezing"})
  {
    const std::string name = folder + (like.empty() ? "/mine" : "/corner");
    const Outcome outcome = run_program("new " + name + like);
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    expect_text(outcome, "compare " + name + ".prm");
    const Outcome run = run_program(
        "run " + name + ".prm --method fem-enthalpy --n 16 --frames 2 --out " + folder
        + "/run");
    EXPECT_EQ(run.status, 0) << run.output;
    const Outcome again = run_program("new " + name + ".prm" + like);
    EXPECT_EQ(again.status, 2);
    expect_text(again, "already");
  }
}

/** A key of the case from the command line: another case, whose figures are its own. */
TEST(App, KeysOfTheCaseAreSetOnTheCommandLine)
{
  const TemporaryDirectory directory;
  const std::string out = directory.path().string() + "/run";
  const Outcome outcome = run_program(
      "run plane-freezing --method sph --n 20 --set 'Scene/Material/latent heat=2' --set "
      "sph.step_factor=0.5 --out "
      + out);
  EXPECT_EQ(outcome.status, 0) << outcome.output;
  const nlohmann::json record = read_json(out + "/run.json");
  EXPECT_EQ(record["case"], "plane-freezing-Material-latent-heat-2");
  const std::string file = out + "/plane-freezing-Material-latent-heat-2.prm";
  ASSERT_TRUE(fs::exists(file));
  // The file is a case like any other, without what holds of the library's.
  const Outcome again = run_program(
      "run " + file + " --method sph --n 20 --set sph.step_factor=0.5 --out "
      + directory.path().string() + "/again");
  EXPECT_EQ(again.status, 0) << again.output;
  EXPECT_EQ(read_json(directory.path().string() + "/again/run.json")["series"],
            record["series"]);
}

TEST(App, KeysOfTheCaseThatAreWrongAreNamed)
{
  const TemporaryDirectory directory;
  const std::string out = " --out " + directory.path().string() + "/run";
  const Outcome unknown = run_program(
      "run plane-freezing --method sph --set 'Scene/Material/latent heet=2'" + out);
  EXPECT_EQ(unknown.status, 2);
  expect_text(unknown, "latent heet");
  expect_text(unknown, "the nearest valid key is 'latent heat'");
  const Outcome of_method
      = run_program("advise plane-freezing --set sph.step_factor=0.5" + out);
  EXPECT_EQ(of_method.status, 2);
  expect_text(of_method, "this command chooses the methods' options itself");
  const Outcome no_value
      = run_program("run plane-freezing --method sph --set units" + out);
  EXPECT_EQ(no_value.status, 2);
  expect_text(no_value, "SUBSECTION/KEY=VALUE");
  EXPECT_FALSE(fs::exists(directory.path().string() + "/run"));
}

TEST(App, ExternalProgramsAreRefusedOrFailWithASentence)
{
  const TemporaryDirectory directory;
  const std::string out = " --out " + directory.path("out").string(),
                    manifest = directory.path("mine.json").string(),
                    run = "run plane-freezing --method external --n 20" + out;
  const Outcome without = run_program(run);
  EXPECT_EQ(without.status, 2);
  expect_text(without, "takes nothing without a manifest");
  const std::string with = " --set external.manifest=" + manifest;
  EXPECT_EQ(run_program(run + with).status, 2); // there is no such file
  std::ofstream(manifest) << R"({"protocol": 1, "name": "mine",
    "command": ["sh", "-c", "echo cannot find it >&2; exit 5"],
    "effects": ["phase_change", "wall_temperature"], "front_origins": ["wall"],
    "shapes": [{"shape": "slab", "dimensions": [1], "walls": ["fixed temperature"]}]})";
  const Outcome failed = run_program(run + with);
  EXPECT_EQ(failed.status, 3);
  expect_text(failed, "external (mine) ended with status 5; it said: cannot find it");
  const Outcome late = run_program(run + with + " --time-limit 0.5 --set "
                                   + "'external.command=sh -c \"sleep 100; true\"'");
  EXPECT_EQ(late.status, 3);
  expect_text(late, "external took longer than its time limit of 0.5 s");
  const Outcome unknown
      = run_program("compare plane-freezing --set extrenal.manifest=x" + out);
  EXPECT_EQ(unknown.status, 2);
  expect_text(unknown, "external");
}
