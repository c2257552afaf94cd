#include <verification/record/run_times.h>
#include <verification/run/run_one.h>
#include <verification/run/tests/fakes.h>
#include <verification/run/timed_repeat.h>

#include <gtest/gtest.h>

namespace meltfront::verification
{
  namespace
  {
    using tests::FakeMethod;

    TEST(RunTimes, AreSettledOnceTheThreeLeastAgree)
    {
      EXPECT_FALSE(settled({true, {1, 1, 1, 1}, {1, 1, 1, 1}})) << "five at least";
      EXPECT_TRUE(settled({true, {9, 1, 5, 1.02, 1.03}, {}})) << "the least count";
      EXPECT_FALSE(settled({true, {9, 1, 5, 1.02, 1.04}, {}}));
      EXPECT_TRUE(settled({true, std::vector<double>(15, 1.), {}}));
      std::vector<double> scattered;
      for(int i = 0; i < 15; ++i)
        scattered.push_back(1 + i);
      EXPECT_TRUE(settled({true, scattered, {}})) << "fifteen at most";
      scattered.pop_back();
      EXPECT_FALSE(settled({true, scattered, {}}));
    }

    TEST(RunTimes, TellWhetherTheyAgreeAndWhetherTheCoreWasShared)
    {
      EXPECT_FALSE(agree_within({false, {1, 1}, {1, 1}}, 0.05)) << "too few";
      EXPECT_TRUE(agree_within({false, {2, 1, 1.05, 1.01}, {}}, 0.05));
      EXPECT_FALSE(agree_within({false, {2, 1, 1.06, 1.01}, {}}, 0.05));
      EXPECT_FALSE(disturbed({false, {}, {}}));
      EXPECT_FALSE(disturbed({false, {2, 1}, {4, 1.19}})) << "the fastest counts";
      EXPECT_TRUE(disturbed({false, {2, 1}, {2, 1.2}}));
    }

    TEST(TimedRepeat, KeepsEveryTimeAndTheLeastOfEachPart)
    {
      int solutions = 0;
      FakeMethod method("fake", [&](const auto &, const auto &) { ++solutions; });
      const cases::Case c = tests::slab_case("x");
      const cases::Resolution resolution{20,
                                         cases::Options(method.option_declarations())};
      RepeatPolicy policy;
      policy.most = 4;
      RunRecord record = run_one(c, method, resolution, "fake", {}, nullptr, policy);
      EXPECT_EQ(solutions, 4);
      EXPECT_EQ(record.repeats, 4);
      EXPECT_FALSE(record.times.careful);
      ASSERT_EQ(record.times.cpu.size(), 4u);
      EXPECT_EQ(record.times.wall.size(), 4u);
      for(const double time : record.times.cpu)
        EXPECT_LE(record.cost.setup_cpu + record.cost.stepping_cpu, time);

      // Below a millisecond: many in the clock for one repeat.
      repeat_carefully(c, method, resolution, record);
      EXPECT_TRUE(record.times.careful);
      EXPECT_EQ(record.repeats, 1) << "the quick ones count no more";
      EXPECT_EQ(record.times.cpu.size(), 1u);
      EXPECT_GT(solutions, 4 + 5);
      EXPECT_NEAR(record.cost.setup_cpu + record.cost.stepping_cpu, record.times.cpu[0],
                  1e-12);
      repeat_carefully(c, method, resolution, record);
      EXPECT_EQ(record.repeats, 2);
    }
  } // namespace
} // namespace meltfront::verification
