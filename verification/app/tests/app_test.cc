#include <verification/app/tests/run_program.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

using namespace meltfront::verification::tests;

TEST(App, ListNamesWhatThereIs)
{
  const Outcome outcome = run_program("list");
  EXPECT_EQ(outcome.status, 0);
  for(const char *name : {"plane-freezing", "sph-2005", "fem-enthalpy",
                          "phase_conductivity", "stability", "step_factor"})
    expect_text(outcome, name);
}

TEST(App, BadArgumentsExitWithTwoAndNameTheNearest)
{
  EXPECT_EQ(run_program("").status, 2);
  const Outcome unknown_command = run_program("verfy");
  EXPECT_EQ(unknown_command.status, 2);
  expect_text(unknown_command, "the nearest is 'verify'");
  const Outcome no_file = run_program("verify nowhere/matrix.prm");
  EXPECT_EQ(no_file.status, 2);
  expect_text(no_file, "there is no matrix file 'nowhere/matrix.prm'");
  const Outcome unknown_case = run_program("run plane-freezin --method sph");
  EXPECT_EQ(unknown_case.status, 2);
  expect_text(unknown_case, "plane-freezing");
  const Outcome unknown_method = run_program("run plane-freezing --method fem-entalpy");
  EXPECT_EQ(unknown_method.status, 2);
  expect_text(unknown_method, "fem-enthalpy");
  const Outcome unknown_option
      = run_program("run plane-freezing --method sph --set sph.step_facto=0.5");
  EXPECT_EQ(unknown_option.status, 2);
  expect_text(unknown_option, "step_factor");
  EXPECT_EQ(run_program("verify nothing-of-this-name").status, 2);
}

TEST(App, ListsTheRunsOfAMatrixAndMakesThemByALauncher)
{
  const TemporaryDirectory directory;
  const fs::path file = directory.path() / "two.prm";
  std::ofstream(file) << "set title = Two methods\nsubsection Block 1\n"
                         "  set cases = plane-freezing\n"
                         "  set methods = sph, fem-enthalpy\n"
                         "  set resolutions = 8, 12, 16, 24\nend\n";
  const Outcome list = run_program("verify " + file.string() + " --list-runs");
  EXPECT_EQ(list.status, 0);
  EXPECT_EQ(std::count(list.output.begin(), list.output.end(), '\n'), 8);
  expect_text(list, "plane-freezing/sph/n=24\n");

  const std::string out = " --out " + (directory.path() / "out").string();
  const std::string verify = "verify " + file.string() + out;
  EXPECT_EQ(run_program(verify + " --only plane-freezing/sph/n=12").status, 0);
  EXPECT_EQ(run_program(verify + " --only 8").status, 0);
  EXPECT_EQ(run_program(verify + " --only plane-freezing/sph/n=13").status, 2);
  const Outcome launched = run_program(verify + " --launcher 'env nice'");
  EXPECT_EQ(launched.status, 0) << launched.output;
  expect_text(launched, "two: PASSED");
  std::set<std::string> makers;
  int runs = 0;
  std::ifstream log(directory.path() / "out/runs.log");
  for(std::string date, time, zone, host, process, rest;
      log >> date >> time >> zone >> host >> process && std::getline(log, rest); ++runs)
    makers.insert(process);
  EXPECT_EQ(runs, 8) << "each once";
  EXPECT_EQ(makers.size(), 8u) << "each by a process of its own";
}

TEST(App, RunWritesRecordFrontPictureAndFields)
{
  for(const std::string method : {"sph", "fem-enthalpy"})
  {
    const TemporaryDirectory directory;
    const Outcome outcome
        = run_program("run plane-freezing --method " + method
                      + " --n 20 --frames 3 --out " + directory.path().string());
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    const nlohmann::json record = read_json(directory.path() / "run.json");
    EXPECT_GT(record.at("quantities").at("front_rms").get<double>(), 0);
    EXPECT_LT(record.at("quantities").at("front_rms").get<double>(), 0.02);
    for(const char *file :
        {"front.csv", "picture.svg", "fields.pvd", "fields-0000.vtu", "fields-0003.vtu"})
      EXPECT_TRUE(fs::exists(directory.path() / file)) << file;
  }
}

TEST(App, ARunThatIsRefusedSaysWhyAndExitsWithTwo)
{
  const TemporaryDirectory directory;
  const Outcome outcome = run_program(
      "run plane-freezing --method sph --n 20 --set sph.step_factor=1.1 --out "
      + directory.path().string());
  EXPECT_EQ(outcome.status, 2);
  expect_text(outcome, "refused");
}

TEST(App, WhatCannotBeProducedIsRefusedWithItsEstimate)
{
  const TemporaryDirectory directory;
  const std::string out = " --out " + directory.path().string();
  const Outcome memory
      = run_program("run line-sink --method sph --n 1000000 --memory 64" + out);
  EXPECT_EQ(memory.status, 2);
  expect_text(memory, "GB of memory, and 64 GB are allowed");
  EXPECT_EQ(read_json(directory.path() / "run.json").at("status"), "refused");
  const Outcome steps = run_program("run plane-freezing --method fem-enthalpy --n 40 "
                                    "--set fem-enthalpy.steps=100000000"
                                    + out);
  EXPECT_EQ(steps.status, 2);
  expect_text(steps, "estimated to take 1e+08 time steps");
  EXPECT_EQ(run_program("run line-sink --method sph --n 20 --memory -1" + out).status, 2);
}

TEST(App, ARunThatTakesLongerThanItMayLeavesItsRecord)
{
  const TemporaryDirectory directory;
  const Outcome outcome
      = run_program("run plane-freezing --method sph --n 2000 --time-limit 0.3 --out "
                    + directory.path().string());
  EXPECT_EQ(outcome.status, 3);
  expect_text(outcome, "took longer than its time limit of 0.3 s");
  const nlohmann::json record = read_json(directory.path() / "run.json");
  EXPECT_EQ(record.at("status"), "failed");
  EXPECT_EQ(record.at("n"), 2000);
}

TEST(App, AnUnwritableDirectoryExitsWithFour)
{
  EXPECT_EQ(
      run_program("run plane-freezing --method sph --n 20 --out /proc/meltfront").status,
      4);
}

TEST(App, CompareMeasuresEveryMethodAndItsReportCanBeMadeAgain)
{
  const TemporaryDirectory directory;
  const Outcome outcome = run_program("compare plane-one-phase --n 8,16,24,32 --out "
                                      + directory.path().string());
  EXPECT_EQ(outcome.status, 0) << outcome.output;
  const nlohmann::json answers = read_json(directory.path() / "answers.json");
  ASSERT_FALSE(answers.empty());
  EXPECT_EQ(answers.front().at("quantity"), "front");
  const double exact = answers.front().at("exact");
  for(const nlohmann::json &method : answers.front().at("methods"))
    // The form as published misses the front there, and does not converge.
    if(method.at("method") != "sph-2005")
    {
      EXPECT_NEAR(method.at("value").get<double>(), exact, 0.02 * exact) << method;
    }
  const nlohmann::json summary = read_json(directory.path() / "summary.json");
  EXPECT_TRUE(summary.contains("passed"));
  for(const char *file :
      {"report.html", "tables/plane-one-phase.csv", "tables/plane-one-phase.md",
       "tables/plane-one-phase.tex", "runs/plane-one-phase/sph/n=32/run.json"})
    EXPECT_TRUE(fs::exists(directory.path() / file)) << file;
  fs::remove(directory.path() / "report.html");
  EXPECT_LE(run_program("report " + directory.path().string()).status, 1);
  EXPECT_TRUE(fs::exists(directory.path() / "report.html"));
}

namespace
{
  /** A slab that freezes, of which no exact solution is stated, and a matrix of it. */
  void write_referenced_case(const fs::path &directory, const std::string &criterion)
  {
    std::ofstream(directory / "slab.prm") << R"(set title = A slab without a solution
set units = normalised
subsection Scene
  set symmetry = planar
  set end time = 0.1
  subsection Domain
    set shape = slab
    set length = 1
  end
  subsection Material
    set latent heat = 1
    set melting temperature = 0
    subsection Solid
      set conductivity = 1
      set specific heat capacity = 1
      set density = 1
    end
  end
  subsection Initial state
    set temperature = 0.2
  end
  subsection Walls
    subsection x_min
      set kind = fixed temperature
      set temperature = -1
    end
  end
end
subsection Reference
  set method = fem-enthalpy
  set n = 64
end
subsection Measure
  set intermediate times = 0.033, 0.05
end
subsection Acceptance
  set criterion 1 = )" << criterion << "\nend\n";
    std::ofstream(directory / "matrix.prm")
        << "set title = Trial\nsubsection Block 1\n  set cases = "
        << (directory / "slab.prm").string()
        << "\n  set methods = sph, fem-enthalpy\n  set resolutions = 16, 32, 64\n"
           "  set options = sph.step_factor = 0.4; sph.dimension = 1\nend\n";
  }

  /** The command that makes the matrix of such a directory. */
  std::string verify_in(const fs::path &directory)
  {
    return "verify " + (directory / "matrix.prm").string() + " --out "
           + (directory / "out").string();
  }
} // namespace

TEST(App, ARunCanStandInForAnExactSolution)
{
  const TemporaryDirectory directory;
  write_referenced_case(
      directory.path(),
      "sph[ step_factor = 0.4, dimension = 1 ]: solid_volume_2_error at n=64 <= 3e-3\n"
      "  set criterion 2 = any method: worst budget_defect <= 1e-9\n"
      "  set criterion 3 = sph: front_rms at n=64 <= 1");
  const Outcome outcome = run_program(verify_in(directory.path()) + " -v");
  EXPECT_EQ(outcome.status, 0) << outcome.output;
  expect_text(outcome, "PASS  slab: sph[ step_factor = 0.4, dimension = 1 ]");
  expect_text(outcome, "PASS  slab: sph[dimension=1,step_factor=0.4]: worst budget");
  expect_text(outcome, "PASS  slab: fem-enthalpy: worst budget_defect");
  expect_text(outcome, "Not judged: 1 criteria of these cases");
  expect_text(outcome, "the reference");
  for(const char *file : {"out/report.html", "out/tables/slab-reference.csv"})
    EXPECT_TRUE(fs::exists(directory.path() / file)) << file;
}

TEST(App, ABoundFinerThanItsReferenceFails)
{
  const TemporaryDirectory directory;
  write_referenced_case(directory.path(),
                        "sph[step_factor=0.4, dimension=1]: solid_volume_2_error at n=64 "
                        "in -1 .. 1e-9");
  const Outcome outcome = run_program(verify_in(directory.path()));
  EXPECT_EQ(outcome.status, 1) << outcome.output;
  expect_text(outcome, "the reference's error bar");
}

// A figure that grew and a run that is missing change the exit status; times do not.
TEST(App, FiguresAreHeldAgainstThoseThatWereKept)
{
  const TemporaryDirectory directory;
  write_referenced_case(directory.path(), "fem-enthalpy: worst budget_defect <= 1e-9");
  const std::string kept = (directory.path() / "kept").string(),
                    verify = verify_in(directory.path());
  fs::create_directory(kept);
  ASSERT_EQ(run_program(verify + " --keep-reference " + kept).status, 0);
  EXPECT_EQ(run_program(verify + " --against " + kept).status, 0);

  const std::string file = kept + "/matrix.json";
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  const auto with = [&](const std::string &key, const std::string &value)
  {
    std::string changed = text.str();
    const std::size_t begin = changed.find('"' + key + "\": ") + key.size() + 4;
    changed.replace(begin, changed.find_first_of(",}", begin) - begin, value);
    std::ofstream(file) << changed;
    return run_program(verify + " --against " + kept);
  };
  EXPECT_EQ(with("cpu_seconds", "1e-9").status, 0);
  const Outcome grew = with("work", "10");
  EXPECT_EQ(grew.status, 1);
  expect_text(grew, "GREW");
  const Outcome missing = with("status", "\"finished\"}, \"x/y/n=1\": {\"status\": "
                                         "\"finished\"");
  EXPECT_EQ(missing.status, 1);
  expect_text(missing, "MISSING");
}

TEST(App, NamesTheNearestOptionInALabelOfACriterion)
{
  const TemporaryDirectory directory;
  write_referenced_case(directory.path(),
                        "fem-enthalpy[step=5]: worst budget_defect <= 1e-12");
  const Outcome outcome = run_program(verify_in(directory.path()));
  EXPECT_EQ(outcome.status, 2);
  expect_text(outcome, "'steps'");
  EXPECT_FALSE(fs::exists(directory.path() / "out/runs"));
}

TEST(App, CapabilitiesAreListedAsATableAndAsJson)
{
  const Outcome table = run_program("list capabilities");
  EXPECT_EQ(table.status, 0);
  for(const char *words : {"rkpm-tracked in the plane", "phase_change", "threads:  1",
                           "external\n      what its options say"})
    expect_text(table, words);
  const Outcome json = run_program("list capabilities --json");
  ASSERT_EQ(json.status, 0);
  const auto methods = nlohmann::json::parse(json.output).at("methods");
  EXPECT_GE(methods.size(), 20U);
  for(const auto &method : methods)
    for(const auto &form : method.at("forms"))
    {
      EXPECT_FALSE(form.at("problems").empty()) << method.at("name");
      EXPECT_GE(form.at("most_threads").get<int>(), 1) << method.at("name");
    }
  EXPECT_EQ(run_program("list methods --json").status, 2);
}

TEST(App, CrosscheckRunsRandomScenesAndTakesUpWhereItStopped)
{
  const TemporaryDirectory directory;
  const std::string out = " --out " + directory.path().string();
  const Outcome outcome
      = run_program("crosscheck --scenes 20 --seed 1 --dimension 1 --within 3" + out);
  EXPECT_EQ(outcome.status, 0) << outcome.output;
  const nlohmann::json summary = read_json(directory.path() / "summary.json");
  EXPECT_EQ(summary.at("scenes"), 20);
  EXPECT_EQ(summary.at("suspect"), 0);
  EXPECT_GE(summary.at("agreed"), 10);
  int sum = 0;
  for(const char *count : {"agreed", "refused", "failed", "suspect"})
    sum += summary.at(count).get<int>();
  EXPECT_EQ(sum, 20);
  // What is written for a scene is a case file that anybody can run.
  const Outcome run = run_program(
      "run " + (directory.path() / "scenes/scene-1-0.prm").string()
      + " --method fem-enthalpy --n 20 --out " + (directory.path() / "run").string());
  EXPECT_EQ(run.status, 0) << run.output;
  const Outcome again
      = run_program("crosscheck --scenes 20 --seed 1 --dimension 1 --within 3" + out);
  expect_text(again, "20 runs were finished before and are kept");
  EXPECT_EQ(read_json(directory.path() / "summary.json"), summary);
}

TEST(App, CrosscheckNamesWhatItDoesNotKnow)
{
  for(const char *arguments : {"--dimension 4", "--scenes 0", "--seed x", "--within -1"})
    EXPECT_EQ(run_program(std::string("crosscheck ") + arguments).status, 2) << arguments;
  const Outcome unknown = run_program("crosscheck --methods sph,fem-entalpy");
  EXPECT_EQ(unknown.status, 2);
  expect_text(unknown, "fem-enthalpy");
  EXPECT_EQ(run_program("crosscheck --methods sph").status, 2);
}

TEST(App, AblateAndSensitivityWriteWhatTheyFoundAndTakeUpWhereTheyStopped)
{
  const TemporaryDirectory directory;
  const std::string out = directory.path("study").string();
  const Outcome ablated = run_program("ablate plane-contrast --n 24 --out " + out);
  ASSERT_EQ(ablated.status, 0) << ablated.output;
  expect_text(ablated, "phase_conductivity");
  const auto ablation = read_json(out + "/ablate.json");
  EXPECT_EQ(ablation.at("method"), "fem-enthalpy");
  EXPECT_GE(ablation.at("effects").size(), 3u);
  std::ifstream report(out + "/report.html");
  const std::string page{std::istreambuf_iterator<char>(report), {}};
  EXPECT_NE(page.find("Without each effect"), std::string::npos);
  // A second call finds every record and comes to the same.
  const auto record = fs::path(out) / "runs/plane-contrast/fem-enthalpy/n=24/run.json";
  const auto written = fs::last_write_time(record);
  EXPECT_EQ(run_program("ablate plane-contrast --n 24 --out " + out).status, 0);
  EXPECT_EQ(fs::last_write_time(record), written);
  EXPECT_EQ(read_json(out + "/ablate.json"), ablation);

  const Outcome steady = run_program("ablate rkpm-wave-1d-flux --n 16 --out "
                                     + directory.path("steady").string());
  EXPECT_EQ(steady.status, 0);
  expect_text(steady, "refused: the steady temperature would be known up to a constant");

  const std::string data = directory.path("data").string();
  const Outcome found = run_program(
      "sensitivity plane-contrast --method rkpm-tracked --n 16 --out " + data);
  ASSERT_EQ(found.status, 0) << found.output;
  expect_text(found, "Material/Solid/conductivity");
  EXPECT_EQ(read_json(data + "/sensitivity.json").at("method"), "rkpm-tracked");

  EXPECT_EQ(run_program("ablate greenspan-rectangle-base-2.5 --out " + out).status, 2);
  EXPECT_EQ(run_program("sensitivity plane-contrast --method sphh --out " + out).status,
            2);
}
