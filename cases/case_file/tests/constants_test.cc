#include <cases/case_file/tests/sample_case.h>
#include <cases/case_file/vary_case.h>

#include <gtest/gtest.h>

using namespace meltfront::cases;
using namespace meltfront::cases::test;

namespace
{
  std::string with_constants(const std::string &constants)
  {
    std::string text = "subsection Constants\n" + constants + "end\n" + slab;
    text = replaced(text, "length = 0.1", "length = 2*r");
    return replaced(text, "temperature = -10", "temperature = T_cold");
  }

  const std::string usual = "  set r = 5 cm\n  set T_cold = -10 degC\n";

  void expect_complaint(const std::string &text, const std::string &piece)
  {
    EXPECT_NE(complaint(text).find(piece), std::string::npos) << complaint(text);
  }
} // namespace

/** A file that names its numbers is the same case as one that writes them. */
TEST(Constants, StandForNumbersInNumbersAndExpressions)
{
  const Case plain = read(slab), named = read(with_constants(usual));
  EXPECT_EQ(named.scene.domain.upper[0], plain.scene.domain.upper[0]);
  EXPECT_EQ(named.scene.boundary(Side::x_min).value({}, 0), -10);
  EXPECT_TRUE(named.scene.boundary(Side::x_min).value.constant);
  const std::string formula = replaced(with_constants(usual), "= T_cold",
                                       "= T_cold - 5*sin(2*pi*t/(1000*r)) + max(r, t)*0");
  EXPECT_DOUBLE_EQ(read(formula).scene.boundary(Side::x_min).value({}, 12.5), -15);
}

TEST(Constants, MayBeFormulasOfThoseBefore)
{
  const std::string text
      = with_constants("  set half = 2.5 cm\n  set r = 2*half\n  set T_cold = -10\n");
  EXPECT_DOUBLE_EQ(read(text).scene.domain.upper[0], 0.1);
  expect_complaint(with_constants("  set r = 2*half\n  set half = 1\n  set T_cold = 0\n"),
                   "a.prm:2: key 'r' in subsection 'Constants' holds the unknown name "
                   "'half'");
}

/** The text that is stored holds them: it is read again as the same case. */
TEST(Constants, AreStoredAndVaried)
{
  const Case named = read(with_constants(usual));
  EXPECT_EQ(read(named.text).scene.domain.upper[0], 0.1);
  const Case varied = vary_case(named, "wide", {{"Constants/r", "7 cm"}});
  EXPECT_DOUBLE_EQ(varied.scene.domain.upper[0], 0.14);
  // A name that nothing uses would change nothing.
  EXPECT_THROW(vary_case(named, "wide", {{"Constants/rr", "7 cm"}}), InputError);
}

TEST(Constants, WhatIsWrongIsNamedWithItsPlace)
{
  expect_complaint(with_constants(usual + "  set spare = 1\n"),
                   "a.prm:4: key 'spare' in subsection 'Constants' is a constant that "
                   "nothing names");
  expect_complaint(with_constants("  set t = 1\n"), "expressions have a variable");
  expect_complaint(with_constants("  set sin = 1\n"), "it is a function");
  expect_complaint(with_constants("  set 2r = 1\n"), "is no name of a constant");
  expect_complaint(with_constants("  set r = 1, 2\n"), "needs one number");
  expect_complaint(with_constants("  set r = 1/0\n"), "is not a finite number");
  expect_complaint(with_constants("  set r = 5 furlongs\n"), "furlongs");
  expect_complaint(replaced(with_constants(usual), "2*r", "2*q"), "needs a number");
  // The unit is held against the key's where the constant is all of the value.
  expect_complaint(replaced(with_constants(usual), "end time = 100", "end time = r"),
                   "unit of something else");
}

/** One scale of temperature, also within formulas; no units in normalised scenes. */
TEST(Constants, KeepTheirUnits)
{
  const std::string kelvin = replaced(
      replaced(with_constants(usual), "temperature = 10", "temperature = 283 K"),
      "= T_cold", "= T_cold + 0*t");
  expect_complaint(kelvin, "a.prm:31: key 'temperature' in subsection "
                           "'Scene/Walls/x_min' is in degC, and another");
  expect_complaint("set units = normalised\n" + with_constants(usual), "(degC)");
}

/** Matter of 1e3 in front of a point is no constant. */
TEST(Constants, DoNotReachIntoNumbers)
{
  const std::string text
      = replaced(with_constants("  set e1 = 7\n  set r = 5 cm\n  set T_cold = -10\n"),
                 "= T_cold", "= T_cold*1.e1 + 0*e1");
  EXPECT_DOUBLE_EQ(read(text).scene.boundary(Side::x_min).value({}, 0), -100);
}
