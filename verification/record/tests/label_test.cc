#include <verification/record/label.h>
#include <verification/run/run_one.h>
#include <verification/run/tests/fakes.h>

#include <gtest/gtest.h>

namespace meltfront::verification
{
  namespace
  {
    TEST(Label, IsTheSameInAnyOrderAndWithBlanks)
    {
      const std::string written
          = run_label("sph", {{"step_factor", "0.9"}, {"jitter", "0.2"}}, 2);
      EXPECT_EQ(canonical_label(written), written);
      EXPECT_EQ(canonical_label(" sph [ threads = 2, step_factor=0.9 ,jitter= 0.2 ] "),
                written);
      EXPECT_EQ(canonical_label("sph"), "sph");
      EXPECT_NE(canonical_label("sph[jitter=0.2]"), canonical_label("sph[jitter=0.20]"));
      EXPECT_EQ(method_of(written), "sph");
      EXPECT_EQ(method_of("sph"), "sph");
      ASSERT_EQ(options_of(written).size(), 3u);
      EXPECT_EQ(options_of(written)[0],
                std::pair(std::string("jitter"), std::string("0.2")));
      EXPECT_TRUE(options_of("sph").empty());
    }

    TEST(Label, APatternMeansAnyValue)
    {
      EXPECT_TRUE(label_matches("sph[b=*,a=1]", "sph[a=1,b=x]"));
      EXPECT_TRUE(label_matches("sph [ a = 1 ]", "sph[a=1]"));
      EXPECT_FALSE(label_matches("sph[a=*]", "sph[a=1,b=2]"));
      EXPECT_FALSE(label_matches("sph[a=*,b=2]", "sph[a=1]"));
      EXPECT_FALSE(label_matches("sph[a=*]", "sph-2005[a=1]"));
      EXPECT_FALSE(label_matches("sph", "sph[a=1]"));
    }

    std::string problem_of(const std::string &label)
    {
      static const tests::FakeMethod fake("fake");
      try
      {
        check_label(label,
                    [](const std::string &name) -> const cases::Method &
                    {
                      if(name != "fake")
                        throw cases::InputError("there is no method '" + name + "'");
                      return fake;
                    });
      }
      catch(const cases::InputError &error)
      {
        return error.what();
      }
      return {};
    }

    TEST(Label, IsHeldAgainstMethodsAndTheirOptions)
    {
      for(const char *good :
          {"fake", "fake[step_factor=0.9]", "fake[scheme=rkl2, step_factor=1,threads=2]",
           "fake[scheme=*]"})
        EXPECT_EQ(problem_of(good), "") << good;
      EXPECT_EQ(problem_of("fakes"), "there is no method 'fakes'");
      EXPECT_NE(problem_of("fake[step_factr=0.9]").find("step_factor"),
                std::string::npos);
      for(const char *bad : {"fake[]", "fake[", "fake[step_factor]", "fake[step_factor=]",
                             "fake]", "fake[step_factor=1]x", "fake[[step_factor=1]]",
                             "fake[scheme=rk4]", "fake[step_factor=7]", "fake[shape=*]",
                             "fake[threads=0]", "fake[threads=two]", ""})
        EXPECT_NE(problem_of(bad), "") << bad;
    }
  } // namespace
} // namespace meltfront::verification
