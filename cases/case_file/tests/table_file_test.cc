#include <cases/case_file/tests/sample_case.h>
#include <cases/property_curve.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

using namespace meltfront::cases;
using namespace meltfront::cases::test;
namespace fs = std::filesystem;

namespace
{
  /** A folder with a CSV file and a case that names it. */
  class TableFile : public testing::Test
  {
  protected:
    void SetUp() override
    {
      const auto *const info = testing::UnitTest::GetInstance()->current_test_info();
      folder = fs::path(testing::TempDir()) / (std::string("mf-") + info->name());
      fs::create_directories(folder);
    }

    void TearDown() override
    {
      fs::remove_all(folder);
    }

    Case read_with(const std::string &csv, const std::string &old_piece,
                   const std::string &new_piece)
    {
      std::ofstream(folder / "a.csv") << csv;
      const fs::path file = folder / "case.prm";
      std::ofstream(file) << replaced(slab, old_piece, new_piece);
      return read_case(file.string());
    }

    Case wall(const std::string &csv, const std::string &words = "table a.csv")
    {
      return read_with(csv, "temperature = -10", "temperature = " + words);
    }

    void expect_refusal(const std::string &csv, const std::string &piece,
                        const std::string &words = "table a.csv")
    {
      try
      {
        wall(csv, words);
        ADD_FAILURE() << piece;
      }
      catch(const InputError &error)
      {
        EXPECT_NE(std::string(error.what()).find(piece), std::string::npos)
            << error.what();
        EXPECT_NE(std::string(error.what()).find("case.prm:27: key 'temperature'"),
                  std::string::npos)
            << error.what();
      }
    }

    fs::path folder;
  };
} // namespace

TEST_F(TableFile, AWallFollowsWhatWasMeasured)
{
  const Case c = wall("\xef\xbb\xbf# logger 7\ntime (min),\"air (degC)\"\r\n0,-5\r\n\n1 "
                      ", -10\n2,-6\n");
  const Field &value = c.scene.boundary(Side::x_min).value;
  EXPECT_FALSE(value.constant);
  EXPECT_EQ(value({}, 0), -5);
  EXPECT_DOUBLE_EQ(value({}, 30), -7.5);
  EXPECT_DOUBLE_EQ(value({}, 100), -10 + 4 * 40. / 60);
  EXPECT_EQ(value.breakpoints, std::vector<double>{60});
  // What is stored needs no other file, and is the same.
  fs::remove(folder / "a.csv");
  const Case again = read_case_text(c.text, "again.prm");
  EXPECT_EQ(again.scene.boundary(Side::x_min).value({}, 75), value({}, 75));
  EXPECT_EQ(again.text, c.text);
  EXPECT_NEAR(temperature_bounds(c.scene).lower, -10, 0.05);
}

TEST_F(TableFile, AColumnOfSeveralIsNamed)
{
  const std::string csv = "time (s); inner (degC); outer (degC)\n0; 1; -3\n100; 2; -4\n";
  EXPECT_EQ(
      wall(csv, "table a.csv column outer").scene.boundary(Side::x_min).value({}, 0), -3);
  expect_refusal(csv, "says which");
  expect_refusal(csv, "the nearest is 'outer'", "table a.csv column outr");
}

TEST_F(TableFile, AConductivityOverTheTemperature)
{
  const Case c = read_with("T (degC),k (W/(cm K))\n-20,0.024\n10,0.021\n",
                           "conductivity = 2.2", "conductivity = table a.csv");
  const auto &curve = c.scene.material.solid.conductivity_curve;
  ASSERT_TRUE(curve);
  EXPECT_DOUBLE_EQ((*curve)(-20), 2.4);
  EXPECT_DOUBLE_EQ((*curve)(-5), 2.25);
}

TEST_F(TableFile, WhatIsWrongIsNamedWithItsLine)
{
  expect_refusal("time (h),air\n0,1\n1,2\n",
                 "a.csv:1: the header's 'air' needs its unit");
  expect_refusal("time (h),air (degC)\n0,1\n1,x\n", "a.csv:3: 'x' is no number");
  expect_refusal("time (h),air (degC)\n0,1\n0,2\n", "'time' must ascend");
  expect_refusal("time (h),air (degC)\n0,1\n1\n", "a.csv:3: has 1 cells");
  expect_refusal("time (m),air (degC)\n0,1\n1,2\n", "unit of something else");
  expect_refusal("time (s),air (degC)\n0,1\n50,2\n",
                 "is known from t = 0 to 50, and the run goes from 0 to 100");
  expect_refusal("time (s),air (degC)\n0,1\n", "needs two points or more");
  expect_refusal("", "holds no header");
  expect_refusal("time (s),air (degC)\n0,1\n200,2\n", "names the table 'b.csv'",
                 "table b.csv");
}

TEST(Table, OverTimeStandsOnlyWhereTimeMatters)
{
  const std::string start
      = replaced(slab, "temperature = 10", "temperature = 0: 1, 9: 2");
  EXPECT_NE(complaint(start).find("cannot be a table"), std::string::npos)
      << complaint(start);
  const Case c
      = read(replaced(slab, "temperature = -10", "temperature = 0: -5, 50: -9, 100: -2"));
  EXPECT_DOUBLE_EQ(c.scene.boundary(Side::x_min).value({}, 25), -7);
}

TEST(Table, OfTheTimeIsWhatAnExpressionOfTheSameCourseIs)
{
  const Scene table
      = read(replaced(slab, "temperature = -10", "temperature = 0: -5, 40: -9, 100: -9"))
            .scene;
  const Scene formula
      = read(replaced(slab, "temperature = -10", "temperature = -5 - 4*min(t/40, 1)"))
            .scene;
  const Field &a = table.boundary(Side::x_min).value,
              &b = formula.boundary(Side::x_min).value;
  EXPECT_EQ(a.breakpoints, b.breakpoints);
  for(double t = 0; t <= 100; t += 2.5)
    EXPECT_NEAR(a({}, t), b({}, t), 1e-14);
}
