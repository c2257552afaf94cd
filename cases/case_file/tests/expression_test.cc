#include <cases/case_file/expression.h>
#include <cases/error.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <thread>
#include <vector>

using namespace meltfront::cases;

namespace
{
  std::string complaint(const std::string &expression,
                        const std::string &variables = "xyzt")
  {
    try
    {
      parse_field(expression, variables);
    }
    catch(const InputError &error)
    {
      return error.what();
    }
    return "no complaint";
  }
} // namespace

TEST(Expression, ConstantsAreUniformFields)
{
  const Field field = parse_field("2*pi - 1e-3 + sqrt(4)", "xt");
  EXPECT_TRUE(field.constant);
  EXPECT_EQ(field({7, 8, 9}, 10), 2 * std::numbers::pi - 1e-3 + 2);
  EXPECT_EQ(field.expression, "2*pi - 1e-3 + sqrt(4)");
  EXPECT_EQ(parse_field("0.190602422788870409", "")({}, 0), 0.190602422788870409);
  EXPECT_TRUE(parse_field("exp(1)", "xyzt").constant);
}

TEST(Expression, VariablesVary)
{
  const Field field = parse_field("x + 10*y + 100*z + 1000*t", "xyzt");
  EXPECT_FALSE(field.constant);
  EXPECT_EQ(field({1, 2, 3}, 4), 4321);
  EXPECT_DOUBLE_EQ(parse_field("log(x) + ln(x)", "x")({std::numbers::e, 0, 0}, 0), 2);
  EXPECT_DOUBLE_EQ(parse_field("x^2 - pow(x, 3)", "x")({3, 0, 0}, 0), -18);
  const Field step = parse_field("if(x > 0.49 && x < 0.515, 0.01, -0.1)", "x");
  EXPECT_EQ(step({0.5, 0, 0}, 0), 0.01);
  EXPECT_EQ(step({0.3, 0, 0}, 0), -0.1);
}

TEST(Expression, KnowsItsFunctions)
{
  const double x = 0.6;
  const std::vector<std::pair<const char *, double>> values{
      {"sin(x)", std::sin(x)},
      {"cos(x)", std::cos(x)},
      {"tan(x)", std::tan(x)},
      {"asin(x)", std::asin(x)},
      {"acos(x)", std::acos(x)},
      {"atan(x)", std::atan(x)},
      {"atan2(x, 2)", std::atan2(x, 2)},
      {"sinh(x)", std::sinh(x)},
      {"cosh(x)", std::cosh(x)},
      {"tanh(x)", std::tanh(x)},
      {"exp(x)", std::exp(x)},
      {"ln(x)", std::log(x)},
      {"log(x)", std::log(x)},
      {"log10(x)", std::log10(x)},
      {"sqrt(x)", std::sqrt(x)},
      {"abs(-x)", x},
      {"min(x, 1)", x},
      {"max(x, 1)", 1},
      {"pow(x, 2)", x * x},
      {"erfc(x)", std::erfc(x)},
      {"if(x < 1 || x > 2, 2, 3)", 2},
      {"floor(x)", 0},
      {"ceil(x)", 1},
      {"sign(-x)", -1},
      {"-x^2", -x * x},
      {"x < 1 ? 2 : 3", 2}};
  for(const auto &[expression, value] : values)
    EXPECT_DOUBLE_EQ(parse_field(expression, "x")({x, 0, 0}, 0), value) << expression;
}

TEST(Expression, SaysWhatIsWrong)
{
  EXPECT_EQ(complaint("sinn(x)"), "holds the unknown name 'sinn'; the nearest is 'sin'");
  EXPECT_EQ(complaint("x + z", "xt"), "depends on z, which it may not here");
  EXPECT_EQ(complaint(""), "needs an expression, not an empty one");
  EXPECT_EQ(complaint("1; 2"), "holds ';', which no expression does");
  EXPECT_EQ(complaint("x = 3"), "holds a single '=', which assigns and does not compare");
  for(const char *list : {"1,2", "(0,5)", "0,5*x", "sin(x),1", "max(1, (2, 3))"})
    EXPECT_EQ(complaint(list), "holds a comma that separates no arguments of a function");
  EXPECT_EQ(complaint("max(1, min(2, (3)))"), "no complaint");
  EXPECT_EQ(complaint("1/0"), "is not a finite number but inf");
  EXPECT_EQ(complaint("sqrt(-1)").substr(0, 28), "is not a finite number but -");
  for(const char *broken :
      {"1 +", "(1", "1)", "sin", "1 2", "x x", "sin()", "pow(1)", ".", "1..2", "if(1, 2)",
       "&&", "1 ? 2", "1,2", "!x", "rand()"})
  {
    EXPECT_NE(complaint(broken), "no complaint") << broken;
    EXPECT_EQ(complaint(broken).find('\n'), std::string::npos) << broken;
  }
  EXPECT_NE(complaint(std::string(500, '(') + "1" + std::string(499, ')')),
            "no complaint");
  EXPECT_NE(complaint(std::string(100000, '1')), "no complaint");
}

TEST(Expression, SeveralThreadsMayEvaluateAtOnce)
{
  const Field field = parse_field("x*exp(-t) + y", "xyzt");
  std::vector<int> wrong(4, 0);
  std::vector<std::thread> threads;
  for(int k = 0; k < 4; ++k)
    threads.emplace_back(
        [&field, &wrong, k]
        {
          for(int i = 0; i < 5000; ++i)
            wrong[k]
                += field({i * 1., k * 1., 0}, i * 1e-3) != i * std::exp(-i * 1e-3) + k;
        });
  for(std::thread &thread : threads)
    thread.join();
  EXPECT_EQ(wrong, std::vector<int>(4, 0));
}

TEST(IntegralFrom, IsExactForSmoothAndSharpForKinkedFunctions)
{
  const auto cubic = integral_from([](double t) { return t * t * t; }, 1, 3);
  EXPECT_NEAR(cubic(3), 20, 20e-14);
  EXPECT_NEAR(cubic(2), 3.75, 4e-14);
  EXPECT_EQ(cubic(1), 0);
  const auto root = integral_from([](double t) { return std::sqrt(t); }, 0, 9);
  EXPECT_NEAR(root(9), 18, 18e-10);
  EXPECT_NEAR(root(0.01), 2e-3 / 3, 1e-11);
  const auto step = integral_from([](double t) { return t < 0.337 ? 1. : 3.; }, 0, 1);
  EXPECT_NEAR(step(1), 0.337 + 3 * 0.663, 1e-5);
}

TEST(IntegralFrom, DifferencesTelescope)
{
  const auto energy = integral_from([](double t) { return std::sin(40 * t) + 2; }, 0, 1);
  double sum = 0;
  for(int i = 0; i < 1000; ++i)
    sum += energy((i + 1) * 1e-3) - energy(i * 1e-3);
  EXPECT_NEAR(sum, (1 - std::cos(40.)) / 40 + 2, 1e-12);
}
