#include <verification/judge/matrix_result.h>
#include <verification/record/hash.h>
#include <verification/record/json_values.h>
#include <verification/run/tests/fakes.h>

#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <random>

namespace meltfront::verification
{
  namespace
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();

    double through_text(double value)
    {
      return number_in(nlohmann::json::parse(json_of(value).dump()));
    }

    TEST(JsonValues, KeepEveryBitOfADouble)
    {
      std::mt19937_64 generator(1);
      for(int i = 0; i < 100000; ++i)
      {
        const double value = std::bit_cast<double>(generator());
        if(std::isnan(value))
          continue;
        ASSERT_EQ(std::bit_cast<std::uint64_t>(through_text(value)),
                  std::bit_cast<std::uint64_t>(value));
      }
      for(const double value : {0., -0., 5e-324, 1.7976931348623157e308, 0.1, 1e22, 3.})
        EXPECT_EQ(std::bit_cast<std::uint64_t>(through_text(value)),
                  std::bit_cast<std::uint64_t>(value));
      EXPECT_TRUE(std::isnan(through_text(nan)));
      EXPECT_EQ(through_text(infinity), infinity);
      EXPECT_EQ(through_text(-infinity), -infinity);
    }

    RunRecord full_record()
    {
      RunRecord record;
      record.case_name = "plane-freezing";
      record.method = "sph";
      record.label = "sph[step_factor=1.1]";
      record.n = 160;
      record.seed = std::numeric_limits<std::uint64_t>::max();
      record.threads = 2;
      record.options = {{"step_factor", "1.1"}, {"time_scheme", "euler"}};
      record.status = RunStatus::finished;
      record.message = "a \"quoted\" line\nand <another> & more";
      record.description = {.dimension = 2,
                            .spacing = 0.1,
                            .smoothing_length = 0.12,
                            .time_step = 1e-5,
                            .unknowns = 160,
                            .parameters = {{"kernel", "cubic spline", ""}}};
      record.effects = {{cases::Effect::phase_change, true, "latent heat is not zero"},
                        {cases::Effect::wall_flux, false, "no wall has a flux"}};
      record.cost.setup_wall = 0.1;
      record.cost.setup_cpu = 0.2;
      record.cost.stepping_wall = 0.4;
      record.cost.stepping_cpu = 0.8;
      record.cost.steps = 10;
      record.cost.unknowns = 160;
      record.cost.work = 1L << 60;
      record.cost.solver_iterations = 7;
      record.cost.most_iterations = 4;
      record.cost.capped_steps = 1;
      record.cost.effects = {{cases::Effect::phase_change, 10, 1280, 0.25}};
      record.peak_memory_mb = 12.5;
      record.repeats = 3;
      record.quantities
          = {{"front_rms", 1. / 3}, {"temperature_l2", nan}, {"front_max", infinity}};
      record.series.time = {0, 0.1};
      record.series.front = {0, 0.2};
      record.series.front_isotherm = {nan, 0.21};
      record.series.front_exact = {0, 0.19};
      record.series.solid_volume = {0, 0.2};
      record.series.budget_defect = {0, 1e-15};
      record.series.temperature_min = {-1, -1};
      record.series.temperature_max = {1, 2};
      record.profile.time = 0.1;
      record.profile.coordinate = {0.05};
      record.profile.temperature = {-0.5};
      record.profile.solid_fraction = {1};
      record.profile.temperature_exact = {nan};
      record.profile.picture_x = {0.05};
      record.profile.picture_y = {0.07};
      record.profile.picture_solid_fraction = {1};
      record.profile.picture_temperature = {-0.5};
      record.frames = {{0.05, {0.1, 0.2}, {0.3, nan}}, {0.1, {0.4}, {0.5}}};
      record.provenance = {{"case_text", "set title = x"}, {"date", "today"}};
      return record;
    }

    TEST(JsonValues, WholeNumbersAreTakenAsTheyAreWrittenOnly)
    {
      const auto number = [](const char *text)
      { return whole_number_in<int>(nlohmann::json::parse(text)); };
      EXPECT_EQ(number("-12"), -12);
      for(const char *text : {"1e20", "1.5", "3.0", "4294967296", "\"3\"", "null", "true",
                              "99999999999999999999"})
        EXPECT_THROW(number(text), nlohmann::json::exception) << text;
      constexpr std::uint64_t largest = std::numeric_limits<std::uint64_t>::max();
      EXPECT_EQ(
          whole_number_in<std::uint64_t>(nlohmann::json::parse(std::to_string(largest))),
          largest);
    }

    TEST(RunRecord, ComesBackFromItsFile)
    {
      const tests::ScratchDirectory directory;
      const RunRecord record = full_record();
      write_json(directory.path("a/b/run.json"), record);
      const auto read = read_json(directory.path("a/b/run.json")).get<RunRecord>();
      EXPECT_EQ(read.label, record.label);
      EXPECT_EQ(read.seed, record.seed);
      EXPECT_EQ(read.message, record.message);
      EXPECT_EQ(read.cost.work, record.cost.work);
      EXPECT_EQ(read.cost.most_iterations, 4);
      EXPECT_EQ(read.frames.at(0).x.at(1), 0.2);
      EXPECT_EQ(read.series.solid_volume, record.series.solid_volume);
      EXPECT_EQ(read.quantities.at("front_rms"), 1. / 3);
      EXPECT_TRUE(std::isnan(read.quantities.at("temperature_l2")));
      EXPECT_EQ(read.quantities.at("front_max"), infinity);
      EXPECT_TRUE(std::isnan(read.series.front_isotherm[0]));
      // All members: what is written again is the same text.
      EXPECT_EQ(nlohmann::json(read).dump(), nlohmann::json(record).dump());
      EXPECT_FALSE(std::filesystem::exists(directory.path("a/b/run.json.part")));
    }

    TEST(RunRecord, OfEarlierRunsLacksWhatWasNotKeptThen)
    {
      nlohmann::json json = full_record();
      json.erase("frames");
      json["series"].erase("solid_volume");
      json["cost"].erase("most_iterations");
      const auto read = json.get<RunRecord>();
      EXPECT_TRUE(read.frames.empty());
      EXPECT_TRUE(read.series.solid_volume.empty());
      EXPECT_EQ(read.cost.most_iterations, 0);
    }

    TEST(RunRecord, HasTheColumnsOfTheConvergenceTableAtItsTopLevel)
    {
      const nlohmann::json json = full_record();
      EXPECT_EQ(json.at("front_rms").get<double>(), 1. / 3);
      EXPECT_EQ(json.at("h").get<double>(), 0.1);
      EXPECT_EQ(json.at("unknowns"), 160);
      EXPECT_EQ(json.at("steps"), 10);
      EXPECT_EQ(json.at("work"), 1L << 60);
      EXPECT_DOUBLE_EQ(json.at("cpu_seconds").get<double>(), 1);
      EXPECT_DOUBLE_EQ(json.at("wall_seconds").get<double>(), 0.5);
      EXPECT_EQ(json.at("peak_memory_mb").get<double>(), 12.5);
      EXPECT_EQ(json.at("n"), 160);
      EXPECT_EQ(json.at("method"), "sph");
    }

    TEST(RunRecord, SurvivesBytesThatAreNotText)
    {
      const tests::ScratchDirectory directory;
      RunRecord record = full_record();
      record.message = "bad byte \xff here";
      write_json(directory.path("run.json"), record);
      const auto read = read_json(directory.path("run.json")).get<RunRecord>();
      EXPECT_EQ(read.message.substr(0, 9), "bad byte ");
    }

    TEST(Sha256, AgreesWithTheStandard)
    {
      // FIPS 180-4, example of a one-block message.
      EXPECT_EQ(sha256("abc"),
                "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
      const tests::ScratchDirectory directory;
      write_atomically(directory.path("text"), "abc");
      EXPECT_EQ(sha256_of_file(directory.path("text")), sha256("abc"));
      EXPECT_THROW(sha256_of_file(directory.path("nothing")), cases::OutputError);
    }

    TEST(ReadJson, SaysWhatIsWrongWithAFile)
    {
      const tests::ScratchDirectory directory;
      EXPECT_THROW(read_json(directory.path("nothing.json")), cases::OutputError);
      write_atomically(directory.path("half.json"), "{\"a\": ");
      EXPECT_THROW(read_json(directory.path("half.json")), cases::OutputError);
    }
  } // namespace
} // namespace meltfront::verification
