#include <cases/reported_scalars.h>
#include <cases/shape.h>
#include <cases/velocity_field.h>
#include <verification/judge/criteria.h>
#include <verification/report/page/case_runs.h>
#include <verification/report/page/report.h>
#include <verification/report/pictures/particle_frames.h>
#include <verification/report/plots/solid_plots.h>
#include <verification/report/tables/ensemble_table.h>
#include <verification/report/tests/fixture.h>
#include <verification/report/tests/well_formed.h>

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace meltfront::verification
{
  namespace
  {

    using fixture::count;

    StoredCase solid_case(const std::string &name)
    {
      StoredCase record;
      record.scene.name = name;
      record.scene.units = "normalised";
      record.scene.problem = cases::ProblemKind::particle_solid;
      record.scene.domain.shape = cases::DomainShape::box;
      record.scene.domain.dimension = 2;
      record.scene.end_time = 10;
      record.title = "A <solid>";
      record.measurement.intermediate_times = {8};
      cases::ParticleSolid solid;
      solid.gravity = 32;
      solid.disturbance = 1e-6;
      solid.base = cases::SolidBase{0.1, cases::HotBase{1, 1.5, 0.025}};
      solid.heating = cases::PointHeating{
          {0.2, 2.5, 0}, {{50000, 0.008}, {50000, 0.0095}}, -2, 2.5};
      record.scene.particle_solid = solid;
      cases::Criterion criterion;
      criterion.text = "greenspan: least_solid at n=3 in 1..2";
      criterion.method = "greenspan";
      criterion.quantity = "least_solid";
      criterion.n = 3;
      criterion.lower = 1;
      criterion.upper = 2;
      record.criteria = {criterion};
      record.printed = {{"A report", "greenspan", "solid_1", 3, 3},
                        {"A report", "greenspan", "least_solid", 3, 1}};
      return record;
    }

    /** A triangle of bonds; the third particle is fluid and fast from step 1 on. */
    ParticleFrame triangle(long step, double fast)
    {
      return {step / 10.,
              step,
              {0, 1, 0.5},
              {0, 0, 0.9},
              {0, 0, fast},
              {0, 0, 0},
              {1, 1, step == 0 ? 1. : 0.}};
    }

    RunRecord solid_run(const std::string &name, std::uint64_t seed)
    {
      RunRecord run;
      run.case_name = name;
      run.method = run.label = "greenspan";
      run.n = 3;
      run.seed = seed;
      run.status = RunStatus::finished;
      run.description.dimension = 2;
      run.description.spacing = 1;
      run.description.time_step = 1e-4;
      run.cost.steps = 100000;
      run.cost.work = 300000;
      run.cost.stepping_cpu = run.cost.stepping_wall = 0.07;
      run.effects = {{cases::Effect::gravity, true, "particles fall with 32"},
                     {cases::Effect::base, true, "there is a floor"}};
      run.quantities
          = {{"solid_1", 3},
             {"least_solid", 1. + static_cast<double>(seed % 3)},
             {"first_break", seed % 2 ? 100. * static_cast<double>(seed) : std::nan("")},
             {"fluid_end_2", seed % 4 == 0},
             {"fluid_end_3", seed % 2 == 0}};
      run.series.time = {0, 5, 10};
      run.series.solid_volume = {3, 3, 1. + static_cast<double>(seed % 3)};
      run.particle_frames = {triangle(0, 0), triangle(80, 8), triangle(100, 7)};
      if(seed == 1)
        for(long step = 0; step < 20; ++step)
          run.animation.push_back(triangle(step, 8));
      return run;
    }

    MatrixResult solids(int seeds)
    {
      MatrixResult result;
      result.name = "solids";
      result.cases = {solid_case("solid")};
      for(int seed = 1; seed <= seeds; ++seed)
        result.runs.push_back(solid_run("solid", static_cast<std::uint64_t>(seed)));
      evaluate(result);
      return result;
    }

    std::string page_of(const MatrixResult &result)
    {
      const fixture::Directory directory;
      write_report(result, directory.path());
      const std::string html = directory.read("report.html");
      EXPECT_EQ(fixture::first_mistake(html), "");
      for(const char *outside : {"http:", "https:", "src=", "<script", "url("})
        EXPECT_EQ(html.find(outside), std::string::npos) << outside;
      return html;
    }
  } // namespace

  TEST(Ensemble, IsMeanSpreadAndStandardErrorOfTheRunsThatHaveTheOutcome)
  {
    const MatrixResult result = solids(12);
    const auto groups = ensemble(result, collect_runs(result, result.cases[0]));
    ASSERT_EQ(groups.size(), 1u);
    ASSERT_EQ(groups[0].rows.size(), 3u); // particles one by one are not asked for
    EXPECT_EQ(groups[0].rows[0].quantity, "solid_1");
    EXPECT_EQ(groups[0].rows[0].meaning, "solid particles at step 80000");
    EXPECT_EQ(groups[0].rows[0].printed, 3);
    EXPECT_TRUE(std::isnan(groups[0].rows[0].printed_deviation())); // none differs
    const EnsembleRow &broken = groups[0].rows[1];
    EXPECT_EQ(broken.quantity, "first_break");
    EXPECT_EQ(broken.runs, 6);
    EXPECT_DOUBLE_EQ(broken.mean, 600);
    EXPECT_DOUBLE_EQ(broken.deviation, std::sqrt(140000.));
    EXPECT_DOUBLE_EQ(broken.standard_error, std::sqrt(140000. / 6));
    EXPECT_TRUE(std::isnan(broken.printed));
    EXPECT_EQ(verdict_of(broken), "");
    const EnsembleRow &least = groups[0].rows[2];
    EXPECT_DOUBLE_EQ(least.mean, 2);
    EXPECT_EQ(verdict_of(least), "PASS");
    EXPECT_NEAR(least.printed_deviation(), -1 / std::sqrt(8. / 11), 1e-12);
    const std::string csv = ensemble_csv(groups);
    EXPECT_NE(csv.find("\"greenspan, n = 3\",least_solid,"), std::string::npos);
    EXPECT_NE(csv.find(",1,2,PASS\n"), std::string::npos);
  }

  TEST(Ensemble, RanksTheParticlesThatAreFluid)
  {
    const MatrixResult result = solids(12);
    const CaseRuns runs = collect_runs(result, result.cases[0]);
    const auto ranked = fluid_particles(runs.labels[0].levels[0]);
    ASSERT_EQ(ranked.size(), 2u);
    EXPECT_EQ(ranked[0].particle, 3);
    EXPECT_EQ(ranked[0].runs, 6);
    EXPECT_EQ(ranked[1].particle, 2);
    EXPECT_DOUBLE_EQ(ranked[1].share, 0.25);
  }

  TEST(Ensemble, SolidParticlesOverTimeHaveABand)
  {
    const MatrixResult result = solids(3);
    const CaseRuns runs = collect_runs(result, result.cases[0]);
    const MethodStyles styles({"greenspan"});
    const Plot plot = solid_particles_over_time(runs, styles);
    ASSERT_EQ(plot.curves.size(), 2u);
    EXPECT_TRUE(plot.curves[0].band);
    EXPECT_DOUBLE_EQ(plot.curves[0].y.back(), 2);
    EXPECT_DOUBLE_EQ(plot.curves[0].spread.back(), 1);
    EXPECT_EQ(plot.curves[1].x, std::vector<double>{8}); // the printed frame
    EXPECT_NE(plot_script(plot).find("filledcurves"), std::string::npos);
  }

  TEST(Ensemble, EnergyFallsWithTheSquareOfTheStep)
  {
    MatrixResult result = solids(0);
    for(const double factor : {2., 1., 0.5})
    {
      RunRecord &run = result.runs.emplace_back(solid_run("solid", 1));
      run.label = fmt::format("greenspan[step_factor={}]", factor);
      run.description.time_step = 1e-4 * factor;
      run.quantities = {{"energy_error", factor * factor}};
    }
    const CaseRuns runs = collect_runs(result, result.cases[0]);
    const Table table = energy_table(runs);
    ASSERT_EQ(table.groups.at(0).rows.size(), 3u);
    EXPECT_EQ(std::get<NumberText>(table.groups[0].rows[0][2].content).digits, "4.000");
    EXPECT_EQ(energy_over_time_step(runs, MethodStyles({"greenspan[step_factor=2]"}))
                  .curves[0]
                  .exponent,
              "dt^2.00");
  }

  TEST(Ensemble, StagesJoinEnergyAndTemperature)
  {
    MatrixResult result = solids(0);
    for(const int seed : {1, 2})
    {
      RunRecord &run = result.runs.emplace_back(solid_run("solid", seed));
      run.quantities = {{"temperature_stage_1", 30},
                        {"temperature_stage_2", 20. + seed},
                        {"temperature_stage_3", 46},
                        {"energy_stage_1", -110},
                        {"energy_stage_2", -120 + seed}};
    }
    const Plot plot = energy_over_temperature(collect_runs(result, result.cases[0]),
                                              MethodStyles({"greenspan"}));
    ASSERT_EQ(plot.curves.size(), 1u);
    EXPECT_EQ(plot.curves[0].x, (std::vector<double>{30, 21.5}));
    EXPECT_EQ(plot.curves[0].y, (std::vector<double>{-110, -118.5}));
    EXPECT_EQ(plot.curves[0].spread[0], 0);
    EXPECT_NEAR(plot.curves[0].spread[1], std::sqrt(0.5), 1e-12);
  }

  TEST(ParticleFrames, DrawBondsOfSolidsAndArrowsOfFastFluid)
  {
    const StoredCase record = solid_case("solid");
    const std::vector<ParticleFrame> frames
        = {triangle(0, 0), triangle(1, 8), triangle(2, 7)};
    const FrameDrawing drawing(record, frames, DrawingColours::of_file());
    const auto lines
        = [&](const ParticleFrame &frame) { return count(drawing.frame(frame), "L"); };
    EXPECT_EQ(lines(frames[0]), 3u);     // the triangle's bonds
    EXPECT_EQ(lines(frames[1]), 1u + 3); // one bond, an arrow's shaft and its head
    EXPECT_EQ(lines(frames[2]), 1u);     // fluid, but slow
    EXPECT_EQ(count(drawing.frame(frames[0]), "<text"), 4u); // three numbers, one line
    EXPECT_NE(drawing.frame(frames[1]).find("step 1: 2 solid"), std::string::npos);
    EXPECT_EQ(count(drawing.background(), "<polygon"), 1u); // the source
    const std::string file = frames_as_file(record, frames);
    EXPECT_EQ(fixture::first_mistake(file.substr(file.find("<svg"))), "");
    EXPECT_EQ(count(file, "step "), 3u);
  }

  TEST(ParticleFrames, LeaveOutNumbersOfLargeSolidsAndSayWhoFlewAway)
  {
    ParticleFrame many = triangle(0, 0), later;
    for(int i = 0; i < 60; ++i)
      for(auto *values : {&many.x, &many.y, &many.velocity_x, &many.velocity_y})
        values->push_back(0.01 * i);
    many.solid.resize(many.x.size(), 1);
    later = many;
    later.x[0] = -50;
    const StoredCase record = solid_case("solid");
    const FrameDrawing drawing(record, {many, later}, DrawingColours::of_file());
    EXPECT_EQ(count(drawing.frame(many), "<text"), 1u);
    EXPECT_EQ(drawing.frame(many).find("out of"), std::string::npos);
    EXPECT_NE(drawing.frame(later).find("1 out of the picture"), std::string::npos);
  }

  TEST(MovingReport, OfHundredsOfRunsIsNoLargerThanOfAFew)
  {
    const std::string few = page_of(solids(10)), many = page_of(solids(300));
    EXPECT_LT(many.size(), few.size() + 2000);
    EXPECT_LT(many.size(), 400000u);
    EXPECT_NE(many.find("1 to 300"), std::string::npos); // the seeds
    EXPECT_NE(many.find("What many runs say together"), std::string::npos);
    EXPECT_NE(many.find("particle 3: 150 of 300 runs (50 %)"), std::string::npos);
  }

  TEST(MovingReport, OfSolidsHasNothingOfHeat)
  {
    const std::string html = page_of(solids(4));
    for(const char *absent :
        {"Convergence", "Exact solution", "Work-precision", "phase change",
         "wall temperature", "Stefan condition", "budget"})
      EXPECT_EQ(html.find(absent), std::string::npos) << absent;
    for(const char *present :
        {"(2.1–3)", "(5.1)", "(4.1)", "50\u2009000 steps", "What the runs cost",
         "@keyframes turn-20", "prefers-reduced-motion", "A &lt;solid&gt;"})
      EXPECT_NE(html.find(present), std::string::npos) << present;
    EXPECT_EQ(count(html, "class=\"turn\""), 20u);
  }

  TEST(MovingReport, WithoutAnyFinishedRun)
  {
    MatrixResult result = solids(5);
    for(RunRecord &run : result.runs)
    {
      run.status = RunStatus::failed;
      run.message = "energy grew";
      run.particle_frames.clear();
    }
    const std::string html = page_of(result);
    EXPECT_EQ(count(html, "5 runs: "), 1u); // one line for all
  }

  TEST(MovingReport, ARunOfASolidHasItsLastFrameAsPicture)
  {
    const fixture::Directory directory;
    write_run_page(solid_run("solid", 1), solid_case("solid"), directory.path());
    const std::string svg = directory.read("picture.svg");
    EXPECT_EQ(count(svg, "step "), 1u);
    EXPECT_NE(svg.find("step 100"), std::string::npos);
  }

  TEST(MovingReport, OfACarriedFrontShowsItOverTheExactOne)
  {
    MatrixResult result;
    result.name = "fronts";
    StoredCase record = solid_case("disk");
    record.scene.problem = cases::ProblemKind::interface_advection;
    record.scene.domain.upper = {1, 1, 0};
    record.criteria.clear();
    record.printed.clear();
    record.scene.particle_solid.reset();
    record.scene.interface = cases::InterfaceAdvection{
        std::make_shared<cases::Ball>(2, cases::Position{0.5, 0.5, 0}, 0.2),
        std::make_shared<cases::RigidMotion>(cases::Position{}, 0, cases::Position{})};
    FrontFrame edge;
    edge.time = 10;
    for(int i = 0; i < 40; ++i)
      for(const int end : {i, i + 1})
      {
        edge.x.push_back(0.5 + 0.2 * std::cos(std::numbers::pi * end / 20));
        edge.y.push_back(0.5 + 0.2 * std::sin(std::numbers::pi * end / 20));
      }
    result.cases = {record};
    for(const int n : {20, 40, 80, 160})
    {
      RunRecord run = solid_run("disk", 2);
      run.particle_frames.clear();
      run.label = run.method = "level-set";
      run.n = n;
      run.description.spacing = 1. / n;
      run.quantities = {{"shape_mismatch_end", 4. / n / n},
                        {"volume_error_end", -1. / n},
                        {"front_l1_end", 0.3 / n},
                        {"curvature_rms_end", std::nan("")}};
      run.frames = {edge};
      result.runs.push_back(run);
    }
    const std::string html = page_of(result);
    for(const char *present : {"disk of radius 0.2", "mismatch, end", "front, L1, end",
                               "Fronts over the exact ones", "Work-precision", "2.00"})
      EXPECT_NE(html.find(present), std::string::npos) << present;
    for(const char *absent : {"curvature, RMS", "Stefan", "Temperature"})
      EXPECT_EQ(html.find(absent), std::string::npos) << absent;
    EXPECT_EQ(main_error(record), "shape_mismatch_end");
  }
} // namespace meltfront::verification
