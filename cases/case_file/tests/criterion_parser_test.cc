#include <cases/case_file/criterion_parser.h>
#include <cases/error.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace meltfront::cases;

TEST(Criterion, TakesBoundsThatAreWholeNumbers)
{
  const Criterion criterion = parse_criterion("sph: front_rms at n=46 in 29..35");
  EXPECT_EQ(criterion.lower, 29);
  EXPECT_EQ(criterion.upper, 35);
}

TEST(Criterion, BoundsAValueAtOneN)
{
  const Criterion c = parse_criterion("sph: front_rms at n=40 <= 1.755e-3");
  EXPECT_EQ(c.method, "sph");
  EXPECT_EQ(c.quantity, "front_rms");
  EXPECT_EQ(c.statistic, Statistic::value);
  EXPECT_EQ(c.n, 40);
  EXPECT_EQ(c.upper, 1.755e-3);
  EXPECT_TRUE(std::isinf(c.lower));
  EXPECT_EQ(c.text, "sph: front_rms at n=40 <= 1.755e-3");
  EXPECT_TRUE(c.expected_failure.empty());
}

TEST(Criterion, MayBeOnAnyMethod)
{
  const Criterion c = parse_criterion("any method: worst budget_defect <= 1e-12");
  EXPECT_EQ(c.method, any_method);
  EXPECT_EQ(c.statistic, Statistic::worst);
  EXPECT_THROW(parse_criterion("any other: worst budget_defect <= 1e-12"), InputError);
  EXPECT_THROW(parse_label("any method"), InputError);
}

TEST(Criterion, TakesRangesAndShares)
{
  const Criterion range = parse_criterion("sph-2005: fraction at n = 40 in 0.656..0.666");
  EXPECT_EQ(range.lower, 0.656);
  EXPECT_EQ(range.upper, 0.666);
  const Criterion share = parse_criterion("a: q at n=20 within 15 % of 0.01063");
  EXPECT_DOUBLE_EQ(share.lower, 0.85 * 0.01063);
  EXPECT_DOUBLE_EQ(share.upper, 1.15 * 0.01063);
  const Criterion negative = parse_criterion("a: q at n=20 within 10% of -2");
  EXPECT_DOUBLE_EQ(negative.lower, -2.2);
  EXPECT_DOUBLE_EQ(negative.upper, -1.8);
}

TEST(Criterion, TakesAFailureThatIsKnown)
{
  const Criterion c = parse_criterion("sph-2005[step_factor=2]: fails at n=60");
  EXPECT_EQ(c.statistic, Statistic::failure);
  EXPECT_EQ(c.method, "sph-2005[step_factor=2]");
  EXPECT_EQ(c.n, 60);
  EXPECT_THROW(parse_criterion("sph: fails at n=60 <= 1"), InputError);
  EXPECT_THROW(parse_criterion("sph: fails"), InputError);
}

TEST(Criterion, TakesTheMedianOfTheSeeds)
{
  const Criterion c = parse_criterion("sph: median front_rms at n=20 in 1 .. 2");
  EXPECT_EQ(c.statistic, Statistic::median);
  EXPECT_EQ(c.quantity, "front_rms");
  EXPECT_EQ(c.n, 20);
  EXPECT_EQ(c.upper, 2);
  EXPECT_THROW(parse_criterion("sph: median front_rms <= 2"), InputError);
}

TEST(Criterion, TakesOrdersAndWorstValues)
{
  const Criterion order = parse_criterion("sph: order of front_rms >= 1.25");
  EXPECT_EQ(order.statistic, Statistic::order);
  EXPECT_EQ(order.lower, 1.25);
  EXPECT_EQ(order.n_from, 0);
  const Criterion rows = parse_criterion("sph: order of front_rms over n=20..50 in 1.35 "
                                         ".. 1.75");
  EXPECT_EQ(rows.n_from, 20);
  EXPECT_EQ(rows.n_to, 50);
  EXPECT_EQ(rows.lower, 1.35);
  const Criterion worst = parse_criterion("fem-enthalpy: worst budget_defect <= 1e-12");
  EXPECT_EQ(worst.statistic, Statistic::worst);
  EXPECT_EQ(worst.method, "fem-enthalpy");
  EXPECT_EQ(worst.upper, 1e-12);
}

TEST(Criterion, TakesALabelWithOptions)
{
  const Criterion c = parse_criterion(
      "fem-fitted[degree=2, time=bdf3]: order of front_end >= 3.5; expected failure: 3.");
  EXPECT_EQ(c.method, "fem-fitted[degree=2, time=bdf3]");
  EXPECT_EQ(c.quantity, "front_end");
  EXPECT_EQ(c.lower, 3.5);
  EXPECT_EQ(parse_label(" a[k=1e-3,l=x] "), "a[k=1e-3,l=x]");
  for(const char *label : {"", "[k=1]", "a[", "a[]", "a]", "a[k]", "a[k=]", "a[=1]",
                           "a[k=1]b", "a[k=1][l=2]", "a b", "a[k=1,]"})
    EXPECT_THROW(parse_label(label), InputError) << label;
}

TEST(Criterion, IsTheWorstOfAnyValueOfAnOption)
{
  EXPECT_EQ(parse_criterion("sph[kernel=*, jitter=0.2]: worst front_rms <= 1").method,
            "sph[kernel=*, jitter=0.2]");
  for(const char *bad : {"sph[kernel=*]: order of front_rms >= 1",
                         "sph[kernel = *]: front_rms at n=20 <= 1"})
    EXPECT_THROW(parse_criterion(bad), InputError) << bad;
}

TEST(Criterion, KeepsAnExpectedFailure)
{
  const Criterion c = parse_criterion(
      "sph: order of front_rms >= 1.25 ; expected failure: 1.1; the mesh: it stalls.");
  EXPECT_EQ(c.expected_failure, "1.1; the mesh: it stalls.");
  EXPECT_EQ(c.lower, 1.25);
}

TEST(Criterion, RefusesWhatItCannotReadAndSaysWhatIsWanted)
{
  const auto complaint = [](const std::string &text)
  {
    try
    {
      parse_criterion(text);
    }
    catch(const InputError &error)
    {
      return std::string(error.what());
    }
    return std::string("no complaint");
  };
  EXPECT_EQ(
      complaint("sph front_rms at n=40 <= 1"),
      "'sph front_rms at n=40 <= 1' cannot be read: 'METHOD:' is wanted before 'sph "
      "front_rms at n=40 <= 1'");
  EXPECT_EQ(complaint("sph: front_rms at n=40"),
            "'sph: front_rms at n=40' cannot be read: '<=', '>=', 'in' or 'within' is "
            "wanted at its end");
  EXPECT_EQ(complaint("sph: front_rms at n=40 <= small"),
            "'sph: front_rms at n=40 <= small' cannot be read: a number is wanted before "
            "'small'");
  EXPECT_EQ(complaint("sph: q at n=4 in 2 .. 1"), "'sph: q at n=4 in 2 .. 1' can never "
                                                  "hold: its lower bound exceeds the "
                                                  "upper one");
  for(const char *broken :
      {"", ":", "sph:", "sph: q", "sph: q at n=0 <= 1", "sph: q at n=-4 <= 1",
       "sph: q at n=4.5 <= 1", "sph: q <= 1", "sph: q at n=4 < 1", "sph: q at n=4 <= nan",
       "sph: q at n=4 <= 1 more", "sph: q at n=4 <= 1;", "sph: worst q at n=4 <= 1",
       "sph: q at n=4 <= 1; expected failure:", "sph: q at n=4 within 5 of 1",
       "sph: order of q over n=50..20 >= 1", "sph: orderly of q >= 1"})
    EXPECT_NE(complaint(broken), "no complaint") << broken;
  EXPECT_NE(complaint(std::string(5000, 'a')), "no complaint");
}

TEST(PrintedValue, NamesPaperAndTable)
{
  const PrintedValue v
      = parse_printed_value("sph-2005: q at n=20 = 0.01063 (Table 1, Error-1)", "A 2005");
  EXPECT_EQ(v.source, "A 2005, Table 1, Error-1");
  EXPECT_EQ(v.method, "sph-2005");
  EXPECT_EQ(v.quantity, "q");
  EXPECT_EQ(v.n, 20);
  EXPECT_EQ(v.value, 0.01063);
  EXPECT_EQ(parse_printed_value("m: q at n=20 = 1", "A").source, "A");
  EXPECT_THROW(parse_printed_value("m: q at n=20 = 1 (Table", "A"), InputError);
  EXPECT_THROW(parse_printed_value("m: q at n=20 <= 1", "A"), InputError);
  EXPECT_THROW(parse_printed_value("m: q at n=20 = 1 Table", "A"), InputError);
}
