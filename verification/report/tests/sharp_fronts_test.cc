#include <verification/judge/reference.h>
#include <verification/report/chapters/chapters.h>
#include <verification/report/page/report.h>
#include <verification/report/pictures/scene_picture.h>
#include <verification/report/pictures/tracked_front.h>
#include <verification/report/plots/case_plots.h>
#include <verification/report/plots/curve_labels.h>
#include <verification/report/plots/gnuplot.h>
#include <verification/report/tables/convergence_table.h>
#include <verification/report/tables/cost_at_error.h>
#include <verification/report/tests/fixture.h>
#include <verification/report/tests/well_formed.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

// Cases whose front is perturbed or merges, references without an exact solution, and
// studies of time schemes.

namespace meltfront::verification
{
  namespace
  {
    constexpr double pi = std::numbers::pi;

    FrontFrame circle(double time, double radius)
    {
      FrontFrame frame;
      frame.time = time;
      for(int i = 0; i < 40; ++i)
      {
        frame.x.push_back(radius * std::cos(2 * pi * i / 40));
        frame.y.push_back(radius * std::sin(2 * pi * i / 40));
      }
      return frame;
    }

    StoredCase annulus_case()
    {
      StoredCase record = fixture::plane_case("annulus");
      cases::Scene &scene = record.scene;
      scene.symmetry = cases::Symmetry::none;
      scene.domain = {cases::DomainShape::shell, 2, {}, {}, 1, 0.2};
      scene.boundaries = {};
      for(const cases::Side side : {cases::Side::outer, cases::Side::inner})
        fixture::set_wall(record, side, cases::BoundaryKind::fixed_temperature, "1");
      record.exact = nullptr;
      record.measurement.front_mode = 4;
      record.measurement.intermediate_times = {0.5};
      record.reference = cases::Reference{"fem-fitted", 80};
      return record;
    }

    /** A run on the annulus whose solid's volume is off by factor h^order. */
    RunRecord annulus_run(const std::string &label, int n, double factor, double order)
    {
      RunRecord run = fixture::run("annulus", label, n, 1, 1, 0.01);
      run.quantities.clear();
      run.quantities["solid_volume_end"] = 0.8 + factor * std::pow(1. / n, order);
      run.quantities["front_mode_end"] = 0.05 - factor * std::pow(1. / n, order);
      run.series.front_exact.clear();
      for(const double t : run.series.time)
        run.series.solid_volume.push_back(0.5 + 0.3 * t);
      run.cost.solver_iterations = 4 * run.cost.steps;
      run.cost.most_iterations = 6;
      return run;
    }

    /** A label of a scheme that refines time, with errors of its order in dt. */
    void add_scheme(MatrixResult &result, const std::string &scheme, double order)
    {
      for(const int n : {20, 40, 80, 160, 320})
      {
        RunRecord &run = result.runs.emplace_back(fixture::run(
            "plane", "fem-fitted[refine=time,scheme=" + scheme + "]", n, 1, order, 0.1));
        run.description.spacing = 0.05;
        run.description.time_step = 1. / n;
      }
    }

    MatrixResult sharp_matrix()
    {
      MatrixResult result = fixture::matrix();
      result.cases.push_back(annulus_case());
      for(const int n : {10, 20, 40, 80})
      {
        result.runs.push_back(annulus_run("fem-fitted", n, 2, 3));
        result.runs.back().frames = {circle(0.5, 0.4), circle(1, 0.6)};
        result.runs.push_back(annulus_run("fem-enthalpy", n, 0.3, 1));
        result.runs.back().cost.solver_iterations = 0;
        result.runs.back().cost.most_iterations = 0;
        result.runs.push_back(fixture::run("plane", "fem-fitted[degree=2]", n, 1, 4, 1));
      }
      add_scheme(result, "bdf2", 2);
      add_scheme(result, "radau3", 3);
      compare_with_references(result);
      return result;
    }

    const CaseRuns *runs_of(const std::vector<CaseRuns> &all, const std::string &name)
    {
      for(const CaseRuns &runs : all)
        if(runs.record->name() == name)
          return &runs;
      return nullptr;
    }

    TEST(SharpReport, ShowsReferencesOrdersAndFronts)
    {
      const MatrixResult result = sharp_matrix();
      const fixture::Directory directory;
      write_report(result, directory.path());
      const std::string html = directory.read("report.html");
      EXPECT_EQ(fixture::first_mistake(html), "");
      for(const char *words :
          {"How far the reference can be trusted", "Richardson", "solid_volume_end",
           "front_mode_end", "Orders of the time schemes",
           "Orders of the elements by degree", "time step dt",
           "The front that fem-fitted tracked at n = 80, at t = 0.5, 1",
           "iterations per step", "most in a step", "Volume that is solid against time"})
        EXPECT_NE(html.find(words), std::string::npos) << words;
      EXPECT_TRUE(directory.has("tables/annulus-reference.csv"));
      EXPECT_NE(directory.read("tables/annulus-reference.csv")
                    .find("solid_volume_end,80,0.0125,0.80000390625"),
                std::string::npos)
          << directory.read("tables/annulus-reference.csv");
    }

    TEST(SharpReport, HasNoChapterOfOrdersWithoutSuchLabels)
    {
      const MatrixResult result = fixture::matrix();
      const fixture::Directory directory;
      write_report(result, directory.path());
      EXPECT_EQ(directory.read("report.html").find("Orders of the time schemes"),
                std::string::npos);
    }

    TEST(OrdersTable, FitsOverTheTimeStepWhereThatIsRefined)
    {
      const MatrixResult result = sharp_matrix();
      const auto all = collect_runs(result);
      const CaseRuns *plane = runs_of(all, "plane");
      ASSERT_NE(plane, nullptr);
      const std::string markdown = table_markdown(orders_table(*plane));
      for(const char *words : {"dt^2.00 +- 0.00", "dt^3.00 +- 0.00", "h^4.00 +- 0.00",
                               "h^1.50 +- 0.00", "time", "space"})
        EXPECT_NE(markdown.find(words), std::string::npos) << words << "\n" << markdown;
      const Plot space = error_against_spacing(*plane, MethodStyles({}));
      const Plot time = error_against_time_step(*plane, MethodStyles({}));
      EXPECT_EQ(time.curves.size(), 2u);
      EXPECT_EQ(space.curves.size(), plane->labels.size() - 2);
      EXPECT_EQ(time.curves[0].exponent, "dt^2.00");
      EXPECT_EQ(time.curves[0].label, "bdf2");
      EXPECT_EQ(time.curves[0].x.front(), 0.05);
    }

    TEST(OrdersTable, LeavesLevelsAtRoundOffOutAndSaysSo)
    {
      MatrixResult result;
      result.cases = {fixture::plane_case("plane")};
      for(const int n : {10, 20, 40, 80, 160})
      {
        RunRecord &run = result.runs.emplace_back(
            fixture::run("plane", "fem-fitted[degree=4]", n, 1, 2, 1));
        run.options["degree"] = "4";
        run.quantities["front_rms"] = n == 160 ? 3e-16 : std::pow(1. / n, 6);
      }
      const CaseRuns runs = collect_runs(result, result.cases[0]);
      const OrderFit fit = order_of(result.cases[0], runs.labels[0], "front_rms");
      EXPECT_NEAR(fit.order, 6, 1e-12);
      EXPECT_EQ(fit.left_out, 1);
      EXPECT_EQ(fit.verdict, OrderVerdict::clean);
      EXPECT_NE(table_markdown(convergence_table(runs)).find("1 level at round-off"),
                std::string::npos);
      result.runs.erase(result.runs.begin());
      const CaseRuns fewer = collect_runs(result, result.cases[0]);
      EXPECT_EQ(std::get<std::string>(
                    order_cell(order_of(result.cases[0], fewer.labels[0], "front_rms"))
                        .content),
                "too few levels; 1 level at round-off left out");
    }

    TEST(ConvergenceCsv, HasNewColumnsBehindThosePromised)
    {
      const MatrixResult result = sharp_matrix();
      const auto all = collect_runs(result);
      const std::string csv = convergence_csv(*runs_of(all, "annulus"));
      const std::string head = csv.substr(0, csv.find('\n'));
      EXPECT_TRUE(head.starts_with("method,n,h,unknowns,steps,front_rms,front_end,"))
          << head;
      for(const char *name :
          {"dt", "solid_volume_end", "solid_volume_end_error", "solid_volume_end_bars",
           "front_mode_end_error", "iterations_per_step", "most_iterations"})
        EXPECT_GT(head.find(std::string(",") + name + ","), head.find(",work,")) << name;
    }

    TEST(ConvergenceTable, IsOfTheSolidWhereThereIsNoExactSolution)
    {
      const MatrixResult result = sharp_matrix();
      const auto all = collect_runs(result);
      const CaseRuns *annulus = runs_of(all, "annulus");
      const std::string markdown = table_markdown(convergence_table(*annulus));
      EXPECT_NE(markdown.find("solid's error, end"), std::string::npos) << markdown;
      EXPECT_EQ(markdown.find("front, RMS"), std::string::npos);
      EXPECT_EQ(volume_unit(*annulus->record), "m²");
      // The cost of an error relative to the reference's volume.
      const LabelRuns *enthalpy = annulus->find("fem-enthalpy");
      const WorkPrecision measured = relative_work_precision(*enthalpy, *annulus);
      ASSERT_EQ(measured.error.size(), 4u);
      const double reference = 0.8 + 2 / 512000.;
      EXPECT_NEAR(measured.error[0], (0.8 + 0.03 - reference) / reference, 1e-14);
      EXPECT_EQ(cheapest(*annulus, 1e-2).reach, Reach::coarsest);
      EXPECT_EQ(cheapest(*annulus, 1e-3).reach, Reach::interpolated);
    }

    TEST(TrackedFront, IsDrawnOverTheScene)
    {
      const MatrixResult result = sharp_matrix();
      const auto all = collect_runs(result);
      const CaseRuns *annulus = runs_of(all, "annulus");
      const RunRecord *run = tracked_run(*annulus);
      ASSERT_NE(run, nullptr);
      EXPECT_EQ(run->n, 80);
      SceneContent content;
      content.tracked = run->frames;
      const std::string svg
          = run_gnuplot(scene_picture_script(*annulus->record, content));
      int points = 0;
      for(std::size_t at = svg.find("gpPt6'"); at != std::string::npos;
          at = svg.find("gpPt6'", at + 1))
        ++points;
      EXPECT_EQ(points, 81) << "two frames of 40, and the marker's definition";
      EXPECT_EQ(tracked_run(*runs_of(all, "plane")), nullptr);
    }

    TEST(CurveLabels, KeepWhatTellsCurvesApart)
    {
      Plot plot;
      for(const char *label :
          {"sph", "sph[jitter=0.2]", "fem[degree=1,refine=space]",
           "fem[degree=2,refine=space]", "fem[degree=2,refine=time,scheme=bdf2]"})
        plot.curves.emplace_back().label = label;
      shorten_labels(plot);
      EXPECT_EQ(plot.curves[0].label, "sph");
      EXPECT_EQ(plot.curves[1].label, "sph[jitter=0.2]") << "the only form of its method";
      EXPECT_EQ(plot.curves[2].label, "degree=1, space");
      EXPECT_EQ(plot.curves[3].label, "degree=2, space");
      EXPECT_EQ(plot.curves[4].label, "degree=2, time, bdf2");
    }
  } // namespace
} // namespace meltfront::verification
