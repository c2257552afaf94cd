#include <verification/report/pictures/scene_picture.h>
#include <verification/report/tables/convergence_table.h>
#include <verification/report/tables/cost_at_error.h>
#include <verification/report/tests/fixture.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>
#include <tuple>

namespace meltfront::verification
{
  namespace
  {
    std::vector<std::string> split(const std::string &line)
    {
      std::vector<std::string> fields;
      std::stringstream stream(line);
      for(std::string field; std::getline(stream, field, ',');)
        fields.push_back(field);
      return fields;
    }

    /** Rows of a CSV without quotes, by the names of its columns. */
    std::vector<std::map<std::string, std::string>> parse(const std::string &csv)
    {
      std::stringstream stream(csv);
      std::string line;
      std::getline(stream, line);
      const auto names = split(line);
      std::vector<std::map<std::string, std::string>> rows;
      while(std::getline(stream, line))
      {
        const auto fields = split(line);
        EXPECT_EQ(fields.size(), names.size()) << line;
        for(std::size_t i = 0; i < names.size() && i < fields.size(); ++i)
          (i == 0 ? rows.emplace_back() : rows.back())[names[i]] = fields[i];
      }
      return rows;
    }
  } // namespace

  TEST(ConvergenceCsv, BeginsWithThePromisedColumns)
  {
    const MatrixResult result = fixture::matrix();
    const std::string csv = convergence_csv(collect_runs(result, result.cases[0]));
    const std::string head = csv.substr(0, csv.find('\n'));
    EXPECT_TRUE(head.starts_with(
        "method,n,h,unknowns,steps,front_rms,front_end,front_isotherm_rms,"
        "temperature_l2,temperature_max,budget_defect,cpu_seconds,wall_seconds,"
        "peak_memory_mb,work,front_max_ice_rms,front_heat_loss_rms,"
        "front_late_max_relative,front_end_relative,"))
        << head;
    EXPECT_TRUE(head.ends_with(",status")) << head;
  }

  TEST(ConvergenceCsv, HoldsTheValuesOfEveryRun)
  {
    const MatrixResult result = fixture::matrix();
    const auto rows = parse(convergence_csv(collect_runs(result, result.cases[0])));
    ASSERT_EQ(rows.size(), 14u);
    for(std::size_t i = 0; i < 4; ++i)
    {
      const double n = std::stod(rows[i].at("n"));
      EXPECT_EQ(rows[i].at("method"), "sph");
      EXPECT_NEAR(std::stod(rows[i].at("front_rms")), 0.5 * std::pow(n, -1.5), 1e-14);
      EXPECT_NEAR(std::stod(rows[i].at("cpu_seconds")), 0.01 * n * n / 400, 1e-12);
      EXPECT_EQ(rows[i].at("front_isotherm_rms"), "nan");
      EXPECT_EQ(rows[i].at("status"), "finished");
    }
    EXPECT_EQ(rows[4].at("n"), "320");
    EXPECT_EQ(rows[4].at("status"), "failed");
    EXPECT_EQ(rows[4].at("front_rms"), "nan");
  }

  TEST(ConvergenceCsv, LabelsWithCommasAreQuoted)
  {
    EXPECT_EQ(csv_field("sph[a=1,b=2]"), "\"sph[a=1,b=2]\"");
    EXPECT_EQ(csv_field("say \"x\",y"), "\"say \"\"x\"\",y\"");
    EXPECT_EQ(csv_field("sph"), "sph");
  }

  TEST(ConvergenceCsv, SeedsAreAveraged)
  {
    const MatrixResult result = fixture::matrix();
    const CaseRuns runs = collect_runs(result, result.cases[1]);
    const LabelRuns *jittered = runs.find("sph[jitter=0.2]");
    ASSERT_NE(jittered, nullptr);
    const Level &level = jittered->levels[0];
    EXPECT_EQ(level.runs.size(), 2u);
    EXPECT_NEAR(level.value("front_rms"), 0.5 * std::pow(20., -1.5), 1e-15);
    // Two values apart by 0.2: their sample deviation is 0.2 / sqrt(2).
    EXPECT_NEAR(level.spread("front_rms"), 0.2 / std::sqrt(2.) * std::pow(20., -1.5),
                1e-15);
    const auto rows = parse(convergence_csv(runs));
    EXPECT_EQ(rows[4].at("seeds"), "2");
  }

  TEST(ConvergenceTable, OrdersOfKnownSequences)
  {
    const MatrixResult result = fixture::matrix();
    const CaseRuns runs = collect_runs(result, result.cases[0]);
    EXPECT_NEAR(order_of(*runs.record, runs.labels[0], "front_rms").order, 1.5, 1e-12);
    const std::string markdown = table_markdown(convergence_table(runs));
    EXPECT_NE(markdown.find("h^1.50 +- 0.00"), std::string::npos);
    EXPECT_NE(markdown.find("h^2.00 +- 0.00"), std::string::npos);
    EXPECT_NE(markdown.find("h^1.00 +- 0.00"), std::string::npos);
  }

  TEST(ConvergenceTable, LeastErrorIsBestAndEmptyColumnsAreLeftOut)
  {
    const MatrixResult result = fixture::matrix();
    const std::string markdown
        = table_markdown(convergence_table(collect_runs(result, result.cases[0])));
    EXPECT_NE(markdown.find("**3.91e-5**"), std::string::npos) << markdown; // 1/160^2
    EXPECT_EQ(markdown.find("isotherm"), std::string::npos);
    EXPECT_EQ(markdown.find("frozen"), std::string::npos);
  }

  TEST(ConvergenceTable, FewerThanFourLevelsGiveNoOrder)
  {
    MatrixResult result;
    result.cases = {fixture::plane_case("plane")};
    for(const int n : {20, 40, 80})
      result.runs.push_back(fixture::run("plane", "sph", n, 1, 2, 1));
    const Table table = convergence_table(collect_runs(result, result.cases[0]));
    EXPECT_EQ(table.groups[0].rows.size(), 3u);
    EXPECT_TRUE(table.groups[0].summary.empty());
    EXPECT_EQ(pairwise_table(collect_runs(result, result.cases[0])).groups[0].rows.size(),
              2u);
  }

  TEST(PrintedTable, DeviationAndOrderOfBoth)
  {
    const MatrixResult result = fixture::matrix();
    const CaseRuns runs = collect_runs(result, result.cases[1]);
    EXPECT_NE(
        printed_csv(runs).find("\"A paper <1999>, Table 1\",sph-2005,front_rms,20,0.025,"
                               "0.0275,10\n"),
        std::string::npos)
        << printed_csv(runs);
    const std::string markdown = table_markdown(printed_table(runs));
    EXPECT_NE(markdown.find("+10.0"), std::string::npos) << markdown;
    EXPECT_NE(markdown.find("n^-1.00 +- 0.00"), std::string::npos) << markdown;
  }

  TEST(PrintedTable, ShowsAsManyDigitsAsThePaper)
  {
    MatrixResult result;
    result.cases = {fixture::plane_case("plane")};
    result.cases[0].printed = {{"P", "sph", "front_rms", 20, 0.01063}};
    const std::string markdown
        = table_markdown(printed_table(collect_runs(result, result.cases[0])));
    EXPECT_NE(markdown.find("0.01063"), std::string::npos) << markdown;
    EXPECT_NE(markdown.find("n/a"), std::string::npos);
  }

  TEST(Picture, FinestRunThatIsStillReadable)
  {
    MatrixResult result;
    result.cases = {fixture::sink_case("sink")};
    for(const auto &[label, n, sites] : {std::tuple("sph-2005", 50, 2500),
                                         {"sph", 20, 400},
                                         {"sph", 50, 2500},
                                         {"sph", 80, 6000},
                                         {"fem-enthalpy", 1024, 0}})
    {
      RunRecord &run = result.runs.emplace_back(fixture::run("sink", label, n, 1, 1, 1));
      run.profile.picture_x.assign(sites, 0);
      run.profile.picture_y.assign(sites, 0);
    }
    const RunRecord *best = run_to_picture(collect_runs(result, result.cases[0]));
    ASSERT_NE(best, nullptr);
    EXPECT_EQ(best->label, "sph");
    EXPECT_EQ(best->n, 50);
    result.runs.resize(0);
    EXPECT_EQ(run_to_picture(collect_runs(result, result.cases[0])), nullptr);
  }

  TEST(CostAtError, KnownAnswer)
  {
    // error = 1 / cost: 1e-3 costs 1000.
    const WorkPrecision measured{{1e-1, 1e-2, 1e-4}, {10, 100, 10000}};
    const CostAtError found = cost_at_error(measured, 1e-3);
    EXPECT_EQ(found.reach, Reach::interpolated);
    EXPECT_NEAR(found.cost, 1000, 1e-9);
    EXPECT_NEAR(cost_at_error(measured, 1e-2).cost, 100, 1e-10);
  }

  TEST(CostAtError, NothingIsExtrapolated)
  {
    const WorkPrecision measured{{1e-1, 1e-2}, {10, 100}};
    EXPECT_EQ(cost_at_error(measured, 9e-3).reach, Reach::not_reached);
    const CostAtError coarsest = cost_at_error(measured, 0.5);
    EXPECT_EQ(coarsest.reach, Reach::coarsest);
    EXPECT_DOUBLE_EQ(coarsest.cost, 10);
    EXPECT_EQ(cost_at_error({}, 1).reach, Reach::not_reached);
  }

  TEST(CostAtError, AnAccidentalDipDoesNotCount)
  {
    const WorkPrecision measured{{1e-1, 1e-5, 1e-2, 1e-3}, {1, 10, 100, 1000}};
    const CostAtError found = cost_at_error(measured, 5e-3);
    EXPECT_GT(found.cost, 100);
    EXPECT_LT(found.cost, 1000);
  }

  TEST(CostAtError, LevelsThatAreNoNumbersAreLeftOut)
  {
    const double nan = std::nan("");
    const WorkPrecision measured{{1e-1, nan, 1e-3, 0}, {10, 50, 1000, 2000}};
    EXPECT_NEAR(cost_at_error(measured, 1e-2).cost, 100, 1e-9);
  }

  TEST(CostAtError, CheapestOfSeveralMethods)
  {
    // Relative errors: sph 1.25 h^1.5 at 0.01 (n/20)^2 s, fem 2.5 h^2 at 0.02 (n/20)^2 s.
    const MatrixResult result = fixture::matrix();
    const CaseRuns runs = collect_runs(result, result.cases[0]);
    const CostAtError found = cheapest(runs, 1e-3);
    EXPECT_EQ(found.label, "fem-enthalpy");
    EXPECT_NEAR(found.cost, 0.02 * 2500 / 400, 1e-12); // 2.5 / n^2 = 1e-3: n = 50
    EXPECT_EQ(cheapest(runs, 1e-9).reach, Reach::not_reached);
  }
} // namespace meltfront::verification
