#include <cases/error.h>
#include <cases/options.h>

#include <gtest/gtest.h>

using namespace meltfront::cases;

namespace
{
  Options sample_options()
  {
    return Options({{"step_factor", "1", 0.5, "Share of the limit.", 0, 2},
                    {"stages", "1", 8l, "Stages of a super step.", 1, 64},
                    {"sorted", "", true, "Sort the particles."},
                    {"kernel",
                     "",
                     std::string("cubic"),
                     "The kernel.",
                     -std::numeric_limits<double>::infinity(),
                     std::numeric_limits<double>::infinity(),
                     {"cubic", "quintic"}}});
  }

  /** The message of the InputError that setting an option raises. */
  std::string complaint(const std::string &key, const std::string &text)
  {
    Options options = sample_options();
    try
    {
      options.set(key, text);
    }
    catch(const InputError &error)
    {
      return error.what();
    }
    return "no complaint";
  }
} // namespace

TEST(Options, StartWithTheirDefaults)
{
  const Options options = sample_options();
  EXPECT_EQ(options.get_double("step_factor"), 0.5);
  EXPECT_EQ(options.get_integer("stages"), 8);
  EXPECT_TRUE(options.get_bool("sorted"));
  EXPECT_EQ(options.get_string("kernel"), "cubic");
}

TEST(Options, NearestIsWhatHoldsTheWordOrWasOnceCalledSo)
{
  EXPECT_EQ(nearest_name("scheme", {"steps", "time_scheme"}), "time_scheme");
  EXPECT_EQ(nearest_name("smoothing_length", {"stages", "smoothing"}), "smoothing");
  EXPECT_EQ(nearest_name("particles", {"stages", "cells"}), "cells");
  EXPECT_EQ(nearest_name("particles", {"stages", "particle"}), "particle");
  EXPECT_EQ(nearest_name("stage", {"steps", "stages"}), "stages");
}

TEST(Options, TakeValuesFromText)
{
  Options options = sample_options();
  options.set("step_factor", "1.1");
  options.set("stages", "12");
  options.set("sorted", "false");
  options.set("kernel", "quintic");
  EXPECT_EQ(options.get_double("step_factor"), 1.1);
  EXPECT_EQ(options.get_integer("stages"), 12);
  EXPECT_FALSE(options.get_bool("sorted"));
  EXPECT_EQ(options.get_string("kernel"), "quintic");
}

TEST(Options, TextOfEveryValueReadsBackToTheSameBits)
{
  Options options = sample_options();
  options.set("step_factor", "0.1234567890123456789");
  Options copy = sample_options();
  for(const auto &[key, text] : options.values())
    copy.set(key, text);
  EXPECT_EQ(copy.get_double("step_factor"), options.get_double("step_factor"));
  EXPECT_EQ(copy.values(), options.values());
}

TEST(Options, NameTheNearestKey)
{
  EXPECT_EQ(complaint("step_facter", "1"),
            "there is no option 'step_facter'; the nearest is 'step_factor'");
  EXPECT_THROW(sample_options().get_double("stepfactor"), InputError);
  EXPECT_THROW(Options().set("anything", "1"), InputError);
}

TEST(Options, RefuseWhatIsNoValueOfTheirKind)
{
  EXPECT_EQ(complaint("step_factor", "fast"),
            "option 'step_factor' needs a number, not 'fast'");
  EXPECT_EQ(complaint("step_factor", "0.5x"),
            "option 'step_factor' needs a number, not '0.5x'");
  EXPECT_EQ(complaint("stages", "8.5"), "option 'stages' needs an integer, not '8.5'");
  EXPECT_EQ(complaint("sorted", "yes"), "option 'sorted' needs true or false, not 'yes'");
  EXPECT_EQ(complaint("kernel", "cubik"),
            "option 'kernel' must be one of cubic, quintic, not 'cubik'");
}

TEST(Options, RefuseWhatLiesOutsideTheirRange)
{
  EXPECT_EQ(complaint("stages", "65"), "option 'stages' must lie within [1, 64], not 65");
  EXPECT_NE(complaint("step_factor", "nan"), "no complaint");
  EXPECT_NE(complaint("step_factor", "-1e-30"), "no complaint");
  EXPECT_EQ(complaint("step_factor", "2"), "no complaint");
}

TEST(NearestName, HasTheLeastEditDistance)
{
  EXPECT_EQ(nearest_name("conductvity", {"density", "conductivity", "capacity"}),
            "conductivity");
  EXPECT_EQ(nearest_name("abc", {"xyz", "abd", "ab"}), "abd");
  EXPECT_EQ(nearest_name("word", {}), "");
}
