// The program as a user starts it on two ranks.

#include <verification/app/tests/run_program.h>

#include <fmt/format.h>

namespace meltfront::verification::tests
{
  namespace
  {
    /** With mpirun, which adds lines of its own where the status is not zero. */
    Outcome run_on_two_ranks(const std::string &arguments)
    {
      Outcome outcome;
      const std::string command = fmt::format(
          "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
          "OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_mpi_yield_when_idle=1 "
          "{} -np 2 {} {} 2>&1",
          MELTFRONT_MPIRUN, MELTFRONT_PROGRAM, arguments);
      std::FILE *pipe = popen(command.c_str(), "r");
      if(pipe == nullptr)
        return outcome;
      char buffer[4096];
      while(const std::size_t size = std::fread(buffer, 1, sizeof(buffer), pipe))
        outcome.output.append(buffer, size);
      const int status = pclose(pipe);
      outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
      return outcome;
    }

    std::size_t times_in(const std::string &text, const std::string &word)
    {
      std::size_t count = 0;
      for(auto at = text.find(word); at != std::string::npos;
          at = text.find(word, at + 1))
        ++count;
      return count;
    }

    const std::string line_sink = "run line-sink --method fem-enthalpy --n 32 --set "
                                  "'Scene/end time=1e5' --frames 2 --out ";
  } // namespace

  TEST(SharedRun, LeavesOneRecordLikeThatOfOneProcess)
  {
    const TemporaryDirectory shared, alone;
    const Outcome outcome = run_on_two_ranks(line_sink + shared.path().string());
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_EQ(times_in(outcome.output, "Written to"), 1u) << outcome.output;
    const auto record = read_json(shared.path("run.json"));
    EXPECT_EQ(record["status"], "finished");
    EXPECT_EQ(record["cost"]["evidence"]["ranks"], 2);
    EXPECT_GT(record["cost"]["evidence"]["iterations_per_step"], 0);
    EXPECT_EQ(record["label"], "fem-enthalpy[ranks=2]");

    ASSERT_EQ(run_program(line_sink + alone.path().string()).status, 0);
    const auto serial = read_json(alone.path("run.json"));
    const std::vector<double> front = record["series"]["front"],
                              serial_front = serial["series"]["front"];
    ASSERT_EQ(front.size(), serial_front.size());
    for(std::size_t k = 0; k < front.size(); ++k)
      EXPECT_NEAR(front[k], serial_front[k], 1e-10);
    for(const char *file : {"fields.pvd", "fields-0002.pvtu", "fields-0002.0000.vtu",
                            "fields-0002.0001.vtu", "front.csv", "picture.svg"})
      EXPECT_TRUE(fs::exists(shared.path(file))) << file;
    std::ifstream in(shared.path("fields-0002.pvtu"));
    const std::string pvtu{std::istreambuf_iterator<char>(in), {}};
    EXPECT_NE(pvtu.find("fields-0002.0001.vtu"), std::string::npos) << pvtu;
    EXPECT_NE(pvtu.find("temperature"), std::string::npos) << pvtu;
  }

  TEST(SharedRun, OfParticlesIsThatOfOneProcessToTheBit)
  {
    const TemporaryDirectory shared, alone;
    const std::string run = "run corner-freezing --method sph --n 40 --frames 2 --out ";
    const Outcome outcome = run_on_two_ranks(run + shared.path().string());
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    ASSERT_EQ(run_program(run + alone.path().string()).status, 0);
    const auto record = read_json(shared.path("run.json")),
               serial = read_json(alone.path("run.json"));
    for(const char *part : {"quantities", "series", "profile"})
      EXPECT_EQ(record.at(part), serial.at(part)) << part;
    EXPECT_LT(record["quantities"]["budget_defect"], 1e-12);
    EXPECT_EQ(record["cost"]["steps"], serial["cost"]["steps"]);
    EXPECT_EQ(record["cost"]["evidence"]["ranks"], 2);
    EXPECT_EQ(record["label"], "sph[ranks=2]");
    for(const char *file : {"fields.pvd", "fields-0002.pvtu", "fields-0002.0000.vtu",
                            "fields-0002.0001.vtu", "front.csv", "picture.svg"})
      EXPECT_TRUE(fs::exists(shared.path(file))) << file;
  }

  /** The first rank alone looks at the time. */
  TEST(SharedRun, OfParticlesEndsWhereOneRankEndsIt)
  {
    const TemporaryDirectory directory;
    const Outcome outcome
        = run_on_two_ranks("run corner-freezing --method sph --n 400 --time-limit 0.5 "
                           "--out "
                           + directory.path().string());
    EXPECT_EQ(outcome.status, 3) << outcome.output;
    EXPECT_EQ(read_json(directory.path("run.json"))["status"], "failed");
    EXPECT_EQ(times_in(outcome.output, "took longer than its time limit of 0.5 s"), 1u)
        << outcome.output;
  }

  TEST(SharedRun, RefusesOtherCommandsAndMethodsInOneSentence)
  {
    const Outcome list = run_on_two_ranks("list cases");
    EXPECT_EQ(list.status, 2) << list.output;
    EXPECT_EQ(times_in(list.output, "meltfront: 'run' is the one command"), 1u)
        << list.output;
    const TemporaryDirectory directory;
    const auto expect_refused = [&](const std::string &run, const std::string &sentence)
    {
      const Outcome outcome
          = run_on_two_ranks("run " + run + " --out " + directory.path().string());
      EXPECT_EQ(outcome.status, 2) << outcome.output;
      EXPECT_EQ(times_in(outcome.output, sentence), 1u) << outcome.output;
    };
    expect_refused("line-sink --method sph-2005 --n 20",
                   "sph-2005 runs on one rank, not on 2");
    expect_refused("line-sink-disk --method sph --n 20",
                   "takes no domain of the shape 'ball'");
    expect_refused("line-sink --method sph --n 20 --set sph.time_scheme=backward-euler",
                   "sph on several ranks takes explicit steps");
    const Outcome shape = run_on_two_ranks("run plane-freezing --method fem-enthalpy "
                                           "--n 20 --out "
                                           + directory.path().string());
    EXPECT_EQ(shape.status, 2) << shape.output;
    expect_text(shape, "takes no domain of the shape 'slab'");
    const Outcome unknown = run_on_two_ranks("run no-such-case --method fem-enthalpy");
    EXPECT_EQ(unknown.status, 2) << unknown.output;
    EXPECT_EQ(times_in(unknown.output, "meltfront: "), 1u) << unknown.output;
  }

  TEST(SharedRun, EndsAtItsTimeLimit)
  {
    const TemporaryDirectory directory;
    const Outcome outcome = run_on_two_ranks(
        "run line-sink --method fem-enthalpy --n 256 --time-limit 2 --out "
        + directory.path().string());
    EXPECT_EQ(outcome.status, 3) << outcome.output;
    EXPECT_EQ(read_json(directory.path("run.json"))["status"], "failed");
    expect_text(outcome, "took longer than its time limit of 2 s");
  }

  /** Left at its time limit as often as it takes, it ends like a run that was not. */
  TEST(SharedRun, GoesOnWhereItWasLeft)
  {
    const TemporaryDirectory scratch;
    const std::string run
        = "run line-sink --method fem-enthalpy --n 128 --frames 2 --set "
          "'Scene/end time=1e5' --set fem-enthalpy.checkpoint=0.02 --out ";
    const std::string whole = scratch.path("whole").string(),
                      left = scratch.path("left").string();
    ASSERT_EQ(run_on_two_ranks(run + whole).status, 0);
    EXPECT_FALSE(fs::exists(whole + "/checkpoint"));
    Outcome outcome = run_on_two_ranks(run + left + " --time-limit 0.3");
    ASSERT_EQ(outcome.status, 3) << outcome.output;
    for(double limit = 0.3; outcome.status == 3 && limit < 100; limit *= 1.5)
      outcome = run_on_two_ranks(fmt::format("{} --time-limit {}",
                                             fs::exists(left + "/checkpoint/state.bin")
                                                 ? "run --resume " + left
                                                 : run + left,
                                             limit));
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    const auto of = [](const std::string &directory)
    {
      const nlohmann::json record = read_json(directory + "/run.json");
      return nlohmann::json{record.at("quantities"), record.at("series"),
                            record.at("profile"), record.at("cost").at("steps"),
                            record.at("cost").at("work")};
    };
    EXPECT_EQ(of(left), of(whole));
    EXPECT_GE(read_json(left + "/run.json")["cost"]["evidence"]["times resumed"], 1);
    for(const fs::directory_entry &entry : fs::directory_iterator(whole))
      EXPECT_TRUE(fs::exists(fs::path(left) / entry.path().filename())) << entry.path();
  }

  /** Begun on two ranks and ended on one, and the other way round: it ends like one that
   * was not left, with the frames written before it was. */
  TEST(SharedRun, GoesOnOnAnotherNumberOfRanks)
  {
    const TemporaryDirectory scratch;
    const std::string run
        = "run line-sink --method fem-enthalpy --n 128 --frames 8 --set "
          "'Scene/end time=1e5' --set fem-enthalpy.checkpoint=0.02 --out ";
    const std::string whole = scratch.path("whole").string();
    ASSERT_EQ(run_on_two_ranks(run + whole).status, 0);
    const std::vector<double> front = read_json(whole + "/run.json")["series"]["front"];
    for(const bool on_two_first : {true, false})
    {
      const std::string left = scratch.path(on_two_first ? "on-two" : "on-one").string();
      const std::string begin
          = run + left + (on_two_first ? "" : " --set fem-enthalpy.engine=distributed");
      Outcome outcome{3, {}};
      for(double limit = 0.5; outcome.status == 3 && limit < 100
                              && !fs::exists(left + "/checkpoint/state.bin");
          limit *= 1.3)
        outcome = on_two_first
                      ? run_on_two_ranks(fmt::format("{} --time-limit {}", begin, limit))
                      : run_program(fmt::format("{} --time-limit {}", begin, limit));
      ASSERT_EQ(outcome.status, 3) << outcome.output;
      outcome = on_two_first ? run_program("run --resume " + left)
                             : run_on_two_ranks("run --resume " + left);
      ASSERT_EQ(outcome.status, 0) << outcome.output;
      const auto record = read_json(left + "/run.json");
      EXPECT_EQ(record["cost"]["evidence"]["ranks"], on_two_first ? 1 : 2);
      EXPECT_EQ(record["cost"]["evidence"]["times resumed"], 1);
      const std::vector<double> found = record["series"]["front"];
      ASSERT_EQ(found.size(), front.size());
      for(std::size_t k = 0; k < front.size(); ++k)
        EXPECT_NEAR(found[k], front[k], 1e-10);
      std::ifstream in(left + "/fields.pvd");
      const std::string frames{std::istreambuf_iterator<char>(in), {}};
      EXPECT_EQ(times_in(frames, "<DataSet"), 9u) << frames;
      EXPECT_TRUE(fs::exists(
          left + (on_two_first ? "/fields-0000.0001.vtu" : "/fields-0000.vtu")));
      EXPECT_TRUE(fs::exists(
          left + (on_two_first ? "/fields-0008.vtu" : "/fields-0008.0001.vtu")));
    }
    const std::string serial = scratch.path("serial").string();
    ASSERT_EQ(run_program(run + serial + " --time-limit 0.05").status, 3);
    const Outcome refused = run_on_two_ranks("run --resume " + serial);
    EXPECT_EQ(refused.status, 2) << refused.output;
    expect_text(refused, "2 ranks cannot go on with it");
  }

  TEST(SharedRun, SaysWhatCannotBeWritten)
  {
    const Outcome outcome = run_on_two_ranks(
        "run line-sink --method fem-enthalpy --n 16 --out /proc/no-such-directory");
    EXPECT_EQ(outcome.status, 4) << outcome.output;
    EXPECT_EQ(times_in(outcome.output, "meltfront: "), 1u) << outcome.output;
  }
} // namespace meltfront::verification::tests
